#include "case/solverRun.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/version.hpp"
#include "case/makeStepper.hpp"
#include "case/provenance.hpp"
#include "case/strainRecorder.hpp"
#include "output/stateFile.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
std::string wallText(const nodal::Wall& wall, const state::GridBox& grid)
{
    const auto place =
        fmt::format("{} = {:g} m", axisNames[wall.axis], grid.origin[wall.axis] + grid.h * double(wall.plane));
    switch (wall.type)
    {
    case nodal::WallType::fixed:
        return "fixed at " + place;
    case nodal::WallType::roller:
        return "roller at " + place;
    case nodal::WallType::friction:
        return fmt::format("friction {:g} at {}", wall.mu, place);
    }
    return place;
}

void line(const std::string& what, const std::string& text)
{
    fmt::print("  {:<14} {}\n", what, text);
}
} // namespace

SolverRun::SolverRun(const CaseDirectory& folder, const Options& options)
    : folder_(folder), options_(options), series_(folder.folder(), folder.name())
{
    const auto control = dictionary::Dictionary::readFile(folder.dictionaryPath("system/controlDict"));
    runTime_.emplace(control);
    auto record = StrainRecorder::wanted(control);
    control.rejectUnread();
    const TimeFolder start = startFolder();
    lastStored_ = start.name;
    laterTimes_ = laterTimes(start);
    state_ = output::readState(folder.statePath(start.name));
    if (state_.particles.size() == 0)
        throw InputError(folder.statePath(start.name).string() + ": found no particles; run seedParticles");
    scene_ = readScene(folder, state_);
    scene_.dictionaries += "// system/controlDict\n" + control.text();
    stepper_ = makeStepper(scene_.shape, state_, scene_.scene);
    stepping::beginLedger(state_, scene_.scene.materials);
    limit_ = stabilityLimit();
    if (!runTime_->adjustable() && runTime_->deltaT() > limit_.deltaT)
        throw InputError(
            control.where("deltaT"),
            fmt::format("deltaT: found {:g} s, c_p deltaT/h = {:.3f}; allowed: at most {:.4g} s ({:.2f}) for {} "
                        "with {} at c_p = {:.1f} m/s and h = {:g} m, or adjustTimeStep yes",
                        runTime_->deltaT(), limit_.courant * runTime_->deltaT() / limit_.deltaT, limit_.deltaT,
                        limit_.courant, stepping::stressUpdateName(scene_.scene.stressUpdate), scene_.shape,
                        limit_.waveSpeed, state_.grid.h));
    if (!record.empty())
        recorder_ = std::make_unique<StrainRecorder>(std::move(record), state_, control.where("recordStrain"));
    written_.emplace(folder, runTime_->purgeWrite(), runTime_->timePrecision());
    written_->goOnFrom(state_, lastStored_);
    peakTime_ = state_.time;
    peakKinetic_ = state_.ledger.kineticEnergy;
    firstStep_ = writtenStep_ = state_.step;
}

SolverRun::~SolverRun() = default;

TimeFolder SolverRun::startFolder() const
{
    if (folder_.times().empty())
        throw InputError(folder_.folder().string() + ": found no time folder with a state.h5; run seedParticles first");
    switch (runTime_->start())
    {
    case RunTime::Start::first:
        return folder_.firstTime();
    case RunTime::Start::given:
        return folder_.nearestTime(runTime_->startTime());
    case RunTime::Start::latest:
        return folder_.latestTime();
    }
    return folder_.latestTime();
}

/// Going on from an earlier time would mix two runs: later times must be given up on purpose.
std::vector<std::string> SolverRun::laterTimes(const TimeFolder& start) const
{
    std::vector<std::string> later;
    for (const auto& time : folder_.times())
        if (time.value > start.value)
            later.push_back(time.name);
    if (!later.empty() && !options_.overwrite)
        throw InputError(
            fmt::format("{}: found stored times after the start at {}: {}; allowed: startFrom latestTime to go "
                        "on from the last, or -overwrite to remove them",
                        folder_.folder().string(), start.name, joinWords(later, " and ")));
    return later;
}

