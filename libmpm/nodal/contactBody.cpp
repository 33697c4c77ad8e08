#include "nodal/contactBody.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>

namespace mpm::nodal
{
DeformableBody::DeformableBody(RigidSurface surface, const Vector3& reference)
    : surface_(std::move(surface)), reference_(reference), velocities_(surface_.points().size(), Vector3{})
{
    low_ = surface_.low();
    high_ = surface_.high();
}

bool DeformableBody::place(const std::vector<Vector3>& points, const std::vector<Vector3>& velocities)
{
    velocities_ = velocities;
    if (!surface_.deform(points))
        return false;
    low_ = surface_.low();
    high_ = surface_.high();
    return true;
}

Vector3 DeformableBody::velocityAt(const Vector3&, const RigidSurface::Nearest& nearest) const
{
    const auto& element = surface_.elements()[std::size_t(nearest.element)];
    Vector3 out{};
    for (std::size_t k = 0; k < std::size_t(surface_.dim()); ++k)
        out = plus(out, times(nearest.weights[k], velocities_[std::size_t(element[k])]));
    return out;
}

double DeformableBody::fastest() const
{
    double most = 0;
    for (const auto& v : velocities_)
        most = std::max(most, length(v));
    return most;
}
} // namespace mpm::nodal
