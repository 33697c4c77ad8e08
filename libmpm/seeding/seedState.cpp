#include "seeding/seedState.hpp"

#include "base/memory.hpp"
#include "seeding/seedLattice.hpp"
#include "seeding/surfacePatches.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace mpm::seeding
{
namespace
{
/// More than full by this share: two regions claim the same place.
constexpr double overfull = 1e-6;

/// How full the boxes are, to notice regions that overlap.
class Filling
{
  public:
    Filling(const geometry::BodyGeometry& body, const BoxLattice& lattice)
        : body_(body), active_(body.regions.size() > 1)
    {
        std::vector<double> planes;
        lattice.xPlanes(0, 0, planes);
        row_ = Index(planes.size());
        layer_ = row_ * Index(lattice.yPlanes(0).size());
    }

    void add(std::size_t region, Index row, Index layer, const std::vector<geometry::BoxPart>& parts)
    {
        for (const geometry::BoxPart& part : parts)
        {
            if (!active_)
                return;
            auto& [filled, last] = boxes_[layer * layer_ + row * row_ + part.box];
            filled += part.volume / part.boxVolume;
            if (filled > 1 + overfull)
                throw InputError(
                    {body_.file.string(), 0},
                    fmt::format("regions '{}' and '{}' overlap at {}; a point may belong to one region only",
                                body_.regions[last]->name(), body_.regions[region]->name(),
                                geometry::placeText(part.centroid, body_.dim)));
            last = region;
        }
    }

  private:
    const geometry::BodyGeometry& body_;
    Index row_ = 1, layer_ = 1;
    bool active_;
    std::unordered_map<Index, std::pair<double, std::size_t>> boxes_;
};

std::size_t materialOf(const geometry::Region& region, const std::vector<SeedMaterial>& materials,
                       const SeedOptions& options)
{
    std::vector<std::string> names;
    for (const SeedMaterial& m : materials)
        names.push_back(m.name);
    const auto given = options.materialOf.find(region.name());
    const std::string wanted = given == options.materialOf.end() ? region.name() : given->second;
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found != names.end())
        return std::size_t(found - names.begin());
    const std::string near = nearestWord(wanted, names);
    throw InputError(
        options.where,
        fmt::format("region '{}': found no material '{}', allowed: {}{}; name one by regions {{ {} {{ material "
                    "{}; }} }}",
                    region.name(), wanted, joinWords(names),
                    near.empty() ? "" : fmt::format(" (did you mean {}?)", near), region.name(),
                    near.empty() ? names.front() : near));
}

/// A slip of the pen in cellSize or particlesPerCell is told before it takes the machine down.
void requireMemory(const geometry::BodyGeometry& body, const state::GridBox& grid, const SeedOptions& options)
{
    constexpr double bytesOfParticle = 250, bytesOfPlane = 8; // what seeding holds at the least
    const double perCell = double(options.lattice.perCell);
    double particles = 0, planes = 0;
    for (const auto& region : body.regions)
        particles += region->volume() / std::pow(grid.h / perCell, body.dim);
    for (int axis = 0; axis < body.dim; ++axis)
        planes += double(grid.cells[std::size_t(axis)]) * perCell;
    if (particles * bytesOfParticle + planes * bytesOfPlane > machineMemory())
        throw InputError(options.where,
                         fmt::format("found particlesPerCell {} in cells of {:.10g} m, which makes {:.2g} "
                                     "particles, more than this machine's memory holds; allowed: larger cells or fewer "
                                     "particles",
                                     options.lattice.perCell, grid.h, particles));
}

double velocityAt(const Seed& seed, const SeedMaterial& material, std::size_t axis, int dim)
{
    const auto& formula = material.velocity[axis];
    const double v = formula.evaluate(std::vector<double>(seed.centre.begin(), seed.centre.begin() + dim));
    if (!std::isfinite(v))
        throw InputError(formula.where(),
                         fmt::format("{}: initialVelocity: found {} at {} from \"{}\", allowed is a "
                                     "finite velocity at every particle",
                                     material.name, v, geometry::placeText(seed.centre, dim), formula.text()));
    return v;
}

void appendParticles(state::State& s, const geometry::Region& region, const std::vector<Seed>& seeds,
                     const SeedMaterial& material, int materialIndex, SeededRegion& report)
{
    state::Particles& p = s.particles;
    const Index first = p.size();
    p.resize(first + Index(seeds.size()));
    const auto& stress = material.initialStress;
    const auto axis = std::size_t(stress.gravity.axis);
    const double highest = stress.gravity.sign < 0 ? region.upper()[axis] : region.lower()[axis];
    for (std::size_t i = 0; i < seeds.size(); ++i)
    {
        const Seed& seed = seeds[i];
        const std::size_t at = std::size_t(first) + i;
        if (stress.above(seed.centre, highest))
            throw InputError(
                material.where,
                fmt::format("{}: initialStress: region '{}' has soil at {}, above surfaceLevel {:.9g}; raise "
                            "surfaceLevel",
                            material.name, region.name(), geometry::placeText(seed.centre, p.dim),
                            stress.surfaceLevel.value_or(highest)));
        const auto sigma = stress.at(seed.centre, material.density, highest);
        for (std::size_t k = 0; k < std::size_t(p.dim); ++k)
        {
            p.x[k][at] = seed.centre[k];
            p.v[k][at] = state::Stored(velocityAt(seed, material, k, p.dim));
            p.length0[k][at] = seed.length[k];
        }
        for (std::size_t k = 0; k < std::size_t(stressComponents(p.dim)); ++k)
            p.stress[k][at] = sigma[k];
        p.volume0[at] = p.volume[at] = seed.volume;
        p.mass[at] = material.density * seed.volume;
        p.id[at] = std::int64_t(at);
        p.material[at] = materialIndex;
        report.mass += p.mass[at];
    }
}
} // namespace

