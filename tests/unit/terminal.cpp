#include "base/terminal.hpp"
#include "base/version.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

using namespace mpm;

namespace
{
/// Progress on a stream and a clock of our own.
struct Scene
{
    std::ostringstream out;
    double seconds = 100;
    Progress::Surroundings surroundings(bool terminal, int width = 120)
    {
        return {&out, terminal, width, [this] { return seconds; }};
    }
    /// What a terminal shows after all carriage returns, the last line only.
    std::string screen() const
    {
        std::string line;
        std::size_t at = 0;
        const std::string all = out.str();
        for (const char c : all)
        {
            if (c == '\n')
                line.clear(), at = 0;
            else if (c == '\r')
                at = 0;
            else
            {
                line.resize(std::max(line.size(), at + 1), ' ');
                line[at++] = c;
            }
        }
        return line.substr(0, line.find_last_not_of(' ') + 1);
    }
};

std::size_t count(const std::string& text, char c)
{
    return std::size_t(std::count(text.begin(), text.end(), c));
}
} // namespace

TEST_CASE("durations read as people say them")
{
    CHECK(formatDuration(0) == "0.00 s");
    CHECK(formatDuration(0.4249) == "0.42 s");
    CHECK(formatDuration(9.996) == "10.0 s");
    CHECK(formatDuration(59.94) == "59.9 s");
    CHECK(formatDuration(59.96) == "1 min 00 s");
    CHECK(formatDuration(65) == "1 min 05 s");
    CHECK(formatDuration(3599.4) == "59 min 59 s");
    CHECK(formatDuration(3599.6) == "1 h 00 min");
    CHECK(formatDuration(2 * 3600 + 3 * 60) == "2 h 03 min");
    CHECK(formatDuration(25 * 3600) == "1 d 01 h");
    CHECK(formatDuration(-1) == "unknown");
    CHECK(formatDuration(1.0 / 0.0) == "unknown");
}

TEST_CASE("sizes change their unit where four digits would begin")
{
    CHECK(formatBytes(0) == "0 B");
    CHECK(formatBytes(999) == "999 B");
    CHECK(formatBytes(1000) == "1.0 kB");
    CHECK(formatBytes(999949) == "999.9 kB");
    CHECK(formatBytes(999960) == "1.0 MB");
    CHECK(formatBytes(3.25e9) == "3.2 GB");
    CHECK(formatBytes(-1) == "unknown");
}

TEST_CASE("a terminal shows one line with bar, time, details, elapsed and left, and none after finish")
{
    Scene scene;
    Progress progress("mpmSolve", 0, 2.5, scene.surroundings(true));
    scene.seconds += 4;
    progress.update(1.0, "dt 0.001 s  1800 particles");
    CHECK(scene.screen() == "mpmSolve [========            ]  40 %  time 1 s  dt 0.001 s  1800 particles  "
                            "4.00 s elapsed, 6.00 s left");
    progress.note("wrote 1");
    CHECK(scene.screen().empty());
    progress.update(1.1, "x");
    CHECK(scene.screen().find("time 1.1 s") != std::string::npos);
    progress.finish();
    CHECK(scene.screen().empty());
    const std::string before = scene.out.str();
    scene.seconds += 10;
    progress.update(2.0, "");
    progress.finish();
    CHECK(scene.out.str() == before);
    CHECK(count(before, '\n') == 1); // the note's
}

TEST_CASE("a terminal line is redrawn at most ten times a second and never wraps")
{
    Scene scene;
    Progress progress("run", 0, 1, scene.surroundings(true, 40));
    for (int step = 0; step < 1000; ++step)
    {
        scene.seconds += 0.001;
        progress.update(step / 1000.0, std::string(100, 'd'));
        REQUIRE(scene.screen().size() < 40);
    }
    CHECK(count(scene.out.str(), '\r') >= 9);
    CHECK(count(scene.out.str(), '\r') <= 10);
}

TEST_CASE("a file gets a plain line every tenth of the way, or every 30 s")
{
    Scene scene;
    {
        Progress progress("run", 0, 100, scene.surroundings(false));
        for (int step = 1; step <= 100; ++step)
        {
            scene.seconds += 0.01;
            progress.update(step, "");
        }
    }
    CHECK(count(scene.out.str(), '\n') == 10);
    CHECK(count(scene.out.str(), '\r') == 0);
    CHECK(scene.out.str().substr(0, scene.out.str().find('\n')) == "run:  10 %  time 10 s  0.10 s elapsed");
    CHECK(scene.out.str().find("run: 100 %  time 100 s") != std::string::npos);

    Scene slow;
    Progress progress("run", 0, 100, slow.surroundings(false));
    for (int step = 1; step <= 90; ++step)
    {
        slow.seconds += 1;
        progress.update(step * 0.1, "");
    }
    CHECK(count(slow.out.str(), '\n') == 3);
    CHECK(slow.out.str().find("30.0 s elapsed, 16 min 10 s left") != std::string::npos);
}

TEST_CASE("the time left follows a run that becomes four times slower")
{
    Scene scene;
    Progress progress("run", 0, 1, scene.surroundings(true, 200));
    double now = 0;
    for (int step = 0; step < 100; ++step) // 0.01 per second
        scene.seconds += 0.5, progress.update(now += 0.005);
    CHECK(scene.screen().find(" 50.0 s left") != std::string::npos);
    for (int step = 0; step < 100; ++step) // 0.0025 per second: the rest takes 150 s
        scene.seconds += 0.5, progress.update(now += 0.00125);
    CHECK(scene.screen().find("2 min 30 s left") != std::string::npos);
}

TEST_CASE("a span without length and a time outside it do no harm")
{
    Scene scene;
    Progress empty("run", 1, 1, scene.surroundings(true, 200));
    scene.seconds += 1;
    empty.update(1);
    CHECK(scene.screen().find("100 %") != std::string::npos);
    Scene other;
    Progress beyond("run", 0, 1, other.surroundings(true, 200));
    other.seconds += 1;
    beyond.update(7);
    CHECK(other.screen().find("100 %") != std::string::npos);
}

TEST_CASE("tables put words to the left and numbers to the right")
{
    Table table({"quantity", "value", "unit"});
    table.row({"particles", "1800", ""});
    table.row({"peak kinetic energy", "1.81e5", "J/m"});
    CHECK(table.text(2) == "  quantity              value  unit\n"
                           "  particles              1800\n"
                           "  peak kinetic energy  1.81e5  J/m\n");
}

TEST_CASE("the build knows itself")
{
    CHECK(count(projectVersion(), '.') == 2);
    CHECK(!gitRevision().empty());
    CHECK(gitRevision().find_first_not_of("0123456789abcdef+unkow") == std::string::npos);
    CHECK(!compilerText().empty());
    CHECK(compilerFlags().find("-fno-math-errno") != std::string::npos);
    CHECK(versionLines().size() == 5);
    CHECK(std::filesystem::exists(projectFolder() + "/libmpm"));
}
