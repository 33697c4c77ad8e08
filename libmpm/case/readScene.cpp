#include "case/readScene.hpp"

#include "case/expressionForce.hpp"
#include "case/gridFromDict.hpp"
#include "case/makeStepper.hpp"
#include "case/readContact.hpp"
#include "case/readSchemes.hpp"
#include "constitutive/law.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

std::vector<constitutive::Material> readMaterials(const Dictionary& d, std::optional<double> cellSize)
{
    std::vector<constitutive::Material> materials;
    for (const auto& name : d.dictNames())
    {
        const Dictionary& m = d.subDict(name, "a material");
        constitutive::Material material;
        material.name = name;
        material.density = m.get<double>({"density", "initial density", unit::density, Bound::positive()});
        auto law = constitutive::makeLaw(m);
        if (cellSize)
            law->regularise(*cellSize);
        material.law = std::move(law);
        m.passOver("initialStress", "stress at the start, applied by seedParticles");
        m.passOver("initialVelocity", "velocity at the start, applied by seedParticles");
        m.passOver("constants", "names for numbers in initialVelocity");
        materials.push_back(std::move(material));
    }
    if (materials.empty())
        throw InputError(d.where(), "no material: one dictionary a material is needed, soil { law mohrCoulomb; ... }");
    return materials;
}

std::vector<constitutive::Material> matchMaterials(const Dictionary& d, const state::State& state)
{
    const auto all = readMaterials(d, state.grid.h);
    std::vector<constitutive::Material> out;
    for (const auto& name : state.materials)
    {
        const auto found = std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == name; });
        if (found == all.end())
        {
            std::vector<std::string> names;
            for (const auto& m : all)
                names.push_back(m.name);
            throw InputError(d.where(), fmt::format("found no material '{}', which particles of the state are made of; "
                                                    "there are {}",
                                                    name, joinWords(names, " and ")));
        }
        out.push_back(*found);
    }
    return out;
}

std::optional<Vector3> readGravity(const Dictionary& d, int dim)
{
    if (d.found("dimensions"))
    {
        const auto given = d.get<dictionary::Dimensions>({"dimensions", "[0 1 -2 0 0 0 0]"});
        if (given != unit::acceleration)
            d.fail("dimensions", "other dimensions than those of an acceleration", "[0 1 -2 0 0 0 0]");
    }
    const Vector3 g = d.get<Vector3>({"value", "acceleration of gravity", unit::acceleration});
    if (dim == 2 && g[2] != 0)
        d.fail("value", fmt::format("a z component of {:g}", g[2]), "0, as dimension is 2");
    if (g == Vector3{})
        return std::nullopt;
    return g;
}

