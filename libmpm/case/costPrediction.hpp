#pragma once
/// What a run will cost, known before it: steps, rows and states from the dictionaries, seconds from a rehearsal on
/// this machine, bytes from the state itself.
///
///     seconds = start + steps particles s + rows r + states w
///
/// s: seconds a particle and step, the median of batches of whole sort intervals on the real state in memory, after a
/// warm-up that is not counted; r: a row of history.csv and energyBudget.csv; w: a state, written into memory (the disk
/// takes states while steps go on). The state that was stepped is thrown away. The rehearsal takes at most 5 % of the
/// predicted run, between 0.2 s and 2 s, but never less than a handful of steps.
///
/// Seconds are given twice: of the processor (all threads), and of the clock on the wall as busy as the machine was
/// during the rehearsal.
///
/// The state at the start is not the state later. What a particle-step costs on the collapsing column (cells of 2/15 m,
/// ns of processor time at the start and at its dearest): uGIMP 60 to 70, as fewer particles share a node and a tile;
/// cpGIMP 65 to 95, because domains wider than a cell reach four nodes an axis in place of three, and one of 64
/// neighbours is enough. Laws cost the same whether soil yields or not (they are computed without branches; substeps
/// excepted). So where domains follow the stretch, wide ones are rehearsed too. Steps that adapt get smaller with speed
/// and as soil loosens: they are counted as allowed now, and at the speed of a fall through the body's own height in
/// soil of twice its volume. Both make a range, from `least` to `most`; the prediction is its middle. Spreading is not
/// foreseen: a body that runs out far takes up to 15 % longer than predicted.
///
/// What cannot be known: how busy the machine will be, what a disk does that is slower than the steps, and which
/// particles will split.
///
/// Covered by tests/unit/costPrediction.cpp, tests/cases/prediction.py and, with ratios of predicted to real,
/// tests/benchmark/predictionCheck.py.
#include "case/runTime.hpp"
#include "splitting/splitParticles.hpp"
#include "state/state.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mpm::cases
{
/// What a run does between a time and its end.
struct RunCount
{
    double steps = 0, states = 0, rows = 0;
    bool exact = true; ///< false: steps of changing size, or too many to be counted one by one
};

/// Counted by taking the steps of RunTime one after the other: exact where their size does not follow the motion.
/// firstLimit, limit: the largest step allowed now and later (adjustTimeStep).
RunCount countRun(const RunTime& runTime, double time, Index step, double firstLimit, double limit);

/// Processor and wall seconds.
struct Seconds
{
    double cpu = 0, wall = 0;
    Seconds& operator+=(const Seconds& o)
    {
        cpu += o.cpu;
        wall += o.wall;
        return *this;
    }
    friend Seconds operator*(double factor, const Seconds& s) { return {factor * s.cpu, factor * s.wall}; }
    friend Seconds operator-(const Seconds& a, const Seconds& b) { return {a.cpu - b.cpu, a.wall - b.wall}; }
};

/// Both clocks of this process, now.
Seconds processSeconds();

/// Of a list of measurements [s]; zero if there are none.
struct Spread
{
    Seconds median, least, most;
};
Spread spreadOf(const std::vector<Seconds>& values);

/// What was measured on the state at the start.
struct Rehearsal
{
    Seconds start;                          ///< reading and checking
    Spread particleStep;                    ///< a step over the particles it was for
    std::optional<Spread> wideParticleStep; ///< the same with domains wider than a cell, where the shape follows them
    Seconds row, state;
    double stateBytes = 0, rowBytes = 0; ///< of state.h5; of one row of all tables
    double stepBytes = 0;                ///< rows that are written every step (recordStrain)
    double peakBytes = 0;                ///< resident, what the run will hold of a copy to go back to included
    Index steps = 0, batches = 0;
    double seconds = 0; ///< wall, of the rehearsal
    std::string fault;  ///< why a step could not be taken; empty: none
};

/// All numbers of a prediction.
struct CostPrediction
{
    RunCount count;
    std::optional<double> mostSteps; ///< adjustTimeStep: steps of loosened soil at the speed of a fall
    double deltaT = 0;               ///< the step allowed now [s]
    Index particles = 0, cellsWithMaterial = 0;
    double particleBytes = 0; ///< columns of the state
    Rehearsal rehearsal;
    Seconds total, stepping, output; ///< the middle of the range
    Seconds least, most;
    /// Splitting: particles and seconds if each particle is split once at the start, and at the cap.
    struct Split
    {
        double particles = 0;
        Seconds total;
    };
    std::optional<Split> splitOnce, splitCap;
    double purge = 0; ///< states that stay; 0: all
};

/// What the state at the start says, before it is stepped.
void describeState(CostPrediction& prediction, const state::State& state,
                   const std::optional<splitting::Rule>& splitting);
/// Adds up the seconds.
void addUp(CostPrediction& prediction);

/// Cells that hold the centre of a particle.
Index cellsWithMaterial(const state::State& state);

/// Bytes in all columns of the particles.
double columnBytes(const state::State& state);

/// The speed a body reaches falling through its own height, beyond what it has [m/s].
double fallSpeed(const state::State& state, const std::optional<Vector3>& gravity);

/// The first particles of a state, as a state of its own.
state::State firstParticles(const state::State& state, Index count);

/// Lines (what, text) as -dry-run prints them.
std::vector<std::pair<std::string, std::string>> predictionLines(const CostPrediction& prediction, int threads);
} // namespace mpm::cases
