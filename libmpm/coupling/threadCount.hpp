#pragma once
#include <omp.h>

namespace mpm::coupling
{
/// The number of threads of the calling thread's loops; put back afterwards, as it may be a master's own.
class ThreadCount
{
  public:
    explicit ThreadCount(int count) : before_(omp_get_max_threads())
    {
        if (count > 0)
            omp_set_num_threads(count);
    }
    ~ThreadCount() { omp_set_num_threads(before_); }
    ThreadCount(const ThreadCount&) = delete;
    ThreadCount& operator=(const ThreadCount&) = delete;

  private:
    int before_;
};
} // namespace mpm::coupling
