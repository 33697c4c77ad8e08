#pragma once
/// A prescribed motion: how far something has gone at time t and how fast it goes.
///
///     motion
///     {
///         velocity     (0.1 0 0);     // [m/s]   one of the three, in any form of dictionary/timeFunction.hpp
///         displacement ("0.01*sin(2*pi*t)" 0 0);  // [m]
///         acceleration { file "constant/quake.csv"; direction (1 0 0); scale 9.81; }  // [m/s^2], at rest before t = 0
///         constants    { f 2; }       // for formulas
///     }
///
/// Displacements count from t = 0: where a displacement is given, its value there is taken off. Beyond its ends a table
/// of displacements or velocities holds its last value, one of accelerations is zero. A step from t to t + dt moves
/// with meanVelocity, which takes it to where displacement() says. Verified in tests/unit/timeFunction.cpp.
#include "dictionary/timeFunction.hpp"

namespace mpm::dictionary
{
class Motion
{
  public:
    enum class Given
    {
        displacement,
        velocity,
        acceleration
    };
    Motion(Given given, TimeFunction f);
    /// Of a dictionary `motion`, which may hold other words too.
    static Motion read(const Dictionary& d, int dim);

    Vector3 displacement(double t) const;            ///< [m], zero at t = 0
    Vector3 velocity(double t) const;                ///< [m/s]
    Vector3 meanVelocity(double t, double dt) const; ///< (displacement(t + dt) - displacement(t))/dt [m/s]
    bool stillAlong(std::size_t axis) const;         ///< is it known to rest for ever?
    bool still() const { return stillAlong(0) && stillAlong(1) && stillAlong(2); }
    std::string describe() const; ///< "velocity (0.1 0 0) m/s"

  private:
    Given given_;
    TimeFunction f_;
    Vector3 start_{}; ///< displacement given for t = 0
};

/// The angle of a rotation about a fixed axis: `angle` [rad], `angularVelocity` [rad/s] or `angularAcceleration`.
Motion readAngle(const Dictionary& d);
} // namespace mpm::dictionary
