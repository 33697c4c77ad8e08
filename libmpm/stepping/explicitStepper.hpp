#pragma once
/// The step for one dimension and one shape. See stepper.hpp for the method; the functions below are its passes, in the
/// order they run.
///
/// One pass over the particles of a tile does all that can be done while they are in cache: the pass that ends a step
/// also projects the particles as it leaves them, which is the first projection of the next step. Sums are the same,
/// bit for bit, as those of a projection on its own.
#include "constitutive/kinematics.hpp"
#include "nodal/absorbingBoundary.hpp"
#include "nodal/bodyContact.hpp"
#include "nodal/contact.hpp"
#include "nodal/damping.hpp"
#include "nodal/localDamping.hpp"
#include "nodal/traction.hpp"
#include "nodal/wall.hpp"
#include "stepping/sceneOf.hpp"
#include "stepping/sortParticles.hpp"
#include "stepping/stepper.hpp"
#include "stepping/workspace.hpp"
#include "transfer/affine.hpp"
#include "transfer/gridToParticle.hpp"

namespace mpm::stepping
{
template <int dim, class Shape>
class ExplicitStepper : public Stepper
{
  public:
    ExplicitStepper(state::State& state, const Scene& scene);
    void step(double dt) override;
    void particlesChanged() override;
    const StepReport& report() const override { return report_; }
    PassTimes times() const override;
    double smallestNodalMassFraction() override;
    double largestSpeed() const override;
    double scratchBytesPerParticle() const override;

  private:
    using Narrow = typename Shape::Narrow;
    using Vectors = typename stepping::Workspace<dim, Shape>::Vectors;
    using Equations = nodal::NodeEquations<dim>;
    static constexpr bool hasCorners = requires { Shape::hasCorners; };

    static constexpr int filterLayer = 1; ///< of the nodes: what XPIC and FMPM filter; smoothed stress

    enum class Project
    {
        nothing,
        momentum, ///< mass and momentum
        forces    ///< mass, momentum and internal force
    };

    /// Rounds of a stress relaxation (stressTreatment.ipp).
    enum class Round
    {
        none,
        project, ///< sigma to the nodes
        again,   ///< sigma - S sigma to the particles' correction, and to the nodes
        finish   ///< the correction
    };

    /// What one pass over the particles does, in this order.
    static constexpr bool plain = SceneOf<Shape>::plain;
    using Maybe = std::conditional_t<plain, Never, bool>;
    struct Pass
    {
        Maybe pressure = false;    ///< only: add the particles' pressure to their cells
        Round round = Round::none; ///< only: that of a stress relaxation
        Maybe gradient = false;    ///< only: keep velocity gradients and add the volume change to the cells
        bool relaxes() const { return !plain && round != Round::none; }
        bool velocity = false;           ///< v from v* and a, and new positions x + dt v*
        Maybe filter = false;            ///< gather the velocity being filtered and project it as it is
        bool reproject = false;          ///< project m v of the updated particles with the weights of the old positions
        bool strain = false;             ///< velocity gradient, F, V and stress
        int gradientLane = 1;            ///< node lanes strains are taken from: 1: v*, 1 + dim: w
        bool moves = false;              ///< the new positions take effect
        Project then = Project::nothing; ///< project the particles as the pass leaves them, for the next equations
        bool everyone = false;           ///< also those that sleep

        // What the scene adds, asked once a pass (completed()): chunks are many.
        Maybe prepares = false;         ///< pressure, a round, gradient or filter
        bool gathers = false;           ///< the velocity gradient
        Maybe filtered = false;         ///< take the filtered velocity
        Maybe byStrainVelocity = false; ///< positions move with w
        Maybe affine = false;           ///< particles carry an affine field
        Maybe replaces = false;         ///< v_p = sum N v, in place of v_p += dt sum N a
        Maybe blends = false;           ///< replaces, or alpha > 0
        Maybe addsStress = false;       ///< forces see more of stress than particles have
        Maybe addsForce = false;        ///< more is projected with the forces
        double alpha = 0;               ///< share of the grid's velocity
    };
    Pass completed(Pass pass) const;

