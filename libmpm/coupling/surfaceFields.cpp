// What goes in and out of a surface: written and read fields, averages, sums, bytes.
#include "base/error.hpp"
#include "coupling/byteStream.hpp"
#include "coupling/exportSurface.hpp"
#include "coupling/surface.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mpm::coupling
{
using namespace mpm::nodal;

namespace
{
void wantOwn(bool wanted, const std::string& what)
{
    if (!wanted)
        throw CouplingError(Fault::badValue, what);
}
} // namespace

Field Surface::field(FieldName name, std::optional<Direction> direction) const
{
    std::vector<std::string> there;
    for (const auto& field : fields())
    {
        if (field.name == name && (!direction || field.direction == *direction))
            return field;
        if (!direction || field.direction == *direction)
            there.push_back(fieldWord(field.name));
    }
    const char* way = !direction ? "" : *direction == Direction::written ? " to write" : " to read";
    throw CouplingError(Fault::unknownField, fmt::format("{}: found {}, a {} surface has {}{}", name_, fieldWord(name),
                                                         kindWord(kind_), joinWords(there, " and "), way));
}

std::size_t Surface::valueCount(const Field& field) const
{
    return std::size_t(field.components) * (field.support == Support::vertex ? exchanged().vertices.size() : 1);
}

void Surface::write(const Field& field, std::span<const double> values, double time)
{
    if (mesh_.dim == 2)
        for (std::size_t n = 0; n < values.size(); ++n)
        {
            const auto c = int(n % std::size_t(field.components));
            const bool flatPose = field.name == FieldName::RigidPose && (c == 2 || c == 4 || c == 5);
            const bool flatTwist = field.name == FieldName::RigidTwist && (c == 2 || c == 3 || c == 4);
            const bool vector = field.components == 3 && c == 2;
            wantOwn(values[n] == 0 || !(flatPose || flatTwist || vector),
                    fmt::format("{}: found {:g} as component {} of {} in 2D; allowed is 0", name_, values[n], c,
                                fieldWord(field.name)));
        }
    if (field.name == FieldName::RigidPose)
    {
        PoseSamples changed = now_.pose;
        changed.dropPosesAfter(time);
        changed.setPose(time, values);
        now_.pose = std::move(changed);
        return;
    }
    if (field.name == FieldName::RigidTwist)
    {
        now_.pose.dropTwistsAfter(time);
        return now_.pose.setTwist(time, values);
    }
    std::vector<double> own(values.begin(), values.end());
    if (partner_)
    {
        own.assign(now_.points.size(), 0.0);
        if (field.extensive)
            partner_->fromOwn.conservative(values, field.components, own);
        else
            partner_->toOwn.consistent(values, field.components, own);
        if (field.extensive)
            sums_ = {};
        for (std::size_t n = 0; n < values.size() && field.extensive; ++n)
            sums_[0][n % 3] += values[n];
        for (std::size_t n = 0; n < own.size() && field.extensive; ++n)
            sums_[1][n % 3] += own[n];
    }
    Samples& samples = field.name == FieldName::Displacement ? now_.displacement
                       : field.name == FieldName::Velocity   ? now_.velocity
                       : field.name == FieldName::Force      ? now_.force
                                                             : now_.traction;
    samples.dropAfter(time);
    samples.set(time, own);
}

std::vector<Vector3> Surface::points() const
{
    std::vector<Vector3> out(mesh_.vertices.size());
    for (std::size_t n = 0; n < out.size(); ++n)
        if (rigid_)
            out[n] = rigid_->toSpace(mesh_.vertices[n]);
        else
            out[n] = {now_.points[3 * n], now_.points[3 * n + 1], now_.points[3 * n + 2]};
    return out;
}

SurfaceMesh Surface::meshNow() const
{
    SurfaceMesh out = mesh_;
    out.vertices = points();
    return out;
}

/// - J_v/(time A_v).
std::vector<double> Surface::tractions(const std::vector<double>& impulse, double time) const
{
    const auto areas = vertexAreas(meshNow());
    std::vector<double> out(impulse.size(), 0.0);
    for (std::size_t n = 0; n < out.size() && time > 0; ++n)
        out[n] = -impulse[n] / (time * areas[n / 3]);
    return out;
}

void Surface::stressAt(const state::State& state, std::vector<double>& out) const
{
    const auto& p = state.particles;
    const int dim = p.dim, components = stressComponents(dim);
    const double h = state.grid.h;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
    {
        std::array<double, 6> sum{};
        double total = 0;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            double w = p.volume[i];
            for (int a = 0; a < dim && w > 0; ++a)
                w *= std::max(0.0, 1 - std::abs(p.x[std::size_t(a)][i] - now_.points[3 * v + std::size_t(a)]) / h);
            if (!(w > 0))
                continue;
            total += w;
            for (int k = 0; k < components; ++k)
                sum[std::size_t(k)] += w * p.stress[std::size_t(k)][i];
        }
        for (int k = 0; k < components && total > 0; ++k)
            out[6 * v + std::size_t(k)] = sum[std::size_t(k)] / total;
    }
}

