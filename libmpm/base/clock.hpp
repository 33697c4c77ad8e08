#pragma once
/// Adds the wall time of its own life to a counter [s].
#include <chrono>

namespace mpm
{
class Clock
{
  public:
    explicit Clock(double& total) : total_(total), start_(std::chrono::steady_clock::now()) {}
    ~Clock() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Clock(const Clock&) = delete;
    Clock& operator=(const Clock&) = delete;

  private:
    double& total_;
    std::chrono::steady_clock::time_point start_;
};
} // namespace mpm
