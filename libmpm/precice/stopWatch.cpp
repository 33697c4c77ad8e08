#include "precice/stopWatch.hpp"

#include <chrono>
#include <utility>

namespace mpm::precice
{
StopWatch::StopWatch(std::function<int()> signal, std::function<void(int)> rescue, double patience)
    : signal_(std::move(signal)), rescue_(std::move(rescue)), patience_(patience),
      thread_([this](const std::stop_token& end) { watch(end); })
{}

void StopWatch::waiting(bool now)
{
    const std::lock_guard lock(mutex_);
    waiting_ = now;
}

void StopWatch::watch(const std::stop_token& end)
{
    constexpr double tick = 0.05;
    double since = 0;
    while (!end.stop_requested())
    {
        std::this_thread::sleep_for(std::chrono::duration<double>(tick));
        const std::lock_guard lock(mutex_);
        since = signal_() && waiting_ ? since + tick : 0;
        if (since < patience_)
            continue;
        rescue_(signal_());
        return;
    }
}
} // namespace mpm::precice
