#include "case/gravityLoading.hpp"

#include "base/error.hpp"
#include "base/terminal.hpp"
#include "base/version.hpp"
#include "case/makeStepper.hpp"
#include "case/provenance.hpp"
#include "case/writtenTimes.hpp"
#include "output/stateFile.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>
#include <utility>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
constexpr const char* dictName = "system/gravityLoadingDict";
constexpr Index maxPasses = 20;

void readRelaxation(const Dictionary& d, RelaxationRule& rule)
{
    rule.kinetic = d.choose("damping", "what takes the motion away",
                            {{"local", "a share of the net force against the velocity"},
                             {"kinetic", "all velocity, whenever the kinetic energy passes a maximum"}},
                            "local") == "kinetic";
    if (!rule.kinetic)
        rule.coefficient =
            d.get<double>({"coefficient", "share of the net force", unit::none, {0, 1, true, true}, rule.coefficient});
    else if (d.found("coefficient"))
        d.fail("coefficient", "it with damping kinetic", "it with damping local");
    rule.tolerance =
        d.get<double>({"tolerance", "net over applied forces at rest", unit::none, Bound::positive(), rule.tolerance});
    rule.kineticTolerance = d.get<double>({"kineticTolerance", "kinetic over elastic energy at rest", unit::none,
                                           Bound::positive(), rule.kineticTolerance});
}

RelaxationRule readRule(const Dictionary& d)
{
    RelaxationRule rule;
    if (const Dictionary* relaxation = d.findDict("dynamicRelaxation", "how the motion comes to rest"))
        readRelaxation(*relaxation, rule);
    rule.maxSteps = d.get<Index>({"maxSteps", "steps until it gives up", unit::none, Bound::atLeast(1), rule.maxSteps});
    if (d.found("maxTime"))
        rule.maxTime = d.get<double>({"maxTime", "time of motion until it gives up", unit::time, Bound::positive()});
    rule.keepPositions = d.get<bool>(
        {"keepPositions", "yes: of what was loaded only stresses are kept", unit::none, {}, rule.keepPositions});
    d.rejectUnread();
    return rule;
}

/// The axis gravity points along most; the last without gravity.
int verticalAxis(const stepping::Scene& scene, int dim)
{
    int vertical = dim - 1;
    for (int a = 0; a < dim && scene.gravity; ++a)
        if (std::abs((*scene.gravity)[a]) > std::abs((*scene.gravity)[vertical]))
            vertical = a;
    return vertical;
}

/// Horizontal over vertical stress by least squares, sum V s_h s_v/sum V s_v^2, of each horizontal axis.
std::vector<double> stressRatios(const state::Particles& p, int vertical)
{
    std::vector<double> ratios;
    for (int a = 0; a < p.dim; ++a)
    {
        double both = 0, square = 0;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            const double v = p.stress[vertical][i];
            both += p.volume[i] * p.stress[a][i] * v;
            square += p.volume[i] * v * v;
        }
        if (a != vertical && square > 0)
            ratios.push_back(both / square);
    }
    return ratios;
}

void line(const std::string& what, const std::string& text)
{
    fmt::print("  {:<14} {}\n", what, text);
}
} // namespace

GravityLoading::GravityLoading(const CaseDirectory& folder, const Options& options) : folder_(folder)
{
    if (folder.hasFile(dictName))
    {
        const auto d = Dictionary::readFile(folder.dictionaryPath(dictName));
        rule_ = readRule(d);
        dictionary_ = d.text();
    }
    if (folder.times().empty())
        throw InputError(folder.folder().string() + ": found no time folder with a state.h5; run seedParticles first");
    timeName_ = folder.firstTime().name;
    state_ = output::readState(folder.statePath(timeName_));
    scene_ = readScene(folder, state_);
    refuse(options);
    auto& s = scene_.scene;
    s.relaxationTime.reset();
    s.localDamping = rule_.kinetic ? 0 : rule_.coefficient; // 0: it only measures
    s.splitting.reset();
    s.merging.reset();
    s.bulkViscosity.reset();
    s.rest.reset();
    for (auto& wall : s.walls)
        wall.motion.reset();
    for (auto& body : s.bodies)
        body.motion.reset();
    for (auto& side : s.absorbing)
        side.incoming.reset();
    s.staggeredStart = false;
    s.timeIntegration = stepping::TimeIntegration::symplecticEuler;
    seeded_ = state_;
    for (std::size_t i = 0; i < std::size_t(state_.particles.size()) && s.gravity; ++i)
        for (int a = 0; a < state_.particles.dim; ++a)
            weight_ += state_.particles.mass[i] * std::abs((*s.gravity)[a]);
}

