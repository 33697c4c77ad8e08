#include "coupling/windowSeries.hpp"

#include "output/replaceFile.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
namespace
{
const std::vector<std::string> columns = {
    "time", "window",      "impulseX", "impulseY", "impulseZ", "momentImpulseX", "momentImpulseY", "momentImpulseZ",
    "work", "contactArea", "forceX",   "forceY",   "forceZ",   "mappedForceX",   "mappedForceY",   "mappedForceZ"};
}

void WindowSeries::open(const std::filesystem::path& postProcessing, const std::list<Surface>& surfaces,
                        std::optional<double> continueAt)
{
    series_.clear();
    for (const auto& surface : surfaces)
        series_.emplace_back(postProcessing / (surface.name() + "Windows.csv"), columns, continueAt);
    open_ = wasOpen_ = true;
}

void WindowSeries::close()
{
    series_.clear();
    open_ = false;
}

void WindowSeries::write(double time, double window, const std::list<Surface>& surfaces)
{
    std::size_t n = 0;
    for (const auto& surface : surfaces)
    {
        const auto sums = surface.resultants();
        std::vector<double> row{time, window};
        for (const auto* part : {&sums.impulse, &sums.momentImpulse})
            row.insert(row.end(), part->begin(), part->end());
        row.push_back(surface.work());
        row.push_back(sums.contactArea);
        for (const auto& part : surface.mappedSums())
            row.insert(row.end(), part.begin(), part.end());
        series_[n++].write(row);
    }
}
void WindowSeries::writeSurfaces(const cases::CaseDirectory& folder, const std::string& timeName,
                                 const std::list<Surface>& surfaces, const state::State& state)
{
    const auto out = folder.postProcessing();
    for (const auto& surface : surfaces)
    {
        output::makeFolder(out / surface.name());
        surface.exportTo(out / surface.name() / (timeName + ".vtp"), &state);
        std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
        for (const auto& time : folder.times())
            if (std::filesystem::exists(out / surface.name() / (time.name + ".vtp")))
                list += fmt::format("<DataSet timestep=\"{}\" file=\"{}/{}.vtp\"/>\n", output::shortest(time.value),
                                    surface.name(), time.name);
        output::replaceText(out / (surface.name() + ".pvd"), list + "</Collection>\n</VTKFile>\n");
    }
}
} // namespace mpm::coupling
