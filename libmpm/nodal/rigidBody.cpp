#include "nodal/rigidBody.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace mpm::nodal
{
namespace
{
Vector3 product(const std::array<double, 9>& R, const Vector3& a)
{
    Vector3 out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = R[3 * i] * a[0] + R[3 * i + 1] * a[1] + R[3 * i + 2] * a[2];
    return out;
}

Vector3 transposedProduct(const std::array<double, 9>& R, const Vector3& a)
{
    Vector3 out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = R[i] * a[0] + R[3 + i] * a[1] + R[6 + i] * a[2];
    return out;
}

/// Rodrigues' formula.
std::array<double, 9> rotationAbout(const Vector3& n, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
    return {c + d * n[0] * n[0],        d * n[0] * n[1] - s * n[2], d * n[0] * n[2] + s * n[1],
            d * n[1] * n[0] + s * n[2], c + d * n[1] * n[1],        d * n[1] * n[2] - s * n[0],
            d * n[2] * n[0] - s * n[1], d * n[2] * n[1] + s * n[0], c + d * n[2] * n[2]};
}
} // namespace

Pose RigidMotion::pose(double time) const
{
    Pose out;
    out.position = translation ? plus(centre, translation->displacement(time)) : centre;
    if (angle)
        out.rotation = rotationAbout(axis, angle->displacement(time)[0]);
    return out;
}

Twist RigidMotion::meanTwist(double time, double dt) const
{
    Twist out;
    if (translation)
        out.velocity = translation->meanVelocity(time, dt);
    if (angle)
        out.angularVelocity = times(angle->meanVelocity(time, dt)[0], axis);
    return out;
}

std::string RigidMotion::describe() const
{
    std::string out = translation ? translation->describe() : "";
    if (angle)
        out +=
            fmt::format("{}turning about ({:g} {:g} {:g})", out.empty() ? "" : ", ", centre[0], centre[1], centre[2]);
    return out.empty() ? "at rest" : out;
}

RigidMotion RigidMotion::read(const dictionary::Dictionary& d, int dim, const Vector3& centroid)
{
    RigidMotion out;
    out.centre = centroid;
    const auto* rotation = d.findDict("rotation", "about an axis through a point that goes along; default: none");
    if (!rotation || d.found("velocity") || d.found("displacement") || d.found("acceleration"))
        out.translation = dictionary::Motion::read(d, dim);
    if (!rotation)
        return out;
    out.centre = rotation->get<Vector3>(
        {"centre", "a point of the axis at t = 0; default: the centroid", dictionary::unit::length, {}, centroid});
    if (dim == 2 && out.centre[2] != 0)
        rotation->fail("centre", fmt::format("a z component of {:g}", out.centre[2]), "0 in 2D");
    out.axis = rotation->get<Vector3>({"axis", "direction of the axis; default: z", {}, {}, Vector3{0, 0, 1}});
    const double size = length(out.axis);
    if (!(size > 0) || (dim == 2 && (out.axis[0] != 0 || out.axis[1] != 0)))
        rotation->fail("axis", fmt::format("({:g} {:g} {:g})", out.axis[0], out.axis[1], out.axis[2]),
                       dim == 2 ? "(0 0 1) or (0 0 -1) in 2D" : "a vector that is not zero");
    out.axis = times(1 / size, out.axis);
    out.angle = dictionary::readAngle(*rotation);
    return out;
}

void RigidBody::move(const Pose& pose, const Twist& twist)
{
    pose_ = pose;
    twist_ = twist;
    constexpr double ever = std::numeric_limits<double>::infinity();
    low_ = {ever, ever, ever};
    high_ = {-ever, -ever, -ever};
    for (const auto& X : surface_->points())
    {
        const Vector3 x = toSpace(X);
        for (std::size_t a = 0; a < 3; ++a)
        {
            low_[a] = std::min(low_[a], x[a]);
            high_[a] = std::max(high_[a], x[a]);
        }
    }
}

Vector3 RigidBody::toSpace(const Vector3& X) const
{
    return plus(pose_.position, product(pose_.rotation, minus(X, reference_)));
}

Vector3 RigidBody::velocityAt(const Vector3& x) const
{
    return plus(twist_.velocity, cross(twist_.angularVelocity, minus(x, pose_.position)));
}

RigidSurface::Nearest RigidBody::nearest(const Vector3& x) const
{
    auto out = surface_->nearest(plus(reference_, transposedProduct(pose_.rotation, minus(x, pose_.position))));
    out.point = toSpace(out.point);
    out.normal = product(pose_.rotation, out.normal);
    return out;
}

double RigidBody::fastest() const
{
    double most = 0;
    if (twist_.angularVelocity == Vector3{})
        return length(twist_.velocity);
    for (const auto& X : surface_->points())
        most = std::max(most, length(velocityAt(toSpace(X))));
    return most;
}
} // namespace mpm::nodal
