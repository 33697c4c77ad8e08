#pragma once
/// Memory of this process.
namespace mpm
{
/// The most that was ever resident [bytes]: VmHWM of Linux; 0 where the system does not tell.
double peakMemory();

/// What it may write to of its own, touched or not [bytes]: VmData of Linux; 0 where the system does not tell.
double dataMemory();

/// What the machine has [bytes], whoever uses it; infinity where the system does not tell.
double machineMemory();
} // namespace mpm
