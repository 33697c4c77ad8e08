#pragma once
/// One row of nodes (constant j, k) while the nodal equations are solved, METHOD Eqs. 1-3 and Walls.
///
/// Before: record lanes hold mass, momentum, force. The row turns them into velocity before (v_i) and trial velocity
/// u = v_i + dt (f/m + g); body effects, then walls change u; at the end u is v* and the acceleration (v* - v_i)/dt.
#include "base/record.hpp"
#include "base/types.hpp"
#include "nodal/contactBody.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace mpm::nodal
{
/// What one moving wall or rigid body did to the nodes of a block in a step.
struct ActorSums
{
    Vector3 impulse{}; ///< on the nodes [N s]
    Vector3 moment{};  ///< of these impulses about the body's position [N m s]
    Index contacts = 0;
    std::vector<SurfaceImpulse> impulses; ///< where the body collects them

    ActorSums& operator+=(const ActorSums& o)
    {
        for (std::size_t a = 0; a < 3; ++a)
        {
            impulse[a] += o.impulse[a];
            moment[a] += o.moment[a];
        }
        contacts += o.contacts;
        impulses.insert(impulses.end(), o.impulses.begin(), o.impulses.end());
        return *this;
    }
};

struct HeldRow; // nodal/bodyContact.hpp

/// Energies and impulses of one step, summed over nodes. Per metre in 2D.
struct NodeSums
{
    double kineticBefore = 0;   ///< sum m v_i^2/2 [J]
    double kineticAfter = 0;    ///< sum m v*^2/2 [J]
    double gravityWork = 0;     ///< sum dt m b . (v_i + v*)/2 [J]
    double tractionWork = 0;    ///< sum dt f_tau . (v_i + v*)/2 [J]
    double frictionLoss = 0;    ///< - sum J_t . v* over friction walls [J]
    double absorbed = 0;        ///< - sum J . ((v_i + v*)/2 - V) of absorbing boundaries [J]
    double dampingLoss = 0;     ///< - sum J . (v_i + v*)/2 of damping [J]
    double forceWorkBefore = 0; ///< sum dt f . v_i over the projected forces [J]
    double forceWork = 0;       ///< sum dt f . v* over the projected forces [J]
    double wallLoss = 0;        ///< sum m (v_i - v*)^2/2 where walls hold [J]
    double motionWork = 0;      ///< sum J . V of impulses J by walls that move at V [J]
    double unbalancedForce = 0; ///< sum |m (v* - v_i)/dt| by components no wall holds [N]; with local damping only
    double appliedForce = 0;    ///< sum |f| by components over the projected forces [N]; the same
    double restWork = 0;        ///< done on what sleeps and follows at nodes it shares [J]
    Index contacts = 0;         ///< nodes at which a friction wall pressed
    double lightest = std::numeric_limits<double>::infinity(); ///< smallest mass of a node that carries any [kg]
    Vector3 gravityImpulse{}, wallImpulse{}, dampingImpulse{}; ///< [N s]
    Vector3 restImpulse{};                                     ///< of what sleeps (stepping/rest.ipp) [N s]
    /// What NodeEquations sum, lane by lane, until gather() adds it to the numbers above: m v_i^2 and m v*^2, dt f .
    /// v_i and dt f . v*, dt g . (v_i + v*) m and dt g m.
    Record kinetic{}, work{}, gravity{}, weight{};

    template <int dim>
    void gather()
    {
        for (int a = 0; a < dim; ++a)
        {
            const int before = 1 + a, after = 1 + dim + a;
            kineticBefore += 0.5 * kinetic[before];
            kineticAfter += 0.5 * kinetic[after];
            forceWorkBefore += work[before];
            forceWork += work[after];
            gravityWork += 0.5 * gravity[after];
            gravityImpulse[std::size_t(a)] += weight[after];
        }
        kinetic = work = gravity = weight = Record{};
    }

    NodeSums& operator+=(const NodeSums& o)
    {
        kineticBefore += o.kineticBefore;
        kineticAfter += o.kineticAfter;
        gravityWork += o.gravityWork;
        tractionWork += o.tractionWork;
        frictionLoss += o.frictionLoss;
        wallLoss += o.wallLoss;
        motionWork += o.motionWork;
        absorbed += o.absorbed;
        forceWorkBefore += o.forceWorkBefore;
        dampingLoss += o.dampingLoss;
        unbalancedForce += o.unbalancedForce;
        appliedForce += o.appliedForce;
        forceWork += o.forceWork;
        contacts += o.contacts;
        lightest = std::min(lightest, o.lightest);
        for (int a = 0; a < 3; ++a)
        {
            gravityImpulse[a] += o.gravityImpulse[a];
            wallImpulse[a] += o.wallImpulse[a];
            dampingImpulse[a] += o.dampingImpulse[a];
            restImpulse[a] += o.restImpulse[a];
        }
        kinetic += o.kinetic;
        work += o.work;
        gravity += o.gravity;
        weight += o.weight;
        return *this;
    }
};

template <int dim>
struct NodeRow
{
    Index begin = 0, end = 0; ///< lattice indices along x
    Index j = 0, k = 0;       ///< lattice indices of the row
    int body = 0;             ///< whose nodes they are
    Record* node = nullptr;   ///< node[i], begin <= i < end
    double dt = 0;
    double time = 0;         ///< at the start of the step [s]
    double smallestMass = 0; ///< nodes lighter than this carry nothing
    NodeSums* sums = nullptr;
    /// What walls did at each node of the row, all empty while none touched it.
    struct WallScratch
    {
        std::vector<Vector3> pushed;   ///< normal velocity taken away along each axis
        std::vector<Vector3> friction; ///< impulses of friction
        std::vector<Vector3> other;    ///< all other impulses
        std::vector<Vector3> absorbed; ///< impulses of absorbing boundaries; empty where there are none

        void clear()
        {
            pushed.clear();
            friction.clear();
            other.clear();
            absorbed.clear();
        }
        /// What walls did before, at a row that is taken up again.
        void add(const WallScratch& before)
        {
            open(before.pushed.size());
            absorbed = before.absorbed;
            for (std::size_t n = 0; n < before.pushed.size(); ++n)
                for (std::size_t a = 0; a < 3; ++a)
                {
                    pushed[n][a] += before.pushed[n][a];
                    friction[n][a] += before.friction[n][a];
                    other[n][a] += before.other[n][a];
                }
        }
        void open(std::size_t n)
        {
            if (!pushed.empty())
                return;
            pushed.assign(n, {});
            friction.assign(n, {});
            other.assign(n, {});
        }
    };
    WallScratch* walls = nullptr;
    std::vector<HeldRow>* held = nullptr; ///< of this block: nodes rigid bodies hold
    ActorSums* actors = nullptr;          ///< of this block: moving walls, then rigid bodies; null: nothing is booked
    std::vector<Record>* projected = nullptr; ///< the records before the row was solved
    const Vector3* contact = nullptr;         ///< contact[i]: impulse of contact on node i; null where there is none

    static constexpr int velocity = 1;    ///< first lane of v_i
    static constexpr int trial = 1 + dim; ///< first lane of f, then u

    bool carries(Index i) const { return node[i][0] > smallestMass; }
};

/// A body effect on nodes: changes the trial velocity, then books what it did once u is final.
template <int dim>
class NodeEffect
{
  public:
    virtual ~NodeEffect() = default;
    virtual void apply(NodeRow<dim>& row) const = 0;
    virtual void book(NodeRow<dim>&) const {}
};

/// The lanes of a record by what they hold, moved and chosen as a whole.
template <int dim>
struct NodeLanes
{
    /// -1 in the lanes of the velocity, of the trial velocity, 0 elsewhere.
    static Mask velocity() { return dim == 2 ? Mask{0, -1, -1, 0, 0, 0, 0, 0} : Mask{0, -1, -1, -1, 0, 0, 0, 0}; }
    static Mask trial() { return dim == 2 ? Mask{0, 0, 0, -1, -1, 0, 0, 0} : Mask{0, 0, 0, 0, -1, -1, -1, 0}; }

    static Record toTrial(const Record& r)
    {
        if constexpr (dim == 2)
            return shuffle<0, 0, 0, 1, 2, 0, 0, 0>(r, r);
        else
            return shuffle<0, 0, 0, 0, 1, 2, 3, 0>(r, r);
    }
    static Record toVelocity(const Record& r)
    {
        if constexpr (dim == 2)
            return shuffle<0, 3, 4, 0, 0, 0, 0, 0>(r, r);
        else
            return shuffle<0, 4, 5, 6, 0, 0, 0, 0>(r, r);
    }
};

/// The equations of a node over a step, for its record as a whole: (m, p, f) -> (m, v_i, u) -> (m, v*, a).
template <int dim>
class NodeEquations
{
  public:
    NodeEquations(double dt, double smallestMass, const Vector3& gravity)
        : dt_(dt), inverseDt_(1 / dt), smallestMass_(smallestMass)
    {
        for (int a = 0; a < dim; ++a)
            gain_[1 + dim + a] = dt * gravity[std::size_t(a)];
    }

    /// p -> v_i, f -> u by forces and gravity; nothing moves where there is no mass.
    MPM_INLINE Record begin(const Record& r) const
    {
        const double inverse = r[0] > smallestMass_ ? 1 / r[0] : 0.0;
        const Record rates = r * inverse; // (1, v, f/m)
        const Record gain = select(splat<Record>(inverse) > Record{}, gain_, Record{});
        return select(Lanes::velocity(), rates,
                      select(Lanes::trial(), Lanes::toTrial(rates) + (dt_ * rates + gain), r));
    }

    /// u -> v* and a.
    MPM_INLINE Record end(const Record& r) const
    {
        const Record acceleration = inverseDt_ * (r - Lanes::toTrial(r));
        return select(Lanes::velocity(), Lanes::toVelocity(r), select(Lanes::trial(), acceleration, r));
    }

    /// What they sum up over a row.
    class Books
    {
      public:
        /// A node before, and once its u is final.
        MPM_INLINE void add(const Record& projected, const Record& r, double smallestMass)
        {
            const Record momentum = r[0] * r;
            mass_ += r;
            momentum_ += momentum;
            kinetic_ += momentum * r;
            work_ += select(Lanes::velocity(), Lanes::toVelocity(projected), projected) * r;
            lightest_ = r[0] > smallestMass ? std::min(lightest_, r[0]) : lightest_;
        }

        MPM_INLINE void close(NodeSums& sums, const NodeEquations& equations) const
        {
            sums.kinetic += kinetic_;
            sums.work += equations.dt_ * work_;
            sums.gravity += equations.gain_ * (momentum_ + Lanes::toTrial(momentum_));
            sums.weight += mass_[0] * equations.gain_;
            sums.lightest = std::min(sums.lightest, lightest_);
        }

      private:
        Record mass_{}, momentum_{}, kinetic_{}, work_{};
        double lightest_ = std::numeric_limits<double>::infinity();
    };

  private:
    using Lanes = NodeLanes<dim>;
    Record gain_{};
    double dt_, inverseDt_, smallestMass_;
};

/// A row whose nodes feel nothing but forces and gravity, in one go; projected(i): (m, p, f) of node i.
template <int dim, class Projected>
void solveFreeRow(NodeRow<dim>& row, const NodeEquations<dim>& equations, Projected&& projected)
{
    typename NodeEquations<dim>::Books books;
    for (Index i = row.begin; i < row.end; ++i)
    {
        const Record before = projected(i), r = equations.begin(before);
        books.add(before, r, row.smallestMass);
        row.node[i] = equations.end(r);
    }
    books.close(*row.sums, equations);
}

/// f -> u for a row; p -> v_i.
template <int dim>
void beginRow(NodeRow<dim>& row, const NodeEquations<dim>& equations)
{
    row.projected->assign(row.node + row.begin, row.node + row.end);
    for (Index i = row.begin; i < row.end; ++i)
        row.node[i] = equations.begin(row.node[i]);
}

/// Books energies and work, that of walls too, then (v_i, u) -> (v*, a).
template <int dim>
void endRow(NodeRow<dim>& row, const NodeEquations<dim>& equations)
{
    typename NodeEquations<dim>::Books books;
    for (Index i = row.begin; i < row.end; ++i)
        books.add((*row.projected)[std::size_t(i - row.begin)], row.node[i], row.smallestMass);
    books.close(*row.sums, equations);
    if (!row.walls->pushed.empty())
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
            {
                const double jn = row.walls->other[std::size_t(i - row.begin)][a];
                const double jt = row.walls->friction[std::size_t(i - row.begin)][a];
                if (jn == 0 && jt == 0)
                    continue;
                // Forces at a node that a wall holds work on v*, as strains see it; what the wall takes from v_i beyond
                // that, m (v_i - v*)^2/2, is an impact.
                const double before = row.node[i][row.velocity + a], after = row.node[i][row.trial + a];
                const double held =
                    row.dt * (*row.projected)[std::size_t(i - row.begin)][row.trial + a] * (before - after);
                const double friction = -jt * after;
                row.sums->forceWorkBefore -= held;
                row.sums->frictionLoss += friction;
                row.sums->wallLoss -= 0.5 * ((jn + jt) * (before + after) + held) + friction;
                row.sums->wallImpulse[a] += jn + jt;
            }
    if (!row.walls->absorbed.empty())
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
            {
                const double impulse = row.walls->absorbed[std::size_t(i - row.begin)][std::size_t(a)];
                row.sums->absorbed -= 0.5 * impulse * (row.node[i][row.velocity + a] + row.node[i][row.trial + a]);
                row.sums->wallImpulse[std::size_t(a)] += impulse;
            }
    for (Index i = row.begin; i < row.end; ++i)
        row.node[i] = equations.end(row.node[i]);
}

/// w = p/m in the lanes of a, of a momentum projected anew: (m, p).
template <int dim>
MPM_INLINE void setStrainVelocity(const NodeRow<dim>& row, Index i, const HalfRecord& momentum)
{
    using Lanes = NodeLanes<dim>;
    Record& r = row.node[i];
    const HalfRecord w = (row.carries(i) ? 1 / r[0] : 0.0) * momentum;
    r = select(Lanes::trial(), Lanes::toTrial(join(w, w)), r);
}

/// (v_i, u) -> (u, v_i), the lanes as a second projection leaves them.
template <int dim>
void swapTrial(NodeRow<dim>& row)
{
    for (Index i = row.begin; i < row.end; ++i)
        for (int a = 0; a < dim; ++a)
        {
            const double velocity = row.node[i][row.velocity + a]; // no std::swap: clang has no references to lanes
            row.node[i][row.velocity + a] = row.node[i][row.trial + a];
            row.node[i][row.trial + a] = velocity;
        }
}
} // namespace mpm::nodal
