#pragma once
/// Volumetric averaging: the rate of volume change the law sees at a particle is a mean over its neighbourhood,
///     D_p <- D_p + (theta_p - tr D_p) I/d,     theta = A tr D,
/// so that four particles in a cell do not each demand their own incompressible flow (locking, and with it pressures
/// of either sign from particle to particle). F follows the same gradient.
///
///     A = C                       cell: theta_c = sum V_p q_p / sum V_p over the cell, back to its particles
///     A = C^T H^n C               patch: the means of cells are averaged n times more, through the nodes they share:
///                                 q_n = sum V_c q_c / sum V_c over the cells at a node, (H q)_c = 2^-d sum q_n over
///                                 the nodes of a cell. Inside that is a hat over 3^d cells, prod over axes (1 2 1)/4
/// With weights V, A is self-adjoint, 0 <= A <= I, also where the material ends: constants and sum V q are kept. (Hats
/// normalised cell by cell are not self-adjoint at surfaces, where an elastic block then flutters; a box of 3^d cells
/// has negative eigenvalues.)
///
/// of total: q = tr D. of elastic: q = tr D - tr D^p with the plastic part of the last step, which stays where it was
/// made: only what makes pressure is averaged. A flow rule that dilates (psi > 0) makes volume in a shear band; spread
/// over neighbours, the band would be held shut by a pressure that pushes ever harder (energy from nowhere). So a law
/// that dilates needs `of elastic` or `conjugate yes`.
///
/// conjugate no: forces keep the particles' stress. Pressures p = K A theta are smooth then, and A is self-adjoint, so
/// the stiffness B^T V K A B is that of an elastic body whose energy is 1/2 theta : K A : theta. What plastic flow, and
/// cells that particles change, make of the difference between sigma : D and sigma : D_averaged is booked as
/// averagingLoss. Pressures made with the cells of long ago are no longer in the range of A: without a
/// stressRelaxation, which brings them back, energy can grow over thousands of steps.
///
/// conjugate yes: forces take sigma + (A s - s) I, s the mean of the d normal stresses: they do exactly the work the
/// strains say, averagingLoss is 0. The price is noise: stresses that equilibrium asks of A s need not be smooth.
///
/// viscosity: volume change that the average leaves out has no stiffness; it would linger in the velocities and feed
/// the noise of stresses. A pressure -eta (tr D - theta) in the forces, eta = viscosity rho h c_p, takes that motion
/// away and leaves alone what the average sees (the hourglass viscosity of Flanagan & Belytschko 1981, doi
/// 10.1002/nme.1620170504, for the modes of an average). Booked as viscosityLoss. Beside a stressRelaxation that
/// follows flow, eta is multiplied by the same memory a_p of it (stressRelaxation.hpp): elastic waves stay.
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

  private:
    struct Block
    {
        state::NodeBox box;
        std::size_t start = 0;
        std::vector<std::int32_t> around; ///< places of the cells of the box and one cell around it, -1: none
        std::vector<double> perNode;      ///< 1/sum V_c of its (n + 1)^d nodes, 0 where there is nothing
    };
    template <class Work>
    void forEachBlock(Work&& work);
    /// Sums over the 2^d values around each corner between them: n + 1 values an axis become n.
    void addPairs(std::vector<double>& values, std::array<std::size_t, 3> n) const;
    void gather(const Block& block, const std::vector<double>& from, std::vector<double>& cells) const;

    int dim_ = 2;
    std::vector<Block> blocks_;
    std::vector<double> volume_, content_, weighted_;
};
} // namespace mpm::treatment