namespace
{
/// A plane normal to an axis.
struct Plane
{
    int axis = 0, side = -1;
    double position = 0;
};

Plane readPlane(const Dictionary& plane, int dim)
{
    const Vector3 n = plane.get<Vector3>({"normal", "outward normal, along an axis"});
    Plane out;
    int nonzero = 0;
    for (int a = 0; a < 3; ++a)
        if (n[a] != 0)
        {
            ++nonzero;
            out.axis = a;
            out.side = n[a] < 0 ? -1 : 1;
        }
    if (nonzero != 1 || out.axis >= dim)
        plane.fail("normal", fmt::format("({:g} {:g} {:g})", n[0], n[1], n[2]),
                   dim == 2 ? "(-1 0 0), (1 0 0), (0 -1 0) or (0 1 0)" : "a vector along one axis");
    out.position = plane.get<double>({"position", "coordinate of the plane along its normal's axis", unit::length});
    return out;
}

const state::SurfacePatch* findPatch(const state::State& state, const std::string& name)
{
    for (const auto& patch : state.patches)
        if (patch.name == name)
            return &patch;
    return nullptr;
}

std::vector<std::string> patchNames(const state::State& state)
{
    std::vector<std::string> names;
    for (const auto& patch : state.patches)
        names.push_back(patch.name);
    return names;
}

[[noreturn]] void failUnknownPatch(const Dictionary& all, const std::string& name, const state::State& state)
{
    const auto names = patchNames(state);
    const auto near = nearestWord(name, names);
    throw InputError(all.where(name),
                     fmt::format("{}: found no boundary of that name in the geometry{}; allowed: {}{}", name,
                                 near.empty() ? "" : " (did you mean '" + near + "'?)",
                                 names.empty() ? std::string("(the geometry names none)") : joinWords(names),
                                 ", or for a wall any name with plane { normal (0 -1 0); position 0; }"));
}

/// The plane all of a patch lies in.
Plane planeOfPatch(const Dictionary& all, const state::SurfacePatch& patch, int dim, double h)
{
    for (int a = 0; a < dim; ++a)
    {
        const auto [low, high] = std::minmax_element(patch.centre[a].begin(), patch.centre[a].end());
        bool flat = patch.size() > 0 && *high - *low <= 1e-9 * h;
        double outward = 0;
        for (Index e = 0; e < patch.size() && flat; ++e)
        {
            const auto edge = [&](int k) { return patch.edges[k][std::size_t(e)]; };
            for (int k = 0; k < dim - 1; ++k)
                flat = flat && std::abs(edge(k * dim + a)) <= 1e-9 * h;
            outward += dim == 2 ? (a == 0 ? edge(1) : -edge(0))
                                : edge((a + 1) % 3) * edge(3 + (a + 2) % 3) - edge((a + 2) % 3) * edge(3 + (a + 1) % 3);
        }
        if (flat && outward != 0)
            return {a, outward < 0 ? -1 : 1, 0.5 * (*low + *high)};
    }
    throw InputError(
        all.where(patch.name),
        fmt::format("{}: found a boundary that is not flat and normal to an axis; a wall must be: give it as "
                    "plane {{ normal (0 -1 0); position 0; }}",
                    patch.name));
}

/// A wall no particle can reach would be ignored, one with its normal into the soil would hold all of it.
void refuseUselessWall(const Dictionary& all, const nodal::Wall& wall, const state::State& state)
{
    const auto& grid = state.grid;
    const auto axis = std::size_t(wall.axis);
    const double position = grid.origin[axis] + grid.h * double(wall.plane);
    if (wall.plane < 0 || wall.plane > grid.cells[axis])
        throw InputError(
            all.where(wall.name),
            fmt::format("{}: found a wall at {} = {:g}, outside the grid; allowed: {:g} to {:g} (system/gridDict)",
                        wall.name, axisNames[axis], position, grid.origin[axis], grid.upper(wall.axis)));
    const auto& p = state.particles;
    const auto behind = [&](Index i) { return wall.side * (p.x[axis][std::size_t(i)] - position) > grid.h; };
    Index count = 0, first = -1;
    for (Index i = 0; i < p.size(); ++i)
        if (behind(i) && count++ == 0)
            first = i;
    if (count > 0)
        throw InputError(
            all.where(wall.name),
            fmt::format("{}: found {} of {} particles behind the wall at {} = {:g}, particle {} at {:g} the first; "
                        "allowed: a normal that points out of the soil, and a position beside it",
                        wall.name, count, p.size(), axisNames[axis], position, p.id[std::size_t(first)],
                        p.x[axis][std::size_t(first)]));
}

/// Walls are whole planes: of two that face the same way only the inner one acts, and on one plane friction would act
/// twice.
void refuseSecondWall(const Dictionary& all, const nodal::Wall& wall, const std::vector<nodal::Wall>& others)
{
    for (const auto& other : others)
        if (other.axis == wall.axis && other.side == wall.side)
            throw InputError(
                all.where(wall.name),
                fmt::format("{}: found a second wall with outward normal {}{}, besides '{}'; allowed: one, as a "
                            "wall is a whole plane",
                            wall.name, wall.side < 0 ? '-' : '+', axisNames[std::size_t(wall.axis)], other.name));
}

nodal::Wall readWall(const Dictionary& all, const Dictionary& d, const std::string& name, const std::string& type,
                     const state::State& state)
{
    nodal::Wall wall;
    wall.name = name;
    wall.type = type == "fixed"    ? nodal::WallType::fixed
                : type == "roller" ? nodal::WallType::roller
                                   : nodal::WallType::friction;
    if (wall.type == nodal::WallType::friction)
        wall.mu = d.get<double>({"mu", "Coulomb friction coefficient", {}, Bound::nonNegative()});
    wall.separation = d.get<bool>(
        {"separation", "on: the wall only pushes; off: it also holds", {}, {}, wall.type == nodal::WallType::friction});
    const int dim = state.particles.dim;
    Plane plane;
    if (const Dictionary* own = d.findDict("plane", "the wall's plane; default: that of the boundary of this name"))
        plane = readPlane(*own, dim);
    else if (const auto* patch = findPatch(state, name))
        plane = planeOfPatch(all, *patch, dim, state.grid.h);
    else
        failUnknownPatch(all, name, state);
    wall.axis = plane.axis;
    wall.side = plane.side;
    if (state.grid.periodic[std::size_t(plane.axis)])
        throw InputError(all.where(name),
                         fmt::format("{}: found a wall normal to {}, along which the grid is periodic; allowed: walls "
                                     "normal to other axes, or no periodic in system/gridDict",
                                     name, axisNames[std::size_t(plane.axis)]));
    const double index = (plane.position - state.grid.origin[plane.axis]) / state.grid.h;
    wall.plane = Index(std::lround(index));
    if (std::abs(index - double(wall.plane)) > 1e-6)
    {
        const auto at = [&](double i) { return state.grid.origin[plane.axis] + state.grid.h * i; };
        throw InputError(all.where(name),
                         fmt::format("{}: found a wall at {} = {:g}, between planes of nodes; allowed: the nearest are "
                                     "{:.10g} and {:.10g} (or move min of system/gridDict)",
                                     name, axisNames[plane.axis], plane.position, at(std::floor(index)),
                                     at(std::floor(index) + 1)));
    }
    refuseUselessWall(all, wall, state);
    return wall;
}
} // namespace

