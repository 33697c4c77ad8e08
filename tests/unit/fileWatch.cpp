// A change is a change of content, told once, after the files have come to rest.
#include "case/fileWatch.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>

using namespace mpm;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
void write(const fs::path& file, const std::string& text)
{
    std::ofstream(file) << text;
}

/// Gives up after so many looks: nothing changed.
std::optional<std::vector<fs::path>> changes(cases::FileWatch& watch, int looks = 40)
{
    return watch.wait([&] { return looks-- <= 0; });
}
} // namespace

TEST_CASE("Files that change, come and go are told once")
{
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "geometry");
    const fs::path file = folder.path() / "geometry" / "column.geo", other = folder.path() / "geometry" / "part.geo";
    write(file, "one");
    cases::FileWatch watch({folder.path() / "geometry", folder.path() / "not there"}, 0.002, 0.01);
    CHECK(!changes(watch));

    write(file, "two"); // as long as before
    CHECK(changes(watch) == std::vector{file});
    CHECK(!changes(watch));

    write(other, "");
    fs::remove(file);
    CHECK(changes(watch) == std::vector{other, file});
    CHECK(!changes(watch));

    fs::rename(other, file); // as editors replace a file
    CHECK(changes(watch) == std::vector{file, other});
}

TEST_CASE("A new time, hidden files and what editors leave are no change")
{
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "gridDict";
    write(file, "one");
    cases::FileWatch watch({folder.path()}, 0.002, 0.01);
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(5));
    for (const char* name : {".gridDict.swp", "gridDict~", "#gridDict#", "gridDict.partial"})
        write(folder.path() / name, "x");
    CHECK(!changes(watch));
    write(file, "two"); // after the touch it is still seen
    CHECK(changes(watch) == std::vector{file});
}

TEST_CASE("A file that goes on changing is told when it has come to rest")
{
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a";
    write(file, "");
    cases::FileWatch watch({folder.path()}, 0.002, 0.03);
    int looks = 0;
    const auto found = watch.wait([&] {
        if (++looks < 20)
            std::ofstream(file, std::ios::app) << looks;
        return looks > 1000;
    });
    CHECK(found == std::vector{file});
    CHECK(looks > 20);
}
