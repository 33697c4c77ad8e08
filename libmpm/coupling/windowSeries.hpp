#pragma once
/// postProcessing/<surface>Windows.csv: a row an accepted window, SI units, in 2D per metre:
///
///     time                            the window's end
///     window                          its length
///     impulseX Y Z, momentImpulseX Y Z   of the soil on the surface, moments about the reference point
///     work                            of the surface on the soil since the start
///     contactArea                     at the end
///     forceX Y Z, mappedForceX Y Z    sum over vertices of the force last exchanged with a partner's mesh, before and
///                                     after the mapping (conservative: they agree to round-off)
///
/// and for ParaView postProcessing/<surface>/<time>.vtp, the surface with its fields at each stored time, listed with
/// their times in postProcessing/<surface>.pvd.
#include "case/caseDirectory.hpp"
#include "coupling/surface.hpp"
#include "output/csvSeries.hpp"

#include <filesystem>
#include <list>

namespace mpm::coupling
{
class WindowSeries
{
  public:
    void open(const std::filesystem::path& postProcessing, const std::list<Surface>& surfaces,
              std::optional<double> continueAt);
    bool isOpen() const { return open_; }
    bool wasOpen() const { return wasOpen_; }
    void close();
    void write(double time, double window, const std::list<Surface>& surfaces);

    /// The surfaces as they are now, beside the state just stored as `timeName`.
    static void writeSurfaces(const cases::CaseDirectory& folder, const std::string& timeName,
                              const std::list<Surface>& surfaces, const state::State& state);

  private:
    std::vector<output::CsvSeries> series_;
    bool open_ = false, wasOpen_ = false;
};
} // namespace mpm::coupling
