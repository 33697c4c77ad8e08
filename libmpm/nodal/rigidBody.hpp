#pragma once
/// A rigid body that soil touches: a surface, where it is, how it moves, and what the soil does to it.
///
///     x = position + R (X - reference),   V(x) = velocity + angularVelocity x (x - position)
///
/// X: points of the surface as it was read; reference: the point of the body that `position` follows (default: the
/// centroid). Who drives the body (a prescribed motion, or another program between two steps) gives pose and twist with
/// move(); force and torque about `position`, of the soil on the body in the last step, stand here afterwards.
/// Verified in tests/unit/rigidBodies.cpp.
#include "dictionary/motion.hpp"
#include "nodal/contactBody.hpp"

#include <memory>
#include <optional>
#include <string>

namespace mpm::nodal
{
struct Pose
{
    Vector3 position{};                                        ///< of the reference point [m]
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1}; ///< R, row by row
};

struct Twist
{
    Vector3 velocity{};        ///< of the reference point [m/s]
    Vector3 angularVelocity{}; ///< [rad/s]
};

/// Translation, and rotation about an axis through a point that goes along.
///
///     motion
///     {
///         velocity (0.1 0 0);             // dictionary/motion.hpp; may be absent beside a rotation
///         rotation
///         {
///             centre          (0 0 0);    // default: the body's centroid
///             axis            (0 0 1);    // 3D; in 2D z
///             angularVelocity 0.5;        // [rad/s], or angle [rad], or angularAcceleration: number, formula, table,
///             file
///         }
///     }
struct RigidMotion
{
    std::optional<dictionary::Motion> translation, angle;
    Vector3 axis{0, 0, 1}; ///< unit
    Vector3 centre{};      ///< at t = 0: the reference point

    Pose pose(double time) const;
    /// Mean of the step, so that the body goes as far as its pose says.
    Twist meanTwist(double time, double dt) const;
    std::string describe() const;
    /// Of a dictionary `motion`.
    static RigidMotion read(const dictionary::Dictionary& d, int dim, const Vector3& centroid);
};

class RigidBody : public ContactBody
{
  public:
    RigidBody(std::shared_ptr<const RigidSurface> surface, const Vector3& reference)
        : surface_(std::move(surface)), reference_(reference)
    {
        pose_.position = reference;
        move(pose_, twist_);
    }

    const RigidSurface& surface() const override { return *surface_; }
    const Vector3& reference() const { return reference_; }
    const Pose& pose() const { return pose_; }
    const Twist& twist() const { return twist_; }
    void move(const Pose& pose, const Twist& twist);

    Vector3 toSpace(const Vector3& X) const;
    Vector3 velocityAt(const Vector3& x) const;
    Vector3 velocityAt(const Vector3& x, const RigidSurface::Nearest&) const override { return velocityAt(x); }
    RigidSurface::Nearest nearest(const Vector3& x) const override;
    Vector3 position() const override { return pose_.position; }
    double fastest() const override;

  private:
    std::shared_ptr<const RigidSurface> surface_;
    Vector3 reference_;
    Pose pose_;
    Twist twist_;
};
} // namespace mpm::nodal
