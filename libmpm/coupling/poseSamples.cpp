#include "coupling/poseSamples.hpp"

#include "coupling/byteStream.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::coupling
{
using nodal::cross;
using nodal::length;
using nodal::minus;
using nodal::plus;
using nodal::times;

namespace
{
void wantSize(std::span<const double> values, std::size_t size)
{
    if (values.size() != size)
        throw CouplingError(Fault::wrongSize, fmt::format("found {} values, allowed are {}", values.size(), size));
}

/// From q to p: exponential(turn) q = p.
Vector3 turn(const Quaternion& q, const Quaternion& p)
{
    return logarithm(product(p, conjugate(q)));
}

Quaternion turned(const Vector3& phi, const Quaternion& q)
{
    return normalised(product(exponential(phi), q));
}
} // namespace

void PoseSamples::setPose(double time, std::span<const double> values)
{
    wantSize(values, 7);
    const Quaternion q = {values[3], values[4], values[5], values[6]};
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(square > 1e-24 && square < 1e24))
        throw CouplingError(Fault::badValue,
                            fmt::format("found a quaternion ({:g} {:g} {:g} {:g}), allowed is one of length 1", q[0],
                                        q[1], q[2], q[3]));
    places_.set(time, values.first(3));
    rotations_.set(time, normalised(q));
}

void PoseSamples::setPose(double time, const nodal::Pose& pose)
{
    places_.set(time, pose.position);
    rotations_.set(time, quaternionOf(pose.rotation));
}

void PoseSamples::setTwist(double time, std::span<const double> values)
{
    wantSize(values, 6);
    velocities_.set(time, values.first(3));
    omegas_.set(time, values.last(3));
}

void PoseSamples::dropPosesAfter(double time)
{
    places_.dropAfter(time);
    rotations_.dropAfter(time);
}

void PoseSamples::dropTwistsAfter(double time)
{
    velocities_.dropAfter(time);
    omegas_.dropAfter(time);
}

void PoseSamples::setInterpolation(Interpolation kind)
{
    kind_ = kind;
    places_.setInterpolation(kind);
}

Quaternion PoseSamples::sample(std::size_t k) const
{
    const auto values = rotations_.sample(k);
    return {values[0], values[1], values[2], values[3]};
}

Vector3 PoseSamples::omega(double t) const
{
    Vector3 out;
    omegas_.value(t, out);
    return out;
}

/// Angular velocity at sample k: said, or of the parabola through the turns from k to two neighbours.
Vector3 PoseSamples::slope(std::size_t k) const
{
    const auto& at = rotations_.times();
    if (!omegas_.empty())
        return omega(at[k]);
    const std::size_t begin = std::min(k > 0 ? k - 1 : 0, at.size() - std::min<std::size_t>(3, at.size()));
    Samples turns(3, Interpolation::Hermite);
    for (std::size_t n = begin; n < std::min(begin + 3, at.size()); ++n)
        turns.set(at[n] - at[k], turn(sample(k), sample(n)));
    Vector3 out;
    turns.slopeAt(k - begin, out);
    return out;
}

Quaternion PoseSamples::rotation(double t) const
{
    const auto& at = rotations_.times();
    const auto next = std::upper_bound(at.begin(), at.end(), t);
    if (next == at.begin())
        return at.empty() ? Quaternion{1, 0, 0, 0} : sample(0);
    if (next == at.end())
        return movedOn(t);
    const auto k = std::size_t(next - at.begin()) - 1;
    const Quaternion q = sample(k);
    if (kind_ == Interpolation::constant)
        return q;
    const Vector3 theta = turn(q, sample(k + 1));
    const double h = at[k + 1] - at[k], s = (t - at[k]) / h;
    if (kind_ == Interpolation::linear)
        return turned(times(s, theta), q);
    const Vector3 first = slope(k), second = rateOfVector(theta, slope(k + 1));
    return turned(plus(times(s * s * (3 - 2 * s), theta),
                       plus(times(h * s * (1 - s) * (1 - s), first), times(h * s * s * (s - 1), second))),
                  q);
}

/// From the last pose on: sub-steps lie on a lattice of their own, so that the result does not depend on who asks when.
Quaternion PoseSamples::movedOn(double t) const
{
    Quaternion q = sample(rotations_.times().size() - 1);
    const auto& said = omegas_.times();
    if (said.empty())
        return q;
    for (double from = rotations_.times().back(); from < t;)
    {
        const auto next = std::upper_bound(said.begin(), said.end(), from);
        if (next == said.begin() || next == said.end()) // held
        {
            const double to = next == said.end() ? t : std::min(*next, t);
            q = turned(times(to - from, omega(from)), q);
            from = to;
            continue;
        }
        const double fastest = std::max(length(omega(from)), length(omega(*next)));
        const double h = (*next - from) / std::ceil(std::clamp(fastest * (*next - from) / 0.1, 1.0, 1e4));
        while (from < *next && from < t)
        {
            const double to = std::min({from + h, *next, t}), step = to - from;
            const double off = std::sqrt(3.0) / 6 * step, middle = 0.5 * (from + to);
            const Vector3 a = omega(middle - off), b = omega(middle + off);
            q = turned(plus(times(0.5 * step, plus(a, b)), times(std::sqrt(3.0) / 12 * step * step, cross(b, a))), q);
            from = to;
        }
    }
    return q;
}

nodal::Pose PoseSamples::pose(double t) const
{
    nodal::Pose out;
    places_.value(t, out.position, &velocities_);
    out.rotation = matrixOf(rotation(t));
    return out;
}

nodal::Twist PoseSamples::meanTwist(double t0, double t1) const
{
    nodal::Twist out;
    places_.meanRate(t0, t1, out.velocity, &velocities_);
    out.angularVelocity = times(1 / (t1 - t0), turn(rotation(t0), rotation(t1)));
    return out;
}

void PoseSamples::forget(double time)
{
    if (places_.empty())
        return;
    if (!omegas_.empty() && rotations_.times().back() < time)
    {
        const Quaternion q = rotation(time);
        rotations_ = Samples(4);
        rotations_.set(time, q);
    }
    else
        rotations_.forget(time);
    places_.forget(time, &velocities_);
    const double needed = std::min(time, places_.times().front());
    velocities_.forget(needed);
    omegas_.forget(needed);
}

void PoseSamples::serialise(std::vector<std::byte>& out) const
{
    putBytes(out, std::int64_t(kind_));
    for (const auto* samples : {&places_, &rotations_, &velocities_, &omegas_})
        samples->serialise(out);
}

PoseSamples PoseSamples::deserialise(std::span<const std::byte>& bytes)
{
    PoseSamples out;
    const auto kind = takeBytes<std::int64_t>(bytes);
    for (auto* samples : {&out.places_, &out.rotations_, &out.velocities_, &out.omegas_})
        *samples = Samples::deserialise(bytes);
    if (kind < 0 || kind > std::int64_t(Interpolation::Hermite) || out.places_.valueCount() != 3 ||
        out.rotations_.valueCount() != 4 || out.velocities_.valueCount() != 3 || out.omegas_.valueCount() != 3 ||
        out.places_.times() != out.rotations_.times() || out.velocities_.times() != out.omegas_.times())
        throw CouplingError(Fault::badState, "found poses whose places and rotations do not fit");
    out.kind_ = Interpolation(kind);
    return out;
}

nodal::Twist twistBetween(const nodal::Pose& from, const nodal::Pose& to, double dt)
{
    return {times(1 / dt, minus(to.position, from.position)),
            times(1 / dt, turn(quaternionOf(from.rotation), quaternionOf(to.rotation)))};
}
} // namespace mpm::coupling