void SolverRun::banner() const
{
    const auto& s = scene_.scene;
    fmt::print("mpmSolve, libmpm {} ({}, {})\n", projectVersion(), gitRevision(), kernelText());
    line("case", std::filesystem::weakly_canonical(folder_.folder()).filename().string());
    line("particles",
         fmt::format("{} in {} dimensions, from time {}", state_.particles.size(), state_.particles.dim, lastStored_));
    line("grid", state_.particles.dim == 2 ? fmt::format("{} x {} cells of {:.6g} m", state_.grid.cells[0],
                                                         state_.grid.cells[1], state_.grid.h)
                                           : fmt::format("{} x {} x {} cells of {:.6g} m", state_.grid.cells[0],
                                                         state_.grid.cells[1], state_.grid.cells[2], state_.grid.h));
    line("method", fmt::format("{}, {}, FLIP{}", scene_.shape, stepping::stressUpdateName(s.stressUpdate),
                               s.picRate > 0 ? fmt::format(" with {:g} 1/s of PIC", s.picRate) : ""));
    for (const auto& material : s.materials)
        line("material", fmt::format("{}: {}, density {:g} kg/m^3, c_p {:.1f} m/s", material.name,
                                     material.law->describe(), material.density, material.waveSpeed()));
    if (s.gravity)
        line("gravity", fmt::format("({:g} {:g} {:g}) m/s^2", (*s.gravity)[0], (*s.gravity)[1], (*s.gravity)[2]));
    if (s.relaxationTime)
        line("damping", fmt::format("viscous, relaxation time {:g} s", *s.relaxationTime));
    for (const auto& wall : s.walls)
        line("wall", wall.name + ": " + wallText(wall, state_.grid) + (wall.separation ? ", may separate" : ", holds"));
    for (const auto& load : s.loads)
        line("load", load.pressure ? fmt::format("{}: pressure {:g} Pa", load.patch, load.magnitude)
                                   : fmt::format("{}: traction ({:g} {:g} {:g}) Pa", load.patch, load.traction[0],
                                                 load.traction[1], load.traction[2]));
    if (s.splitting)
        line("splitting", fmt::format("{} at {:g} seeding spacings, every {} steps",
                                      s.splitting->mode == splitting::Mode::fourWay ? "fourWay" : "stretched",
                                      s.splitting->threshold, s.splitting->interval));
    if (done())
        line("time", fmt::format("{:g} s; endTime {:g} s is reached, there is nothing to do", state_.time,
                                 runTime_->endTime()));
    else
        line("time", fmt::format("{:g} s to {:g} s, deltaT {}{:g} s", state_.time, runTime_->endTime(),
                                 runTime_->adjustable() ? "adjusted, first " : "", stepSize()));
    line("stability", fmt::format("deltaT <= {:.4g} s (c_p deltaT/h <= {:.2f}); now {:.3f}", limit_.deltaT,
                                  limit_.courant, limit_.waveSpeed * stepSize() / state_.grid.h));
    line("threads", fmt::format("{}", options_.threadCount()));
    for (const auto& note : {instructionSetNote(state_, instructionSet()), storageNote(state_, storage())})
        if (!note.empty())
            line("note", note);
}

void SolverRun::openOutput()
{
    folder_.requireWritable();
    folder_.removeLeftovers();
    written_->tidy();
    const bool fresh = state_.step == 0;
    // A run that ended here wrote its last row out of turn; the uninterrupted run has none.
    const bool outOfTurn = state_.step % runTime_->historyInterval() != 0 && !done();
    const auto continueAt = fresh ? std::nullopt : std::optional(state_.time - (outOfTurn ? 0.5 * state_.deltaT : 0.0));
    const auto out = folder_.postProcessing();
    history_ = std::make_unique<output::CsvSeries>(out / "history.csv", stepping::historyColumns(), continueAt);
    budget_ = std::make_unique<output::CsvSeries>(out / "energyBudget.csv", stepping::budgetColumns(), continueAt);
    if (recorder_)
        recorder_->open(out / "strainPaths.csv", state_, continueAt);
    for (const auto& name : laterTimes_)
        folder_.removeTime(name);
    if (!history_->lastTime()) // a new series begins with the state it starts from
        writeRow();
    state_.provenance["version"] = projectVersion();
    state_.provenance["revision"] = gitRevision();
    state_.provenance["compiler"] = compilerText() + ", " + compilerFlags();
    recordInstructionSet(state_, instructionSet());
    recordStorage(state_, storage());
    state_.provenance["dictionaries"] = scene_.dictionaries;
    if (done())
        writeSeries(); // a run killed at its very end may lack it
    progress_ = std::make_unique<Progress>("mpmSolve", state_.time, runTime_->endTime());
    profile_.beginSteps(stepper_->times());
}

