#pragma once
/// What a boundary dictionary says, as plain data: walls (wall.hpp has their equations) and loads (traction.hpp).
#include "base/types.hpp"
#include "dictionary/motion.hpp"

#include <memory>
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

struct Load
{
    std::string patch;
    bool pressure = false;
    Vector3 traction{};   ///< [Pa], if not a pressure
    double magnitude = 0; ///< [Pa], if a pressure
};
} // namespace mpm::nodal
