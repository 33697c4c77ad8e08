#pragma once
/// Time of a run, in OpenFOAM's words:
///
///     startFrom        latestTime;     // firstTime | startTime | latestTime: the stored time to go on from
///     startTime        0;              // [s], with startFrom startTime
///     stopAt           endTime;
///     endTime          2.5;            // [s]
///     deltaT           1e-3;           // [s]; the first step with adjustTimeStep yes
///     adjustTimeStep   no;             // yes: (c_p + |v|) deltaT/h <= maxCo and 0.9 of the stability limit
///     maxCo            0.5;            // [-]
///     maxDeltaT        1e30;           // [s]
///     writeControl     runTime;        // timeStep | runTime (fixed deltaT: the nearest step, otherwise the first step
///                                      // past it) | adjustableRunTime (steps are shortened to land on write times)
///     writeInterval    0.25;           // [s], or steps
///     purgeWrite       0;              // keep the last n written times; 0 keeps all
///     timePrecision    6;              // digits in folder names
///     runTimeModifiable no;            // only `no`: a run reads its dictionaries once
///     historyInterval  1;              // steps between rows of postProcessing/history.csv
///     fields           (referencePosition); // stored beyond what the method needs (case/expressionForce.hpp); default
///     ()
///
/// The sequence of steps follows from the state and the write times alone, never from endTime: a run takes the same
/// steps however it is cut by restarts. It ends with the step that reaches endTime: with a fixed step the nearest one,
/// with changing steps the first not before it, which lands on it if endTime is a write time of adjustableRunTime and
/// goes past it by less than a step otherwise.
#include "dictionary/dictionary.hpp"
#include "stepping/timeStep.hpp"

#include <string>

namespace mpm::cases
{
class RunTime
{
  public:
    explicit RunTime(const dictionary::Dictionary& controlDict);

    enum class Start
    {
        first,
        given,
        latest
    };
    Start start() const { return start_; }
    double startTime() const { return startTime_; }
    double endTime() const { return endTime_; }
    double deltaT() const { return deltaT_; }
    bool adjustable() const { return adjust_; }
    double maxCo() const { return maxCo_; }
    Index purgeWrite() const { return purge_; }
    int timePrecision() const { return precision_; }
    Index historyInterval() const { return history_; }

    /// Is the run over at this time?
    bool done(double time) const;
    /// The step to take from `time`; `limit` is the largest allowed (adjustTimeStep), ignored otherwise.
    double nextStep(double time, double limit) const;
    /// (c_p + |v|) deltaT/h <= maxCo and 0.9 of the stability limit.
    double boundedStep(const stepping::StabilityLimit& limit, double h) const;
    /// Is the state after this step to be written?
    bool writeNow(double timeBefore, double timeAfter, Index step) const;
    /// The same where somebody else says when the run ends.
    bool inTurn(double timeBefore, double timeAfter, Index step) const;

  private:
    bool changing() const; ///< are steps of changing size?
    bool landing() const;  ///< are steps shortened to end at write times?

    Start start_;
    double startTime_, endTime_, deltaT_, maxCo_, maxDeltaT_;
    bool adjust_;
    std::string writeControl_;
    double writeInterval_;
    Index purge_, history_;
    int precision_;
};
} // namespace mpm::cases