stepping::StabilityLimit SolverRun::stabilityLimit() const
{
    return stepping::stabilityLimit(*stepper_, state_, scene_.scene, limitIgnoresMass(scene_.shape));
}

/// maxCo bounds the Courant number with the particles' own speed; the stability limit is kept with a margin.
double SolverRun::stepSize() const
{
    if (!runTime_->adjustable())
        return runTime_->nextStep(state_.time, 0);
    const double courant = runTime_->maxCo() * state_.grid.h / (limit_.waveSpeed + stepper_->largestSpeed());
    const double wanted = std::min(courant, 0.9 * limit_.deltaT);
    return runTime_->nextStep(state_.time, state_.step == 0 ? std::min(wanted, runTime_->deltaT()) : wanted);
}

void SolverRun::step()
{
    timeBefore_ = state_.time;
    const Clock clock(stepSeconds_);
    if (runTime_->adjustable() && stepping::limitFollowsMass(scene_.scene, limitIgnoresMass(scene_.shape)))
        limit_ = stabilityLimit();
    if (recorder_)
        recorder_->before(state_);
    try
    {
        stepper_->step(stepSize());
    }
    catch (const StepError& error)
    {
        progress_.reset();
        finishWriting();
        throw StepError(
            fmt::format("{}\n    the last stored time is {}; nothing after it was kept", error.what(), lastStored_));
    }
    if (recorder_)
        recorder_->after(state_);
    profile_.countStep(state_.particles.size());
    if (state_.ledger.kineticEnergy > peakKinetic_)
    {
        peakKinetic_ = state_.ledger.kineticEnergy;
        peakTime_ = state_.time;
    }
}

void SolverRun::writeIfDue()
try
{
    if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        finishWriting(); // a failure is told at once
    const bool last = done();
    if (state_.step % runTime_->historyInterval() == 0 || last)
        writeRow();
    if (runTime_->writeNow(timeBefore_, state_.time, state_.step))
        writeState();
    if (progress_->due(state_.time))
        progress_->update(state_.time, fmt::format("t {:.4g} s  dt {:.3g} s  {} particles", state_.time, state_.deltaT,
                                                   state_.particles.size()));
}
catch (const InputError& error)
{
    failWriting(error);
}

void SolverRun::writeRow()
{
    const Clock clock(profile_.history);
    const auto totals = stepping::totals(state_, scene_.scene.materials);
    history_->write(stepping::historyRow(state_, totals, stepper_->report()));
    budget_->write(stepping::budgetRow(state_, totals));
}

void SolverRun::writeState(bool outOfTurn)
{
    const Clock clock(profile_.output);
    finishWriting();
    writingName_ = written_->next(state_, outOfTurn);
    writtenStep_ = state_.step;
    const auto pending = std::make_shared<output::PendingState>(folder_.timePath(writingName_), state_);
    writing_ = std::async(std::launch::async, [this, pending] {
        history_->synchronise(); // a state on disk has its rows there
        budget_->synchronise();
        pending->commit();
        lastStored_ = writingName_; // read after finishWriting only
        written_->committed();
        writeSeries();
    });
}

void SolverRun::writeSeries()
{
    std::vector<std::string> names;
    for (const auto& time : folder_.times())
        names.push_back(time.name);
    series_.write(names);
}