/// The field on the surface's own vertices, or of the whole.
std::vector<double> Surface::own(const Field& field, const state::State& state) const
{
    std::vector<double> out;
    const auto x = points();
    switch (field.name)
    {
    case FieldName::Force:
        if (rigid_)
            return {now_.onSurface.begin(), now_.onSurface.end()};
        for (const double impulse : now_.impulse)
            out.push_back(now_.step > 0 ? -impulse / now_.step : 0);
        return out;
    case FieldName::Torque:
        return {now_.torque.begin(), now_.torque.end()};
    case FieldName::ContactArea:
        out = now_.area;
        if (rigid_)
        {
            double sum = 0;
            for (const double area : now_.area)
                sum += area;
            out = {sum};
        }
        return out;
    case FieldName::Traction:
        return tractions(now_.impulse, now_.step);
    case FieldName::Displacement:
        for (std::size_t n = 0; n < x.size(); ++n)
            for (std::size_t a = 0; a < 3; ++a)
                out.push_back(x[n][a] - mesh_.vertices[n][a]);
        return out;
    case FieldName::Velocity:
        if (!rigid_)
            return now_.velocities;
        for (const auto& place : x)
        {
            const Vector3 v = rigid_->velocityAt(place);
            out.insert(out.end(), v.begin(), v.end());
        }
        return out;
    case FieldName::Stress:
        out.assign(6 * x.size(), 0.0);
        stressAt(state, out);
        return out;
    default:
        return out; // written ones: field() has refused them
    }
}

void Surface::give(const Field& field, const std::vector<double>& own, std::span<double> out) const
{
    if (!partner_ || field.support == Support::surface)
    {
        std::copy(own.begin(), own.end(), out.begin());
        return;
    }
    if (!field.extensive)
        return partner_->fromOwn.consistent(own, field.components, out);
    partner_->toOwn.conservative(own, field.components, out);
    if (field.name != FieldName::Force)
        return;
    sums_ = {};
    for (std::size_t n = 0; n < own.size(); ++n)
        sums_[0][n % 3] += own[n];
    for (std::size_t n = 0; n < out.size(); ++n)
        sums_[1][n % 3] += out[n];
}

void Surface::read(const Field& field, const state::State& state, std::span<double> out) const
{
    give(field, own(field, state), out);
}

void Surface::exportTo(const std::filesystem::path& file, const state::State* state) const
{
    std::vector<VertexField> out;
    for (const auto& field : fields())
        if (state && field.direction == Direction::read && field.support == Support::vertex)
            out.push_back({fieldWord(field.name), field.components, own(field, *state)});
    exportSurface(file, name_, meshNow(), out);
}

