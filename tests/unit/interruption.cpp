// The first signal is noted, the second kills; ignored ones stay ignored.
#include "case/interruption.hpp"

#include <catch2/catch.hpp>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using mpm::cases::Interruption;

namespace
{
/// How a child ends that runs `action`.
template <class Action>
int statusOf(Action&& action)
{
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(action());
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}
} // namespace

TEST_CASE("the first signal is noted")
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
    {
        const Interruption interruption;
        CHECK(interruption.signal() == 0);
        std::raise(number);
        CHECK(interruption.signal() == number);
    }
    const Interruption fresh;
    CHECK(fresh.signal() == 0);
    CHECK(Interruption::exitCode(SIGINT) == 130);
    CHECK(Interruption::exitCode(SIGTERM) == 143);
    CHECK(mpm::cases::signalName(SIGHUP) == "SIGHUP");
}

TEST_CASE("the second signal kills, of whichever kind")
{
    for (const int second : {SIGINT, SIGTERM, SIGHUP})
    {
        const int status = statusOf([&] {
            const Interruption interruption;
            std::raise(SIGINT);
            std::raise(second);
            return 0;
        });
        REQUIRE(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == second);
    }
}

TEST_CASE("ignored signals stay ignored, and what was there before comes back")
{
    const int status = statusOf([] {
        std::signal(SIGHUP, SIG_IGN);
        std::signal(SIGTERM, SIG_DFL); // Catch has its own
        {
            const Interruption interruption;
            std::raise(SIGHUP);
            if (interruption.signal() != 0)
                return 1;
            std::raise(SIGTERM);
        }
        struct sigaction now = {};
        sigaction(SIGTERM, nullptr, &now);
        return now.sa_handler == SIG_DFL ? 0 : 2;
    });
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}
