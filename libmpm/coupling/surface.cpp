#include "coupling/surface.hpp"

#include "base/error.hpp"
#include "coupling/byteStream.hpp"
#include "nodal/insideBody.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::coupling
{
using namespace mpm::nodal;

namespace
{
std::vector<double> flat(const std::vector<Vector3>& values)
{
    std::vector<double> out;
    for (const auto& v : values)
        out.insert(out.end(), v.begin(), v.end());
    return out;
}

std::vector<Vector3> vectors(const std::vector<double>& values)
{
    std::vector<Vector3> out(values.size() / 3);
    for (std::size_t n = 0; n < values.size(); ++n)
        out[n / 3][n % 3] = values[n];
    return out;
}

/// The body's own surface: the same points under the same numbers (check() has refused what would be merged).
RigidSurface closedSurface(const SurfaceMesh& mesh)
{
    auto elements = mesh.elements;
    for (auto& e : elements)
        e[2] = std::max(e[2], Index(0));
    return RigidSurface(mesh.dim, mesh.vertices, std::move(elements), Location{});
}
} // namespace

Surface::Surface(std::string name, SurfaceMesh mesh, SurfaceKind kind, const SurfaceOptions& options)
    : name_(std::move(name)), mesh_(std::move(mesh)), kind_(kind), options_(options)
{
    check(mesh_, kind != SurfaceKind::Monitor, name_);
    const auto refuse = [&](const std::string& what) { throw CouplingError(Fault::badSurface, name_ + ": " + what); };
    if (!(options.mu >= 0) || !std::isfinite(options.mu))
        refuse(fmt::format("found friction mu {}, allowed are finite values of 0 and more", options.mu));
    for (const double x : options.reference)
        if (!options.referenceIsCentroid && !std::isfinite(x))
            refuse(fmt::format("found {} in the reference point, allowed are finite numbers", x));
    const std::size_t count = mesh_.vertices.size();
    now_.displacement = now_.velocity = now_.force = now_.traction = Samples(3 * count);
    now_.impulse = now_.windowImpulse = std::vector<double>(3 * count, 0.0);
    now_.area.assign(count, 0.0);
    now_.points = flat(mesh_.vertices);
    now_.velocities.assign(3 * count, 0.0);
    if (kind == SurfaceKind::Monitor)
    {
        carried_ = std::make_shared<CarriedSurface>();
        carried_->name = name_;
        carried_->points = mesh_.vertices;
        carried_->velocities.assign(count, Vector3{});
        return;
    }
    try
    {
        auto surface = std::make_shared<RigidSurface>(closedSurface(mesh_));
        reference_ = options.referenceIsCentroid ? surface->centroid() : options.reference;
        if (rigid())
            rigid_ = std::make_shared<RigidBody>(surface, reference_);
        else
            deformable_ = std::make_shared<DeformableBody>(*surface, reference_);
    }
    catch (const InputError& error)
    {
        refuse(error.what());
    }
    now_.place.position = reference_;
}

void Surface::setInterpolation(const Field& field, Interpolation interpolation)
{
    switch (field.name)
    {
    case FieldName::RigidPose:
        return now_.pose.setInterpolation(interpolation);
    case FieldName::Displacement:
        return now_.displacement.setInterpolation(interpolation);
    case FieldName::Velocity:
        return now_.velocity.setInterpolation(interpolation);
    case FieldName::Force:
        return now_.force.setInterpolation(interpolation);
    case FieldName::Traction:
        return now_.traction.setInterpolation(interpolation);
    default:
        throw CouplingError(
            Fault::badValue,
            fmt::format("{}: found an interpolation of {}, which is linear; allowed is one of RigidPose", name_,
                        fieldWord(field.name)));
    }
}

void Surface::setPartner(SurfaceMesh mesh, MappingMethod method)
{
    check(mesh, false, name_ + " (partner's mesh)");
    Mapping toOwn(mesh, mesh_, method), fromOwn(mesh_, mesh, method);
    partner_.emplace(Partner{std::move(mesh), std::move(toOwn), std::move(fromOwn)});
}

void Surface::enter(const state::State& state, stepping::Scene& scene)
{
    const auto refuse = [&](const std::string& what) { throw CouplingError(Fault::badSurface, name_ + ": " + what); };
    const auto& grid = state.grid;
    Vector3 low = mesh_.vertices.front(), high = low;
    for (const auto& x : mesh_.vertices)
        for (std::size_t a = 0; a < 3; ++a)
        {
            low[a] = std::min(low[a], x[a]);
            high[a] = std::max(high[a], x[a]);
        }
    for (int a = 0; a < grid.dim; ++a)
    {
        const auto n = std::size_t(a);
        if (high[n] < grid.origin[n] || low[n] > grid.upper(a))
            refuse(
                fmt::format("found it at {} = {:g} to {:g}, outside the grid; allowed: {:g} to {:g} (system/gridDict)",
                            axisNames[n], low[n], high[n], grid.origin[n], grid.upper(a)));
        if (grid.periodic[n] && kind_ != SurfaceKind::Monitor)
            refuse("found it in a periodic grid; allowed: no periodic in system/gridDict");
    }
    for (const auto& body : scene.bodies)
        if (body.name == name_)
            refuse("found a rigid body of that name in constant/rigidBodies; allowed is another name");
    now_.pose.setPose(state.time, now_.place);
    now_.displacement.set(state.time, std::vector<double>(now_.points.size(), 0.0));
    if (carried_)
    {
        scene.carried.push_back(carried_);
        return;
    }
    std::shared_ptr<ContactBody> body = rigid_;
    if (deformable_)
        body = deformable_;
    body->collects = true;
    if (const double most = body->surface().depth(grid.h); most < 0.45 * grid.h)
        refuse(fmt::format("found a surface {:g} m thick at most; allowed is a cell, {:g} m, and more: nodes inside it "
                           "have to tell its sides apart",
                           2 * most, grid.h));
    scene.bodies.push_back({name_, body, options_.mu, options_.separation, nullptr});
}

void Surface::refuseInsideSoil(const state::State& state) const
{
    const ContactBody& body = rigid_ ? static_cast<const ContactBody&>(*rigid_) : *deformable_;
    const auto found = particlesInside(body, state.particles, state.grid.h);
    if (found.count > 0)
        throw CouplingError(
            Fault::badSurface,
            fmt::format("{}: found {} particles inside it at the start, particle {} the deepest, {:g} m "
                        "({:.2g} cells); allowed: a surface that begins outside the soil",
                        name_, found.count, state.particles.id[std::size_t(found.deepest)], found.depth,
                        found.depth / state.grid.h));
}

void Surface::startAt(const state::State& state)
{
    if (carried_)
        return;
    if (rigid_)
    {
        now_.place = now_.pose.pose(state.time);
        rigid_->move(now_.place, {});
    }
    else
    {
        std::vector<double> offset(now_.points.size());
        now_.displacement.value(state.time, offset, &now_.velocity);
        for (std::size_t n = 0; n < offset.size(); ++n)
            now_.points[n] = mesh_.vertices[n / 3][n % 3] + offset[n];
        if (!deformable_->place(vectors(now_.points), vectors(now_.velocities)))
            throw CouplingError(Fault::badSurface, name_ + ": found a deformed surface that holds no volume");
    }
    if (state.step == 0)
        refuseInsideSoil(state);
}

void Surface::moveBody(double dt)
{
    if (rigid_)
        rigid_->move(now_.place, now_.twist);
    else if (!deformable_->place(vectors(now_.points), vectors(now_.velocities)))
        throw CouplingError(Fault::badSurface, name_ + ": found a deformed surface that holds no volume");
    now_.step = dt;
}

void Surface::place(double time, double dt, double h)
{
    if (carried_)
    {
        std::vector<double> load(now_.points.size(), 0.0), part(load.size(), 0.0);
        if (!now_.force.empty())
            now_.force.mean(time, time + dt, load);
        if (!now_.traction.empty())
        {
            now_.traction.mean(time, time + dt, part);
            const auto areas = vertexAreas(meshNow());
            for (std::size_t n = 0; n < load.size(); ++n)
                load[n] += areas[n / 3] * part[n];
        }
        const bool none = std::all_of(load.begin(), load.end(), [](double f) { return f == 0; });
        carried_->forces = none ? std::vector<Vector3>{} : vectors(load);
        return;
    }
    double fastest = 0;
    if (rigid_)
    {
        now_.twist = twistBetween(now_.place, now_.pose.pose(time + dt), dt);
        moveBody(dt);
        fastest = rigid_->fastest();
    }
    else
    {
        std::vector<double> offset(now_.points.size());
        now_.displacement.value(time + dt, offset, &now_.velocity);
        for (std::size_t n = 0; n < offset.size(); ++n)
            now_.velocities[n] = (mesh_.vertices[n / 3][n % 3] + offset[n] - now_.points[n]) / dt;
        moveBody(dt);
        fastest = deformable_->fastest();
    }
    if (!(fastest * dt <= 0.5 * h))
        throw CouplingError(Fault::jump,
                            fmt::format("{}: found a way of {:.3g} m in a substep of {:.3g} s at {:.9g} s; allowed is "
                                        "half a cell, {:.3g} m: a smaller window, or a motion said for its end",
                                        name_, fastest * dt, dt, time, 0.5 * h));
}

void Surface::collect(double time, double dt, double h)
{
    now_.window += dt;
    if (carried_)
    {
        now_.points = flat(carried_->points);
        now_.velocities = flat(carried_->velocities);
        now_.work += carried_->work;
        now_.sumImpulse = minus(now_.sumImpulse, carried_->impulse);
        now_.onSurface = times(-1 / dt, carried_->impulse);
        return;
    }
    ContactBody& body = rigid_ ? static_cast<ContactBody&>(*rigid_) : *deformable_;
    std::fill(now_.impulse.begin(), now_.impulse.end(), 0.0);
    for (const auto& given : body.impulses)
        for (std::size_t k = 0; k < std::size_t(mesh_.dim); ++k)
            for (std::size_t a = 0; a < 3; ++a)
                now_.impulse[3 * std::size_t(body.surface().elements()[std::size_t(given.element)][k]) + a] +=
                    given.weights[k] * given.impulse[a];
    for (std::size_t n = 0; n < now_.impulse.size(); ++n)
        now_.windowImpulse[n] += now_.impulse[n];
    now_.onSurface = body.force;
    now_.torque = body.torque;
    now_.sumImpulse = plus(now_.sumImpulse, times(dt, body.force));
    now_.sumMoment = plus(now_.sumMoment, times(dt, body.torque));
    if (rigid_)
        now_.work -= dt * (dot(body.force, now_.twist.velocity) + dot(body.torque, now_.twist.angularVelocity));
    else
        for (std::size_t n = 0; n < now_.impulse.size(); ++n)
            now_.work += now_.impulse[n] * now_.velocities[n];
    findArea(body.impulses, h);
    if (rigid_)
        now_.place = now_.pose.pose(time + dt);
    else
        for (std::size_t n = 0; n < now_.points.size(); ++n)
            now_.points[n] += dt * now_.velocities[n];
    moveBody(dt);
}

void Surface::beginWindow()
{
    std::fill(now_.windowImpulse.begin(), now_.windowImpulse.end(), 0.0);
    now_.sumImpulse = now_.sumMoment = {};
    now_.window = 0;
}

void Surface::endWindow(double time)
{
    now_.pose.forget(time);
    now_.displacement.forget(time, &now_.velocity);
    now_.velocity.forget(std::min(time, now_.displacement.empty() ? time : now_.displacement.times().front()));
    now_.force.forget(time);
    now_.traction.forget(time);
}
} // namespace mpm::coupling
