// What a run of the solver says before its first step and after its last.
#include "base/clock.hpp"
#include "base/memory.hpp"
#include "base/processorClock.hpp"
#include "base/version.hpp"
#include "case/effectTables.hpp"
#include "case/expressionForce.hpp"
#include "case/provenance.hpp"
#include "case/solverRun.hpp"
#include "nodal/rigidBody.hpp"
#include "nodal/wall.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mpm::cases
{
namespace
{
std::string wallText(const nodal::Wall& wall, const state::GridBox& grid)
{
    const auto place = fmt::format("{} = {:g} m{}", axisNames[wall.axis], nodal::wallPosition(wall, grid, 0),
                                   wall.motion ? " at t = 0, " + wall.motion->describe() : "");
    switch (wall.type)
    {
    case nodal::WallType::fixed:
        return "fixed at " + place;
    case nodal::WallType::roller:
        return "roller at " + place;
    case nodal::WallType::friction:
        return fmt::format("friction {:g} at {}", wall.mu, place);
    }
    return place;
}

/// How many particles have an edge longer than a cell, and the longest in cells: numerical fracture.
std::pair<Index, double> longParticles(const state::State& state)
{
    const auto& p = state.particles;
    Index count = 0;
    double longest = 0;
    for (Index i = 0; i < p.size(); ++i)
    {
        double most = 0;
        for (int k = 0; k < p.dim; ++k)
        {
            double square = 0;
            for (int a = 0; a < p.dim; ++a)
                square += std::pow(p.F[a * p.dim + k][std::size_t(i)], 2);
            most = std::max(most, p.length0[k][std::size_t(i)] * std::sqrt(square) / state.grid.h);
        }
        count += most > 1;
        longest = std::max(longest, most);
    }
    return {count, longest};
}

std::vector<std::string> periodicAxes(const state::GridBox& grid)
{
    std::vector<std::string> axes;
    for (int a = 0; a < grid.dim; ++a)
        if (grid.periodic[std::size_t(a)])
            axes.push_back(axisNames[std::size_t(a)]);
    return axes;
}

/// Smallest wave modulus rho c_p^2 [Pa].
double softest(const std::vector<constitutive::Material>& materials)
{
    double modulus = std::numeric_limits<double>::infinity();
    for (const auto& m : materials)
        modulus = std::min(modulus, m.density * m.waveSpeed() * m.waveSpeed());
    return modulus;
}

/// "0.3", "0.2 to 0.3".
std::string muText(const nodal::ContactProperties& contact)
{
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t one = 0; one < contact.mu.size(); ++one)
        for (std::size_t other = 0; other < one; ++other)
        {
            least = std::min(least, contact.mu[one][other]);
            most = std::max(most, contact.mu[one][other]);
        }
    return least == most ? fmt::format("{:g}", most) : fmt::format("{:g} to {:g}", least, most);
}

void line(const std::string& what, const std::string& text)
{
    fmt::print("  {:<14} {}\n", what, text);
}
} // namespace

