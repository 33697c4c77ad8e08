#pragma once
/// A signal that comes while the coupling library waits for its partner: the library does not come back for it. Once it
/// has waited for `patience` seconds after a signal, another thread does what is to be done (`rescue`: write the last
/// accepted window, end the program); the soil is at rest meanwhile. A library that comes back in time is left alone.
///
///     StopWatch watch([&] { return interruption.signal(); }, [&](int signal) { ...; std::_Exit(128 + signal); });
///     watch.waiting(true);  library.advance(step);  watch.waiting(false);
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace mpm::precice
{
class StopWatch
{
  public:
    StopWatch(std::function<int()> signal, std::function<void(int)> rescue, double patience = 1);

    /// Is the library at work? Comes back only when no rescue is under way.
    void waiting(bool now);

  private:
    void watch(const std::stop_token& end);

    std::function<int()> signal_;
    std::function<void(int)> rescue_;
    double patience_;
    std::mutex mutex_;
    bool waiting_ = false;
    std::jthread thread_; ///< last: it ends before what it looks at
};
} // namespace mpm::precice
