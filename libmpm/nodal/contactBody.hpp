#pragma once
/// What soil touches, as nodal/bodyContact.hpp sees it: a closed surface that moves as somebody says.
///
/// Two there are: RigidBody (pose and twist, nodal/rigidBody.hpp) and DeformableBody (each point for itself).
#include "nodal/rigidSurface.hpp"

#include <vector>

namespace mpm::nodal
{
/// An impulse of the body on the soil, given at a point of the surface.
struct SurfaceImpulse
{
    Index element = 0;
    std::array<double, 3> weights{}; ///< of the element's points
    Vector3 impulse{};               ///< [N s], per metre in 2D
};

class ContactBody
{
  public:
    virtual ~ContactBody() = default;

    /// As it was read (rigid), or as it is now (deformable).
    virtual const RigidSurface& surface() const = 0;
    /// Distance, nearest point and outward normal in space.
    virtual RigidSurface::Nearest nearest(const Vector3& x) const = 0;
    /// The body's velocity where soil at x, with that nearest point, touches it.
    virtual Vector3 velocityAt(const Vector3& x, const RigidSurface::Nearest& nearest) const = 0;
    /// Moments are about it.
    virtual Vector3 position() const = 0;
    /// The largest speed of its surface [m/s].
    virtual double fastest() const = 0;
    /// The box around the body in space.
    const Vector3& low() const { return low_; }
    const Vector3& high() const { return high_; }

    Vector3 force{}, torque{};            ///< of the soil on the body in the last step [N, N m]; per metre in 2D
    bool collects = false;                ///< are the impulses wanted one by one?
    std::vector<SurfaceImpulse> impulses; ///< of the last step, in an order that no thread count changes

  protected:
    Vector3 low_{}, high_{};
};

/// A body whose points move each for itself: between two steps somebody says where they are, and their mean velocities
/// in the coming step. The velocity at a point of the surface is that of its element's points by the weights there, and
/// impulses go back to the points by the same weights, so that sum of impulse . velocity over points is the work done.
/// Verified in tests/unit/participant.cpp.
class DeformableBody : public ContactBody
{
  public:
    /// reference: moments are about it.
    DeformableBody(RigidSurface surface, const Vector3& reference);

    /// False if the surface holds no volume any more.
    bool place(const std::vector<Vector3>& points, const std::vector<Vector3>& velocities);
    const std::vector<Vector3>& velocities() const { return velocities_; }

    const RigidSurface& surface() const override { return surface_; }
    RigidSurface::Nearest nearest(const Vector3& x) const override { return surface_.nearest(x); }
    Vector3 velocityAt(const Vector3& x, const RigidSurface::Nearest& nearest) const override;
    Vector3 position() const override { return reference_; }
    double fastest() const override;

  private:
    RigidSurface surface_;
    Vector3 reference_;
    std::vector<Vector3> velocities_;
};
} // namespace mpm::nodal