void SolverRun::banner() const
{
    const auto& s = scene_.scene;
    fmt::print("mpmSolve, libmpm {} ({}, {})\n", projectVersion(), gitRevision(), kernelText());
    line("case", std::filesystem::weakly_canonical(folder_.folder()).filename().string());
    line("particles",
         fmt::format("{} in {} dimensions, from time {}", state_.particles.size(), state_.particles.dim, lastStored_));
    line("grid", state_.particles.dim == 2 ? fmt::format("{} x {} cells of {:.6g} m", state_.grid.cells[0],
                                                         state_.grid.cells[1], state_.grid.h)
                                           : fmt::format("{} x {} x {} cells of {:.6g} m", state_.grid.cells[0],
                                                         state_.grid.cells[1], state_.grid.cells[2], state_.grid.h));
    if (const auto periodic = periodicAxes(state_.grid); !periodic.empty())
        line("periodic", "along " + joinWords(periodic, " and "));
    line("method", scene_.shape + ", " + stepping::methodText(s));
    if (s.treatment.any())
        line("stresses", treatment::describe(s.treatment));
    if (!overrides_.empty())
        line("overridden", fmt::format("{}, by {}{}", overrides_.describe(), overrides_.reason(),
                                       state_.step > 0 ? ", with which this run began" : ""));
    for (const auto& material : s.materials)
        line("material", fmt::format("{}: {}, density {:g} kg/m^3, c_p {:.1f} m/s", material.name,
                                     material.law->describe(), material.density, material.waveSpeed()));
    if (s.gravity)
        line("gravity", fmt::format("({:g} {:g} {:g}) m/s^2", (*s.gravity)[0], (*s.gravity)[1], (*s.gravity)[2]) +
                            (s.gravityRamp ? fmt::format(", coming on over {:g} s{}", s.gravityRamp->duration,
                                                         s.gravityRamp->smooth ? ", smooth" : "")
                                           : ""));
    if (const auto* force = dynamic_cast<const ExpressionForce*>(s.bodyForce.get()))
        line("bodyForce", force->describe() + " m/s^2");
    if (s.relaxationTime)
        line("damping", fmt::format("viscous, relaxation time {:g} s", *s.relaxationTime));
    if (s.localDamping)
        line("damping", fmt::format("local, coefficient {:g}", *s.localDamping));
    for (const auto& wall : s.walls)
        line("wall", wall.name + ": " + wallText(wall, state_.grid) + (wall.separation ? ", may separate" : ", holds"));
    if (s.contact)
        line("contact",
             fmt::format("between {}, mu {}{}", joinWords(s.contact->bodies, " and "), muText(*s.contact),
                         s.contact->detection == nodal::ContactDetection::nodes ? ", felt at shared nodes" : ""));
    for (const auto& plane : s.absorbing)
        line("absorbing", fmt::format("{} at {} = {:g} m: {:.4g} and {:.4g} 1/s along and across its normal{}",
                                      plane.name, axisNames[std::size_t(plane.axis)],
                                      state_.grid.origin[std::size_t(plane.axis)] + state_.grid.h * double(plane.plane),
                                      plane.normalRate, plane.shearRate,
                                      plane.incoming ? ", incoming " + plane.incoming->describe() : ""));
    for (const auto& body : s.bodies)
        line("body", fmt::format("{}: {} {}, friction {:g}, {}, {}", body.name, body.body->surface().elements().size(),
                                 state_.particles.dim == 2 ? "segments" : "triangles", body.mu,
                                 body.separation ? "may separate" : "holds", body.motion->describe()));
    for (const auto& load : s.loads)
        line("load", load.pressure ? fmt::format("{}: pressure {:g} Pa", load.patch, load.magnitude)
                                   : fmt::format("{}: traction ({:g} {:g} {:g}) Pa", load.patch, load.traction[0],
                                                 load.traction[1], load.traction[2]));
    if (s.splitting)
        line("splitting", fmt::format("{} at {:g} seeding spacings, every {} steps",
                                      s.splitting->mode == splitting::Mode::fourWay ? "fourWay" : "stretched",
                                      s.splitting->threshold, s.splitting->interval));
    if (s.rest)
        line("rest", fmt::format("waves below a strain of {:g} ({:g} Pa) may be ignored, a look every {} steps{}",
                                 s.rest->tolerance, s.rest->tolerance * softest(s.materials), s.sortInterval,
                                 s.rest->follow ? "; what sleeps follows slowly" : ""));
    if (s.merging)
        line("merging", fmt::format("of edges under {:g} seeding spacings, every {} steps", s.merging->threshold,
                                    s.merging->interval));
    if (s.bulkViscosity)
        line("bulkViscosity",
             fmt::format("linear {:g}, quadratic {:g}", s.bulkViscosity->linear, s.bulkViscosity->quadratic));
    if (done())
        line("time", fmt::format("{:g} s; endTime {:g} s is reached, there is nothing to do", state_.time,
                                 runTime_->endTime()));
    else
        line("time", fmt::format("{:g} s to {:g} s, deltaT {}{:g} s", state_.time, runTime_->endTime(),
                                 runTime_->adjustable() ? "adjusted, first " : "", stepSize()));
    line("stability", fmt::format("deltaT <= {:.4g} s for {} with {}; now {:.3f} of it, (c_p + |v|) deltaT/h = {:.3f}",
                                  limit_.deltaT, stepping::methodText(s), scene_.shape, stepSize() / limit_.deltaT,
                                  (limit_.waveSpeed + limit_.speed) * stepSize() / state_.grid.h));
    line("monitor", monitor_->describe());
    line("threads", fmt::format("{}", options_.threadCount()));
    if (folder_.hasFile("system/couplingDict"))
        line("note", "system/couplingDict: its surfaces are not in this run; mpmCouple or a master puts them there "
                     "(docs/coupling.md)");
    for (const auto& note : {instructionSetNote(state_, instructionSet()), storageNote(state_, storage())})
        if (!note.empty())
            line("note", note);
}

