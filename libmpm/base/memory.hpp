#pragma once
/// Memory of this process.
namespace mpm
{
/// The most that was ever resident [bytes]: VmHWM of Linux; 0 where the system does not tell.
double peakMemory();

/// What the machine has [bytes], whoever uses it; infinity where the system does not tell.
double machineMemory();
} // namespace mpm
