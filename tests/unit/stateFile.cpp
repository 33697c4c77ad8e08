#include "base/error.hpp"
#include "output/derivedFields.hpp"
#include "output/hdf5File.hpp"
#include "output/replaceFile.hpp"
#include "output/stateFile.hpp"
#include "support/fullDisk.hpp"
#include "support/sampleState.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using namespace mpm::output;
using mpm::tests::sampleState;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
std::string contents(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void writeContents(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

template <class T>
bool sameBits(const state::Column<T>& a, const state::Column<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void requireSameBits(state::State a, state::State b)
{
    REQUIRE(a.particles.size() == b.particles.size());
    REQUIRE(a.particles.dim == b.particles.dim);
    std::vector<std::string> columnsA, columnsB;
    const auto collect = [](std::vector<std::string>& out) {
        return [&out](auto& column) {
            out.emplace_back(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(column[0]));
        };
    };
    a.particles.forEachColumn(collect(columnsA));
    b.particles.forEachColumn(collect(columnsB));
    CHECK(columnsA == columnsB);
    CHECK(std::memcmp(&a.ledger, &b.ledger, sizeof a.ledger) == 0);
    CHECK(std::memcmp(&a.time, &b.time, sizeof a.time) == 0);
    CHECK(a.step == b.step);
    CHECK(std::memcmp(&a.deltaT, &b.deltaT, sizeof a.deltaT) == 0);
    CHECK(a.slabs == b.slabs);
    CHECK(a.seedSpacing == b.seedSpacing);
    CHECK(a.nextId == b.nextId);
    CHECK(a.grid.dim == b.grid.dim);
    CHECK(a.grid.h == b.grid.h);
    CHECK(a.grid.origin == b.grid.origin);
    CHECK(a.grid.cells == b.grid.cells);
    CHECK(a.materials == b.materials);
    CHECK(a.provenance == b.provenance);
    REQUIRE(a.patches.size() == b.patches.size());
    for (std::size_t i = 0; i < a.patches.size(); ++i)
    {
        CHECK(a.patches[i].name == b.patches[i].name);
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(sameBits(a.patches[i].centre[k], b.patches[i].centre[k]));
        for (std::size_t k = 0; k < 6; ++k)
            CHECK(sameBits(a.patches[i].edges[k], b.patches[i].edges[k]));
    }
}

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

TEST_CASE("a state comes back bitwise, in 2D and 3D")
{
    TemporaryFolder folder;
    for (int dim : {2, 3})
    {
        const auto state = sampleState(dim, 150);
        writeState(folder / "0.5", state);
        requireSameBits(readState(folder / "0.5/state.h5"), state);
        CHECK_FALSE(fs::exists(folder / "0.5/state.h5.partial"));
        const auto summary = readSummary(folder / "0.5/state.h5");
        CHECK(summary.particles == 150);
        CHECK(summary.time == state.time);
        CHECK(summary.step == state.step);
        CHECK(summary.dim == dim);
    }
}

TEST_CASE("an empty state and one without names come back")
{
    TemporaryFolder folder;
    state::State empty(3);
    writeState(folder / "0", empty);
    requireSameBits(readState(folder / "0/state.h5"), empty);
}

TEST_CASE("particles stored in any order come back sorted by key and id")
{
    TemporaryFolder folder;
    const auto state = sampleState(2, 100);
    auto shuffled = state;
    std::vector<Index> order;
    for (Index i = 0; i < 100; ++i)
        order.push_back((37 * i + 11) % 100);
    shuffled.particles.permute(order);
    writeState(folder / "0", shuffled);
    requireSameBits(readState(folder / "0/state.h5"), state);
}

TEST_CASE("writing replaces the old state at once or not at all")
{
    TemporaryFolder folder;
    auto state = sampleState(2, 10);
    writeState(folder / "1", state);

    SECTION("a left-over temporary does not harm")
    {
        writeContents(folder / "1/state.h5.partial", "half a file");
        requireSameBits(readState(folder / "1/state.h5"), state);
        state.step = 99;
        writeState(folder / "1", state);
        CHECK(readState(folder / "1/state.h5").step == 99);
        CHECK_FALSE(fs::exists(folder / "1/state.h5.partial"));
    }
    SECTION("a state that could not be read again is not written")
    {
        auto broken = state;
        broken.particles.v[1][3] = std::nan("");
        CHECK_THROWS_AS(writeState(folder / "1", broken), InputError);
        requireSameBits(readState(folder / "1/state.h5"), state);
    }
    SECTION("a failure while writing keeps the old state and leaves no temporary")
    {
        auto twice = state;
        twice.patches.push_back(twice.patches.front()); // two patches of one name cannot be stored
        CHECK_THROWS_AS(writeState(folder / "1", twice), InputError);
        requireSameBits(readState(folder / "1/state.h5"), state);
        CHECK_FALSE(fs::exists(folder / "1/state.h5.partial"));
        CHECK_THROWS_AS(writeState(folder / "2", twice), InputError);
        CHECK_FALSE(fs::exists(folder / "2"));
    }
    SECTION("a full disk keeps the old state")
    {
        auto later = sampleState(2, 500);
        CHECK(tests::refusedOnFullDisk(30000, [&] { writeState(folder / "1", later); }));
        requireSameBits(readState(folder / "1/state.h5"), state);
        CHECK_FALSE(fs::exists(folder / "1/state.h5.partial"));
        CHECK(tests::refusedOnFullDisk(1000, [&] { writeDerived(folder / "1/state.h5", state, {}); }));
        requireSameBits(readState(folder / "1/state.h5"), state);
        CHECK(tests::refusedOnFullDisk(30000, [&] { writeState(folder / "3", later); }));
        CHECK_FALSE(fs::exists(folder / "3"));
    }
    SECTION("a folder that cannot be made is named")
    {
        CHECK_THROWS_WITH(writeState(folder / "1/state.h5/2", state), Catch::Contains("state.h5/2"));
        CHECK_THROWS_WITH(writeState("/proc/1.5", state), Catch::Contains("/proc/1.5"));
    }
}

TEST_CASE("a writer killed at any moment leaves a whole state")
{
    TemporaryFolder folder;
    auto state = sampleState(2, 400);
    state.step = 0;
    writeState(folder / "1", state);
    Index last = 0;
    for (int round = 0; round < 12; ++round)
    {
        const pid_t writer = ::fork();
        REQUIRE(writer >= 0);
        if (writer == 0)
        {
            for (;;)
            {
                ++state.step;
                for (Index i = 0; i < state.particles.size(); ++i)
                    state.particles.v[0][std::size_t(i)] = double(state.step);
                state.particles.padLastChunk();
                try
                {
                    writeState(folder / "1", state);
                }
                catch (...)
                {
                    ::_exit(1);
                }
            }
        }
        ::usleep(useconds_t(4000 + 3170 * round));
        ::kill(writer, SIGKILL);
        int status = 0;
        ::waitpid(writer, &status, 0);
        REQUIRE(WIFSIGNALED(status));
        const auto found = readState(folder / "1/state.h5");
        CHECK(found.step >= last);
        if (found.step > 0)
            for (Index i = 0; i < found.particles.size(); ++i)
                REQUIRE(found.particles.v[0][std::size_t(i)] == double(found.step));
        last = found.step;
        state.step = last;
    }
    CHECK(last > 0);
}

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
    int refused = 0, tried = 0;
    for (std::size_t at = 0; at < whole.size(); at += 53, ++tried)
    {
        std::string bytes = whole;
        bytes[at] = char(bytes[at] ^ (1 << (at % 8)));
        writeContents(damaged, bytes);
        refused += refusal(damaged) != "accepted";
    }
    CHECK(tried > 300);
    CHECK(refused > 0);
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
        other.setAttribute("/", "formatVersion", Index(1));
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
        CHECK_THAT(refusal(file), Catch::Contains("/particles/mass: holds values of 32-bit float, 64-bit float expected"));
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
        CHECK_THAT(spoil("/particles/volume", {30}, 7, -1.0), Catch::Contains(seventh) && Catch::Contains("volume is -1"));
    }
    SECTION("position")
    {
        CHECK_THAT(spoil("/particles/position", {30, 2}, 15, std::nan("")), Catch::Contains(seventh));
    }
    SECTION("stress")
    {
        CHECK_THAT(spoil("/particles/stress", {30, 4}, 30, HUGE_VAL), Catch::Contains(seventh) && Catch::Contains("inf"));
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

TEST_CASE("derived fields follow the particles by id and end with them")
{
    TemporaryFolder folder;
    const auto state = sampleState(2, 40);
    auto shuffled = state;
    std::vector<Index> order;
    for (Index i = 0; i < 40; ++i)
        order.push_back((7 * i + 3) % 40);
    shuffled.particles.permute(order);
    writeState(folder / "1", shuffled);
    const fs::path file = folder / "1/state.h5";
    std::vector<double> a, b;
    for (Index i = 0; i < 40; ++i)
    {
        a.push_back(double(state.particles.id[std::size_t(i)]));
        b.push_back(-a.back());
    }
    const NodalFields nodal{{{0, 1, 0}, {2, 3, 0}}, {{"stress", "Pa", {"yy"}, {{5, 6}}}}};
    writeDerived(file, state, {{"smoothedStress", "Pa", {"xx", "yy"}, {a, b}}}, nodal);
    writeDerived(file, state, {{"overburden", "Pa", {"overburden"}, {b}}});

    const auto fields = readDerived(file, state);
    REQUIRE(fields.size() == 2);
    CHECK(fields[1].name == "smoothedStress");
    CHECK(fields[1].unit == "Pa");
    CHECK(fields[1].components == std::vector<std::string>{"xx", "yy"});
    CHECK(fields[1].columns == std::vector<std::vector<double>>{a, b});
    // In the file each row stands beside the id it belongs to.
    const auto raw = Hdf5File::open(file).read<double>("/derived/smoothedStress", {40, 2});
    for (Index i = 0; i < 40; ++i)
        CHECK(raw[std::size_t(2 * i)] == double(shuffled.particles.id[std::size_t(i)]));
    const auto back = readDerivedNodal(file);
    CHECK(back.position == nodal.position);
    CHECK(back.fields[0].columns == nodal.fields[0].columns);
    requireSameBits(readState(file), state);
    const auto summary = readSummary(file);
    REQUIRE(summary.derived.size() == 2);
    CHECK(summary.derived[0].name == "overburden");
    CHECK(summary.derived[1].components == std::vector<std::string>{"xx", "yy"});

    SECTION("writing them again does not let the file grow")
    {
        const auto before = fs::file_size(file);
        for (int i = 0; i < 5; ++i)
            writeDerived(file, state, {{"smoothedStress", "Pa", {"xx", "yy"}, {a, b}}}, nodal);
        CHECK(double(fs::file_size(file)) < 1.2 * double(before));
    }
    SECTION("a new state drops them")
    {
        writeState(folder / "1", state);
        CHECK(readSummary(file).derived.empty());
        CHECK(readDerivedNodal(file).position.empty());
    }
    SECTION("other particles are refused and the file stays")
    {
        auto other = sampleState(2, 40);
        other.particles.id[3] += 1000;
        other.nextId += 1000;
        CHECK_THROWS_WITH(writeDerived(file, other, {{"x", "1", {"x"}, {a}}}), Catch::Contains("other particles"));
        CHECK_THROWS_AS(readDerived(file, other), InputError);
        CHECK_THROWS_AS(writeDerived(file, state, {{"x", "1", {"x"}, {{1.0}}}}), InputError);
        CHECK(readDerived(file, state).size() == 2);
        CHECK_FALSE(fs::exists(folder / "1/state.h5.partial"));
    }
}

TEST_CASE("a dataset that claims more than the file holds is refused before anything is allocated")
{
    TemporaryFolder folder;
    writeState(folder / "1", sampleState(2, 30));
    const fs::path file = folder / "1/state.h5";
    // The extent 30 of a dataspace message becomes 2^60 wherever it stands.
    std::string bytes = contents(file);
    const std::string thirty("\x1e\0\0\0\0\0\0\0", 8);
    const std::string huge("\0\0\0\0\0\0\0\x10", 8);
    int found = 0;
    for (auto at = bytes.find(thirty); at != std::string::npos; at = bytes.find(thirty, at + 8), ++found)
        bytes.replace(at, 8, huge);
    REQUIRE(found > 12);
    writeContents(file, bytes);
    CHECK_THAT(refusal(file), Catch::Contains("/particles/position") && Catch::Contains("more than the file's"));
}