void readBoundaries(const Dictionary& d, const state::State& state, stepping::Scene& scene)
{
    for (const auto& name : d.dictNames())
    {
        const Dictionary& b = d.subDict(name, "a boundary");
        const auto type = b.choose("type", "what the boundary does",
                                   {{"fixed", "no motion"},
                                    {"roller", "no motion along the normal"},
                                    {"friction", "Coulomb friction"},
                                    {"traction", "given load vector"},
                                    {"pressure", "given load along the inward normal"}});
        if (type != "traction" && type != "pressure")
        {
            const nodal::Wall wall = readWall(d, b, name, type, state);
            refuseSecondWall(d, wall, scene.walls);
            scene.walls.push_back(wall);
            continue;
        }
        nodal::Load load;
        load.patch = name;
        load.pressure = type == "pressure";
        if (load.pressure)
            load.magnitude = b.get<double>({"value", "pressure", unit::pressure});
        else
            load.traction = b.get<Vector3>({"value", "load per current area", unit::pressure});
        if (state.particles.dim == 2 && load.traction[2] != 0)
            b.fail("value", fmt::format("a z component of {:g}", load.traction[2]), "0, as dimension is 2");
        if (!findPatch(state, name))
            failUnknownPatch(d, name, state);
        scene.loads.push_back(load);
    }
}

