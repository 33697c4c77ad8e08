#pragma once
/// A surface that the soil carries along: its points move with v*, and may load the soil.
///
///     x <- x + dt v(x),  v(x) = sum_i N_i(x) v*_i,        f_i += sum_points N_i(x) F
///
/// N: hat functions, renormalised over nodes with mass (nodal/pointWeights.hpp). A point that the soil has left goes on
/// at its last velocity; one that carries a load there is a StepError. Somebody sets the forces between two steps.
/// Verified in tests/unit/participant.cpp.
#include "state/gridBox.hpp"
#include "state/tileGrid.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mpm::nodal
{
struct CarriedSurface
{
    std::string name;
    std::vector<Vector3> points, velocities; ///< [m], [m/s] of the last step
    std::vector<Vector3> forces;             ///< on the soil [N], per metre in 2D; empty: no load
    double work = 0;                         ///< of the forces in the last step [J]
    Vector3 impulse{};                       ///< the same [N s]
};

/// Its part in the steps of a stepper.
template <int dim>
class SurfaceCarrier
{
  public:
    SurfaceCarrier(CarriedSurface& surface, int body) : surface_(&surface), body_(body) {}

    bool loads() const { return !surface_->forces.empty(); }
    /// Adds the forces to the force lanes of the nodes (mass lanes summed).
    void scatter(const state::GridBox& grid, state::TileGrid& nodes, double smallestMass);
    /// After the nodal equations (lanes v*, a): the work sum dt F . (v_i + v*)/2 and the impulse, added to the ledger's
    /// entries; returns sum dt F . v_i and sum dt F . v*.
    std::pair<double, double> book(double dt, double& work, Vector3& impulse) const;
    void move(const state::GridBox& grid, const state::TileGrid& nodes, double smallestMass, double dt);

  private:
    struct Added
    {
        Record* node;
        Vector3 force;
    };
    CarriedSurface* surface_;
    int body_;
    std::vector<Added> added_;
};

extern template class SurfaceCarrier<2>;
extern template class SurfaceCarrier<3>;
} // namespace mpm::nodal