void GravityLoading::refuse(const Options& options) const
{
    const auto file = folder_.statePath(timeName_).lexically_normal().string();
    if (state_.step > 0 || state_.particles.size() == 0)
        throw InputError({file},
                         fmt::format("found {} particles after {} steps; allowed: a state of seedParticles, which "
                                     "no run has changed",
                                     state_.particles.size(), state_.step));
    if (state_.provenance.count("gravityLoading") && !options.overwrite)
        throw InputError({file}, "is loaded already; -overwrite loads it once more");
    const auto& s = scene_.scene;
    if (s.gravityRamp)
        throw InputError({"constant/g"},
                         "ramp: found gravity that comes on while the run goes; allowed: gravity without it, "
                         "as gravityLoading finds the stresses under all of it");
    if (!s.gravity && s.loads.empty() && !s.bodyForce)
        throw InputError(folder_.folder().string() +
                         ": found no load at all; allowed: constant/g, constant/bodyForce, or a traction or "
                         "pressure in constant/boundaryConditions");
    for (const auto& material : s.materials)
        if (rule_.keepPositions && material.law->hyperelastic())
            throw InputError(
                fmt::format("{}: keepPositions: found yes with material '{}', law {}, whose stress is that of "
                            "its deformation; allowed: no",
                            dictName, material.name, material.law->name()));
}

void GravityLoading::banner() const
{
    const auto& s = scene_.scene;
    fmt::print("gravityLoading, libmpm {} ({})\n", projectVersion(), gitRevision());
    line("particles",
         fmt::format("{} in {} dimensions, time {}", state_.particles.size(), state_.particles.dim, timeName_));
    line("method", scene_.shape + ", " + stepping::methodText(s));
    for (const auto& material : s.materials)
        line("material", fmt::format("{}: {}", material.name, material.law->describe()));
    line("damping", rule_.kinetic ? "kinetic" : fmt::format("local, coefficient {:g}", rule_.coefficient));
    line("at rest", fmt::format("net forces below {:g} of those applied, kinetic below {:g} of elastic energy",
                                rule_.tolerance, rule_.kineticTolerance));
    line("kept", rule_.keepPositions ? "stresses; positions and deformation are those seeded" : "the deformed body");
}

double GravityLoading::ratioOf(const stepping::StepReport& report) const
{
    const double applied = std::max(report.appliedForce, weight_);
    return applied > 0 ? report.unbalancedForce / applied : 0;
}

/// Until the body rests; true if it did so from the start.
bool GravityLoading::relax()
{
    auto stepper = makeStepper(scene_.shape, state_, scene_.scene);
    const bool ignoresMass = limitIgnoresMass(scene_.shape);
    auto limit = stepping::stabilityLimit(*stepper, state_, scene_.scene, ignoresMass);
    const double restSpeed = stepping::fastestWave(state_, scene_.scene.materials);
    const auto logOf = [&](double ratio) { return -std::log10(std::max(ratio, rule_.tolerance)); };
    std::unique_ptr<Progress> progress;
    double least = 0, lastKinetic = 0;
    bool peaked = false;
    for (bool first = true;; first = false)
    {
        stepper->step(0.9 * limit.deltaT);
        const auto& report = stepper->report();
        ratio_ = ratioOf(report);
        kinetic_ = report.nodalKineticEnergy;
        strain_ = report.strainEnergy;
        if (firstRatio_ < 0)
            firstRatio_ = ratio_;
        const bool rests = ratio_ <= rule_.tolerance && kinetic_ <= rule_.kineticTolerance * strain_;
        if (first && rests)
            return true;
        ++steps_;
        time_ += state_.deltaT;
        if (rests)
            return false;
        if (steps_ >= rule_.maxSteps || time_ >= rule_.maxTime)
            giveUp(ratio_);
        if (!progress)
        {
            progress = std::make_unique<Progress>("gravityLoading", logOf(ratio_), logOf(0));
            progress->inPieces();
            least = ratio_;
        }
        least = std::min(least, ratio_);
        if (progress->due(logOf(least)))
            progress->update(logOf(least), fmt::format("pass {}, step {}, net force {:.2e} of the load, kinetic {:.2e} "
                                                       "of elastic energy",
                                                       passes_, steps_, ratio_, strain_ > 0 ? kinetic_ / strain_ : 0));
        peaked = rule_.kinetic && kinetic_ < lastKinetic && !peaked;
        if (peaked)
        {
            standStill();
            stepper->particlesChanged();
        }
        lastKinetic = peaked ? 0 : kinetic_;
        limit = stepping::movedLimit(limit, restSpeed, state_, report.largestSpeed);
    }
}

