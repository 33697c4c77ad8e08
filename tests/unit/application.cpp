#include "case/application.hpp"
#include "base/error.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <sstream>
#include <unistd.h>

using namespace mpm;
using namespace mpm::cases;
namespace fs = std::filesystem;

namespace
{
/// A folder of our own with a case inside, removed afterwards.
struct Folder
{
    fs::path path = fs::temp_directory_path() / ("mpmApplication" + std::to_string(getpid()));
    Folder()
    {
        fs::create_directories(path / "column/system");
        fs::create_directories(path / "empty");
        std::ofstream(path / "file") << "text";
    }
    ~Folder() { fs::remove_all(path); }
};

/// Sends one of the standard streams into a file while it lives.
struct Capture
{
    Capture(int stream, const fs::path& file) : stream_(stream), file_(file), saved_(dup(stream))
    {
        flush();
        const int to = open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        dup2(to, stream_);
        close(to);
    }
    std::string end()
    {
        flush();
        dup2(saved_, stream_);
        close(saved_);
        std::ostringstream text;
        text << std::ifstream(file_).rdbuf();
        return text.str();
    }
    static void flush()
    {
        std::cout.flush();
        std::fflush(stdout);
        std::fflush(stderr);
    }
    int stream_;
    fs::path file_;
    int saved_;
};

struct Outcome
{
    int code;
    std::string out, error;
};

ApplicationInfo solver()
{
    ApplicationInfo info{"mpmSolve", "moves the particles"};
    info.usesTime = info.usesDryRun = info.usesOverwrite = info.usesThreads = true;
    info.options = {
        {"field", "NAME", "what to smooth"}, {"set", "WORD=VALUE...", "replaces an entry"}, {"brief", "", "say less"}};
    info.details = "Reads system/controlDict.";
    return info;
}

Outcome run(const Folder& folder, std::vector<std::string> words, const std::function<int(const Options&)>& body,
            const ApplicationInfo& info = solver())
{
    words.insert(words.begin(), "program");
    std::vector<char*> argv;
    for (auto& word : words)
        argv.push_back(word.data());
    Capture out(STDOUT_FILENO, folder.path / "out"), error(STDERR_FILENO, folder.path / "error");
    const int code = runApplication(int(argv.size()), argv.data(), info, body);
    Outcome outcome{code, out.end(), error.end()};
    return outcome;
}

int unreachable(const Options&)
{
    std::puts("the body ran");
    return 0;
}
} // namespace

TEST_CASE("options are read as users of OpenFOAM type them")
{
    Folder folder;
    const std::string column = folder.path / "column";
    Options got;
    const auto outcome = run(folder,
                             {"-case", column, "-time", "0:1", "-dry-run", "-overwrite", "-threads", "3", "-set", "E=1",
                              "-field", "sigma", "-set", "nu=-0.2"},
                             [&](const Options& options) {
                                 got = options;
                                 std::puts("body");
                                 return 0;
                             });
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "body\n");
    CHECK(outcome.error.empty());
    CHECK(got.caseFolder == column);
    CHECK(got.time == std::optional<std::string>("0:1"));
    CHECK(got.dryRun);
    CHECK(got.overwrite);
    CHECK_FALSE(got.latestTime);
    CHECK(got.threads == 3);
    CHECK(got.threadCount() == 3);
    CHECK(got.value("field") == "sigma");
    CHECK(got.extra.at("set") == std::vector<std::string>{"E=1", "nu=-0.2"});
    CHECK_FALSE(got.has("brief"));
    CHECK(got.value("missing", "default") == "default");
}

TEST_CASE("an argument may begin with a dash when it is no option")
{
    Folder folder;
    ApplicationInfo info{"driveLaw", "tests a law", {{"strain", "X", ""}}};
    info.usesCase = false;
    double strain = 0;
    CHECK(run(
              folder, {"-strain", "-0.5"}, [&](const Options& o) { return strain = o.number("strain", 0), 0; }, info)
              .code == 0);
    CHECK(strain == -0.5);
    for (const char* bad : {"-0.5x", "nan", "inf", "1e400", ""})
        CHECK(run(
                  folder, {"-strain", bad}, [&](const Options& o) { return o.number("strain", 0), 0; }, info)
                  .error == std::string("--> driveLaw: error: -strain: found '") + bad + "', allowed a number\n");
}

