#pragma once
/// The step for one dimension and one shape. See stepper.hpp for the method; the functions below are its passes, in the
/// order they run.
#include "nodal/gravity.hpp"
#include "nodal/traction.hpp"
#include "nodal/wall.hpp"
#include "stepping/sortParticles.hpp"
#include "stepping/stepper.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/particleToGrid.hpp"

namespace mpm::stepping
{
template <int dim, class Shape>
class ExplicitStepper : public Stepper
{
  public:
    ExplicitStepper(state::State& state, const Scene& scene);
    void step(double dt) override;
    const StepReport& report() const override { return report_; }
    const PassTimes& times() const override { return times_; }
    double smallestNodalMassFraction() override;
    double largestSpeed() const override;

  private:
    using Weights = transfer::ChunkWeights<dim, Shape>;

    /// Sums over one slab; added in slab order.
    struct SlabSums
    {
        double kinetic = 0, plasticWork = 0, apexVolume = 0, bodyForceWork = 0, bodyForceEnd = 0;
        double strainWork = 0; ///< sum V sigma : D dt with stress and volume before the update
        double smallestJacobian = 1, maxYield = 0;
        Index apexReturns = 0, cappedDomains = 0;
        Index badParticle = -1; ///< index of a particle that cannot go on
    };

    struct Half
    {
        bool strain = false;    ///< take velocity gradients from lanes `gradientLane` and update F and stress
        bool velocity = false;  ///< v += dt a
        bool position = false;  ///< x += dt v*
        bool reproject = false; ///< add m v of the updated particles to the slab's window
        int gradientLane = 1;   ///< 1: v*, 1 + dim: w
    };

    // passes
    void arrange();
    void cutSlabs();
    void coverParticles();
    template <bool forces>
    void particleToGrid();
    void solveNodes(double dt);
    void strainVelocities(double dt, bool secondProjection);
    void gridToParticle(double dt, const Half& half);
    void moveSurfaces(double dt);
    void bookParticles(double dt, const Half& half);

    // chunk work
    void gatherInto(const Half& half, const Weights& w, int count, transfer::Gathered<dim>& g) const;
    void advanceVelocity(Index first, int count, double dt, const transfer::Gathered<dim>& g, SlabSums& sums);
    void updateStress(Index first, int count, double dt, int lane, const transfer::Gathered<dim>& g, SlabSums& sums);
    void callLaws(Index first, constitutive::Chunk<dim>& chunk) const;
    void domainsOfChunk(Index first, SlabSums& sums);

    void applyWalls(nodal::NodeRow<dim>& row) const;
    template <class Body>
    void forEachRow(Body&& body);
    [[noreturn]] void fail(Index particle, const std::string& what) const;

    state::State& state_;
    const Scene scene_;
    std::vector<std::unique_ptr<nodal::NodeEffect<dim>>> effects_;
    std::vector<nodal::WallEffect<dim>> walls_;
    std::vector<nodal::Traction<dim>> tractions_;
    std::vector<std::size_t> tractionPatch_;
    std::vector<splitting::Barrier> barriers_;

    transfer::DomainColumns lambda_;
    state::NodeGrid grid_;
    std::vector<Index> slabBegin_; ///< first particle of each slab, and the end
    std::vector<SlabSums> slabSums_;
    std::vector<nodal::NodeSums> rowSums_;
    double smallestMass_ = 0;
    double time_ = 0; ///< at the start of the step
    StepReport report_;
    PassTimes times_;
};
} // namespace mpm::stepping