void GravityLoading::run()
{
    double movedLast = 0;
    for (;;)
    {
        ++passes_;
        const state::State before = state_;
        if (relax())
        {
            state_ = before;
            break;
        }
        const double moved = largestDisplacement();
        const double lastPass = std::exchange(movedLast, moved);
        displacement_ = std::max(displacement_, moved);
        if (!rule_.keepPositions)
            break;
        if (passes_ == maxPasses || (passes_ > 1 && moved > 0.5 * lastPass && moved > 0.01 * state_.grid.h))
            giveUp(ratio_); // each equilibrium is that of another body
        putBack();
    }
    standStill();
}

/// The seeded state with the stresses of this one.
void GravityLoading::putBack()
{
    std::unordered_map<std::int64_t, std::size_t> place;
    const auto& from = state_.particles;
    for (std::size_t i = 0; i < std::size_t(from.size()); ++i)
        place[from.id[i]] = i;
    state::State to = seeded_;
    for (std::size_t i = 0; i < std::size_t(to.particles.size()); ++i)
        for (int k = 0; k < stressComponents(to.particles.dim); ++k)
            to.particles.stress[k][i] = from.stress[k][place.at(to.particles.id[i])];
    to.particles.padLastChunk();
    state_ = to;
}

void GravityLoading::standStill()
{
    auto& p = state_.particles;
    for (int a = 0; a < p.dim; ++a)
        std::fill(p.v[a].begin(), p.v[a].end(), 0);
    for (int k = 0; k < p.dim * p.dim && p.hasAffine(); ++k)
        std::fill(p.affine[k].begin(), p.affine[k].end(), 0);
}

double GravityLoading::largestDisplacement() const
{
    std::unordered_map<std::int64_t, std::size_t> place;
    const auto &from = seeded_.particles, &p = state_.particles;
    for (std::size_t i = 0; i < std::size_t(from.size()); ++i)
        place[from.id[i]] = i;
    double largest = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        double square = 0;
        for (int a = 0; a < p.dim; ++a)
            square += std::pow(p.x[a][i] - from.x[a][place.at(p.id[i])], 2);
        largest = std::max(largest, square);
    }
    return std::sqrt(largest);
}

void GravityLoading::giveUp(double ratio) const
{
    throw StepError(fmt::format(
        "found no equilibrium in {} steps ({:.4g} s): net forces are {:.3g} of those applied (tolerance {:g}), kinetic "
        "energy {:.3g} of the elastic (tolerance {:g}); the body has moved by up to {:.3g} m. It may have none (a "
        "slope "
        "that fails), or needs more maxSteps. Nothing was written",
        steps_, time_, ratio, rule_.tolerance, strain_ > 0 ? kinetic_ / strain_ : 0, rule_.kineticTolerance,
        std::max(displacement_, largestDisplacement())));
}

void GravityLoading::report() const
{
    const auto& p = state_.particles;
    fmt::print("\nAt rest after {} steps in {} pass{}\n", steps_, passes_, passes_ == 1 ? "" : "es");
    line("net force",
         fmt::format("{:.3g} of the load (at the start {:.3g}), tolerance {:g}", ratio_, firstRatio_, rule_.tolerance));
    line("displacement", fmt::format("{:.4g} m at most{}", displacement_, rule_.keepPositions ? ", taken back" : ""));
    const int vertical = verticalAxis(scene_.scene, p.dim);
    std::string text;
    std::size_t n = 0;
    const auto ratios = stressRatios(p, vertical);
    for (int a = 0; a < p.dim; ++a)
        if (a != vertical && n < ratios.size())
            text += fmt::format("{}sigma_{}{} = {:.4f} sigma_{}{}", text.empty() ? "" : ", ", axisNames[a],
                                axisNames[a], ratios[n++], axisNames[vertical], axisNames[vertical]);
    if (!text.empty())
        line("K0", text + " (least squares by volume)");
    line("energy",
         fmt::format("elastic {:.4g} J, plastic {:.4g} J in the last pass", strain_, state_.ledger.plasticDissipation));
}

void GravityLoading::write()
{
    folder_.requireWritable();
    state_.time = 0;
    state_.step = 0;
    state_.deltaT = 0;
    state_.stepFactor = 1;
    state_.ledger = {};
    forgetTurn(state_);
    recordInstructionSet(state_, instructionSet());
    recordStorage(state_, storage());
    state_.provenance["gravityLoading"] = fmt::format("{} {}; {} steps, net force {:.3g} of the load\n{}",
                                                      projectVersion(), gitRevision(), steps_, ratio_, dictionary_);
    output::writeState(folder_.timePath(timeName_), state_);
    fmt::print("wrote {}/state.h5\n", timeName_);
}
} // namespace mpm::cases