TEST_CASE("what is wrong on the command line is named, and nothing runs")
{
    Folder folder;
    const std::string column = folder.path / "column",
                      allowed = "-case DIR, -time RANGES, -latestTime, -dry-run, -overwrite, -threads N, -field NAME, "
                                "-set WORD=VALUE..., -brief, "
                                "-help and -version";
    const std::string caseAllowed = "allowed a case folder (one that holds a folder 'system')";
    struct Row
    {
        std::vector<std::string> words;
        std::string message;
    };
    const std::vector<Row> rows = {
        {{"-latesttime"}, "found the option '-latesttime', allowed " + allowed + "; did you mean '-latestTime'?"},
        {{"-lat"}, "found the option '-lat', allowed " + allowed + "; did you mean '-latestTime'?"},
        {{"--case", column}, "found the option '--case', allowed " + allowed + "; did you mean '-case'?"},
        {{"-case=" + column},
         "found the option '-case=" + column + "', allowed " + allowed + "; did you mean '-case'?"},
        {{"-"}, "found the option '-', allowed " + allowed},
        {{"--"}, "found the option '--', allowed " + allowed},
        {{""}, "found the argument '', allowed " + allowed},
        {{"-case", column, "-qqqqqqqqqq"}, "found the option '-qqqqqqqqqq', allowed " + allowed},
        {{column}, "found the argument '" + column + "', allowed " + allowed},
        {{"-case", column, "help"}, "found the argument 'help', allowed " + allowed + "; did you mean '-help'?"},
        {{"-brief", "yes", "-case", column}, "found the argument 'yes', allowed " + allowed},
        {{"-case"}, "'-case' lacks its argument, allowed -case DIR"},
        {{"-case", "-latestTime"}, "'-case' lacks its argument (found the option '-latestTime'), allowed -case DIR"},
        {{"-case", column, "-brief", "-brief"}, "'-brief' was given twice"},
        {{"-case", column, "-case", "other"}, "'-case' was given twice"},
        {{"-case", column, "-time", "0", "-latestTime"}, "found both '-time' and '-latestTime', allowed one of them"},
        {{"-case", column, "-threads", "0"}, "-threads: found '0', allowed an integer from 1 to 1024"},
        {{"-case", column, "-threads", "2x"}, "-threads: found '2x', allowed an integer from 1 to 1024"},
        {{"-case", column, "-threads", "1.5"}, "-threads: found '1.5', allowed an integer from 1 to 1024"},
        {{"-case", column, "-threads", "99999999999"},
         "-threads: found '99999999999', allowed an integer from 1 to 1024"},
        {{"-case", "/nowhere/at all"}, "-case: found '/nowhere/at all', which does not exist, " + caseAllowed},
        {{"-case", ""}, "-case: found '', which does not exist, " + caseAllowed},
        {{"-case", folder.path / "file"},
         "-case: found '" + (folder.path / "file").string() + "', which is no folder, " + caseAllowed},
        {{"-case", folder.path / "empty"},
         "-case: found '" + (folder.path / "empty").string() + "', which holds no folder 'system', " + caseAllowed},
    };
    for (const Row& row : rows)
    {
        const auto outcome = run(folder, row.words, unreachable);
        CHECK(outcome.error == "--> mpmSolve: error: " + row.message + "\n");
        CHECK(outcome.out.empty());
        CHECK(outcome.code == 1);
    }
}

TEST_CASE("an option that means nothing to a utility is refused")
{
    Folder folder;
    ApplicationInfo info{"plain", "does little"};
    const auto outcome = run(folder, {"-case", folder.path / "column", "-threads", "2"}, unreachable, info);
    CHECK(outcome.code == 1);
    CHECK(outcome.error == "--> plain: error: found the option '-threads', allowed -case DIR, -help and -version\n");
    info.usesCase = false;
    CHECK(run(
              folder, {}, [](const Options&) { return 7; }, info)
              .code == 7);
    CHECK(run(folder, {"-case", "."}, unreachable, info).code == 1);
}

