#pragma once
// The scene whose instructions are counted: an elastic block without gravity that vibrates freely, nothing else.
#include "constitutive/law.hpp"
#include "support/scenes.hpp"

#include <cstdlib>

namespace counted
{
using namespace mpm;

/// 40 x 50 particles, two a cell along each axis, off the nodes.
inline state::State block()
{
    state::State s =
        scenes::seedBlock({.corner = {3.1, 3.3, 0}, .n = {40, 50, 1}, .spacing = 0.5, .h = 1, .cells = {27, 32, 1}});
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.v[0][i] = std::sin(0.3 * p.x[1][i]);
        p.v[1][i] = std::cos(0.2 * p.x[0][i]);
    }
    p.padLastChunk();
    return s;
}

/// The law comes from the catalogue, by its word in a dictionary.
inline stepping::Scene scene(const char* material)
{
    stepping::Scene out;
    out.materials = {{"solid", 1000, constitutive::makeLaw(dictionary::Dictionary::readFile(material))}};
    return out;
}

/// Program STEPS MATERIAL: so many steps of dt = 0.3 h/c_p.
template <class Make>
int steps(int argc, char** argv, Make&& make)
{
    if (argc != 3)
        return 1;
    state::State s = block();
    const stepping::Scene elastic = scene(argv[2]);
    const auto stepper = make(s, elastic);
    const double dt = 0.3 * s.grid.h / elastic.materials.front().waveSpeed();
    for (int n = std::atoi(argv[1]); n > 0; --n)
        stepper->step(dt);
    return stepper->report().strainEnergy > 0 ? 0 : 2;
}
} // namespace counted
