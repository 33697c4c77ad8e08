#pragma once
/// Wall time [s]: now(), and a clock that adds the time of its own life to a counter. The same for the processor time of
/// all threads, which a busy machine disturbs less.
#include <chrono>
#include <ctime>

namespace mpm
{
inline double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline double readClock(clockid_t clock)
{
    timespec t{};
    ::clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// [s], user and system, of all threads of this process.
inline double processorNow()
{
    return readClock(CLOCK_PROCESS_CPUTIME_ID);
}

/// The same of the calling thread.
inline double threadProcessorNow()
{
    return readClock(CLOCK_THREAD_CPUTIME_ID);
}

template <double (*Now)()>
class ClockOf
{
  public:
    explicit ClockOf(double& total) : total_(total), start_(Now()) {}
    ~ClockOf() { total_ += Now() - start_; }
    ClockOf(const ClockOf&) = delete;
    ClockOf& operator=(const ClockOf&) = delete;

  private:
    double& total_;
    double start_;
};

using Clock = ClockOf<now>;
using ProcessorClock = ClockOf<processorNow>;
} // namespace mpm
