#pragma once
/// The scene of the benchmark, made in memory: the collapsing soil column of cases/collapsingSoilColumn (Andersen &
/// Andersen 2009, section 3), 4 m wide and 8 m high, and in 3D 4 m deep; free on all sides, friction at the base.
///
///     2D   n x 2n particles, 2 x 2 a cell            3D   n x 2n x n particles, 2 x 2 x 2 a cell
///     h = 8 m/n, Mohr-Coulomb (20 MPa, 0.42, 1 kPa, 42 deg, 0), K0 stress, g = 9.8 m/s^2, mu = 0.6
///     dt = 0.847 h/c_p: the case's Courant number (USL: 0.9 of its stability limit if that is less)
///
/// A column of up to some ten thousand particles runs to 0.5 s, in the middle of the collapse, where most particles
/// yield. Larger ones are refined from it: each particle gives way to 2 x 2 (2 x 2 x 2) children at x_p +- F l0_k/4
/// with its F, v and sigma and halves of its edges, and the cells are halved. So every size does the same work at the
/// same time of the same collapse, and none costs a long run.
///
/// Verified in tests/unit/benchmarkRows.cpp: counts; mass, volume, momentum and centre are kept to round-off.
#include "stepping/stepper.hpp"

#include <map>
#include <string>

namespace mpm::benchmark
{
inline constexpr double collapseTime = 0.5; ///< [s]

/// How a number of particles is reached: `across` particles over the width at first, each split `refinements` times.
struct ColumnSize
{
    int dim = 2;
    Index across = 30;
    int refinements = 0;

    Index particles() const;
};

/// The size nearest to `wanted` particles whose first column has at most a width of `widest` particles.
ColumnSize columnSize(int dim, Index wanted, Index widest);

/// The column at rest under K0 stress, as seedParticles makes it.
state::State seedColumn(int dim, Index across);

/// Material, gravity, base, scheme; no splitting. law: a word of the catalogue (mohrCoulomb, linearElastic).
stepping::Scene columnScene(const std::string& law, stepping::StressUpdate update);

/// The case's splitting rule.
splitting::Rule columnSplitting();

/// dt [s] for cells of side h [m].
double columnDeltaT(stepping::Stepper& stepper, const state::State& state, const stepping::Scene& scene,
                    bool ignoresMass);

/// Every particle replaced by its 2^dim children, cells halved, clock and ledger at the start of a new run. Children
/// keep above the base by drawing all of them nearer to their common centre.
state::State refine(const state::State& coarse);

/// Columns at 0.5 s, run once for all rows of one process.
class ColumnCache
{
  public:
    /// The refined column at 0.5 s.
    state::State collapsed(const ColumnSize& size);

  private:
    std::map<std::pair<int, Index>, state::State> coarse_; ///< by dimension and `across`
};

/// Share of the particles that lie on the yield surface of their material.
double yieldingShare(const state::State& state, const std::vector<constitutive::Material>& materials);
} // namespace mpm::benchmark
