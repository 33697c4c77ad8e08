#include "case/actorSeries.hpp"

#include "nodal/rigidBody.hpp"
#include "output/replaceFile.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
namespace fs = std::filesystem;

namespace
{
/// PolyData of VTK's XML format, ASCII.
std::string surfaceText(const nodal::RigidBody& body)
{
    const auto& surface = body.surface();
    const bool flat = surface.dim() == 2;
    std::string text =
        fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
                    "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" {}=\"{}\">\n"
                    "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
                    surface.points().size(), flat ? "NumberOfLines" : "NumberOfPolys", surface.elements().size());
    for (const auto& X : surface.points())
    {
        const Vector3 x = body.toSpace(X);
        text += fmt::format("{} {} {}\n", output::shortest(x[0]), output::shortest(x[1]), output::shortest(x[2]));
    }
    const char* cells = flat ? "Lines" : "Polys";
    text += fmt::format("</DataArray>\n</Points>\n<{}>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
                        "format=\"ascii\">\n",
                        cells);
    for (const auto& e : surface.elements())
        text += flat ? fmt::format("{} {}\n", e[0], e[1]) : fmt::format("{} {} {}\n", e[0], e[1], e[2]);
    text += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t n = 1; n <= surface.elements().size(); ++n)
        text += fmt::format("{}\n", n * std::size_t(surface.dim()));
    return text + fmt::format("</DataArray>\n</{}>\n</Piece>\n</PolyData>\n</VTKFile>\n", cells);
}
} // namespace

ActorSeries::ActorSeries(const stepping::Scene& scene) : bodies_(scene.bodies)
{
    for (const auto& wall : scene.walls)
        if (wall.motion)
            names_.push_back(wall.name);
    for (const auto& body : scene.bodies)
        names_.push_back(body.name);
}

const std::vector<std::string>& ActorSeries::columns()
{
    static const std::vector<std::string> columns = {"time",
                                                     "x",
                                                     "y",
                                                     "z",
                                                     "velocityX",
                                                     "velocityY",
                                                     "velocityZ",
                                                     "angularVelocityX",
                                                     "angularVelocityY",
                                                     "angularVelocityZ",
                                                     "forceX",
                                                     "forceY",
                                                     "forceZ",
                                                     "torqueX",
                                                     "torqueY",
                                                     "torqueZ",
                                                     "contacts"};
    return columns;
}

void ActorSeries::open(const fs::path& postProcessing, std::optional<double> continueAt)
{
    tables_.clear();
    for (const auto& name : names_)
        tables_.push_back(std::make_unique<output::CsvSeries>(postProcessing / (name + ".csv"), columns(), continueAt));
}

void ActorSeries::writeRow(double time, const stepping::StepReport& report)
{
    for (std::size_t n = 0; n < tables_.size(); ++n)
    {
        std::vector<double> row{time};
        const auto a = n < report.actors.size() ? report.actors[n] : stepping::ActorReport{};
        for (const auto* part : {&a.position, &a.velocity, &a.angularVelocity, &a.force, &a.torque})
            row.insert(row.end(), part->begin(), part->end());
        row.push_back(double(a.contacts));
        tables_[n]->write(row);
    }
}

void ActorSeries::synchronise() const
{
    for (const auto& table : tables_)
        table->synchronise();
}

void ActorSeries::writeSurfaces(const fs::path& postProcessing,
                                const std::vector<std::pair<std::string, double>>& times) const
{
    for (const auto& body : bodies_)
    {
        const fs::path folder = postProcessing / body.name;
        output::makeFolder(folder);
        std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
        for (const auto& [name, time] : times)
        {
            const auto file = folder / (name + ".vtp");
            if (!fs::exists(file) && body.motion)
            {
                auto placed = dynamic_cast<const nodal::RigidBody&>(*body.body);
                placed.move(body.motion->pose(time), {});
                output::replaceText(file, surfaceText(placed));
            }
            list +=
                fmt::format("<DataSet timestep=\"{}\" file=\"{}/{}.vtp\"/>\n", output::shortest(time), body.name, name);
        }
        output::replaceText(postProcessing / (body.name + ".pvd"), list + "</Collection>\n</VTKFile>\n");
    }
}
} // namespace mpm::cases
