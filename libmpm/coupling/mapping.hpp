#pragma once
/// Values at the vertices of one surface mesh from those of another.
///
/// Consistent (intensive fields: displacement, velocity, traction, stress): u_i = sum_j W_ij u_j with rows that add up
/// to one: a constant stays what it is. Conservative (extensive fields: force): f_j = sum_i W_ij f_i, the exact
/// transpose of the consistent mapping the other way, so that sums are kept and work is: sum f_j . u_j = sum f_i . u_i
/// to round-off.
///
///     nearestNeighbour    W_ij = 1 for the vertex j nearest to i (the first of several)
///     nearestProjection   j: vertices of the element nearest to i, W_ij: weights of the foot point; linear fields are
///                         mapped exactly where a vertex lies on the other surface
///
/// (H.-J. Bungartz et al. 2016, preCICE, Comput. Fluids 141, section 4; C. Farhat, M. Lesoinne & P. Le Tallec 1998,
/// Comput. Methods Appl. Mech. Eng. 157, for the transpose.) Verified in tests/unit/mapping.cpp.
#include "coupling/surfaceMesh.hpp"

#include <span>
#include <vector>

namespace mpm::coupling
{
enum class MappingMethod
{
    nearestNeighbour,
    nearestProjection
};

class Mapping
{
  public:
    /// Values known on `from` are wanted on `to`. CouplingError (badSurface) for a mesh without vertices, or without
    /// elements where they are projected on.
    Mapping(const SurfaceMesh& from, const SurfaceMesh& to, MappingMethod method);

    /// `components` values a vertex, vertex by vertex; out.size() = components * to.vertices.
    void consistent(std::span<const double> in, int components, std::span<double> out) const;
    /// The transpose: from values on `to` (in) to values on `from` (out); sums of every component are kept.
    void conservative(std::span<const double> in, int components, std::span<double> out) const;
    /// How far the vertices of `to` lie from `from`, at most [m].
    double largestDistance() const { return distance_; }

  private:
    struct Weight
    {
        Index row, column;
        double value;
    };
    std::vector<Weight> weights_; ///< by row
    Index rows_ = 0, columns_ = 0;
    double distance_ = 0;
};
} // namespace mpm::coupling
