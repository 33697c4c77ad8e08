#pragma once
/// Processor time [s], user and system: what a busy machine disturbs less than wall time (base/clock.hpp).
#include <ctime>

namespace mpm
{
inline double readClock(clockid_t clock)
{
    timespec t{};
    ::clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Of all threads of this process.
inline double processorNow()
{
    return readClock(CLOCK_PROCESS_CPUTIME_ID);
}

/// Of the calling thread.
inline double threadProcessorNow()
{
    return readClock(CLOCK_THREAD_CPUTIME_ID);
}

/// Adds the processor time of its own life, of all threads, to a counter.
class ProcessorClock
{
  public:
    explicit ProcessorClock(double& total) : total_(total), start_(processorNow()) {}
    ~ProcessorClock() { total_ += processorNow() - start_; }
    ProcessorClock(const ProcessorClock&) = delete;
    ProcessorClock& operator=(const ProcessorClock&) = delete;

  private:
    double& total_;
    double start_;
};
} // namespace mpm
