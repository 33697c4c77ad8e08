// State files that are truncated, damaged, foreign or made to do harm: always one InputError that names file and
// object.
#include "base/error.hpp"
#include "output/hdf5File.hpp"
#include "output/stateFile.hpp"
#include "support/fileContents.hpp"
#include "support/sampleState.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mpm;
using namespace mpm::output;
using mpm::tests::contents;
using mpm::tests::sampleState;
using mpm::tests::TemporaryFolder;
using mpm::tests::writeContents;
namespace fs = std::filesystem;

namespace
{
std::string refusal(const fs::path& file)
{
    try
    {
        readState(file);
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "accepted";
}
} // namespace

TEST_CASE("a file cut anywhere is refused by name")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 30));
    const std::string whole = contents(folder / "1/state.h5");
    const fs::path cut = folder / "cut.h5";
    for (std::size_t keep = 0; keep < whole.size(); keep += 97)
    {
        writeContents(cut, whole.substr(0, keep));
        const std::string message = refusal(cut);
        INFO("kept " << keep << " of " << whole.size() << " bytes: " << message);
        CHECK(message.find(cut.string()) == 0);
    }
    writeContents(cut, whole.substr(0, whole.size() - 1));
    CHECK(refusal(cut).find(cut.string()) == 0);
}

TEST_CASE("flipped bytes end in a state or one InputError, never in anything else")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 20));
    const std::string whole = contents(folder / "1/state.h5");
    const fs::path damaged = folder / "damaged.h5";
#ifdef __SANITIZE_ADDRESS__ // forks slowly; tests/fuzz does more of this
    const std::size_t stride = 477;
#else
    const std::size_t stride = 53;
#endif
    int refused = 0, tried = 0;
    for (std::size_t at = 0; at < whole.size(); at += stride, ++tried)
    {
        std::string bytes = whole;
        bytes[at] = char(bytes[at] ^ (1 << (at % 8)));
        writeContents(damaged, bytes);
        refused += refusal(damaged) != "accepted";
    }
    CHECK(tried > 50);
    CHECK(refused > 0);
}

TEST_CASE("damage to the header of any object is refused before a header behind it is opened")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 20));
    const std::string whole = contents(folder / "1/state.h5");
    const fs::path damaged = folder / "damaged.h5";
    int headers = 0;
    for (auto at = whole.find("OHDR"); at != std::string::npos; at = whole.find("OHDR", at + 4), ++headers)
    {
        std::string bytes = whole;
        bytes[at + 20] = char(bytes[at + 20] ^ 1);
        writeContents(damaged, bytes);
        CHECK_THAT(refusal(damaged), Catch::Contains("damaged at /") || Catch::Contains("cannot be opened"));
    }
    CHECK(headers > 50);
}

TEST_CASE("foreign files are refused readably")
{
    TemporaryFolder folder;
    const fs::path file = folder / "foreign.h5";
    CHECK_THAT(refusal(file), Catch::Contains("no such file"));
    CHECK_THAT(refusal(folder.path()), Catch::Contains("is not a file"));
    writeContents(file, "time,dt\n0,1\n");
    CHECK_THAT(refusal(file), Catch::Contains("is not an HDF5 file"));
    {
        auto other = Hdf5File::create(file);
        other.writeScalar("/answer", 42.0, "1");
        other.close();
    }
    CHECK_THAT(refusal(file), Catch::Contains("format is missing"));
    {
        auto other = Hdf5File::create(file);
        other.setAttribute("/", "format", std::string("libmpm mesh"));
        other.setAttribute("/", "formatVersion", Index(2));
        other.close();
    }
    CHECK_THAT(refusal(file), Catch::Contains("\"libmpm mesh\""));
    {
        auto other = Hdf5File::create(file);
        other.setAttribute("/", "format", std::string("libmpm state"));
        other.setAttribute("/", "formatVersion", Index(7));
        other.close();
    }
    CHECK_THAT(refusal(file), Catch::Contains("formatVersion is 7"));
}

