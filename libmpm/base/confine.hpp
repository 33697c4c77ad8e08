#pragma once
#include <limits>

/// Takes from this process, for good, what reading a file does not need: making, writing, renaming or removing files,
/// starting processes, the network; and bounds its memory by that of the machine, or to so many bytes more than it has.
/// Threads may still be started.
///
/// By limits of the kernel and a filter of system calls (seccomp, Linux on x86-64 and AArch64), which answers EPERM.
/// Where the filter is not to be had, file sizes are still limited to zero.
namespace mpm
{
/// True if the filter is in force.
bool confineProcess(double moreMemory = std::numeric_limits<double>::infinity());
} // namespace mpm
