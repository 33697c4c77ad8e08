#pragma once
/// Where the wall time of a run went: the passes of the step, history and output around it, and the rest. The rows add
/// up to the time since the profile was made.
///
///     pass          what
///     start         reading and checking the case, until the first step
///     weights       shape functions
///     toGrid        particles to grid: mass, momentum, forces
///     nodal         gravity, walls, tractions: sweeps over nodes
///     toParticles   grid to particles: velocity, position, second projection
///     law           velocity gradients, deformation and stress
///     sort, split   order of the particles in memory; refining them
///     timeStep      how large the next step may be
///     monitor       what stepping/monitor.hpp looks at, and copies to go back to
///     history       energy budget, rows of postProcessing/*.csv
///     output        states and the index files of ParaView
///     other         all else: strain paths, progress
///     total         the sum
///     processor     time of the processor from the first step on, all threads, without history, output and formulas of
///                   body forces (a formula costs many times what a step does, whatever the method): no part of the sum
///
/// nsPerParticleStep is a row's time over the sum, over all steps, of the particles there were. Covered by
/// tests/cases/profile.py.
#include "stepping/stepper.hpp"

#include <chrono>
#include <filesystem>

namespace mpm::cases
{
class RunProfile
{
  public:
    double timeStep = 0, monitor = 0, history = 0, output = 0; ///< [s], filled by base/clock.hpp
    double apartProcessor = 0; ///< processor time that does not count as the steps' own [s]

    /// Reading and checking are over.
    void beginSteps(const stepping::PassTimes& passes);
    /// A step of so many particles is done.
    void countStep(Index particles) { particleSteps_ += double(particles); }
    double particleSteps() const { return particleSteps_; } ///< steps of particles counted so far
    double elapsed() const;                                 ///< since the profile was made [s]
    /// Processor time of all threads since beginSteps(), without apartProcessor [s].
    double processor() const;
    double nsPerParticleStep(double seconds) const { return particleSteps_ > 0 ? 1e9 * seconds / particleSteps_ : 0; }

    /// The rows as aligned text, those that took no time left out.
    std::string text(const stepping::PassTimes& passes, int indent) const;
    /// CSV: pass,seconds,share,nsPerParticleStep; share is a fraction of the total.
    void write(const std::filesystem::path& file, const stepping::PassTimes& passes) const;

  private:
    struct Row
    {
        const char* pass;
        double seconds;
    };
    std::vector<Row> rows(const stepping::PassTimes& passes) const;

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    double start_ = 0, particleSteps_ = 0, processorStart_ = 0;
};
} // namespace mpm::cases