TEST_CASE("datasets of wrong type, rank or length, and missing ones, are named")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 30));
    const fs::path file = folder / "1/state.h5";
    const std::vector<double> values(30, 1.0);
    auto edit = Hdf5File::edit(file);
    SECTION("missing")
    {
        edit.remove("/particles/stress");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/particles/stress: is missing"));
    }
    SECTION("type")
    {
        const std::vector<float> narrow(30, 1.0f);
        edit.remove("/particles/mass");
        edit.write<float>("/particles/mass", narrow, {30}, "kg");
        edit.close();
        CHECK_THAT(refusal(file),
                   Catch::Contains("/particles/mass: holds values of 32-bit float, 64-bit float expected"));
    }
    SECTION("text for a number")
    {
        edit.remove("/particles/mass");
        edit.writeText("/particles/mass", "heavy");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/particles/mass: holds values of text"));
    }
    SECTION("rank")
    {
        edit.remove("/particles/mass");
        edit.write<double>("/particles/mass", values, {30, 1}, "kg");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/particles/mass: has the shape 30 x 1, 30 expected"));
    }
    SECTION("length")
    {
        edit.remove("/particles/mass");
        edit.write<double>("/particles/mass", std::span(values).first(29), {29}, "kg");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/particles/mass: has the shape 29, 30 expected"));
    }
    SECTION("a group in place of a dataset")
    {
        edit.remove("/particles/mass");
        edit.makeGroup("/particles/mass");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/particles/mass"));
    }
    SECTION("patches without a place")
    {
        edit.remove("/patches");
        edit.makeGroup("/patches/top");
        edit.close();
        CHECK_THAT(refusal(file), Catch::Contains("/patches/top"));
    }
}

TEST_CASE("values that are no state are refused, naming the particle")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 30));
    const fs::path file = folder / "1/state.h5";
    const auto state = readState(file);
    const auto spoil = [&]<class T>(const std::string& name, const Shape& shape, std::size_t at, T value) {
        auto edit = Hdf5File::edit(file);
        auto values = edit.template read<T>(name, shape);
        values[at] = value;
        edit.remove(name);
        edit.template write<T>(name, values, shape, "1");
        edit.close();
        return refusal(file);
    };
    const std::string seventh = "id " + std::to_string(state.particles.id[7]) + " (row 7)";
    SECTION("mass")
    {
        const std::string message = spoil("/particles/mass", {30}, 7, 0.0);
        CHECK_THAT(message, Catch::Contains(seventh) && Catch::Contains("mass is 0"));
    }
    SECTION("volume")
    {
        CHECK_THAT(spoil("/particles/volume", {30}, 7, -1.0),
                   Catch::Contains(seventh) && Catch::Contains("volume is -1"));
    }
    SECTION("position")
    {
        CHECK_THAT(spoil("/particles/position", {30, 2}, 15, std::nan("")), Catch::Contains(seventh));
    }
    SECTION("stress")
    {
        CHECK_THAT(spoil("/particles/stress", {30, 4}, 30, HUGE_VAL),
                   Catch::Contains(seventh) && Catch::Contains("inf"));
    }
    SECTION("det F")
    {
        CHECK_THAT(spoil("/particles/deformationGradient", {30, 2, 2}, 28, -2.0),
                   Catch::Contains(seventh) && Catch::Contains("det F"));
    }
    SECTION("material")
    {
        CHECK_THAT(spoil("/particles/material", {30}, 7, std::int32_t(2)),
                   Catch::Contains(seventh) && Catch::Contains("material index 2"));
    }
    SECTION("id beyond nextId")
    {
        CHECK_THAT(spoil("/particles/id", {30}, 7, state.nextId), Catch::Contains("nextId"));
    }
    SECTION("id twice")
    {
        CHECK_THAT(spoil("/particles/id", {30}, 7, state.particles.id[8]), Catch::Contains("is there twice"));
    }
    SECTION("ledger")
    {
        CHECK_THAT(spoil("/ledger/gravityWork", {}, 0, std::nan("")), Catch::Contains("gravityWork"));
    }
    SECTION("grid")
    {
        CHECK_THAT(spoil("/grid/cells", {3}, 0, Index(1) << 60), Catch::Contains("grid"));
    }
}

TEST_CASE("changed extents are noticed before anything is allocated")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 30));
    const fs::path file = folder / "1/state.h5";
    // The extent 30 of a dataspace message becomes 2^60 wherever it stands; the headers' checksums tell.
    std::string bytes = contents(file);
    const std::string thirty("\x1e\0\0\0\0\0\0\0", 8);
    const std::string huge("\0\0\0\0\0\0\0\x10", 8);
    int found = 0;
    for (auto at = bytes.find(thirty); at != std::string::npos; at = bytes.find(thirty, at + 8), ++found)
        bytes.replace(at, 8, huge);
    REQUIRE(found > 12);
    writeContents(file, bytes);
    // which object is met first is open: bytes that look alike may stand in an earlier checksum
    CHECK_THAT(refusal(file), Catch::Contains("damaged"));
}
