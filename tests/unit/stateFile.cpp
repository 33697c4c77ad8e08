#include "output/stateFile.hpp"
#include "base/error.hpp"
#include "output/derivedFields.hpp"
#include "output/hdf5File.hpp"
#include "output/ledgerEntries.hpp"
#include "output/paraviewSeries.hpp"
#include "support/fileContents.hpp"
#include "support/fullDisk.hpp"
#include "support/sampleState.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstring>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using namespace mpm::output;
using mpm::tests::sampleState;
using mpm::tests::TemporaryFolder;
using mpm::tests::writeContents;
namespace fs = std::filesystem;

namespace
{
template <class T>
bool sameBits(const state::Column<T>& a, const state::Column<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
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
    const auto entries = [](const state::Ledger& ledger) {
        std::vector<std::string> bytes;
        forEachLedgerEntry(ledger, [&](const std::string&, const auto& value, const std::string&) {
            bytes.emplace_back(reinterpret_cast<const char*>(&value), sizeof value);
        });
        return bytes;
    };
    CHECK(entries(a.ledger) == entries(b.ledger));
    CHECK(std::memcmp(&a.time, &b.time, sizeof a.time) == 0);
    CHECK(a.step == b.step);
    CHECK(std::memcmp(&a.deltaT, &b.deltaT, sizeof a.deltaT) == 0);
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

TEST_CASE("columns that a case asks for come back too, and are absent where it does not")
{
    TemporaryFolder folder;
    for (int dim : {2, 3})
    {
        auto state = sampleState(dim, 70);
        writeState(folder / "0", state);
        CHECK_FALSE(readState(folder / "0/state.h5").particles.hasX());
        CHECK_FALSE(readState(folder / "0/state.h5").particles.hasAffine());
        auto& p = state.particles;
        p.enableX();
        CHECK(p.X[0][69] == p.x[0][69]);
        p.enableAffine();
        for (int k = 0; k < dim * dim; ++k)
            for (std::size_t i = 0; i < 70; ++i)
            {
                p.X[std::size_t(k % dim)][i] += 0.1 * double(i);
                p.affine[std::size_t(k)][i] = double(k) - 0.3 * double(i);
            }
        p.padLastChunk();
        writeState(folder / "1", state);
        requireSameBits(readState(folder / "1/state.h5"), state);
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

TEST_CASE("the series for ParaView follows states that change, come and go")
{
    TemporaryFolder folder;
    writeState(folder / "0", sampleState(2, 10));
    writeState(folder / "1", sampleState(2, 11));
    ParaviewSeries series(folder.path(), "sample");
    series.write({"0", "1"});
    const auto counts = [&](const std::string& ending) {
        std::string found;
        const std::string text = tests::contents(folder / ("sample" + ending));
        const std::string word = "NumberOfElements=\"";
        for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
            found += text.substr(at + word.size(), text.find('"', at + word.size()) - at - word.size()) + " ";
        return found;
    };
    CHECK(counts(".xdmf") == "10 11 ");
    CHECK(counts(".domains.xdmf") == "10 11 ");
    writeState(folder / "1", sampleState(2, 12));
    writeState(folder / "2", sampleState(2, 13));
    series.write({"0", "1", "2"});
    CHECK(counts(".xdmf") == "10 12 13 ");
    series.write({"1", "2"});
    CHECK(counts(".domains.xdmf") == "12 13 ");
    CHECK_THROWS_AS(series.write({"3"}), InputError);
    CHECK(counts(".xdmf") == "12 13 ");
}
