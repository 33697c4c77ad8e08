#include "coupling/windowSeries.hpp"

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
} // namespace mpm::coupling
