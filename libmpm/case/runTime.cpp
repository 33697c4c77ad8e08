#include "case/runTime.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

RunTime::RunTime(const Dictionary& d)
{
    d.choose("application", "the solver", {{"mpmSolve", "explicit material point method"}}, "mpmSolve");
    const auto from = d.choose("startFrom", "the stored time to go on from",
                               {{"firstTime", "the first stored time"},
                                {"startTime", "the stored time nearest to startTime"},
                                {"latestTime", "the last stored time"}},
                               "latestTime");
    start_ = from == "firstTime" ? Start::first : from == "startTime" ? Start::given : Start::latest;
    startTime_ = d.get<double>({"startTime", "time to start from", unit::time, Bound::any(), 0.0});
    d.choose("stopAt", "when the run ends", {{"endTime", "at endTime"}}, "endTime");
    endTime_ = d.get<double>({"endTime", "end of the run", unit::time});
    deltaT_ = d.get<double>({"deltaT", "time step", unit::time, Bound::positive()});
    adjust_ = d.get<bool>({"adjustTimeStep", "follow maxCo and the stability limit", {}, {}, false});
    maxCo_ = d.get<double>({"maxCo", "largest (c_p + |v|) deltaT/h", {}, Bound::positive(), 0.5});
    maxDeltaT_ = d.get<double>({"maxDeltaT", "largest time step", unit::time, Bound::positive(), 1e30});
    writeControl_ = d.choose("writeControl", "when states are written",
                             {{"timeStep", "every writeInterval steps"},
                              {"runTime", "at the step that reaches every writeInterval seconds"},
                              {"adjustableRunTime", "steps are shortened to land on every writeInterval seconds"}},
                             "runTime");
    writeInterval_ = writeControl_ == "timeStep"
                         ? double(d.get<Index>({"writeInterval", "steps between states", {}, Bound::atLeast(1)}))
                         : d.get<double>({"writeInterval", "time between states", unit::time, Bound::positive()});
    purge_ = d.get<Index>({"purgeWrite", "keep the last n written times (0: all)", {}, Bound::nonNegative(), 0});
    precision_ = int(d.get<Index>({"timePrecision", "digits in folder names", {}, Bound::between(1, 17), 6}));
    history_ = d.get<Index>({"historyInterval", "steps between rows of history.csv", {}, Bound::atLeast(1), 1});
    if (d.get<bool>({"runTimeModifiable", "read dictionaries again while running", {}, {}, false}))
        d.fail("runTimeModifiable", "yes", "no: a run reads its dictionaries once, so that it can be repeated");
}

bool RunTime::done(double time) const
{
    // Steps of changing size: the first that reaches it, with a margin for sums of steps that should land on it.
    return time > endTime_ - (changing() ? std::max(1e-9 * deltaT_, 1e-15 * std::abs(endTime_)) : 0.5 * deltaT_);
}

bool RunTime::changing() const
{
    return adjust_ || landing();
}

bool RunTime::landing() const
{
    return writeControl_ == "adjustableRunTime";
}

double RunTime::nextStep(double time, double limit) const
{
    const double wanted = adjust_ ? std::min(limit, maxDeltaT_) : deltaT_;
    if (!landing())
        return wanted;
    const double remaining = writeInterval_ * (std::floor(time / writeInterval_ + 1e-9) + 1) - time;
    return remaining / std::max(1.0, std::ceil(remaining / wanted - 1e-9));
}

double RunTime::boundedStep(const stepping::StabilityLimit& limit, double h) const
{
    return std::min(maxCo_ * h / (limit.waveSpeed + limit.speed), 0.9 * limit.deltaT);
}

bool RunTime::writeNow(double before, double after, Index step) const
{
    return done(after) || inTurn(before, after, step);
}

bool RunTime::inTurn(double before, double after, Index step) const
{
    if (writeControl_ == "timeStep")
        return step % Index(writeInterval_) == 0;
    // Equal steps: the one nearest to the write time. Steps of changing size: every write time falls into just one of
    // them, whatever their sizes; the margin is for sums of steps that should land on it.
    const double margin = changing() ? 1e-9 * writeInterval_ : 0.5 * deltaT_;
    return std::floor((after + margin) / writeInterval_) > std::floor((before + margin) / writeInterval_);
}
} // namespace mpm::cases
