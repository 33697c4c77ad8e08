#pragma once
/// What mpmCouple does beside the library: the case as a participant, its part of couplingDict, what is said on the way
/// and at the end. run() works with any coupling library.
///
/// Errors: InputError for what is written wrongly; StepError, one line, when the partner is gone or the soil cannot go
/// on: the last accepted window is on disk then and named.
#include "base/terminal.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/interruption.hpp"
#include "coupling/participant.hpp"
#include "precice/coupledRun.hpp"
#include "precice/preciceDict.hpp"
#include "precice/stopWatch.hpp"

#include <memory>
#include <optional>
#include <string>

namespace mpm::precice
{
class CoupledCase
{
  public:
    explicit CoupledCase(const cases::Options& options);

    const PreciceCoupling& coupling() const { return coupling_; }
    void banner() const;

    /// Runs until the library ends it, a signal comes or something goes wrong. The exit code.
    template <CouplingLibrary Library>
    int run(Library& library)
    {
        const cases::Interruption interruption;
        StopWatch watch([&] { return interruption.signal(); }, [this](int signal) { rescue(signal); });
        Hooks hooks;
        hooks.stop = [&] { return interruption.signal() != 0; };
        hooks.accepted = [this](const AcceptedWindow& window) { accepted(window); };
        hooks.waiting = [&](bool now) { watch.waiting(now); };
        try
        {
            CoupledRun<Library> run(soil_, library, coupling_, hooks);
            begin();
            const bool whole = run.run();
            return whole ? summary() : stopped(interruption.signal());
        }
        catch (const StepError& error)
        {
            broken(error);
        }
    }

  private:
    std::string latest() const;
    void begin();
    void accepted(const AcceptedWindow& window);
    int summary();
    int stopped(int signal);
    [[noreturn]] void rescue(int signal);
    [[noreturn]] void broken(const StepError& error);

    cases::CaseDirectory folder_;
    coupling::Participant soil_;
    PreciceCoupling coupling_;
    std::unique_ptr<Progress> progress_;
    AcceptedWindow last_;
    Index iterations_ = 0;
};

/// The end of time in preCICE's configuration [s], for the progress line only; nothing where it says none plainly.
std::optional<double> maxTime(const std::filesystem::path& config);
} // namespace mpm::precice
