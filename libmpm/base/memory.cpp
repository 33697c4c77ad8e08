#include "base/memory.hpp"

#include <fstream>
#include <limits>
#include <string>
#include <unistd.h>

namespace mpm
{
namespace
{
double fromStatus(const char* key)
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kilobytes = 0; word == key && status >> kilobytes)
            return 1024 * kilobytes;
    return 0;
}
} // namespace

double peakMemory()
{
    return fromStatus("VmHWM:");
}

double dataMemory()
{
    return fromStatus("VmData:");
}

double machineMemory()
{
    const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGE_SIZE);
    return pages > 0 && size > 0 ? double(pages) * double(size) : std::numeric_limits<double>::infinity();
}
} // namespace mpm
