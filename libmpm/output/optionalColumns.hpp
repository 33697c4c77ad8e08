#pragma once
/// Columns of the particles that not every state has, with their names in state.h5 and their units.
#include "state/particles.hpp"

#include <array>
#include <string>

namespace mpm::output
{
/// Columns of one number a particle that belong to treatments of stress; a file has those in use.
template <class Particles>
auto optionalColumns(Particles& p)
{
    struct Optional
    {
        std::string name, unit;
        bool has;
        decltype((p.tensionGap)) column;
        void (state::Particles::*keep)(bool);
    };
    return std::array{
        Optional{"tensionGap", "1", p.hasTensionGap(), p.tensionGap, &state::Particles::keepTensionGap},
        Optional{"dilationRate", "1/s", p.hasDilationRate(), p.dilationRate, &state::Particles::keepDilationRate},
        Optional{"flowMemory", "1", p.hasFlowMemory(), p.flowMemory, &state::Particles::keepFlowMemory},
        Optional{"viscousStress", "Pa", p.hasViscousStress(), p.viscousStress, &state::Particles::keepViscousStress}};
}
} // namespace mpm::output
