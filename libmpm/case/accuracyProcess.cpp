#include "case/accuracyProcess.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace mpm::cases
{
namespace fs = std::filesystem;

namespace
{
double seconds(const timeval& t)
{
    return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
}

/// The signals that may come for both, held back around fork: a child that takes one by its parent's handler loses it.
sigset_t endings()
{
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&set, signal);
    return set;
}

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* argv, char* const* environment, int log, pid_t parent)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction now = {};
        ::sigaction(signal, nullptr, &now);
        if (now.sa_handler != SIG_IGN)
            ::signal(signal, SIG_DFL);
    }
    const sigset_t held = endings();
    ::sigprocmask(SIG_UNBLOCK, &held, nullptr);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent)
        ::_exit(127);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, 0);
    ::dup2(log, 1);
    ::dup2(log, 2);
    ::execve(program, argv, environment);
    ::_exit(127);
}

std::vector<std::string> environmentOfOneThread()
{
    std::vector<std::string> out;
    for (char** entry = environ; *entry; ++entry)
        if (std::strncmp(*entry, "OMP_NUM_THREADS=", 16) != 0)
            out.emplace_back(*entry);
    out.emplace_back("OMP_NUM_THREADS=1");
    return out;
}

std::vector<char*> pointers(std::vector<std::string>& texts)
{
    std::vector<char*> out;
    for (auto& text : texts)
        out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

int codeOf(int status)
{
    return WIFEXITED(status) ? WEXITSTATUS(status) : WIFSIGNALED(status) ? 128 + WTERMSIG(status) : -1;
}
} // namespace

ProcessResult runProcess(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& log,
                         const std::function<bool()>& stopped)
{
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0)
        throw InputError(fmt::format("{}: cannot be written ({})", log.string(), std::strerror(errno)));
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    auto environment = environmentOfOneThread();
    const auto argv = pointers(words), variables = pointers(environment);
    const pid_t parent = ::getpid();
    const double begin = now();
    const sigset_t held = endings();
    sigset_t before;
    ::pthread_sigmask(SIG_BLOCK, &held, &before);
    const pid_t child = ::fork();
    if (child == 0)
        become(words[0].c_str(), argv.data(), variables.data(), file, parent);
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::close(file);
    ProcessResult result;
    if (child < 0)
        return result;
    int status = 0;
    rusage usage{};
    auto pause = std::chrono::microseconds(200);
    for (bool told = false; ::wait4(child, &status, WNOHANG, &usage) == 0;)
    {
        if (!told && stopped && stopped())
            told = ::kill(child, SIGTERM) == 0;
        std::this_thread::sleep_for(pause);
        pause = std::min(pause * 2, std::chrono::microseconds(10000));
    }
    result.wallSeconds = now() - begin;
    result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.exitCode = codeOf(status);
    return result;
}

fs::path utilityPath(const std::string& name)
{
    std::error_code none;
    const auto beside = fs::read_symlink("/proc/self/exe", none).parent_path() / name;
    if (none || !fs::exists(beside, none))
        throw InputError(
            fmt::format("found no {} beside this program, allowed: both in one folder, as they are built", name));
    return beside;
}

std::string errorInLog(const fs::path& log)
{
    std::ifstream in(log);
    std::string last, error;
    for (std::string line; std::getline(in, line);)
    {
        if (const auto at = line.find("error: "); line.starts_with("-->") && at != std::string::npos)
            error = line.substr(at + 7);
        if (!line.empty())
            last = line;
    }
    return error.empty() ? last : error;
}
} // namespace mpm::cases
