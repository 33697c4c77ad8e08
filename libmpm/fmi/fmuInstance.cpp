#include "fmi/fmuInstance.hpp"

#include "base/error.hpp"
#include "output/hdf5Probe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <omp.h>

namespace mpm::fmi
{
using coupling::CouplingError;
using coupling::Lifecycle;
using coupling::Participant;

namespace
{
/// Is it the same point in time, as a sum of many steps would miss it?
bool sameTime(double a, double b)
{
    return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

/// The participant sets how many threads the calling thread has for OpenMP; the importer finds its own number again.
class ThreadsOfCaller
{
  public:
    ThreadsOfCaller() : before_(omp_get_max_threads()) {}
    ~ThreadsOfCaller() { omp_set_num_threads(before_); }
    ThreadsOfCaller(const ThreadsOfCaller&) = delete;
    ThreadsOfCaller& operator=(const ThreadsOfCaller&) = delete;

  private:
    int before_;
};
} // namespace

Instance::Instance(std::string name, const std::string& token, const std::filesystem::path& resources, Log log)
    : name_(std::move(name)), token_(token), case_(resources / caseFolderName), log_(log)
{
    if (!std::filesystem::is_directory(case_))
        throw Refusal(fmt::format("resourcePath: found no case in '{}'", resources.string()));
    if (const std::string found = tokenOf(case_); found != token)
        throw Refusal(fmt::format("instantiationToken: found '{}', but the case in the FMU has {}: "
                                  "modelDescription.xml is of another FMU, or the case was changed",
                                  token, found));
    build();
    parameters_ = numbersOfCase(case_);
    variables_ = variablesOf(*participant_, parameters_);
    clear();
}

Instance::~Instance()
{
    try
    {
        if (participant_ && copy_ && !copy_->isTemporary() && participant_->lifecycle() == Lifecycle::Stepping)
            participant_->finalize();
    }
    catch (const std::exception& error)
    {
        log_(fmi3Error, fmt::format("{}: fmi3FreeInstance: {}", name_, error.what()));
    }
}

void Instance::require(std::initializer_list<Phase> allowed) const
{
    if (std::find(allowed.begin(), allowed.end(), phase_) != allowed.end())
        return;
    std::vector<std::string> names;
    for (const Phase phase : allowed)
        names.emplace_back(phaseName(phase));
    throw Refusal(fmt::format("called in {}, allowed in {}", phaseName(phase_), joinWords(names)));
}

/// All variables as modelDescription.xml says they start.
void Instance::clear()
{
    phase_ = Phase::Instantiated;
    values_ = variables_.startValues();
    touched_.assign(variables_.all.size(), false);
    said_ = values_;
    saidOf_.assign(variables_.inputs.size(), false);
    outputFolder_.clear();
    stopTime_.reset();
    pending_ = false;
    window_ = 0;
    substeps_ = 0;
}

namespace
{
/// The states of the case need not be looked at by a process of its own before they are read (output/hdf5Probe.hpp), as
/// the token tells that they are those that were exported. The importer's process may have threads: no place for fork.
void trust(const std::filesystem::path& folder)
{
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().filename() == "state.h5")
            output::rememberHarmless(entry.path());
}
} // namespace

/// A participant of the case with the parameters as they are, not initialised; in a folder in which nothing was
/// calculated yet. Until it is there, all stays as it was.
void Instance::build()
{
    std::unique_ptr<CaseCopy> fresh;
    if (!copy_ || calculated_ || copiedTo_ != outputFolder_)
        fresh = std::make_unique<CaseCopy>(case_, outputFolder_);
    if (fresh)
        trust(fresh->folder());
    const double threads = variables_.all.empty() ? 1 : values_[variables_.all[variables_.at("threads")].first];
    participant_ = std::make_unique<Participant>((fresh ? fresh : copy_)->folder(), settings(), int(threads));
    if (fresh)
        copy_ = std::move(fresh);
    copiedTo_ = outputFolder_;
    calculated_ = false;
    stale_ = false;
}

/// A participant with the parameters as they are that was not initialised yet.
void Instance::prepare()
{
    if (stale_ || !participant_ || participant_->lifecycle() != Lifecycle::Created)
        build();
}

void Instance::initialise()
{
    prepare();
    participant_->initialize();
    pending_ = false;
    window_ = 0;
    substeps_ = 0;
    refreshOutputs();
}

std::vector<coupling::Setting> Instance::settings() const
{
    std::vector<coupling::Setting> out;
    for (const Variable& v : variables_.all)
        if (v.parameter)
        {
            const auto now = std::span(values_).subspan(v.first, v.size());
            if (!std::equal(now.begin(), now.end(), v.start.begin()))
                out.push_back(settingOf(*v.parameter, now));
        }
    return out;
}

bool Instance::sameParameters(const std::vector<double>& values) const
{
    return std::all_of(variables_.all.begin(), variables_.all.end(), [&](const Variable& v) {
        const auto first = std::ptrdiff_t(v.first);
        return !v.parameter || std::equal(values.begin() + first, values.begin() + first + std::ptrdiff_t(v.size()),
                                          values_.begin() + first);
    });
}

void Instance::enterInitializationMode(double startTime, std::optional<double> stopTime)
{
    require({Phase::Instantiated});
    if (stopTime && !(*stopTime > startTime))
        throw Refusal(fmt::format("found stopTime {}, allowed: after startTime {}", *stopTime, startTime));
    prepare();
    if (!sameTime(startTime, participant_->time()))
        throw Refusal(fmt::format("found startTime {}, allowed {}, where the case in the FMU begins", startTime,
                                  participant_->time()));
    initialise();
    stopTime_ = stopTime;
    phase_ = Phase::InitializationMode;
}

void Instance::exitInitializationMode()
{
    require({Phase::InitializationMode});
    if (stale_)
        initialise();
    writeInputs(0);
    said_ = values_;
    for (std::size_t i = 0; i < saidOf_.size(); ++i)
        saidOf_[i] = isSet(variables_.inputs[i]);
    phase_ = Phase::StepMode;
}

void Instance::terminate()
{
    require({Phase::StepMode});
    accept();
    phase_ = Phase::Terminated;
}

void Instance::reset()
{
    if (participant_ && !copy_->isTemporary() && participant_->lifecycle() == Lifecycle::Stepping)
        participant_->finalize();
    participant_.reset();
    copy_.reset();
    clear();
    stale_ = true;
}

void Instance::accept()
{
    if (!pending_)
        return;
    participant_->acceptWindow();
    pending_ = false;
    log_(fmi3OK, fmt::format("{}: what was calculated until {} s stands", name_, time()));
}

bool Instance::isSet(const InputField& input) const
{
    return std::any_of(input.variables.begin(), input.variables.end(), [&](std::size_t i) { return touched_[i]; });
}

void Instance::writeInputs(double relativeTime)
{
    for (const InputField& input : variables_.inputs)
        if (isSet(input))
            participant_->writeField(input.surface, input.field, variables_.fieldValues(input, values_), relativeTime);
}

/// Takes back what was said for the end of a step that was not taken: what held before is said again, which drops what
/// was said for later. Fields of which nothing was said before need the snapshot.
void Instance::sayAgain(const coupling::Snapshot& before)
{
    if (!before.empty())
        return participant_->restoreState(before);
    for (std::size_t i = 0; i < variables_.inputs.size(); ++i)
        if (saidOf_[i])
            participant_->writeField(variables_.inputs[i].surface, variables_.inputs[i].field,
                                     variables_.fieldValues(variables_.inputs[i], said_), 0);
}

double Instance::doStep(double from, double length, bool stepsBeforeStand)
{
    require({Phase::StepMode});
    if (!(length > 0) || !std::isfinite(length))
        throw Refusal(fmt::format("found communicationStepSize {}, allowed: > 0", length));
    if (!sameTime(from, time()))
        throw Refusal(fmt::format("found currentCommunicationPoint {}, allowed {}, where the FMU is", from, time()));
    const double target = from + length;
    if (stopTime_ && target > *stopTime_ && !sameTime(target, *stopTime_))
        throw Refusal(fmt::format("found a step to {} s, allowed: up to stopTime {} s", target, *stopTime_));
    if (stepsBeforeStand)
        accept();
    const double window = target - participant_->time(); // so that rounding of many steps does not add up
    const ThreadsOfCaller threads;
    std::vector<bool> set;
    for (const InputField& input : variables_.inputs)
        set.push_back(isSet(input));
    const coupling::Snapshot before = set == saidOf_ ? coupling::Snapshot() : participant_->saveState();
    try
    {
        writeInputs(window);
        const coupling::Advance done = participant_->advance(window);
        calculated_ = true;
        copy_->keep();
        if (done.status == coupling::Status::discarded)
        {
            sayAgain(before);
            throw Refusal(done.message, fmi3Discard);
        }
        said_ = values_;
        saidOf_ = set;
        pending_ = true;
        window_ = window;
        substeps_ = done.substeps;
    }
    catch (const CouplingError& error)
    {
        sayAgain(before);
        const bool badSurface = error.fault() != coupling::Fault::files;
        throw Refusal(error.what(), badSurface ? fmi3Discard : fmi3Error);
    }
    refreshOutputs();
    log_(fmi3OK, fmt::format("{}: {} s reached in {} steps", name_, time(), substeps_));
    return time();
}

void Instance::refreshOutputs()
{
    values_[0] = participant_->time();
    const Reading from{*participant_, window_, substeps_, participant_->balance()};
    for (const Variable& v : variables_.all)
        if (v.read)
            v.read(from, std::span(values_).subspan(v.first, v.size()));
}
} // namespace mpm::fmi
