#pragma once
/// A plane geometry loses its z. Throws InputError, naming file and place, unless z is constant to 1e-9 of its size.
#include "geometry/gmshMesh.hpp"

namespace mpm::geometry
{
void flatten(GmshMesh& mesh);
} // namespace mpm::geometry
