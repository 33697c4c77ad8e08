#include "base/childProcess.hpp"

#include "base/confine.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace mpm
{
namespace
{
constexpr int codeOfException = 70;

[[noreturn]] void child(const std::function<std::string()>& work, double moreMemory, int out, pid_t parent)
{
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (::getppid() != parent)
        ::_exit(codeOfException);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(number, SIG_DFL); // the parent's handlers are none of ours
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (int descriptor = 0; nowhere >= 0 && descriptor <= 2; ++descriptor)
        ::dup2(nowhere, descriptor);
    confineProcess(moreMemory);
    try
    {
        const std::string bytes = work();
        for (std::size_t done = 0; done < bytes.size();)
        {
            const ssize_t n = ::write(out, bytes.data() + done, bytes.size() - done);
            if (n < 0 && errno != EINTR)
                ::_exit(codeOfException);
            done += std::size_t(std::max<ssize_t>(n, 0));
        }
        ::_exit(0); // nothing of the parent is flushed or destroyed twice
    }
    catch (...)
    {
        ::_exit(codeOfException);
    }
}

/// Reads to the end of the pipe; says what went wrong, if anything.
std::string collect(int in, const ChildLimits& limits, ChildAnswer& answer)
{
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(limits.seconds);
    std::vector<char> block(std::size_t(1) << 16);
    for (;;)
    {
        const double left = std::chrono::duration<double>(end - Clock::now()).count();
        if (left <= 0)
        {
            answer.late = true;
            return fmt::format("took longer than {:g} s and was ended", limits.seconds);
        }
        pollfd ready{in, POLLIN, 0};
        if (::poll(&ready, 1, int(std::min(left, 1.0) * 1000) + 1) <= 0)
            continue;
        const ssize_t n = ::read(in, block.data(), block.size());
        if (n == 0)
            return "";
        answer.bytes.append(block.data(), std::size_t(std::max<ssize_t>(n, 0)));
        if (answer.bytes.size() > limits.answerBytes)
            return fmt::format("answered with more than {} MB and was ended", limits.answerBytes >> 20);
    }
}

/// The same of how the process ended.
std::string judge(int status, const std::string& bytes)
{
    if (WIFSIGNALED(status))
        return fmt::format("was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0 || bytes.empty())
        return fmt::format("left with exit code {} and without an answer", WEXITSTATUS(status));
    return "";
}
} // namespace

ChildAnswer runInChild(const std::function<std::string()>& work, const ChildLimits& limits)
{
    int ends[2];
    if (::pipe(ends) != 0)
        return {.bytes = {}, .failure = fmt::format("could not be started: {}", std::strerror(errno))};
    std::fflush(nullptr);
    const pid_t parent = ::getpid(), process = ::fork();
    if (process == 0)
    {
        ::close(ends[0]);
        child(work, limits.moreMemory, ends[1], parent);
    }
    ::close(ends[1]);
    ChildAnswer answer;
    if (process < 0)
        answer.failure = fmt::format("could not be started: {}", std::strerror(errno));
    else
    {
        answer.ran = true;
        answer.failure = collect(ends[0], limits, answer);
        if (!answer.failure.empty())
            ::kill(process, SIGKILL);
        int status = 0;
        while (::waitpid(process, &status, 0) < 0 && errno == EINTR)
            continue;
        if (answer.failure.empty())
            answer.failure = judge(status, answer.bytes);
    }
    ::close(ends[0]);
    if (!answer.failure.empty())
        answer.bytes.clear();
    return answer;
}
} // namespace mpm
