#pragma once
/// SemiDiscrete for one dimension and one shape. One evaluation: particles to windows (m, p, f), nodes (v_i, a_i),
/// nodes to particles (x', v', F', sigma'). Definitions in equations.ipp.
#include "constitutive/kinematics.hpp"
#include "nodal/nodeRow.hpp"
#include "semiDiscrete/semiDiscrete.hpp"
#include "transfer/affine.hpp"
#include "transfer/chunkColumns.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/particleToGrid.hpp"

namespace mpm::semiDiscrete
{
template <int dim, class Shape>
class Equations : public SemiDiscrete
{
  public:
    Equations(const state::State& state, Model model);
    void arrange(const state::State& state) override;
    std::size_t size() const override { return std::size_t(count_) * std::size_t(columns()); }
    void pack(const state::State& state, std::vector<double>& y) const override;
    Summary unpack(const double* y, state::State& state) const override;
    void rates(double t, const double* y, double* rate, Powers* powers) override;
    bool strayed() const override { return strayed_; }
    int keyNodes() const override { return Narrow::nodes; }
    long evaluations() const override { return evaluations_; }

  private:
    using Narrow = typename Shape::Narrow;
    using Vectors = double[dim][lanes];
    // columns of y
    static constexpr int ofX = 0, ofV = dim, ofF = 2 * dim, ofStress = 2 * dim + dim * dim;
    int columns() const { return ofStress + (hasStress_ ? stressSize<dim> : 0); }

    /// What a law needs of its material, by Particles::material.
    struct Modulus
    {
        const constitutive::Hyperelastic* hyperelastic; ///< null: the rate law
        double lame, twoG, halfOverBulk, quarterOverShear;
    };

    /// One thread's chunk of particles and node windows.
    struct Workspace
    {
        AlignedVector<typename transfer::ValueNode<dim>::Type> values;
        AlignedVector<typename transfer::GradientNode<dim, 1>::Type> gradients;
        alignas(64) Vectors x, v, half;
        alignas(64) double mass[lanes], volume[lanes], J[lanes];
        alignas(64) double stress[stressSize<dim>][lanes], stressRate[stressSize<dim>][lanes];
        alignas(64) constitutive::TensorLanes<dim> L, F, FRate;
        alignas(64) double b[3][lanes];
        transfer::Values<dim> value;
        transfer::ChunkWeights<dim, Shape> wide;
        transfer::ChunkWeights<dim, Narrow> narrow;
        transfer::ParticleRecords<dim, transfer::Forces> forces;
    };
    /// Sums over one tile or block, added in their order.
    struct Sums
    {
        Powers powers;
        bool stray = false;
        Index bad = -1;
    };

    void buildTiles();
    void sortAnew(const double* y);
    void project(double t, const double* y);
    void projectTile(Workspace& ws, const state::Tile& tile, double t, const double* y, Sums& sums);
    void solveNodes(Powers* powers);
    void solveRow(const state::Block& block, Index j, Index k, Sums& sums);
    void gather(double t, const double* y, double* rate, Powers* powers);
    void gatherTile(Workspace& ws, const state::Tile& tile, double t, const double* y, double* rate, Powers* powers);
    void stressRates(Workspace& ws, Index first, int count, Powers* powers) const;

    void loadChunk(Workspace& ws, Index first, int count, const double* y) const;
    void stressOf(const state::Particles& p, Index first, int count, const constitutive::TensorLanes<dim>& F,
                  double (&stress)[stressSize<dim>][lanes]) const;
    Index domains(const state::Particles& p, Index first, int count, const constitutive::TensorLanes<dim>& F,
                  Vectors& half) const;
    void unpackChunk(const double* y, state::Particles& p, Index first, int count, Summary& sums, Index& bad) const;
    static double energyDensity(const Modulus& modulus, const double (&sigma)[6]);
    template <class Visit>
    void forHyperelastic(const state::Particles& p, Index first, int count, Visit&& visit) const;
    template <class Body>
    void withWeights(Workspace& ws, Body&& body) const;
    double inBox(int axis, double x) const;
    void load(const double* y, int column, Index first, int count, double (&out)[lanes]) const;
    void store(double* y, int column, Index first, int count, const double (&in)[lanes]) const;
    [[noreturn]] void failOutside() const;
    [[noreturn]] void failBad(const state::Particles& p, Index particle) const;
    template <class Body>
    void forEachTile(Body&& body);

    Model model_;
    state::GridBox box_;
    transfer::WallPlanes wallPlanes_;
    std::vector<Modulus> moduli_;
    bool hasStress_ = false;       ///< is there a rate law?
    bool hasHyperelastic_ = false; ///< is there a law of F?

    state::TileLayout layout_;
    state::TileGrid grid_;
    state::Particles particles_; ///< in the order of tiles, x those of the last evaluation
    std::vector<Index> slot_;    ///< place in y of each of them; empty: the same order
    Index count_ = 0;
    double smallestMass_ = 0;
    std::vector<Sums> sums_;
    std::vector<std::unique_ptr<Workspace>> workspaces_;
    bool strayed_ = false;
    long evaluations_ = 0;
};
} // namespace mpm::semiDiscrete
