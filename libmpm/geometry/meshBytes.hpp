#pragma once
/// A mesh, or the reason why there is none, as bytes on the way from the process that runs gmsh to ours.
///
/// Nothing of what arrives is believed: counts fit the bytes that are there, indices are those of points, points are
/// finite. (The process at the other end ran code that a geometry file may have taken over.)
#include "geometry/gmshMesh.hpp"

namespace mpm::geometry
{
std::string meshBytes(const GmshMesh& mesh);

/// The bytes of a refusal; reading them throws it.
std::string refusalBytes(const std::string& message);

/// Throws InputError: the refusal, or bytes that are no mesh of dimension `dim`. `file` for messages.
GmshMesh meshFromBytes(const std::string& bytes, const std::filesystem::path& file, int dim);
} // namespace mpm::geometry
