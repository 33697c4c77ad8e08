#include "case/application.hpp"

#include "base/error.hpp"
#include "base/version.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <omp.h>
#include <system_error>
#ifdef __linux__
#include <unistd.h>
#endif

namespace mpm::cases
{
namespace
{
constexpr int mostThreads = 1024;
constexpr const char* outputFailed = "the standard output could not be written (is the disk full?)";

std::vector<ExtraOption> allOptions(const ApplicationInfo& info)
{
    std::vector<ExtraOption> all;
    if (info.usesCase)
        all.push_back({"case", "DIR", "the case folder (default: the current one)"});
    if (info.usesTime)
    {
        all.push_back({"time", "RANGES", "stored times to work on, like '0.5,1:2' or ':1' (default: all)"});
        all.push_back({"latestTime", "", "work on the latest stored time only"});
    }
    if (info.usesDryRun)
        all.push_back({"dry-run", "", "check all input, then stop before anything is written"});
    if (info.usesOverwrite)
        all.push_back({"overwrite", "", "replace results that exist"});
    if (info.usesThreads)
        all.push_back({"threads", "N", "number of threads (default: OMP_NUM_THREADS, else 1)"});
    all.insert(all.end(), info.options.begin(), info.options.end());
    all.push_back({"help", "", "print this page and stop"});
    all.push_back({"version", "", "print version, revision, compiler and flags and stop"});
    return all;
}

bool mayLackArgument(const ExtraOption& option)
{
    return option.argument.starts_with('[');
}

bool isRepeatable(const ExtraOption& option)
{
    return option.argument.ends_with("...");
}

/// How the option is typed: "-case DIR".
std::string usage(const ExtraOption& option)
{
    return option.argument.empty() ? "-" + option.name : fmt::format("-{} {}", option.name, option.argument);
}

[[noreturn]] void failUnknown(const std::string& token, const std::vector<ExtraOption>& options)
{
    const std::size_t dashes = token.find_first_not_of('-');
    const std::string bare = dashes == std::string::npos ? "" : token.substr(dashes, token.find('=') - dashes);
    std::vector<std::string> typed, names;
    for (const ExtraOption& option : options)
    {
        typed.push_back(usage(option));
        names.push_back(option.name);
    }
    const auto begun = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return token.starts_with('-') ? bare.size() > 1 && name.starts_with(bare) : name == bare;
    });
    const std::string nearest = begun != names.end() ? *begun : token.starts_with('-') ? nearestWord(bare, names) : "";
    throw InputError(fmt::format("found {} '{}', allowed {}{}", token.starts_with('-') ? "the option" : "the argument",
                                 token, joinWords(typed, " and "),
                                 nearest.empty() ? "" : fmt::format("; did you mean '-{}'?", nearest)));
}

const ExtraOption* findOption(const std::vector<ExtraOption>& options, const std::string& name)
{
    for (const ExtraOption& option : options)
        if (option.name == name)
            return &option;
    return nullptr;
}

/// What stands on the command line, by option, every mistake of form refused. By hand rather than by a library, because
/// messages quote what was typed, and libraries read `-case` by turning it into something else first.
std::map<std::string, std::vector<std::string>> parse(const std::vector<std::string>& arguments,
                                                      const std::vector<ExtraOption>& options)
{
    std::map<std::string, std::vector<std::string>> given;
    for (std::size_t i = 0; i < arguments.size(); ++i)
    {
        const std::string& token = arguments[i];
        const ExtraOption* option = token.starts_with('-') ? findOption(options, token.substr(1)) : nullptr;
        if (!option)
            failUnknown(token, options);
        if (given.count(option->name) && !isRepeatable(*option))
            throw InputError(fmt::format("'{}' was given twice", token));
        auto& values = given[option->name];
        if (option->argument.empty())
            continue;
        const std::string next = i + 1 < arguments.size() ? arguments[i + 1] : "";
        const bool isOption = next.size() > 1 && next[0] == '-' && findOption(options, next.substr(1));
        if ((i + 1 == arguments.size() || isOption) && mayLackArgument(*option))
        {
            values.push_back("");
            continue;
        }
        if (i + 1 == arguments.size() || isOption)
            throw InputError(fmt::format("'{}' lacks its argument{}, allowed {}", token,
                                         isOption ? " (found the option '" + next + "')" : "", usage(*option)));
        values.push_back(next);
        ++i;
    }
    return given;
}

int threadNumber(const std::string& source, const std::string& text)
{
    int threads = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
    if (error != std::errc() || end != text.data() + text.size() || threads < 1 || threads > mostThreads)
        throw InputError(fmt::format("{}: found '{}', allowed an integer from 1 to {}", source, text, mostThreads));
    return threads;
}

Options toOptions(std::map<std::string, std::vector<std::string>> given, const ApplicationInfo& info)
{
    Options options;
    for (auto& [name, values] : given)
    {
        if (findOption(info.options, name))
            options.extra[name] = std::move(values);
        else if (name == "case")
            options.caseFolder = values.front();
        else if (name == "time")
            options.time = values.front();
        else if (name == "latestTime")
            options.latestTime = true;
        else if (name == "dry-run")
            options.dryRun = true;
        else if (name == "overwrite")
            options.overwrite = true;
        else if (name == "threads")
            options.threads = threadNumber("-threads", values.front());
    }
    if (options.time && options.latestTime)
        throw InputError("found both '-time' and '-latestTime', allowed one of them");
    return options;
}