void SolverRun::printPrediction(const CostPrediction& prediction) const
{
    for (const auto& [what, text] : predictionLines(prediction, options_.threadCount()))
        line(what, text);
    for (const auto& [what, text] : expectedErrorLines(folder_, options_, presentCase()))
        line(what, text);
}

void SolverRun::warnings() const
{
    const auto& ledger = state_.ledger;
    if (stepper_->report().cappedDomains > 0)
        line("note", fmt::format("{} particle domains are held at {} cells; split them earlier or seed finer",
                                 stepper_->report().cappedDomains, scene_.shape == "cpGIMP" ? "two" : "one"));
    if (const auto [count, longest] = longParticles(state_); count > 0)
        line("note",
             fmt::format("{} particles are longer than a cell (the longest {:.1f} cells): the body may tear between "
                         "them; split them (mpmSchemes splitting) or seed finer",
                         count, longest));
    if (ledger.splitsPutOff > 0)
        line("note", fmt::format("{} particles wait at a wall for their split", ledger.splitsPutOff));
    if (ledger.splitsCapped > 0)
        line("note",
             fmt::format("{} particles are longer than the threshold, at the cap of maxGeneration or maxParticles",
                         ledger.splitsCapped));
    for (const auto& note : idleEffects(effectRun(), usedEffects()))
        line("note", note);
}

