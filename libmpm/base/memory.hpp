#pragma once
/// Memory of this process.
namespace mpm
{
/// The most that was ever resident [bytes]: VmHWM of Linux; 0 where the system does not tell.
double peakMemory();
} // namespace mpm