void checkCaseFolder(const std::filesystem::path& folder)
{
    namespace fs = std::filesystem;
    std::error_code error;
    const std::string allowed = "allowed a case folder (one that holds a folder 'system')";
    if (!fs::exists(folder, error))
        throw InputError(fmt::format("-case: found '{}', which does not exist, {}", folder.string(), allowed));
    if (!fs::is_directory(folder, error))
        throw InputError(fmt::format("-case: found '{}', which is no folder, {}", folder.string(), allowed));
    if (!fs::is_directory(folder / "system", error))
        throw InputError(
            fmt::format("-case: found '{}', which holds no folder 'system', {}", folder.string(), allowed));
}

void print(const std::string& text)
{
    std::fwrite(text.data(), 1, text.size(), stdout);
}

int complain(const ApplicationInfo& info, int code, const std::string& message)
{
    std::fflush(stdout);
    std::fputs(fmt::format("--> {}: error: {}\n", info.name, message).c_str(), stderr);
    return code;
}

int run(const std::vector<std::string>& arguments, const ApplicationInfo& info,
        const std::function<int(const Options&)>& body)
{
    const std::vector<ExtraOption> known = allOptions(info);
    if (arguments.size() == 1 && arguments[0] == "-completionWords") // for etc/completion
    {
        for (const ExtraOption& option : known)
            print("-" + option.name + "\n");
        return 0;
    }
    for (const std::string& argument : arguments)
        if (argument == "-help")
            return print(helpPage(info)), 0;
    const auto given = parse(arguments, known);
    if (given.count("version"))
    {
        print(info.name + " of libmpm\n");
        for (const std::string& line : versionLines())
            print("    " + line + "\n");
        return 0;
    }
    const Options options = toOptions(given, info);
    omp_set_num_threads(options.threadCount()); // a bad OMP_NUM_THREADS is told before any work
    if (info.usesCase)
        checkCaseFolder(options.caseFolder);
    return body(options);
}
} // namespace

bool Options::has(const std::string& name) const
{
    return extra.count(name) > 0;
}

std::string Options::value(const std::string& name, const std::string& fallback) const
{
    const auto found = extra.find(name);
    return found == extra.end() || found->second.empty() ? fallback : found->second.front();
}

double Options::number(const std::string& name, double fallback) const
{
    if (!has(name))
        return fallback;
    const std::string text = value(name);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        throw InputError(fmt::format("-{}: found '{}', allowed a number", name, text));
    return number;
}

int Options::threadCount() const
{
    if (threads > 0)
        return threads;
    const char* environment = std::getenv("OMP_NUM_THREADS");
    if (!environment || !*environment)
        return 1;
    const std::string text = environment; // "4,2" names nested levels; the first counts here
    return threadNumber("OMP_NUM_THREADS", text.substr(0, text.find(',')));
}

std::string helpPage(const ApplicationInfo& info)
{
    const std::vector<ExtraOption> options = allOptions(info);
    std::size_t width = 0;
    for (const ExtraOption& option : options)
        width = std::max(width, usage(option).size());
    std::string page = fmt::format("{}: {}\n\nUsage: {} [options]\n\n", info.name, info.purpose, info.name);
    for (const ExtraOption& option : options)
        page += fmt::format("  {:<{}}  {}\n", usage(option), width, option.help);
    if (!info.details.empty())
        page += "\n" + info.details + (info.details.back() == '\n' ? "" : "\n");
    return page;
}

namespace
{
/// OpenMP's threads spin where they wait, unless the environment they find when the program is loaded says otherwise;
/// beside another busy program two spinning threads are dozens of times slower than one. So the utility starts itself
/// again with patient threads: they spin for some microseconds, then sleep. Who sets OMP_WAIT_POLICY decides instead.
void letThreadsSleep(char** argv, const ApplicationInfo& info)
{
#ifdef __linux__
    const bool threads = info.usesThreads || std::any_of(info.options.begin(), info.options.end(),
                                                         [](const ExtraOption& o) { return o.name == "threads"; });
    if (!threads)
        return;
    std::error_code failed;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
    if (failed || self.filename() != info.name || std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT"))
        return;
    setenv("OMP_WAIT_POLICY", "passive", 1);
    setenv("GOMP_SPINCOUNT", "2000", 1);
    execv("/proc/self/exe", argv);
#else
    (void)argv, (void)info;
#endif
}
} // namespace

int runApplication(int argc, char** argv, const ApplicationInfo& info, const std::function<int(const Options&)>& body)
{
    letThreadsSleep(argv, info);
    std::signal(SIGXFSZ, SIG_IGN); // a limit on file sizes is an error of that file, not the end
    try
    {
        const int code = run(std::vector<std::string>(argv + (argc > 0), argv + argc), info, body);
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            return complain(info, code ? code : 1, outputFailed);
        return code;
    }
    catch (const InputError& error)
    {
        return complain(info, 1, error.what());
    }
    catch (const std::filesystem::filesystem_error& error)
    {
        return complain(info, 1, error.what());
    }
    catch (const std::system_error& error)
    {
        if (std::ferror(stdout))
            return complain(info, 1, outputFailed);
        return complain(info, 2, error.what()); // of the machine: no more threads, say
    }
    catch (const StepError& error)
    {
        return complain(info, 2, error.what());
    }
    catch (const std::bad_alloc&)
    {
        return complain(info, 2, "not enough memory; fewer particles or cells need less");
    }
    catch (const std::exception& error)
    {
        return complain(
            info, 3,
            fmt::format("{} (a mistake in {} itself, not in your input: please report it)", error.what(), info.name));
    }
    catch (...)
    {
        return complain(info, 3,
                        fmt::format("unknown failure (a mistake in {} itself, not in your input: please "
                                    "report it)",
                                    info.name));
    }
}
} // namespace mpm::cases
