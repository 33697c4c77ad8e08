#include "precice/coupledCase.hpp"

#include "base/error.hpp"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <regex>

namespace mpm::precice
{
namespace
{
PreciceCoupling readCoupling(const cases::CaseDirectory& folder, const coupling::Participant& soil)
{
    const auto dict = dictionary::Dictionary::readFile(folder.dictionaryPath("system/couplingDict"));
    std::vector<KnownSurface> known;
    for (const auto& name : soil.surfaces())
        known.push_back({name, soil.kind(name)});
    return readPrecice(dict, folder.folder(), known);
}

std::string listed(const std::vector<DataLink>& links)
{
    std::vector<std::string> names;
    for (const auto& link : links)
        names.push_back(quantityWord(link.quantity));
    return names.empty() ? "nothing" : joinWords(names, ", ");
}

void say(const std::string& text)
{
    std::fflush(stdout);
    std::fputs(text.c_str(), stderr);
}
} // namespace

CoupledCase::CoupledCase(const cases::Options& options)
    : folder_(options.caseFolder), soil_(options.caseFolder, {}, options.threads),
      coupling_(readCoupling(folder_, soil_))
{}

void CoupledCase::banner() const
{
    fmt::print("mpmCouple: {} as '{}' of {}\n", folder_.name(), coupling_.participant, coupling_.config.string());
    for (const auto& link : coupling_.surfaces)
        fmt::print("    {} {} on mesh {}: reads {}; writes {}\n", kindWord(link.kind), link.surface, link.mesh,
                   listed(link.read), listed(link.write));
    std::fflush(stdout);
}

std::string CoupledCase::latest() const
{
    return folder_.latestTime().name;
}

void CoupledCase::begin()
{
    const double start = soil_.time();
    last_.time = start;
    if (const auto length = maxTime(coupling_.config))
        progress_ = std::make_unique<Progress>("mpmCouple", start, start + *length);
}

void CoupledCase::accepted(const AcceptedWindow& window)
{
    last_ = window;
    iterations_ += window.iterations;
    if (progress_ && progress_->due(window.time))
        progress_->update(window.time,
                          fmt::format("window {}  {} substeps{}", window.windows, window.substeps,
                                      window.iterations > 1 ? fmt::format("  {} iterations", window.iterations) : ""));
}

int CoupledCase::summary()
{
    progress_.reset();
    fmt::print("{} windows{}, {:g} s; the state is in {}/state.h5\n", last_.windows,
               iterations_ > last_.windows ? fmt::format(" in {} iterations", iterations_) : "", last_.time, latest());
    return 0;
}

int CoupledCase::stopped(int signal)
{
    progress_.reset();
    say(fmt::format("--> mpmCouple: stopped by {} at {:g} s; the last accepted window is in {}/state.h5 (startFrom "
                    "latestTime goes on from there)\n",
                    cases::signalName(signal), last_.time, latest()));
    return cases::Interruption::exitCode(signal);
}

void CoupledCase::rescue(int signal)
{
    int code = 1;
    try
    {
        if (soil_.lifecycle() == coupling::Lifecycle::Initialized || soil_.lifecycle() == coupling::Lifecycle::Stepping)
            soil_.finalize();
        code = stopped(signal);
    }
    catch (const std::exception& error)
    {
        say(fmt::format("--> mpmCouple: error: {}\n", error.what()));
    }
    std::fflush(stdout);
    std::_Exit(code); // the library still waits for its partner in the other thread
}

void CoupledCase::broken(const StepError& error)
{
    progress_.reset();
    throw StepError(
        fmt::format("{}; the last accepted window is in {}/state.h5 (startFrom latestTime goes on from there)",
                    error.what(), latest()));
}

std::optional<double> maxTime(const std::filesystem::path& config)
{
    std::ifstream file(config);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::smatch found;
    if (!std::regex_search(text, found, std::regex(R"rx(<max-time\s+value\s*=\s*["']\s*([-+.\deE]+)\s*["'])rx")))
        return std::nullopt;
    const double value = std::strtod(found[1].str().c_str(), nullptr);
    return value > 0 ? std::optional(value) : std::nullopt;
}
} // namespace mpm::precice
