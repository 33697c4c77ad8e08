#pragma once
/// The pose of a rigid body between the times a master said it for: places as in coupling/samples.hpp, rotations along
/// the shortest arc from sample to sample,
///
///     R(t) = exponential(phi(t)) R_k,   phi(t_k) = 0,   phi(t_k+1) = theta = logarithm(R_k+1 R_k^-1)
///
///     constant    phi = 0
///     linear      phi = s theta (K. Shoemake 1985, SIGGRAPH Comput. Graph. 19, 245-254)
///     Hermite     cubic in s with the slopes phi' = dexp^-1(phi) omega of the twists said (order 4), or of the
///     parabola
///                 through the three poses nearest (order 3)
///
/// After the last pose: held, or moved on by twists, where there are any: the place by the integral of the velocity,
/// the rotation by dR/dt = skew(omega) R with steps of order 4 (Magnus; W. Magnus 1954; S. Blanes et al. 2009, Phys.
/// Rep. 470, section 5), exact for an axis that stays.
///
/// Plain data. Errors as in samples.hpp, and CouplingError (badValue) for a quaternion without length, which is
/// normalised otherwise. Verified in tests/unit/samples.cpp.
#include "coupling/rotation.hpp"
#include "coupling/samples.hpp"
#include "nodal/rigidBody.hpp"

namespace mpm::coupling
{
class PoseSamples
{
  public:
    explicit PoseSamples(Interpolation kind = Interpolation::linear) : places_(3, kind), rotations_(4), kind_(kind) {}

    /// x y z qw qx qy qz. Before the first one the body rests where its reference configuration is: pose {}.
    void setPose(double time, std::span<const double> values);
    void setPose(double time, const nodal::Pose& pose);
    /// vx vy vz wx wy wz; between them linear.
    void setTwist(double time, std::span<const double> values);
    /// What was said for later than `time` does not hold any more.
    void dropPosesAfter(double time);
    void dropTwistsAfter(double time);
    void setInterpolation(Interpolation kind);

    bool empty() const { return places_.empty(); }
    nodal::Pose pose(double t) const;
    /// Takes pose(t0) to pose(t1) exactly.
    nodal::Twist meanTwist(double t0, double t1) const;
    void forget(double time);

    void serialise(std::vector<std::byte>& out) const;
    static PoseSamples deserialise(std::span<const std::byte>& bytes);

    bool operator==(const PoseSamples&) const = default;

  private:
    Quaternion sample(std::size_t k) const;
    Vector3 omega(double t) const;
    Vector3 slope(std::size_t k) const;
    Quaternion rotation(double t) const;
    Quaternion movedOn(double t) const;

    Samples places_, rotations_;        ///< of the same times
    Samples velocities_{3}, omegas_{3}; ///< of the same times
    Interpolation kind_;
};

/// The velocities of one step that takes `from` to `to`: R_to = exponential(dt angularVelocity) R_from.
nodal::Twist twistBetween(const nodal::Pose& from, const nodal::Pose& to, double dt);
} // namespace mpm::coupling
