#pragma once
/// The boxes particles are cut from: every cell of the grid in n boxes an axis.
///
///     particlesPerCell 2;     // n, along each axis
///     arrangement lattice;    // all boxes alike, planes on those of the grid
///     arrangement jittered;   // planes inside the grid moved by up to jitter box sides either way
///     jitter 0.2;             // [-], below 0.5; the boxes still tile the grid
///     randomSeed 1;
///
/// Jittered boxes: z planes move as a whole, y planes layer by layer, x planes row by row. The shift of a plane is a
/// hash of (randomSeed, axis, plane, row, layer), in integer arithmetic, so that every platform makes the same boxes.
#include "geometry/region.hpp"
#include "state/gridBox.hpp"

namespace mpm::seeding
{
struct LatticeOptions
{
    Index perCell = 2;
    bool jittered = false;
    double jitter = 0.2; ///< in box sides
    Index randomSeed = 1;
};

class BoxLattice : public geometry::BoxTiling
{
  public:
    BoxLattice(const state::GridBox& grid, const LatticeOptions& options);

    const state::GridBox& grid() const { return grid_; }
    bool jittered() const { return options_.jittered; }
    double spacing() const { return grid_.h / double(options_.perCell); } ///< side of an unmoved box [m]

    /// Fits the planes to a region: corners within round-off of a plane take it with them, so that a side drawn on a
    /// plane cuts no dust off the boxes there. Throws InputError with the region's name, the place and the box that is
    /// needed if the region leaves the grid.
    void fit(const geometry::Region& region);

    std::vector<double> zPlanes() const override;
    std::vector<double> yPlanes(Index layer) const override;
    void xPlanes(Index row, Index layer, std::vector<double>& planes) const override;

  private:
    void requireInside(const geometry::Region& region) const;
    double plane(int axis, Index index, Index row, Index layer) const;
    std::vector<double> planes(int axis, Index row, Index layer) const;

    state::GridBox grid_;
    LatticeOptions options_;
    std::array<Index, 3> boxes_{};
    std::array<std::vector<double>, 3> regular_; ///< planes before jitter, fitted
};
} // namespace mpm::seeding