namespace
{
/// The state's box may be moved and widened, its lattice may not.
void takeGrid(const Dictionary& gridDict, state::State& state)
{
    const auto grid = gridFromDict(gridDict);
    auto& own = state.grid;
    bool same = grid.dim == own.dim && std::abs(grid.h - own.h) <= 1e-12 * own.h;
    for (int a = 0; a < own.dim && same; ++a)
    {
        const double shift = (grid.origin[a] - own.origin[a]) / own.h;
        same = std::abs(shift - std::round(shift)) <= 1e-6;
    }
    if (!same)
        gridDict.fail(
            "cellSize",
            fmt::format("dimension {}, cells of {:g} m from ({:g}, {:g}, {:g})", grid.dim, grid.h, grid.origin[0],
                        grid.origin[1], grid.origin[2]),
            fmt::format("the grid the particles were seeded on, dimension {}, cells of {:g} m from ({:g}, {:g}, "
                        "{:g}); to change it run seedParticles -overwrite",
                        own.dim, own.h, own.origin[0], own.origin[1], own.origin[2]));
    own = grid;
    const auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        for (int a = 0; a < grid.dim; ++a)
            if (const double x = p.x[std::size_t(a)][i]; !(x >= grid.origin[a] && x <= grid.upper(a)))
                gridDict.fail(
                    x < grid.origin[a] ? "min" : "max",
                    fmt::format("{} from {:g} to {:g} m", axisNames[std::size_t(a)], grid.origin[a], grid.upper(a)),
                    fmt::format("a box around all particles: the one with id {} lies at {:g} m", p.id[i], x));
}

/// A hyperelastic law makes stress from the deformation alone: what a state of step 0 holds would vanish unseen.
void refuseLostStress(const Dictionary& d, const std::vector<constitutive::Material>& materials,
                      const state::State& state)
{
    const auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()) && state.step == 0; ++i)
        for (int k = 0; k < stressComponents(p.dim); ++k)
            if (const auto& m = materials[std::size_t(p.material[i])];
                p.stress[std::size_t(k)][i] != 0 && m.law->hyperelastic())
                throw InputError(
                    d.where(m.name),
                    fmt::format("{}: found law {}, whose stress follows from the deformation since the start, "
                                "and particle {} with {} {:g} Pa at the start; allowed: initialStress of type "
                                "none (seedParticles -overwrite)",
                                m.name, m.law->name(), p.id[i], stressNames[std::size_t(k)],
                                double(p.stress[std::size_t(k)][i])));
}
} // namespace

SceneOfCase readScene(const CaseDirectory& folder, state::State& state, const Overrides& overrides)
{
    SceneOfCase out;
    std::vector<std::pair<std::string, Dictionary>> read;
    const auto open = [&](const std::string& name) -> const Dictionary& {
        read.emplace_back(name, Dictionary::readFile(folder.dictionaryPath(name)));
        overrides.apply(name, read.back().second);
        return read.back().second;
    };
    read.reserve(16);
    takeGrid(open("system/gridDict"), state);
    const Dictionary& materialProperties = open("constant/materialProperties");
    out.scene.materials = matchMaterials(materialProperties, state);
    refuseLostStress(materialProperties, out.scene.materials, state);
    if (folder.hasFile("constant/g"))
        out.scene.gravity = readGravity(open("constant/g"), state.particles.dim);
    if (folder.hasFile("constant/bodyForce"))
        if (const auto force = readBodyForce(open("constant/bodyForce"), state.particles.dim))
        {
            if (const auto* component = force->usesReference())
                provideReference(state, {component->where(), "value: \"" + component->text() + "\" uses X, Y or Z"});
            out.scene.bodyForce = force;
        }
    if (folder.hasFile("constant/boundaryConditions"))
        readBoundaries(open("constant/boundaryConditions"), state, out.scene);
    if (folder.hasFile("constant/contactProperties"))
        out.scene.contact = readContact(open("constant/contactProperties"), out.scene.materials);
    const Dictionary& schemes = open("system/mpmSchemes");
    out.shape = readSchemes(schemes, out.scene);
    out.scene.treatment = readStressTreatment(schemes, out.scene);
    if (out.scene.rest && out.scene.treatment.any())
        schemes.fail("rest", "it with a stressTreatment",
                     "one of the two: treatments take averages over what may sleep");
    if (out.scene.timeIntegration != stepping::TimeIntegration::symplecticEuler)
        if (const auto why = whyNotSmooth(out.shape, out.scene); !why.empty())
            schemes.fail("timeIntegration", schemes.get<std::string>({"timeIntegration", "time integration"}),
                         "symplecticEuler here: " + why);
    for (const auto& [name, dictionary] : read)
    {
        dictionary.rejectUnread();
        out.dictionaries += "// " + name + "\n" + dictionary.text() + "\n";
    }
    return out;
}
} // namespace mpm::cases
