#pragma once
/// Overburden: the vertical stress that the weight of the material above would cause if it were carried straight down,
///     sigma_o(y) = - g M(y) / w
/// the yardstick for stress fields of a body at rest (exact for a level layer, good away from steep slopes).
///
/// Definition. The horizontal plane is divided into columns of the grid's cell width w (squares in 3D), with nodes on
/// their edges. Every deformed domain x_p +- F l0/2 is cut into equal parts along its edges, fine enough that a part is
/// at most w/8 wide, and each part goes to the column that holds its centre: particle q has the mass m_qc in column c,
/// spread evenly over the heights its parts there reach. M_c(y) is the mass above y in column c. At a particle,
/// sigma_o is the mean over its columns weighted by m_pc, at the height of its centre (half of its own mass counts, so
/// a level layer of lattice particles has sigma_o = - rho g d exactly). At a point it is taken from the column that
/// holds it, on an edge as the mean of the columns beside it that hold material.
///
/// Gravity must point along one axis; "above" is against it. Verified in tests/unit/smoothing.cpp.
///
/// Time grows with particles times the logarithm of how many stand in a column: heights are found by bisection, the
/// mass above comes from sums made once. Memory: about 70 bytes a particle.
#include "state/state.hpp"

#include <map>

namespace mpm::smoothing
{
class Overburden
{
  public:
    /// gravity [m/s^2]. Throws InputError unless it points along one axis and the state has a grid.
    Overburden(const state::State& state, const Vector3& gravity);

    /// Is there an overburden: gravity along one axis?
    static bool defined(const Vector3& gravity, int dim);

    int axis() const { return up_; }  ///< the vertical axis, also the stress component that overburden stands for
    double atParticle(Index p) const; ///< [Pa], negative under load
    double atPoint(const Vector3& x) const;

  private:
    using Cell = std::array<Index, 2>;
    struct Share
    {
        double bottom, top; ///< heights along the vertical, growing upwards [m]
        double mass;        ///< [kg]
    };

    void makeShares(const state::State& state, Index p);
    void addPart(const Cell& cell, double height, double thickness, double mass);
    std::int32_t columnOf(const Cell& cell);
    void sortShares(const state::State& state);
    double massAbove(std::int32_t column, double height) const;
    double stress(double massAbove) const;

    int dim_ = 2, up_ = 1;
    double sign_ = 1, g_ = 0, width_ = 0, area_ = 0;
    Vector3 origin_{};
    std::map<Cell, std::int32_t> columns_;
    std::map<Cell, std::int32_t>::const_iterator lastColumn_;

    // By column: its shares from the highest top down, and the mass of those before each.
    std::vector<std::size_t> columnBegin_;
    std::vector<Share> shares_;
    std::vector<double> massBefore_;
    std::vector<double> thickest_;

    // By particle: columns it has a share in, in the order of cells, and its mass there.
    std::vector<std::size_t> ownBegin_{0};
    std::vector<std::int32_t> ownColumn_;
    std::vector<double> ownMass_;
    std::vector<double> height_; ///< of particle centres

    std::vector<std::pair<Cell, Share>> made_; ///< shares of one particle
};
} // namespace mpm::smoothing
