#pragma once
/// Wall time [s]: now(), and a clock that adds the time of its own life to a counter.
#include <chrono>

namespace mpm
{
inline double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Clock
{
  public:
    explicit Clock(double& total) : total_(total), start_(now()) {}
    ~Clock() { total_ += now() - start_; }
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;

  private:
    double& total_;
    double start_;
};
} // namespace mpm
