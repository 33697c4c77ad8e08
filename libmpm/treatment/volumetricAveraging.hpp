#pragma once
/// Volumetric averaging: the rate of volume change the law sees at a particle is a mean over its neighbourhood,
///     D_p <- D_p + (theta_p - tr D_p) I/d,     theta = A tr D,
/// so that four particles in a cell do not each demand their own incompressible flow (locking, and with it pressures
/// of either sign from particle to particle). F follows the same gradient.
///
///     A = C                       cell: theta_c = sum V_p q_p / sum V_p over the cell, back to its particles
///     A = C^T H^n C               patch: the means of cells are averaged n times more over the 3^d cells around,
///                                 (H q)_c = sum w_cd V_d q_d / sum w_cd V_d, w = prod over axes (2 - |c - d|)
/// Hat weights have a spectrum without negative values; a plain box of 3^d cells is unstable.
///
/// of total: q = tr D. of elastic: q = tr D - tr D^p with the plastic part of the last step, which stays where it was
/// made: only what makes pressure is averaged. A flow rule that dilates (psi > 0) makes volume in a shear band; spread
/// over neighbours, the band would be held shut by a pressure that pushes ever harder (energy from nowhere). So a law
/// that dilates needs `of elastic` or `conjugate yes`.
///
/// conjugate no: forces keep the particles' stress. Pressures p = K A theta are smooth then, and A is symmetric, so the
/// stiffness B^T V K A B is that of an elastic body whose energy is 1/2 theta : K A : theta; what plastic flow makes of
/// the difference between sigma : D and sigma : D_averaged is booked as averagingLoss.
/// conjugate yes: forces take sigma + (A* s - s) I, s the mean of the d normal stresses, A* the adjoint of A with weights
/// V: they do exactly the work the strains say, averagingLoss is 0. The price is noise: stresses that equilibrium asks of
/// A* s need not be smooth.
///
/// viscosity: volume change that the average leaves out has no stiffness; it would linger in the velocities and feed the
/// noise of stresses. A pressure -eta (tr D - theta) in the forces, eta = viscosity rho h c_p, takes that motion away and
/// leaves alone what the average sees (the hourglass viscosity of Flanagan & Belytschko 1981, doi
/// 10.1002/nme.1620170504, for the modes of an average). Booked as viscosityLoss.
///
/// Sources: mean dilatation of Nagtegaal, Parks & Rice 1974 (doi 10.1016/0045-7825(74)90032-2) and Hughes 1980 (doi
/// 10.1002/nme.1620150914); cell averages in MPM: Mast, Mackenzie-Helnwein, Arduino, Miller & Shin 2012 (doi
/// 10.1016/j.jcp.2012.04.032). Repeated hats,
/// averaging the elastic part and the viscosity are ours.
///
///     volumetricAveraging          // in stressTreatment of system/mpmSchemes; absent: none
///     {
///         region     patch;        // cell | patch
///         repeats    2;            // patch: n
///         of         total;        // total | elastic
///         conjugate  no;
///         viscosity  0;            // [-] of rho h c_p, at most 0.5
///     }
///
/// Cost: one pass over the particles and sweeps over cells a step. Verified in tests/unit/volumetricAveraging.cpp.
#include "state/tileGrid.hpp"

#include <cstdint>
#include <vector>

namespace mpm::treatment
{
enum class AveragingRegion
{
    cell,
    patch
};
enum class AveragedPart
{
    total,
    elastic
};

struct VolumetricAveraging
{
    AveragingRegion region = AveragingRegion::patch;
    int repeats = 2;
    AveragedPart of = AveragedPart::total;
    bool conjugate = false;
    double viscosity = 0;

    int hats() const { return region == AveragingRegion::cell ? 0 : repeats; }
};

/// Means over cells and their neighbours. A cell bears the name of its lowest node; arrays are ordered as the nodes of
/// the grid's blocks. Sums run in a fixed order, so threads do not matter.
class CellAverage
{
  public:
    /// For the blocks as they are now.
    void build(const state::TileGrid& grid);

    /// To be filled with sum V_p and sum V_p q_p of each cell.
    std::vector<double>& volume() { return volume_; }
    std::vector<double>& content() { return content_; }

    /// content <- H^n of the cells' means; 0 where there is nothing.
    void average(int hats);
    /// content <- (H*)^n of the cells' means: sum V_c a_c (H b)_c = sum V_c (H* a)_c b_c.
    void averageAdjoint(int hats);

  private:
    void takeMeans();
    void weighHats();
    /// out_c = sum_d w_cd in_d over the 3^d cells around c.
    void addHats(const std::vector<double>& in, std::vector<double>& out) const;

    struct Block
    {
        state::NodeBox box;
        std::size_t start = 0;
        std::vector<std::int32_t> around; ///< places of the cells of the box and one cell around it, -1: none
    };
    int dim_ = 2;
    std::vector<Block> blocks_;
    std::vector<double> volume_, content_;
    std::vector<double> perHat_; ///< 1/sum w_cd V_d, 0 where there is nothing
    std::vector<double> weighted_;
};
} // namespace mpm::treatment