    bool hyperelastic() const { return !plain && anyHyperelastic_; }
    bool hasHistory() const { return !plain && anyHistory_; }
    bool plastic() const { return !plain && anyPlastic_; }
    /// Is anything done to strains and stresses beside the law?
    bool treated() const { return !plain && treated_; }
    bool averages() const { return scene_.treatment.averaging.has_value(); }
    bool viscous() const { return scene_.treatment.hasViscosity(); }
    bool bulkViscous() const { return scene_.bulkViscosity.has_value(); }
    bool conjugate() const { return averages() && scene_.treatment.averaging->conjugate; }
    /// Does the step at hand relax stresses?
    bool relaxes() const;

    using Workspace = stepping::Workspace<dim, Shape>;

    void arrange();
    void buildTiles(bool look = false); ///< look: may tiles fall asleep?
    void project();
    void projectAgain(Project what);
    template <class Node>
    void sumWindows(const nodal::NodeRow<dim>& row, const state::Block& block, Node* sum);
    template <class What>
    void sumNodes(nodal::NodeRow<dim>& row, const state::Block& block);
    void solveNodes();
    void solveNodes(const std::vector<Index>& blocks);
    void filterVelocities();
    template <class Change>
    void filterRow(Change&& change);
    void strainVelocities(double dt, bool secondProjection);
    void projectAgainToRow(const nodal::NodeRow<dim>& row, const state::Block& block);
    void foreseeContact(nodal::NodeRow<dim>& row, const state::Block& block, const Equations& equations);
    Equations equations(double dt) const;
    void solveFreeRow(nodal::NodeRow<dim>& row, const state::Block& block, const Equations& equations);
    void solveRow(nodal::NodeRow<dim>& row, const Equations& equations);
    void finishRow(nodal::NodeRow<dim>& row, const Equations& equations);

    // contact between bodies, in contactWork.ipp
    static nodal::ParticleReach particleReach();
    void sizeContact();
    void meetBodies();
    void keepRow(const nodal::NodeRow<dim>& row, const state::Block& block);
    void finishSharedRows();
    void bookContact(nodal::NodeSums& sums);
    void strainTogether(bool secondProjection);
    bool prescribed(int body) const { return contact_ && contact_->rigid(body); }
    bool shared(const state::Block& block) const
    {
        return contact_ && contact_->holds(std::size_t(&block - grid_.blocks().data()));
    }
    /// The first projection of a step. USF needs forces only where walls ask for contact before the strains.
    Project firstProjection() const
    {
        const bool foresees = touches() || contact_ || rests();
        return scene_.stressUpdate == StressUpdate::USF && !foresees ? Project::momentum : Project::forces;
    }
    void particlePass(double dt, const Pass& wanted);
    void sortAnew(bool look);
    void strainPass(double dt, int gradientLane, bool moves);
    void moveSurfaces(double dt);
    void book(const Pass& pass);
    void bookStressWork(double dt);

    // remedies for erratic stresses, in stressTreatment.ipp
    void prepareTreatment();
    void prepareBulkViscosity();
    void sizeTreatment();
    void averageVolumeChange(double dt, int gradientLane);
    void averagePressure();
    void sumCells();
    void correctStress();
    void sumStress();
    void leastSquaresCorrection();
    void openTreatment(Workspace& ws, const state::Tile& tile, const Pass& pass);
    bool locateCells(Workspace& ws, const Vectors& x, const state::NodeBox& box, int count) const;
    void addToCells(Workspace& ws, const state::Tile& tile, Index first, int count, const double (&value)[lanes]);
    void addPressure(Workspace& ws, const state::Tile& tile, Index first, int count);
    template <class W>
    void relaxationRound(Workspace& ws, const W& w, const state::Tile& tile, Index first, int count, Round round);
    void addVolumeChange(Workspace& ws, const state::Tile& tile, Index first, int count);
    void volumeChange(Workspace& ws, Index first, int count, double (&change)[lanes]) const;
    void takeAverage(Workspace& ws, const state::Tile& tile, Index first, int count);
    void loseToAverage(Workspace& ws, double dt, const double (&volume)[lanes], double (&work)[lanes]);
    void loadViscosity(Workspace& ws, Index first, int count) const;
    void traceOfForces(Workspace& ws, double dt, const constitutive::StressLanes<dim>& strain,
                       double (&trace)[lanes]) const;
    double viscousWork(const double (&stress)[lanes], const double (&trace)[lanes],
                       const double (&volume)[lanes]) const;
    void renewBulkViscosity(Workspace& ws, Index first, int count, double dt, const double (&trace)[lanes]);
    void takeAveragePressure(Workspace& ws, const state::Tile& tile, const Vectors& x);
    void relaxStress(Workspace& ws, Index first, int count, double dt, const constitutive::StressLanes<dim>& strain);
    void takeAveragedGradient(Workspace& ws, const state::Tile& tile, Index first, int count);
    void treatBefore(Workspace& ws, const state::Tile& tile, Index first, int count, double dt,
                     const constitutive::StressLanes<dim>& strainOfForces, double (&trace)[lanes],
                     double (&workOfForces)[lanes]);
    void treatAfter(Workspace& ws, Index first, int count, double dt, const double (&trace)[lanes],
                    double (&workOfForcesAfter)[lanes]);
    [[gnu::noinline]] void callTreatedLaws(Workspace& ws, Index first, int count, double dt, bool oneMaterial);