SeedOptions readSeedOptions(const dictionary::Dictionary& dict)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    SeedOptions options;
    options.where = dict.where();
    options.geometry = dict.get<std::string>({"geometry",
                                              "geometry file, from the case folder; default the only one in geometry/",
                                              unit::none,
                                              {},
                                              std::string{}});
    options.geometryWhere = dict.where("geometry");
    options.scale =
        dict.get<double>({"scale", "metres per unit of the geometry file", unit::none, Bound::positive(), 1.0});
    options.meshingTime = dict.get<double>({"meshingTime", "how long gmsh may take over the geometry", unit::time,
                                            Bound{0, 86400, true, false}, options.meshingTime});
    options.lattice.perCell = dict.get<Index>(
        {"particlesPerCell", "particles in a cell along each axis", unit::none, Bound::between(1, 100), Index(2)});
    options.lattice.jittered =
        dict.choose("arrangement", "how the boxes lie",
                    {{"lattice", "equal boxes"}, {"jittered", "boxes with randomly moved sides"}},
                    "lattice") == "jittered";
    if (options.lattice.jittered)
    {
        options.lattice.jitter = dict.get<double>(
            {"jitter", "largest shift of a side, in box sides", unit::none, Bound::rightOpen(0, 0.5), 0.2});
        options.lattice.randomSeed =
            dict.get<Index>({"randomSeed", "another seed, another arrangement", unit::none, {}, Index(1)});
    }
    else
        for (const char* word : {"jitter", "randomSeed"})
            if (dict.found(word))
                dict.fail(word, "it with arrangement lattice", "it only with arrangement jittered");
    if (const auto* regions = dict.findDict("regions", "materials of the geometry's regions"))
    {
        options.where = regions->where();
        for (const std::string& name : regions->dictNames())
            options.materialOf[name] =
                regions->subDict(name, "a region")
                    .get<std::string>({"material",
                                       "a dictionary of materialProperties; default the region's own name",
                                       unit::none,
                                       {},
                                       name});
    }
    return options;
}

Seeding seedState(const geometry::BodyGeometry& body, const state::GridBox& grid,
                  const std::vector<SeedMaterial>& materials, const SeedOptions& options)
{
    Seeding made{state::State(body.dim), {}};
    state::State& s = made.state;
    s.grid = grid;
    std::vector<std::string> names;
    for (const auto& region : body.regions)
        names.push_back(region->name());
    for (const auto& [name, material] : options.materialOf)
        if (std::find(names.begin(), names.end(), name) == names.end())
        {
            const std::string near = nearestWord(name, names);
            throw InputError(options.where, fmt::format("regions: found '{}', but {} has the regions {}{}", name,
                                                        body.file.string(), joinWords(names, " and "),
                                                        near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
        }

    requireMemory(body, grid, options);
    BoxLattice lattice(grid, options.lattice);
    try
    {
        for (const auto& region : body.regions)
            lattice.fit(*region);
    }
    catch (const InputError& error)
    {
        throw InputError({body.file.string(), 0}, error.what());
    }
    for (std::size_t k = 0; k < std::size_t(body.dim); ++k)
        s.seedSpacing[k] = lattice.spacing();

    Filling filling(body, lattice);
    for (std::size_t r = 0; r < body.regions.size(); ++r)
    {
        const geometry::Region& region = *body.regions[r];
        const SeedMaterial& material = materials[materialOf(region, materials, options)];
        const RegionSeeds seeded =
            seedRegion(region, lattice, defaultSliverFraction,
                       [&](Index row, Index layer, const auto& parts) { filling.add(r, row, layer, parts); });
        if (seeded.seeds.empty())
            throw InputError({body.file.string(), 0},
                             fmt::format("region '{}' is too small to hold a particle", region.name()));
        auto used = std::find(s.materials.begin(), s.materials.end(), material.name);
        if (used == s.materials.end())
            used = s.materials.insert(used, material.name);
        made.regions.push_back(
            {region.name(), material.name, region.volume(), 0, Index(seeded.seeds.size()), seeded.merged});
        appendParticles(s, region, seeded.seeds, material, int(used - s.materials.begin()), made.regions.back());
    }
    s.particles.padLastChunk();
    s.nextId = s.particles.size();
    for (const geometry::Boundary& boundary : body.boundaries)
        s.patches.push_back(makePatch(boundary, body.dim, lattice.spacing()));
    return made;
}
} // namespace mpm::seeding
