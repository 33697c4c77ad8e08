#pragma once
/// A 3D region: closed triangle surfaces, nested ones bounding cavities. The only place where CGAL's 3D algorithms are
/// used.
///
/// Triangles may face either way; they are turned so that their normals point out of the region.
/// Errors (InputError, with the region's name and the place): a degenerate triangle, an open surface, a surface that
/// cuts or touches itself.
#include "geometry/region.hpp"
#include "geometry/simplex.hpp"

#include <memory>

namespace mpm::geometry
{
class Region3D : public Region
{
  public:
    Region3D(std::string name, const std::vector<Vector3>& points, const std::vector<Simplex>& triangles);
    ~Region3D() override;

    bool contains(const Vector3& p) const override;
    const std::vector<Vector3>& vertices() const override;
    void forEachRow(const BoxTiling& tiling, const Row& visit) const override;

    /// The triangles as given, turned outward.
    const std::vector<Simplex>& triangles() const;

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};

/// Triangles, by index, that cut or touch another one away from what they share, or have no area: decided exactly.
/// Empty for a surface Region3D takes; for surfaces made here, to mend them. The triangles close a surface, facing
/// alike.
std::vector<std::size_t> cuttingTriangles(const std::vector<Vector3>& points, const std::vector<Simplex>& triangles);
} // namespace mpm::geometry