void SolverRun::summary()
{
    {
        const Clock clock(profile_.output);
        const ProcessorClock processor(profile_.apartProcessor);
        finishWriting();
    }
    progress_->finish();
    if (const auto* force = dynamic_cast<const ExpressionForce*>(scene_.scene.bodyForce.get()))
        profile_.apartProcessor += force->seconds();
    const auto t = stepping::totals(state_, scene_.scene.materials);
    const auto& l = state_.ledger;
    const double supplied = std::abs(l.gravityWork + l.tractionWork + l.bodyForceWork + l.motionWork);
    const double mismatch = stepping::residual(l, t.strainEnergy);
    const Index steps = state_.step - firstStep_;
    const char* unit = state_.particles.dim == 2 ? "kJ/m" : "kJ";
    fmt::print("\nDone: {} steps to {:g} s in {} ({} of it output)\n", steps, state_.time,
               formatDuration(profile_.elapsed()), formatDuration(profile_.history + profile_.output));
    line("speed", fmt::format("{:.1f} ns per particle and step", profile_.nsPerParticleStep(stepSeconds_)));
    line("particles", fmt::format("{}, {} splits{}", state_.particles.size(), l.splits,
                                  scene_.scene.merging ? fmt::format(", {} merges", l.merges) : ""));
    if (const double memory = peakMemory(); memory > 0)
        line("memory", fmt::format("{} at most, {:.0f} bytes a particle", formatBytes(memory),
                                   memory / double(state_.particles.size())));
    std::string extent;
    for (int a = 0; a < state_.particles.dim; ++a)
        extent += fmt::format("{} {:.3f} .. {:.3f} m{}", axisNames[a], t.extents.low[a], t.extents.high[a],
                              a + 1 < state_.particles.dim ? ", " : " (particle centres)");
    line("extent", extent);
    line("energy",
         fmt::format("kinetic {:.4g} {} (peak {:.4g} at {:.3f} s), strain {:.4g}, plastic {:.4g}, friction {:.4g}",
                     t.kineticEnergy / 1e3, unit, peakKinetic_ / 1e3, peakTime_, t.strainEnergy / 1e3,
                     l.plasticDissipation / 1e3, l.frictionDissipation / 1e3));
    bool motion = false;
    for (const auto& wall : scene_.scene.walls)
        motion = motion || wall.motion;
    if (motion || !scene_.scene.bodies.empty())
        line("motion", fmt::format("walls and bodies did {:.4g} {} of work, {} contacts of bodies", l.motionWork / 1e3,
                                   unit, l.bodyContacts));
    if (!scene_.scene.absorbing.empty())
        line("absorbing", fmt::format("{:.4g} {} let out", l.absorbedEnergy / 1e3, unit));
    if (scene_.scene.relaxationTime || scene_.scene.localDamping)
        line("damping", fmt::format("{:.4g} {} dissipated", l.dampingDissipation / 1e3, unit));
    if (scene_.scene.bulkViscosity)
        line("bulkViscosity", fmt::format("{:.4g} {} dissipated", l.bulkViscosityLoss / 1e3, unit));
    if (const auto& treatment = scene_.scene.treatment; treatment.any())
    {
        const auto share = [&](double energy) {
            return fmt::format("{:.3g} {}{}", energy / 1e3, unit,
                               supplied > 0 ? fmt::format(" ({:.2f} %)", 100 * energy / supplied) : "");
        };
        std::string text;
        const auto add = [&](bool used, const std::string& what, double energy) {
            if (used)
                text += (text.empty() ? "" : ", ") + what + " " + share(energy);
        };
        add(treatment.relaxation.has_value(), "relaxation took", l.relaxationLoss);
        add(treatment.averaging && !treatment.averaging->conjugate, "averaging", l.averagingLoss);
        add(treatment.hasViscosity(), "its viscosity", l.viscosityLoss);
        add(treatment.tensionGap, "open gaps hold", l.gapWork);
        line("stresses", text);
    }
    line("residual",
         fmt::format("{:.4g} {}{}", mismatch / 1e3, unit,
                     supplied > 0 ? fmt::format(", {:.2f} % of the work supplied", 100 * mismatch / supplied) : ""));
    line("apex", fmt::format("{} returns, {:.4g} m^{} of volume {}", l.apexReturns, l.apexVolume, state_.particles.dim,
                             scene_.scene.treatment.tensionGap ? "open" : "dropped"));
    if (runTime_->adjustable() && steps > 0)
        line("time step", fmt::format("{:.4g} to {:.4g} s, mean {:.4g} s; adapting it took {:.2g} % of the run",
                                      smallestStep_, largestStep_, (state_.time - firstTime_) / double(steps),
                                      100 * profile_.timeStep / profile_.elapsed()));
    for (const auto& [what, text] : monitor_->summary())
        line(what, text);
    warnings();
    line("last time", lastStored_);
    fmt::print("\n{}", deeds());
    fmt::print("\n{}", profile_.text(stepper_->times(), 2));
    if (options_.has("profile"))
        profile_.write(folder_.postProcessing() / "profile.csv", stepper_->times());
}
} // namespace mpm::cases
