#pragma once
/// What a program does when the disk is full, tried in a child process whose files may not grow beyond a limit.
#include "base/error.hpp"

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mpm::tests
{
/// True if the action ends in an InputError when files end at `bytes`.
template <class Action>
bool refusedOnFullDisk(unsigned long bytes, Action&& action)
{
    const pid_t child = ::fork();
    if (child == 0)
    {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try
        {
            action();
        }
        catch (const InputError&)
        {
            ::_exit(7);
        }
        catch (...)
        {
            ::_exit(8);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 7;
}
} // namespace mpm::tests
