#pragma once
/// A body pushes soil: at nodes inside it and up to half a cell around it, with the outward normal n of the body
/// there (nodal/rigidBody.hpp), V its velocity at the node, r = u - V:
///     r_n <- 0 where r.n < 0 (with separation off: always),  r_t <- r_t max(0, 1 - mu |r.n|/|r_t|)
/// the equations of walls (nodal/wall.hpp), for a surface of any shape. As soil touches what its nodes touch, it is
/// held off about half a cell; a body thinner than a cell is refused when it is read.
///
///     blade                       // constant/rigidBodies: one dictionary a body
///     {
///         geometry   "geometry/blade.stl";   // closed: .stl (ASCII, binary), .msh; in 2D also
///         points     ((0 0) (1 0) (1 2));    // a polygon, instead of a geometry
///         scale      1;           // of the geometry's coordinates
///         mu         0.3;         // Coulomb friction, >= 0; default 0
///         separation on;          // off: the body holds as well; default on
///         motion     { velocity (0.1 0 0); rotation { angularVelocity 0.5; } }   // default: it rests
///     }
///
/// Contact is decided once a step: velocities that strains are taken from follow it (follow), as walls do. Impulses and
/// moments are summed for the body (postProcessing/<name>.csv); work motionWork = sum J . V; impact and friction are
/// those of r. Step errors: a body that moves more than half a cell in a step. Verified in tests/unit/rigidBodies.cpp.
#include "nodal/boundaries.hpp"
#include "nodal/nodeRow.hpp"
#include "nodal/rigidBody.hpp"
#include "state/gridBox.hpp"

namespace mpm::nodal
{
/// A node a body holds, in one step.
struct HeldNode
{
    enum State
    {
        apart,
        slips,
        sticks
    };
    Index i = 0;
    int actor = 0;
    State state = apart;
    Vector3 normal{}, velocity{};
    double pushed = 0; ///< velocity into the body that it has taken away
    Index element = 0; ///< of the surface: nearest to the node
    std::array<double, 3> weights{};
};

/// Those of a row (j, k) of a block.
struct HeldRow
{
    Index j = 0, k = 0;
    std::vector<HeldNode> nodes;
    std::vector<char> found; ///< by actor: have its nodes been looked for?
};

template <int dim>
class BodyContact
{
  public:
    /// actor: its place in NodeRow::actors.
    BodyContact(const Body& body, const state::GridBox& grid, int actor);

    /// To be called before a step: takes the body where its motion says. StepError if it is too fast.
    void place(double time, double dt, const state::GridBox& grid);
    void push(NodeRow<dim>& row) const;
    void rub(NodeRow<dim>& row) const;
    void follow(NodeRow<dim>& row) const;

    ContactBody& body() const { return *body_.body; }
    /// Null for a deformable one.
    RigidBody* rigid() const { return rigid_.get(); }
    const std::string& name() const { return body_.name; }
    double speedAt(double time) const;
    Vector3 positionAt(double time) const;

  private:
    HeldRow* nodesOf(NodeRow<dim>& row) const;
    void give(NodeRow<dim>& row, const HeldNode& node, const Vector3& change, bool friction) const;

    Body body_;
    std::shared_ptr<RigidBody> rigid_;
    int actor_;
    Vector3 origin_{};
    double h_, reach_;
};

extern template class BodyContact<2>;
extern template class BodyContact<3>;
} // namespace mpm::nodal
