#pragma once
/// The group /visualisation of state.h5: what ParaView draws, ready to use, in float32/int32.
///
/// points (N, 3): centres, with z = 0 in 2D. corners: the deformed domain of each particle,
/// x +- F l0_1 / 2 +- F l0_2 / 2 (+- F l0_3 / 2), in VTK's order of a quadrilateral (4 a particle) or a hexahedron (8).
/// Stress and derived fields stand there column by column (sigma_yy, smoothedStress_yy): of ParaView's two XDMF
/// readers only the older one can cut a column out of (N, k) by itself.
#include "output/hdf5File.hpp"
#include "state/particles.hpp"

namespace mpm::output
{
/// Corner offsets in units of half edges: (-,-) (+,-) (+,+) (-,+), in 3D first at the lower, then at the upper face.
inline constexpr std::array<std::array<int, 3>, 8> cornerSigns = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// "sigma_xx", ...
std::string stressComponentName(int component);
/// "smoothedStress_xx", ...; the field's own name if it has one column.
std::vector<std::string> derivedComponentNames(const std::string& field, const std::vector<std::string>& components);

void writeVisualisation(Hdf5File& file, const state::Particles& particles);
} // namespace mpm::output
