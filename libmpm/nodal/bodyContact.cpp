#include "nodal/bodyContact.hpp"

#include "base/error.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::nodal
{
namespace
{
template <int dim>
Vector3 trialVelocity(const NodeRow<dim>& row, Index i)
{
    Vector3 out{};
    for (int a = 0; a < dim; ++a)
        out[std::size_t(a)] = row.node[i][row.trial + a];
    return out;
}
} // namespace

template <int dim>
BodyContact<dim>::BodyContact(const Body& body, const state::GridBox& grid, int actor)
    : body_(body), rigid_(std::dynamic_pointer_cast<RigidBody>(body.body)), actor_(actor), origin_(grid.origin),
      h_(grid.h), reach_((0.5 + 1e-6) * grid.h)
{}

template <int dim>
void BodyContact<dim>::place(double time, double dt, const state::GridBox& grid)
{
    if (body_.motion)
        rigid_->move(body_.motion->pose(time), body_.motion->meanTwist(time, dt));
    if (const double path = body_.body->fastest() * dt; !(path <= 0.5 * grid.h))
        throw StepError(fmt::format("at time {:.9g} s the body '{}' moves {:.3g} m in a step of {:.3g} s, allowed is "
                                    "half a cell, {:.3g} m: a smaller deltaT is needed",
                                    time, body_.name, path, dt, 0.5 * grid.h));
}

template <int dim>
Vector3 BodyContact<dim>::positionAt(double time) const
{
    return body_.motion ? body_.motion->pose(time).position : body_.body->position();
}

template <int dim>
double BodyContact<dim>::speedAt(double time) const
{
    if (!body_.motion)
        return body_.body->fastest();
    Twist twist;
    if (body_.motion->translation)
        twist.velocity = body_.motion->translation->velocity(time);
    if (body_.motion->angle)
        twist.angularVelocity = times(body_.motion->angle->velocity(time)[0], body_.motion->axis);
    RigidBody copy = *rigid_;
    copy.move(body_.motion->pose(time), twist);
    return copy.fastest();
}

/// The row's list, with the nodes of this body found if they were not yet; null where there can be none.
template <int dim>
HeldRow* BodyContact<dim>::nodesOf(NodeRow<dim>& row) const
{
    const ContactBody& body = *body_.body;
    Index begin = row.begin, end = row.end;
    const Index fixed[3] = {0, row.j, row.k};
    for (int a = 0; a < dim; ++a)
    {
        const auto n = std::size_t(a);
        const double low = (body.low()[n] - reach_ - origin_[n]) / h_,
                     high = (body.high()[n] + reach_ - origin_[n]) / h_;
        if (a == 0)
        {
            begin = std::max(begin, Index(std::ceil(low)));
            end = std::min(end, Index(std::floor(high)) + 1);
        }
        else if (double(fixed[a]) < low || double(fixed[a]) > high)
            return nullptr;
    }
    if (begin >= end)
        return nullptr;
    HeldRow* held = nullptr;
    for (auto& known : *row.held)
        if (known.j == row.j && known.k == row.k)
            held = &known;
    if (!held)
    {
        row.held->push_back({row.j, row.k, {}, {}});
        held = &row.held->back();
    }
    const auto actor = std::size_t(actor_);
    if (held->found.size() <= actor)
        held->found.resize(actor + 1);
    if (held->found[actor])
        return held;
    held->found[actor] = true;
    for (Index i = begin; i < end; ++i)
    {
        if (!row.carries(i))
            continue;
        Vector3 x{};
        const Index index[3] = {i, row.j, row.k};
        for (int a = 0; a < dim; ++a)
            x[std::size_t(a)] = origin_[std::size_t(a)] + h_ * double(index[a]);
        const auto nearest = body.nearest(x);
        if (nearest.distance <= reach_)
            held->nodes.push_back({i, actor_, HeldNode::apart, nearest.normal, body.velocityAt(x, nearest), 0,
                                   nearest.element, nearest.weights});
    }
    return held;
}

/// Changes the trial velocity of a node and books the impulse.
template <int dim>
void BodyContact<dim>::give(NodeRow<dim>& row, const HeldNode& node, const Vector3& change, bool friction) const
{
    Record& r = row.node[node.i];
    const std::size_t n = std::size_t(node.i - row.begin);
    Vector3 impulse{}, x{};
    const Index index[3] = {node.i, row.j, row.k};
    for (int a = 0; a < dim; ++a)
    {
        const auto k = std::size_t(a);
        impulse[k] = r[0] * change[k];
        x[k] = origin_[k] + h_ * double(index[a]);
        r[row.trial + a] += change[k];
        (friction ? row.walls->friction : row.walls->other)[n][k] += impulse[k];
    }
    const double work = dot(impulse, node.velocity);
    row.sums->motionWork += work;
    (friction ? row.sums->frictionLoss : row.sums->wallLoss) += work;
    if (!row.actors)
        return;
    auto& sums = row.actors[actor_];
    sums.impulse = plus(sums.impulse, impulse);
    sums.moment = plus(sums.moment, cross(minus(x, body_.body->position()), impulse));
    if (body_.body->collects)
        sums.impulses.push_back({node.element, node.weights, impulse});
}

template <int dim>
void BodyContact<dim>::push(NodeRow<dim>& row) const
{
    HeldRow* held = nodesOf(row);
    if (!held)
        return;
    for (auto& node : held->nodes)
    {
        if (node.actor != actor_)
            continue;
        node.pushed = 0; // of this pass: a second one, after contact between bodies, rubs with what it pushes
        const double into = -dot(minus(trialVelocity(row, node.i), node.velocity), node.normal);
        if (body_.separation && !(into > 0))
            continue;
        row.walls->open(std::size_t(row.end - row.begin));
        node.state = HeldNode::slips;
        node.pushed = into;
        give(row, node, times(into, node.normal), false);
        if (row.actors)
            row.actors[actor_].contacts += 1;
    }
}

template <int dim>
void BodyContact<dim>::rub(NodeRow<dim>& row) const
{
    HeldRow* held = body_.mu > 0 ? nodesOf(row) : nullptr;
    if (!held)
        return;
    for (auto& node : held->nodes)
    {
        if (node.actor != actor_ || !(node.pushed > 0))
            continue;
        const Vector3 r = minus(trialVelocity(row, node.i), node.velocity);
        const Vector3 slip = minus(r, times(dot(r, node.normal), node.normal));
        const double size = length(slip);
        const double keep = size > 0 ? std::max(0.0, 1 - body_.mu * node.pushed / size) : 0;
        if (keep == 0)
            node.state = HeldNode::sticks;
        give(row, node, times(keep - 1, slip), true);
    }
}

/// What the body has pushed moves with it along the normal, what sticks moves with it; nothing else moves into it.
template <int dim>
void BodyContact<dim>::follow(NodeRow<dim>& row) const
{
    for (const auto& held : *row.held)
        if (held.j == row.j && held.k == row.k)
            for (const auto& node : held.nodes)
            {
                if (node.actor != actor_)
                    continue;
                const Vector3 r = minus(trialVelocity(row, node.i), node.velocity);
                const double out = dot(r, node.normal);
                if (node.state == HeldNode::apart && out >= 0)
                    continue;
                for (int a = 0; a < dim; ++a)
                    row.node[node.i][row.trial + a] -=
                        node.state == HeldNode::sticks ? r[std::size_t(a)] : out * node.normal[std::size_t(a)];
            }
}

template class BodyContact<2>;
template class BodyContact<3>;
} // namespace mpm::nodal
