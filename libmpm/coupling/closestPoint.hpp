#pragma once
/// The point of a surface that is closest to a point in space, with the weights of its element's vertices.
/// (C. Ericson, Real-Time Collision Detection (2005), 5.1.5; the tree: coupling/boxTree.hpp.) The surface need not be
/// closed. Verified in tests/unit/surfaceMesh.cpp.
#include "coupling/boxTree.hpp"
#include "coupling/surfaceMesh.hpp"

namespace mpm::coupling
{
struct Foot
{
    Index element = -1;
    Vector3 weights{}; ///< of its vertices; not negative, they add up to one
    Vector3 point{};
    double distance = 0; ///< not negative [m]
};

/// Of one element.
Foot footPoint(const SurfaceMesh& mesh, Index element, const Vector3& x);

class ClosestPoint
{
  public:
    explicit ClosestPoint(SurfaceMesh mesh);
    /// Of elements as close, the first.
    Foot operator()(const Vector3& x) const;

  private:
    SurfaceMesh mesh_;
    BoxTree tree_;
};
} // namespace mpm::coupling
