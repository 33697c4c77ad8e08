#pragma once
/// What a run writes about its moving walls and rigid bodies.
///
///     postProcessing/<name>.csv       at every row of history.csv: time; x y z, a body's reference point or a wall's
///                                     displacement [m]; velocity [m/s]; angularVelocity [rad/s]; force of the soil on
///                                     it [N] and torque about x y z [N m] in the step before (per metre in 2D, zero
///                                     in the first row); contacts, nodes pressed
///     postProcessing/<name>/<time>.vtp, postProcessing/<name>.pvd      a body's surface at every written time, for
///                                     ParaView: its place follows from the time, so files that are missing are made
///                                     anew by any later run
#include "output/csvSeries.hpp"
#include "stepping/stepper.hpp"

#include <filesystem>
#include <memory>

namespace mpm::cases
{
class ActorSeries
{
  public:
    explicit ActorSeries(const stepping::Scene& scene);

    /// Begins the tables, or continues them.
    void open(const std::filesystem::path& postProcessing, std::optional<double> continueAt);
    void writeRow(double time, const stepping::StepReport& report);
    void synchronise() const;
    /// Surfaces of all bodies at the times of these folders (name, seconds).
    void writeSurfaces(const std::filesystem::path& postProcessing,
                       const std::vector<std::pair<std::string, double>>& times) const;

    static const std::vector<std::string>& columns();

  private:
    std::vector<std::string> names_;
    std::vector<nodal::Body> bodies_;
    std::vector<std::unique_ptr<output::CsvSeries>> tables_;
};
} // namespace mpm::cases