/// Throws what went wrong meanwhile.
void SolverRun::finishWriting()
{
    if (!writing_.valid())
        return;
    writing_.get();
}

void SolverRun::warnings() const
{
    const auto& ledger = state_.ledger;
    const auto& scene = scene_.scene;
    const Index steps = state_.step - firstStep_;
    if (stepper_->report().cappedDomains > 0)
        line("note", fmt::format("{} particle domains are held at {} cells; split them earlier or seed finer",
                                 stepper_->report().cappedDomains, scene_.shape == "cpGIMP" ? "two" : "one"));
    if (ledger.splitsPutOff > 0)
        line("note", fmt::format("{} particles wait at a wall for their split", ledger.splitsPutOff));
    if (ledger.splitsCapped > 0)
        line("note",
             fmt::format("{} particles are longer than the threshold, at the cap of maxGeneration or maxParticles",
                         ledger.splitsCapped));
    bool friction = false;
    for (const auto& wall : scene.walls)
        friction = friction || (wall.type == nodal::WallType::friction && wall.mu > 0);
    if (friction && ledger.wallContacts == 0)
        line("note", fmt::format("friction: 0 contacts in {} steps", steps));
    if (scene.splitting && ledger.splits == 0)
        line("note", fmt::format("splitting: 0 particles split in {} steps", steps));
}

void SolverRun::summary()
{
    {
        const Clock clock(profile_.output);
        finishWriting();
    }
    progress_->finish();
    const auto t = stepping::totals(state_, scene_.scene.materials);
    const auto& l = state_.ledger;
    const double supplied = std::abs(l.gravityWork + l.tractionWork + l.bodyForceWork);
    const double mismatch = stepping::residual(l, t.strainEnergy);
    const Index steps = state_.step - firstStep_;
    const char* unit = state_.particles.dim == 2 ? "kJ/m" : "kJ";
    fmt::print("\nDone: {} steps to {:g} s in {} ({} of it output)\n", steps, state_.time,
               formatDuration(profile_.elapsed()), formatDuration(profile_.history + profile_.output));
    line("speed", fmt::format("{:.1f} ns per particle and step", profile_.nsPerParticleStep(stepSeconds_)));
    line("particles", fmt::format("{}, {} splits", state_.particles.size(), l.splits));
    if (const double memory = peakMemory(); memory > 0)
        line("memory", fmt::format("{} at most, {:.0f} bytes a particle", formatBytes(memory),
                                   memory / double(state_.particles.size())));
    std::string extent;
    for (int a = 0; a < state_.particles.dim; ++a)
        extent += fmt::format("{} {:.3f} .. {:.3f} m{}", axisNames[a], t.extents.low[a], t.extents.high[a],
                              a + 1 < state_.particles.dim ? ", " : " (particle centres)");
    line("extent", extent);
    line("energy",
         fmt::format("kinetic {:.4g} {} (peak {:.4g} at {:.3f} s), strain {:.4g}, plastic {:.4g}, friction {:.4g}",
                     t.kineticEnergy / 1e3, unit, peakKinetic_ / 1e3, peakTime_, t.strainEnergy / 1e3,
                     l.plasticDissipation / 1e3, l.frictionDissipation / 1e3));
    if (scene_.scene.relaxationTime)
        line("damping", fmt::format("{:.4g} {} dissipated", l.dampingDissipation / 1e3, unit));
    line("residual",
         fmt::format("{:.4g} {}{}", mismatch / 1e3, unit,
                     supplied > 0 ? fmt::format(", {:.2f} % of the work supplied", 100 * mismatch / supplied) : ""));
    line("apex",
         fmt::format("{} returns, {:.4g} m^{} of volume dropped", l.apexReturns, l.apexVolume, state_.particles.dim));
    warnings();
    line("last time", lastStored_);
    fmt::print("\n{}", profile_.text(stepper_->times(), 2));
    if (options_.has("profile"))
        profile_.write(folder_.postProcessing() / "profile.csv", stepper_->times());
}
} // namespace mpm::cases