    // the work of a pass on one tile and one chunk, in chunkWork.ipp
    void passOverTile(Workspace& ws, const state::Tile& tile, double dt, const Pass& pass);
    void passOverChunk(Workspace& ws, const state::Tile& tile, Index first, int count, double dt, const Pass& pass);
    void listColumns(transfer::Prefetch& ahead, const Pass& pass) const;
    template <class Body>
    void withWeights(Workspace& ws, const Vectors& x, Body&& body) const;
    [[gnu::noinline]] void prepareOverChunk(Workspace& ws, const state::Tile& tile, Index first, int count,
                                            const Pass& pass);
    void moveByStrainVelocity(Workspace& ws, Index first, int count, double dt);
    [[gnu::noinline]] void addStressOfForces(Workspace& ws, const state::Tile& tile, const Vectors& x, Index first,
                                             int count, const Pass& pass);
    template <class W>
    [[gnu::noinline]] void addForces(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x, Index first,
                                     int count, double dt, const Pass& pass);
    double shareOfGridVelocity() const;
    [[gnu::noinline]] void blendVelocity(Workspace& ws, double dt, const Pass& pass) const;
    [[gnu::noinline]] void advanceVelocity(Workspace& ws, Index first, int count, double dt, const Pass& pass);
    template <class W>
    void projectBodyForce(Workspace& ws, const W& w, const state::Tile& tile, Index first, int count, double dt,
                          bool moves);
    template <class W>
    void projectMomentum(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x, Index first, int count,
                         bool withAffine);
    template <class Node, class W>
    void projectAffine(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x, Index first, int count);
    template <class W>
    void advanceAffine(Workspace& ws, const W& w, const state::Tile& tile, Index first, int count);
    int cornerDomains(Workspace& ws, Index first, int count) const;
    bool affine() const { return scene_.transfer == Transfer::APIC || scene_.transfer == Transfer::TPIC; }
    /// Does the step at hand filter velocities?
    bool filters() const
    {
        return (scene_.transfer == Transfer::XPIC || scene_.transfer == Transfer::FMPM) &&
               (!scene_.filterRate || state_.step % scene_.filterInterval == 0);
    }
    /// ... and take nothing but the filtered velocity?
    bool movesFiltered() const { return filters() && !scene_.filterRate; }
    bool splitsNow() const { return scene_.splitting && state_.step % scene_.splitting->interval == 0; }
    /// Is this the last step before a look at which particles are to be split?
    bool splitsNext() const { return scene_.splitting && (state_.step + 1) % scene_.splitting->interval == 0; }
    /// Does the next step begin with a sort? A projection before it would be thrown away; where an axis is periodic, it
    /// tells who is to be wrapped.
    bool sortsNext() const
    {
        const auto& periodic = state_.grid.periodic;
        return (state_.step + 1) % scene_.sortInterval == 0 && !periodic[0] && !periodic[1] && !periodic[2];
    }
    bool longEdges(Workspace& ws, Index first, int count) const;
    void split(bool known);
    void updateStress(Workspace& ws, const state::Tile& tile, Index first, int count, double dt);
    StrainColumns<dim> openColumns(Workspace& ws, Index first, int count);
    void putBack(Workspace& ws, Index first, int count);
    [[gnu::noinline]] void findBadParticle(Workspace& ws, Index first, int count) const;
    [[gnu::noinline]] void prepareTreated(Workspace& ws, const state::Tile& tile, Index first, int count, double dt,
                                          const StrainColumns<dim>& columns, double (&trace)[lanes]);
    [[gnu::noinline]] void bookKept(Workspace& ws, Index first, int count, double dt, const double (&trace)[lanes]);
    void findStiffest(Workspace& ws, Index first, int count) const;
    bool loadModuli(Workspace& ws, Index first, int count) const;
    template <class Body>
    void forHyperelastic(Index first, int count, Body&& body) const;
    void storedEnergy(const Workspace& ws, Index first, int count, double (&stored)[lanes]) const;
    void callLaws(Index first, int count, constitutive::Chunk<dim>& chunk, bool oneMaterial) const;
    [[gnu::always_inline]] inline void loadDomains(Workspace& ws, Index first, int count) const;
    void updateDomains(Workspace& ws, Index first, int count);
    void checkInside(Workspace& ws, const Vectors& x) const;
    static void lap(Workspace& ws, double PassTimes::*part);

