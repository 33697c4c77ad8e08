#pragma once
/// Particles inside a body that soil is to touch from outside: a scene cannot begin so.
#include "nodal/contactBody.hpp"
#include "state/particles.hpp"

namespace mpm::nodal
{
struct Intruders
{
    Index count = 0;   ///< deeper than a millionth of a cell
    Index deepest = 0; ///< place of the deepest
    double depth = 0;  ///< how deep [m]
};

Intruders particlesInside(const ContactBody& body, const state::Particles& particles, double h);
} // namespace mpm::nodal
