#include "case/readScene.hpp"

#include "case/expressionForce.hpp"
#include "case/gridFromDict.hpp"
#include "case/makeStepper.hpp"
#include "case/readBoundaries.hpp"
#include "case/readContact.hpp"
#include "case/readRigidBodies.hpp"
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

std::optional<nodal::GravityRamp> readGravityRamp(const Dictionary& d)
{
    const Dictionary* ramp = d.findDict("ramp", "how gravity comes on; default: at once");
    if (!ramp)
        return std::nullopt;
    nodal::GravityRamp out;
    out.duration = ramp->get<double>({"duration", "from nothing at t = 0", unit::time, Bound::nonNegative()});
    out.smooth = ramp->choose("shape", "of the ramp", {{"linear", "t/duration"}, {"smooth", "s^2 (3 - 2 s)"}},
                              std::string("linear")) == "smooth";
    return out.duration > 0 ? std::optional(out) : std::nullopt;
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

bool undeformed(const state::Particles& p, std::size_t i)
{
    for (int a = 0; a < p.dim; ++a)
        for (int k = 0; k < p.dim; ++k)
            if (p.F[std::size_t(a * p.dim + k)][i] != (a == k ? 1 : 0))
                return false;
    return true;
}

/// A hyperelastic law makes stress from the deformation alone: what a state of step 0 holds would vanish unseen, unless
/// it came with its deformation (gravityLoading).
void refuseLostStress(const Dictionary& d, const std::vector<constitutive::Material>& materials,
                      const state::State& state)
{
    const auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()) && state.step == 0; ++i)
        for (int k = 0; k < stressComponents(p.dim); ++k)
            if (const auto& m = materials[std::size_t(p.material[i])];
                p.stress[std::size_t(k)][i] != 0 && m.law->hyperelastic() && undeformed(p, i))
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
    {
        const Dictionary& g = open("constant/g");
        out.scene.gravity = readGravity(g, state.particles.dim);
        out.scene.gravityRamp = readGravityRamp(g);
    }
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
    readRigidMotions(materialProperties, out.scene.materials, state.particles.dim,
                     out.scene.contact ? &*out.scene.contact : nullptr);
    if (folder.hasFile("constant/rigidBodies"))
        readRigidBodies(open("constant/rigidBodies"), state, out.scene);
    const Dictionary& schemes = open("system/mpmSchemes");
    out.shape = readSchemes(schemes, out.scene);
    out.scene.treatment = readStressTreatment(schemes, out.scene);
    if (out.scene.rest && out.scene.contact)
        schemes.fail("rest", "it beside constant/contactProperties",
                     "one of the two: what lies on another body does not rest alone");
    if (out.scene.rest && out.scene.rest->follow && (!out.scene.loads.empty() || !out.scene.absorbing.empty()))
        schemes.fail("rest",
                     fmt::format("follow yes with {}", out.scene.loads.empty() ? "absorbing boundaries" : "loads"),
                     "follow no: what these do is known step by step only");
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
