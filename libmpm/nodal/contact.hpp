#pragma once
/// Contact between bodies with Coulomb friction. A body is one material or several; each has its own field of nodal
/// velocities (its own tiles and blocks of nodes, state/tileGrid.hpp), so bodies slip and part freely, and only at
/// nodes which two of them reach is there anything to decide (the multi-velocity grid of Bardenhagen, Brackbill &
/// Sulsky 2000, doi 10.1016/S0045-7825(99)00338-2).
///
/// Normal and gap. A node sees of each body the particles that carry weight at it. n, from body 1 to body 2, is normal
/// to the plane that separates the centres of the two clouds best (nodal/hullDistance.hpp); the gap is the distance of
/// the two clouds along n,
///     g = min_2 (x_p.n - r_p(n)) - max_1 (x_p.n + r_p(n)),     r_p(n)^2 = sum_k (n . F l0_k)^2/4,
/// r_p the half width of the ellipsoid within the particle's domain. So a flat surface has its own normal up to its
/// very edge, where gradients of nodal mass turn by 30 degrees and more, and domains meet where they are drawn, not two
/// cells before. (Nairn, Hammerquist & Smith 2020, doi 10.1016/j.cma.2020.112859, separate the clouds by logistic
/// regression.) Where clouds are mixed already, n joins their centres.
///
/// Law, u the trial velocities after forces, body effects and walls, m* = m_1 m_2/(m_1 + m_2), d = u_1 - u_2:
///     push      J_n = m* (d.n - max(g, 0)/dt)  where that is positive: what would overlap by the end of the step
///     touches friction  J_t = m* d_t where |m* d_t| <= mu J_n (stick), else mu J_n d_t/|d_t| u_1 -= (J_n n + J_t)/m_1,
///     u_2 += (J_n n + J_t)/m_2
/// so momentum is kept; parting is free. Walls then push once more. Where more than two bodies meet, all pairs are
/// repeated in turn with their sums of push and friction held to the law, until nothing changes.
///
/// Contact and stick are decided once a step; velocities w that strains are taken from follow (wall.hpp has the
/// reason): pairs in contact keep the normal difference of v*, those that stick all of it, and others do not approach
/// by more than their gap.
///
/// A rigid body (constitutive/rigid.hpp) counts as an infinite mass. Its nodes move from x_i to where the pose at the
/// end of the step takes them, so its particles do; what that takes, J = m (v* - v_i) less all other impulses, is
/// booked as motionWork J.(v_i + v*)/2, and among the impulses of walls.
///
/// Energy: contactFriction = - sum J_t . v*, never negative, and contactLoss, the rest of the work of both impulses:
/// m* ((v_i,1 - v_i,2).n)^2/2 of an impact, shared with the work of forces as for walls (nodeRow.hpp).
///
///     bodies      (disc plane);         // constant/contactProperties. A body: a material, or a list of materials
///                                       // (disc (soil rock)); materials not named are one body more
///     mu          0.3;                  // between bodies, >= 0
///     pairs       ((disc plane 0.2));   // default none; a body that is a list goes by its first material
///     detection   domains;              // domains | nodes: contact as soon as two bodies carry the same node, a cell
///     or
///                                       // more before they meet (for comparison)
///
/// Without the file all materials are one body that holds together, and no step has a pass more. A body thinner than
/// two cells between parts of one other body is not seen from both sides. Verified in tests/unit/contact.cpp,
/// tests/verification/{contactOnIncline,contactOfDiscs}.
#include "nodal/contactProperties.hpp"
#include "nodal/nodeRow.hpp"
#include "state/gridBox.hpp"
#include "state/tileGrid.hpp"

#include <vector>

namespace mpm::nodal
{
/// How far particles are felt: points with a reach of their own (in cells), or domains.
struct ParticleReach
{
    bool domains = true;
    double points = 0;
};

/// What contact did in a step, on both bodies together.
struct ContactSums
{
    double friction = 0, loss = 0; ///< energy taken [J]
    double held = 0;               ///< sum dt f . (v_i - v*) in the directions it acts: forces work on v* there
    Index nodes = 0;               ///< pairs of nodes that pressed
};

template <int dim>
class Contact
{
  public:
    Contact(const ContactProperties& properties, const ParticleReach& reach) : properties_(properties), reach_(reach) {}

    /// For tiles just cut.
    void arrange(const state::TileGrid& nodes);
    /// Blocks that other bodies reach into, ascending.
    const std::vector<Index>& blocks() const { return blocks_; }
    bool holds(std::size_t block) const { return !shared_.empty() && shared_[block]; }

    /// Finds the nodes two bodies carry (lane 0: masses) for particles where they are, with their normals and gaps.
    void find(const state::TileGrid& nodes, const state::Particles& particles, const state::GridBox& grid,
              double smallestMass);
    /// Trial velocities in the second lanes.
    void push(state::TileGrid& nodes, double dt);
    /// w in the second lanes of a layer, v* in the first.
    void follow(state::TileGrid& nodes, int layer) const;
    /// After the nodal equations (lanes v*, a); `projected` has the records (m, p, f) of all nodes by place.
    ContactSums book(const state::TileGrid& nodes, const std::vector<Record>& projected, double dt) const;
    /// Where rigid bodies go in the coming step.
    void place(double time, double dt);
    bool rigid(int body) const { return !poses_.empty() && properties_.motion[std::size_t(body)]; }
    /// u of a rigid body's nodes, after beginRow.
    void drive(NodeRow<dim>& row, const state::GridBox& grid) const;
    /// w = v*.
    static void followDrive(NodeRow<dim>& row);
    /// Work and impulse of who drives it, before endRow.
    static void bookDrive(NodeRow<dim>& row);
    /// Impulses of contact on the nodes, by place.
    const std::vector<Vector3>& impulses() const { return impulse_; }

  private:
    /// Two bodies at a node.
    struct Pair
    {
        std::array<Index, 2> place{}; ///< of their nodes
        std::array<bool, 2> rigid{};
        std::array<std::size_t, 2> side{}; ///< their blocks among those of the box
        Index node = 0;                    ///< within the box
        double mu = 0;
        Vector3 n{};
        double gap = 0;
        double push = 0; ///< J_n
        Vector3 rub{};   ///< J_t
        bool sticks = false;
    };
    struct Box
    {
        std::vector<Index> blocks;
        std::vector<Pair> pairs; ///< those of a node side by side
    };
    struct Clouds;
    void findPairs(const state::TileGrid& nodes, double smallestMass, Box& box, Clouds& clouds) const;
    void gatherClouds(const state::TileGrid& nodes, const state::Particles& p, const state::GridBox& grid,
                      const Box& box, Clouds& clouds) const;
    bool locate(const state::Particles& p, const Clouds& clouds, double h, Pair& pair) const;
    static Vector3 inverseMasses(const Record* records, const Pair& pair);
    void solve(Record* records, double dt, Pair* begin, Pair* end);
    template <class Work>
    void forEachBox(Work&& work);

    ContactProperties properties_;
    ParticleReach reach_;
    std::vector<char> shared_; ///< by block
    std::vector<Index> blocks_;
    std::vector<Box> boxes_;
    std::vector<Vector3> impulse_;
    double dt_ = 0, drivenFor_ = 0;
    std::vector<std::array<Pose, 2>> poses_; ///< of rigid bodies, at the start and the end of the step
};

template <int dim>
template <class Work>
void Contact<dim>::forEachBox(Work&& work)
{
    const int count = int(boxes_.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int b = 0; b < count; ++b)
        work(boxes_[std::size_t(b)]);
}
} // namespace mpm::nodal
