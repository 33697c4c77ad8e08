#pragma once
/// What a boundary dictionary says, as plain data: walls (wall.hpp has their equations) and loads (traction.hpp).
#include "base/types.hpp"
#include "dictionary/motion.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

namespace mpm::nodal
{
enum class WallType
{
    fixed,
    roller,
    friction
};

struct Wall
{
    std::string name;
    WallType type = WallType::roller;
    int axis = 1;    ///< 0, 1, 2: the axis it is normal to
    int side = -1;   ///< -1: outward normal along -axis (a floor), +1: along +axis
    Index plane = 0; ///< lattice index of the wall's plane of nodes
    double mu = 0;
    bool separation = false;
    double position = 0; ///< of a moving wall at t = 0, along its axis [m]; `plane` then says nothing
    std::shared_ptr<const dictionary::Motion> motion = nullptr; ///< null: it rests
};

class ContactBody;
struct RigidMotion;

/// A body soil touches (bodyContact.hpp).
struct Body
{
    std::string name;
    std::shared_ptr<ContactBody> body;
    double mu = 0;
    bool separation = true;
    std::shared_ptr<const RigidMotion> motion = nullptr; ///< of a rigid one; null: somebody moves it between steps
};

/// A plane that lets waves out (absorbingBoundary.hpp).
struct Absorbing
{
    std::string name;
    int axis = 1;
    int side = -1;
    Index plane = 0;
    double normalRate = 0, shearRate = 0;                         ///< 2 a c_p/h, 2 b c_s/h [1/s]
    std::shared_ptr<const dictionary::Motion> incoming = nullptr; ///< velocity of the wave that comes in; null: none
};

/// How gravity comes on: its factor at time t (gravity.hpp).
struct GravityRamp
{
    double duration = 0; ///< [s]
    bool smooth = false;

    /// Mean factor from t to t + dt.
    double mean(double t, double dt) const
    {
        if (t >= duration)
            return 1;
        const auto sum = [this](double time) { // of the factor, since 0
            const double s = std::clamp(time / duration, 0.0, 1.0), beyond = std::max(0.0, time - duration);
            return beyond + duration * (smooth ? s * s * s * (1 - 0.5 * s) : 0.5 * s * s);
        };
        return dt > 0 ? (sum(t + dt) - sum(t)) / dt : 0;
    }
};

struct Load
{
    std::string patch;
    bool pressure = false;
    Vector3 traction{};   ///< [Pa], if not a pressure
    double magnitude = 0; ///< [Pa], if a pressure
};
} // namespace mpm::nodal
