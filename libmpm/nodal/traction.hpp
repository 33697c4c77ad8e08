#pragma once
/// Surface load on a named boundary, the tau term of METHOD Eq. 3: f_i += int N_i tau dS, one point per surface element
/// at its centre, hat functions N_i. Elements are carried with the material: centre by v*, edges by its gradient, so
/// that the loaded area follows the deformation.
///
///     top { type traction; value (0 -1e3 0); }   // constant/boundaryConditions, Pa of current area, any direction
///     top { type pressure; value 1e3; }          // Pa, along the inward normal of the deformed element
///
/// Where bodies are in contact (contact.hpp), nodes are those of the body that the patch lies on.
///
/// Where a hat reaches a node without mass (linear shape near a surface), the element's weights are renormalised over
/// the nodes that carry mass, so no load is lost; an element with no such node is a StepError. Verified in
/// tests/unit/walls.cpp.
#include "nodal/boundaries.hpp"
#include "state/gridBox.hpp"
#include "state/state.hpp"
#include "state/tileGrid.hpp"

namespace mpm::nodal
{
template <int dim>
class Traction
{
  public:
    /// body: whose nodes carry the load (state/tileGrid.hpp).
    explicit Traction(const Load& load, int body = 0) : load_(load), body_(body) {}

    /// Adds the load to the force lanes of the nodes (mass lanes summed, smallestMass as in NodeRow).
    void scatter(const state::SurfacePatch& patch, const state::GridBox& grid, state::TileGrid& nodes,
                 double smallestMass);
    /// After the nodal equations (lanes v*, a): adds the work sum dt f . (v_i + v*)/2 [J] and the impulse [N s] of the
    /// load; returns sum dt f . v_i and sum dt f . v*.
    std::pair<double, double> book(double dt, double& work, Vector3& impulse) const;
    const Load& load() const { return load_; }
    int body() const { return body_; }

  private:
    struct Added
    {
        Record* node;
        Vector3 force;
    };
    Load load_;
    int body_;
    std::vector<Added> added_;
};

/// The body a surface lies on: that of the particle closest to most of its points. Ties go to the body named first.
int bodyUnder(const std::vector<Vector3>& points, const state::Particles& particles, const state::TileLayout& layout);

/// Moves a patch by the velocities v* in the lanes 1..dim of a body's nodes.
template <int dim>
void movePatch(state::SurfacePatch& patch, const state::GridBox& grid, const state::TileGrid& nodes, int body,
               double smallestMass, double dt);

extern template class Traction<2>;
extern template class Traction<3>;
extern template void movePatch<2>(state::SurfacePatch&, const state::GridBox&, const state::TileGrid&, int, double,
                                  double);
extern template void movePatch<3>(state::SurfacePatch&, const state::GridBox&, const state::TileGrid&, int, double,
                                  double);
} // namespace mpm::nodal
