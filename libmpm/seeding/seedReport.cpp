#include "seeding/seedReport.hpp"

#include "base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::seeding
{
namespace
{
std::string line(const std::string& what, const std::string& text)
{
    return fmt::format("  {:<14} {}\n", what, text);
}

std::string latticeText(const state::State& state, const LatticeOptions& lattice)
{
    const auto& c = state.grid.cells;
    const bool flat = state.particles.dim == 2;
    const Index n = lattice.perCell;
    return fmt::format("{} cells of {:.6g} m, {} boxes each, {}",
                       flat ? fmt::format("{} x {}", c[0], c[1]) : fmt::format("{} x {} x {}", c[0], c[1], c[2]),
                       state.grid.h, flat ? fmt::format("{} x {}", n, n) : fmt::format("{} x {} x {}", n, n, n),
                       lattice.jittered
                           ? fmt::format("jittered by {:g}, randomSeed {}", lattice.jitter, lattice.randomSeed)
                           : "lattice");
}

std::string stressText(const InitialStress& stress)
{
    if (stress.type == InitialStress::Type::none)
        return "none";
    if (stress.type == InitialStress::Type::uniform)
        return fmt::format("({:g}) Pa", fmt::join(stress.value, " "));
    return fmt::format("K0 = {:.4g}, depth from {}", stress.K0,
                       stress.surfaceLevel ? fmt::format("{} = {:g} m", axisNames[std::size_t(stress.gravity.axis)],
                                                         *stress.surfaceLevel)
                                           : std::string("the top of its region"));
}
} // namespace

std::string report(const geometry::BodyGeometry& body, const Seeding& seeded,
                   const std::vector<SeedMaterial>& materials, const SeedOptions& options)
{
    const bool flat = body.dim == 2;
    const auto count = [](std::size_t n, const char* one, const char* many) {
        return n == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", n, many);
    };
    std::string text = line("geometry", fmt::format("{}, {}, {}", body.file.filename().string(),
                                                    count(body.regions.size(), "region", "regions"),
                                                    count(body.boundaries.size(), "boundary", "boundaries")));
    for (const std::string& note : body.notes)
        text += line("note", note);
    text += line("grid", latticeText(seeded.state, options.lattice));
    for (const SeedMaterial& m : materials)
        if (std::find(seeded.state.materials.begin(), seeded.state.materials.end(), m.name) !=
            seeded.state.materials.end())
            text += line("material", fmt::format("{}: {}, density {:g} kg/m^3, initial stress {}", m.name,
                                                 m.description, m.density, stressText(m.initialStress)));
    Table regions({"region", "material", flat ? "area [m2]" : "volume [m3]", flat ? "mass [kg/m]" : "mass [kg]",
                   "particles", "slivers merged"});
    for (const SeededRegion& r : seeded.regions)
        regions.row({r.name, r.material, fmt::format("{:.10g}", r.volume), fmt::format("{:.10g}", r.mass),
                     std::to_string(r.particles), std::to_string(r.merged)});
    text += regions.text(2);
    Table boundaries({"boundary", flat ? "length [m]" : "area [m2]", "pieces"});
    for (std::size_t b = 0; b < body.boundaries.size(); ++b)
        boundaries.row({body.boundaries[b].name, fmt::format("{:.10g}", body.boundaries[b].area()),
                        std::to_string(seeded.state.patches[b].size())});
    if (!body.boundaries.empty())
        text += boundaries.text(2);
    return text;
}
} // namespace mpm::seeding
