#pragma once
/// Rows of the benchmark for people and for programs.
#include "benchmark/measureRow.hpp"

namespace mpm::benchmark
{
/// Two tables: times, rates and ratios; and where the time went.
std::string tableOf(const std::vector<Row>& rows);

/// An array of objects with exactly the members dimension, shape, stressUpdate, law, real ("double"; "float" with
/// MPM_STORAGE=float), particles, threads, nsPerParticleStep (median), naiveNsPerParticleStep (null if not measured),
/// bytesPerParticle (resident), triadGBs, fmaGFs, rooflineShare. A number that is not finite is null.
std::string jsonOf(const std::vector<Row>& rows);
} // namespace mpm::benchmark