    // who sleeps, in rest.ipp
    bool rests() const { return scene_.rest.has_value(); }
    void prepareRest();
    void choosePlaces();
    bool isDriven(const state::Tile& tile) const;
    bool disturbsEverywhere() const;
    void lookForRest();
    void fallAsleep();
    double asleep() const { return double(scene_.rest->looks + 1); } ///< quietLooks of what sleeps
    void layToRest();
    double disturbance(const state::Tile& tile, const std::vector<char>& solved);
    std::vector<Index> wake(const std::vector<char>& solved);
    const Record* restingMotion(const nodal::NodeRow<dim>& row, const state::Block& block);
    void sumRestingMotion(nodal::NodeRow<dim> row, const state::Block& block, Record* motion);
    double energyOf(const state::Tile& tile);
    void holdResting(const std::vector<Index>& blocks);
    void holdStrainVelocities();
    // what sleeps follows slowly, in restFollow.ipp
    bool follows() const { return rests() && scene_.rest->follow; }
    void catchUp();
    void keepUp(double dt);
    void kickSleepers(double dt);
    bool followMotion(const std::vector<Index>& which, double T, bool projects);
    MotionOfSleepers motionOfSleepers() const;
    std::vector<TileSums> passOverSleepers(const std::vector<Index>& which, double dt, const Pass& pass);

    void placeActors(double dt);
    void reportActors(double dt);
    double actorSpeed() const;
    bool driven() const; ///< is anything prescribed that changes with time?
    bool touches() const { return !walls_.empty() || !bodies_.empty(); } ///< they decide on contact
    bool bounded() const { return touches() || !absorbing_.empty(); }
    void applyWalls(nodal::NodeRow<dim>& row) const;
    template <class Body>
    void forEachRow(Body&& body); ///< of the blocks reached_
    template <class Body>
    void forEachRow(const std::vector<Index>& blocks, Body&& body, bool inPart = false);
    [[noreturn]] void fail(Index particle, const std::string& what) const;
    [[noreturn]] void failOutside() const;

    state::State& state_;
    const typename SceneOf<Shape>::Type scene_;
    template <class T>
    using List = typename SceneOf<Shape>::template List<T>;
    List<std::unique_ptr<nodal::NodeEffect<dim>>> effects_;
    typename SceneOf<Shape>::template Pointer<nodal::LocalDamping<dim>> localDamping_;
    List<nodal::WallEffect<dim>> walls_;
    List<nodal::Traction<dim>> tractions_;
    std::vector<std::size_t> tractionPatch_;
    List<nodal::SurfaceCarrier<dim>> carriers_;
    std::vector<splitting::Barrier> barriers_;
    List<nodal::BodyContact<dim>> bodies_;
    List<nodal::AbsorbingBoundary<dim>> absorbing_;
    Maybe wallsMove_ = false;
    Maybe bounded_ = false;                             ///< bounded(), asked for every row of nodes
    int actors_ = 0;                                    ///< moving walls and rigid bodies
    std::vector<nodal::ActorSums> actorSums_;           ///< actors_ a block
    std::vector<std::vector<nodal::HeldRow>> heldRows_; ///< nodes that bodies hold, by block
    transfer::WallPlanes wallPlanes_;                   ///< of walls that stay where they are