TEST_CASE("OMP_NUM_THREADS counts when -threads is not given, and must be a number")
{
    Folder folder;
    const std::string column = folder.path / "column";
    int threads = 0;
    const auto body = [&](const Options& options) { return threads = options.threadCount(), 0; };
    unsetenv("OMP_NUM_THREADS");
    CHECK(run(folder, {"-case", column}, body).code == 0);
    CHECK(threads == 1);
    setenv("OMP_NUM_THREADS", "2,4", 1);
    CHECK(run(folder, {"-case", column}, body).code == 0);
    CHECK(threads == 2);
    setenv("OMP_NUM_THREADS", "many", 1);
    const auto outcome = run(folder, {"-case", column}, body);
    unsetenv("OMP_NUM_THREADS");
    CHECK(outcome.code == 1);
    CHECK(outcome.error == "--> mpmSolve: error: OMP_NUM_THREADS: found 'many', allowed an integer from 1 to 1024\n");
}

TEST_CASE("every ending has its message and its exit code")
{
    Folder folder;
    const std::vector<std::string> words = {"-case", folder.path / "column"};
    const auto ending = [&](const std::function<int(const Options&)>& body) {
        const auto outcome = run(folder, words, body);
        return std::to_string(outcome.code) + " " + outcome.error;
    };
    CHECK(ending([](const Options&) { return 0; }) == "0 ");
    CHECK(ending([](const Options&) -> int {
              throw InputError({"system/gridDict", 3}, "cellSize: found 0");
          }) == "1 --> mpmSolve: error: system/gridDict:3: cellSize: found 0\n");
    CHECK(ending([](const Options&) -> int { throw StepError("step 12: particle 3 left the grid"); }) ==
          "2 --> mpmSolve: error: step 12: particle 3 left the grid\n");
    CHECK(ending([](const Options&) -> int { throw std::bad_alloc(); }) ==
          "2 --> mpmSolve: error: not enough memory; fewer particles or cells need less\n");
    CHECK(ending([](const Options&) -> int { throw std::logic_error("index 7"); }) ==
          "3 --> mpmSolve: error: index 7 (a mistake in mpmSolve itself, not in your input: please report it)\n");
    CHECK(
        ending([](const Options&) -> int { throw 5; }) ==
        "3 --> mpmSolve: error: unknown failure (a mistake in mpmSolve itself, not in your input: please report it)\n");
    CHECK(ending([](const Options&) { return fs::create_directory("/proc/mpm/none"), 0; }).substr(0, 2) == "1 ");
}

TEST_CASE("help, version and completion words print to standard output and stop")
{
    Folder folder;
    const auto help = run(folder, {"-case", "/nowhere", "-nonsense", "-help"}, unreachable);
    CHECK(help.code == 0);
    CHECK(help.error.empty());
    CHECK(help.out == helpPage(solver()));
    CHECK(help.out == R"(mpmSolve: moves the particles

Usage: mpmSolve [options]

  -case DIR           the case folder (default: the current one)
  -time RANGES        stored times to work on, like '0.5,1:2' or ':1' (default: all)
  -latestTime         work on the latest stored time only
  -dry-run            check all input, then stop before anything is written
  -overwrite          replace results that exist
  -threads N          number of threads (default: OMP_NUM_THREADS, else 1)
  -field NAME         what to smooth
  -set WORD=VALUE...  replaces an entry
  -brief              say less
  -help               print this page and stop
  -version            print version, revision, compiler and flags and stop

Reads system/controlDict.
)");
    const auto version = run(folder, {"-version"}, unreachable);
    CHECK(version.code == 0);
    CHECK(version.out.find("mpmSolve of libmpm\n    version ") == 0);
    const auto words = run(folder, {"-completionWords"}, unreachable);
    CHECK(words.code == 0);
    CHECK(words.out ==
          "-case\n-time\n-latestTime\n-dry-run\n-overwrite\n-threads\n-field\n-set\n-brief\n-help\n-version\n");
}
