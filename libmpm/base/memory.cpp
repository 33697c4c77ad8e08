#include "base/memory.hpp"

#include <fstream>
#include <string>

namespace mpm
{
double peakMemory()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes)
            return 1024 * kilobytes;
    return 0;
}
} // namespace mpm
