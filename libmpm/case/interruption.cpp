#include "case/interruption.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

namespace mpm::cases
{
namespace
{
struct Watched
{
    int number;
    const char* name;
};
constexpr std::array<Watched, 3> watched = {{{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}}};

/// Signals reach any thread: not a sig_atomic_t, which is for one.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler may not wait");
std::array<struct sigaction, watched.size()> before;

/// Only what POSIX allows in a handler: a flag, and sigaction.
void note(int number)
{
    received = number;
    struct sigaction deadly = {};
    deadly.sa_handler = SIG_DFL;
    for (const auto& one : watched)
        sigaction(one.number, &deadly, nullptr);
}
} // namespace

Interruption::Interruption()
{
    received = 0;
    struct sigaction noted = {};
    noted.sa_handler = note;
    noted.sa_flags = SA_RESTART; // files under way are written to the end
    for (const auto& one : watched)
        sigaddset(&noted.sa_mask, one.number);
    for (std::size_t i = 0; i < watched.size(); ++i)
    {
        sigaction(watched[i].number, nullptr, &before[i]);
        if (before[i].sa_handler != SIG_IGN)
            sigaction(watched[i].number, &noted, nullptr);
    }
}

Interruption::~Interruption()
{
    for (std::size_t i = 0; i < watched.size(); ++i)
        sigaction(watched[i].number, &before[i], nullptr);
}

int Interruption::signal() const
{
    return received;
}

std::string signalName(int signal)
{
    for (const auto& one : watched)
        if (one.number == signal)
            return one.name;
    return "signal " + std::to_string(signal);
}
} // namespace mpm::cases
