#pragma once
/// What this machine can do at most, measured in this process with the threads asked for: the two lines of the
/// roofline (Williams, Waterman & Patterson, CACM 52 (2009) 65-76).
///
///     triad   a = b + s c over arrays far larger than the caches; 24 bytes an element, as McCalpin's STREAM counts
///     fma     independent chains of fused multiply-adds in registers of the widest kind the build uses; 2 flops each
///
/// Each is the best of several short runs: the machine's limit, not its average under load.
namespace mpm::benchmark
{
double triadBytesPerSecond(int threads);
double fmaFlopsPerSecond(int threads);
} // namespace mpm::benchmark