void Surface::average(const Field& field, std::span<double> out) const
{
    const double window = now_.window;
    std::vector<double> own;
    const auto whole = [&](const Vector3& sum) {
        for (const double part : sum)
            own.push_back(window > 0 ? part / window : 0);
    };
    if (field.name == FieldName::Traction)
        own = tractions(now_.windowImpulse, window);
    else if (field.name == FieldName::Torque)
        whole(now_.sumMoment);
    else if (field.name == FieldName::Force && rigid_)
        whole(now_.sumImpulse);
    else if (field.name == FieldName::Force)
        for (const double impulse : now_.windowImpulse)
            own.push_back(window > 0 ? -impulse / window : 0);
    else
        throw CouplingError(Fault::unknownField,
                            fmt::format("{}: found a window average of {}, allowed are Force, Torque "
                                        "and Traction",
                                        name_, fieldWord(field.name)));
    give(field, own, out);
}

Resultants Surface::resultants() const
{
    Resultants out;
    out.impulse = now_.sumImpulse;
    out.momentImpulse = now_.sumMoment;
    if (now_.window > 0)
    {
        out.force = times(1 / now_.window, now_.sumImpulse);
        out.torque = times(1 / now_.window, now_.sumMoment);
    }
    for (const double area : now_.area)
        out.contactArea += area;
    return out;
}

std::vector<std::byte> Surface::save() const
{
    std::vector<std::byte> out;
    now_.pose.serialise(out);
    for (const auto* samples : {&now_.displacement, &now_.velocity, &now_.force, &now_.traction})
        samples->serialise(out);
    putBytes(out, now_.place);
    putBytes(out, now_.twist);
    for (const auto* list : {&now_.points, &now_.velocities, &now_.impulse, &now_.windowImpulse, &now_.area})
        putBytes(out, *list);
    for (const auto* vector : {&now_.onSurface, &now_.torque, &now_.sumImpulse, &now_.sumMoment})
        putBytes(out, *vector);
    for (const double number : {now_.step, now_.window, now_.work})
        putBytes(out, number);
    return out;
}

Surface::Now Surface::parse(std::span<const std::byte>& bytes) const
{
    Now read;
    read.pose = PoseSamples::deserialise(bytes);
    for (auto* samples : {&read.displacement, &read.velocity, &read.force, &read.traction})
        *samples = Samples::deserialise(bytes);
    read.place = takeBytes<nodal::Pose>(bytes);
    read.twist = takeBytes<nodal::Twist>(bytes);
    for (auto* list : {&read.points, &read.velocities, &read.impulse, &read.windowImpulse, &read.area})
        *list = takeDoubles(bytes);
    for (auto* vector : {&read.onSurface, &read.torque, &read.sumImpulse, &read.sumMoment})
        *vector = takeBytes<Vector3>(bytes);
    for (double* number : {&read.step, &read.window, &read.work})
        *number = takeBytes<double>(bytes);
    const std::size_t count = now_.points.size();
    bool fits = read.area.size() == now_.area.size();
    for (const auto* list : {&read.points, &read.velocities, &read.impulse, &read.windowImpulse})
        fits = fits && list->size() == count;
    for (const auto* samples : {&read.displacement, &read.velocity, &read.force, &read.traction})
        fits = fits && samples->valueCount() == count;
    if (!fits)
        throw CouplingError(Fault::badState, name_ + ": found a saved surface with another number of vertices");
    return read;
}

void Surface::load(std::span<const std::byte> bytes)
{
    Now before = std::exchange(now_, parse(bytes));
    if (carried_)
    {
        for (std::size_t n = 0; n < now_.points.size(); ++n)
        {
            carried_->points[n / 3][n % 3] = now_.points[n];
            carried_->velocities[n / 3][n % 3] = now_.velocities[n];
        }
        return;
    }
    try
    {
        moveBody(now_.step);
    }
    catch (const CouplingError&)
    {
        now_ = std::move(before);
        moveBody(now_.step);
        throw;
    }
}
} // namespace mpm::coupling