    state::TileLayout layout_;
    state::TileGrid grid_;
    typename SceneOf<Shape>::template Pointer<nodal::Contact<dim>> contact_; ///< null: one body
    struct
    {
        std::vector<Record> projected;                                  ///< nodes before they were solved, by place
        std::vector<typename nodal::NodeRow<dim>::WallScratch> byWalls; ///< by place of a row's first node
    } kept_;                                                            ///< of blocks that bodies share
    std::array<state::Column<state::Stored>, 3> domain_; ///< half lengths over h, where they follow the stretch
    std::array<state::Column<double>, 3> next_;          ///< positions at the end of the step, between two passes
    treatment::CellAverage cells_;
    std::array<state::Column<double>, dim * dim> gradient_;         ///< L between the two passes of an average
    std::array<state::Column<double>, stressSize<dim>> correction_; ///< T sigma - sigma of a relaxation
    double relaxationRate_ = 0, flowMemory_ = 0;
    std::vector<double> viscosities_;   ///< eta of each material
    std::vector<Index> awake_;          ///< tiles whose particles take part in the step, ascending
    std::vector<Index> reached_;        ///< blocks of nodes these reach, ascending
    std::vector<state::NodeBox> parts_; ///< of blocks, that tiles awake reach; empty: whole blocks are solved
    bool inPart_ = false;               ///< are parts of blocks solved in the step at hand?
    double restSpeed_ = 0, restWave_ = 0, restStress_ = 0; ///< eps c_p, c_p, eps M of the slowest material
    double restingEnergy_ = 0;                             ///< strain energy of what sleeps
    MotionOfSleepers resting_;                             ///< of what sleeps
    std::vector<char> motionKnown_;     ///< by block: 1: restingMotion_ is up to date, 2: and nothing sleeps there
    std::vector<Record> restingMotion_; ///< (m, p, v) of what sleeps, by place of a node
    std::vector<Index> waking_;         ///< tiles that follow and wake in the next step
    std::vector<std::array<double, 2>> bulkViscosities_; ///< rho_0 h b1 c_p and rho_0 (b2 h)^2 of each material
    std::vector<TileSums> tileSums_;
    std::vector<char> longEdges_; ///< tiles in which a particle may have to be split
    std::vector<nodal::NodeSums> blockSums_;
    std::vector<std::unique_ptr<Workspace>> workspaces_; ///< one a thread
    /// Work of internal forces in this step, - sum dt f_int . v, and of the strains, sum V sigma : D dt.
    struct
    {
        double ofForcesBefore = 0, ofForces = 0;   ///< on v_i, on v*
        double ofStrainsBefore = 0, ofStrains = 0; ///< of the stress before and after its update, both on w
    } work_;
    double smallestMass_ = 0;
    double kick_ = 0; ///< time over which the coming step's accelerations act: dt, half of it at a staggered start
    std::vector<std::array<double, 2>> moduli_; ///< 1/(2 K) and 1/(4 G) of each material
    bool anyHistory_ = false;                   ///< is there a material whose law usesHistory()?
    bool anyHyperelastic_ = false;              ///< is there a material whose stress is a function of F?
    bool treated_ = false;
    bool anyPlastic_ = false; ///< is there a material that can yield?
    bool arranged_ = false;   ///< tiles belong to the particles as they stand
    bool projected_ = false;  ///< windows hold the first projection of the coming step
    bool stray_ = false;      ///< the last projection left particles out
    StepReport report_;
    PassTimes times_;            ///< of the parts with a clock of their own
    PassTimes sampled_;          ///< of the parts of particle passes, in the steps that were sampled
    double particleSeconds_ = 0; ///< wall time of all particle passes
};
} // namespace mpm::stepping
