#include "nodal/contact.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
namespace
{
template <int dim>
Vector3 lanesOf(const Record& r, int first)
{
    Vector3 v{};
    for (int a = 0; a < dim; ++a)
        v[a] = r[first + a];
    return v;
}

Vector3 across(const Vector3& d, const Vector3& n)
{
    const double along = dot(d, n);
    return {d[0] - along * n[0], d[1] - along * n[1], d[2] - along * n[2]};
}

/// Takes the impulse J from one node and gives it to another.
template <int dim>
void exchange(Record& one, Record& other, const Vector3& inverse, const Vector3& J)
{
    for (int a = 0; a < dim; ++a)
    {
        one[1 + dim + a] -= inverse[0] * J[a];
        other[1 + dim + a] += inverse[1] * J[a];
    }
}
} // namespace

template <int dim>
void Contact<dim>::arrange(const state::TileGrid& nodes)
{
    boxes_.clear();
    shared_.assign(nodes.blocks().size(), 0);
    for (const auto& sharing : nodes.sharedBoxes())
    {
        boxes_.push_back({sharing, {}});
        for (const Index b : sharing)
            shared_[std::size_t(b)] = 1;
    }
    blocks_.clear();
    for (std::size_t b = 0; b < shared_.size(); ++b)
        if (shared_[b])
            blocks_.push_back(Index(b));
    const auto& last = nodes.blocks().empty() ? state::Block{} : nodes.blocks().back();
    impulse_.assign(last.start + std::size_t(last.box.size()), {});
}

/// 1/m_1, 1/m_2 and the reduced mass.
template <int dim>
Vector3 Contact<dim>::inverseMasses(const Record* records, const Pair& pair)
{
    Vector3 out{};
    for (std::size_t s = 0; s < 2; ++s)
        out[s] = pair.rigid[s] ? 0 : 1 / records[pair.place[s]][0];
    out[2] = 1 / (out[0] + out[1]);
    return out;
}

template <int dim>
void Contact<dim>::place(double time, double dt)
{
    drivenFor_ = dt;
    poses_.resize(properties_.motion.size());
    for (std::size_t b = 0; b < poses_.size(); ++b)
        if (const auto& motion = properties_.motion[b])
            poses_[b] = {motion->pose(time), motion->pose(time + dt)};
}

template <int dim>
void Contact<dim>::drive(NodeRow<dim>& row, const state::GridBox& grid) const
{
    const auto& [from, to] = poses_[std::size_t(row.body)];
    for (Index i = row.begin; i < row.end; ++i)
    {
        const Index node[3] = {i, row.j, row.k};
        Vector3 arm{}, body{};
        for (std::size_t a = 0; a < dim; ++a)
            arm[a] = grid.origin[a] + grid.h * double(node[a]) - from.position[a];
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                body[a] += from.rotation[3 * b + a] * arm[b];
        for (std::size_t a = 0; a < dim; ++a)
        {
            double end = to.position[a] - from.position[a] - arm[a];
            for (std::size_t b = 0; b < 3; ++b)
                end += to.rotation[3 * a + b] * body[b];
            row.node[i][row.trial + int(a)] = row.carries(i) ? end / drivenFor_ : 0;
        }
    }
}

template <int dim>
void Contact<dim>::followDrive(NodeRow<dim>& row)
{
    for (Index i = row.begin; i < row.end; ++i)
        for (int a = 0; a < dim; ++a)
            row.node[i][row.trial + a] = row.node[i][row.velocity + a];
}

template <int dim>
void Contact<dim>::bookDrive(NodeRow<dim>& row)
{
    for (Index i = row.begin; i < row.end; ++i)
        for (int a = 0; a < dim && row.carries(i); ++a)
        {
            const Record& r = row.node[i];
            const double before = r[row.velocity + a], after = r[row.trial + a];
            const double force = row.dt * (*row.projected)[std::size_t(i - row.begin)][row.trial + a];
            const double J = r[0] * (after - before) - force - (row.contact ? row.contact[i][a] : 0);
            row.sums->motionWork += 0.5 * J * (before + after);
            row.sums->wallImpulse[std::size_t(a)] += J;
        }
}

template <int dim>
void Contact<dim>::push(state::TileGrid& nodes, double dt)
{
    dt_ = dt;
    forEachBox([&](Box& box) {
        for (const Index b : box.blocks)
        {
            const auto& block = nodes.blocks()[std::size_t(b)];
            std::fill_n(impulse_.begin() + std::ptrdiff_t(block.start), block.box.size(), Vector3{});
        }
        for (std::size_t from = 0, to = 0; from < box.pairs.size(); from = to)
        {
            while (to < box.pairs.size() && box.pairs[to].node == box.pairs[from].node)
                ++to;
            solve(nodes.place(0), dt, box.pairs.data() + from, box.pairs.data() + to);
        }
    });
}

/// The pairs at one node.
template <int dim>
void Contact<dim>::solve(Record* records, double dt, Pair* begin, Pair* end)
{
    constexpr int mostRounds = 50;
    for (Pair* p = begin; p < end; ++p)
    {
        p->push = 0;
        p->rub = {};
        p->sticks = false;
    }
    for (int round = 0; round < mostRounds; ++round)
    {
        double change = 0, scale = 0;
        for (Pair* p = begin; p < end; ++p)
        {
            Record &one = records[p->place[0]], &other = records[p->place[1]];
            const Vector3 inverse = inverseMasses(records, *p);
            const double reduced = inverse[2];
            const Vector3 u = lanesOf<dim>(one, 1 + dim), v = lanesOf<dim>(other, 1 + dim);
            const Vector3 d{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
            const double before = p->push;
            p->push = std::max(0.0, before + reduced * (dot(d, p->n) - std::max(p->gap, 0.0) / dt));
            const Vector3 slip = across(d, p->n), rubbed = p->rub;
            for (int a = 0; a < dim; ++a)
                p->rub[a] += reduced * slip[a];
            const double needed = std::sqrt(dot(p->rub, p->rub)), most = p->mu * p->push;
            p->sticks = p->push > 0 && needed <= most;
            if (needed > most)
                for (int a = 0; a < dim; ++a)
                    p->rub[a] *= most / needed;
            Vector3 J{};
            for (int a = 0; a < dim; ++a)
                J[a] = (p->push - before) * p->n[a] + p->rub[a] - rubbed[a];
            exchange<dim>(one, other, inverse, J);
            for (int a = 0; a < dim; ++a)
            {
                impulse_[std::size_t(p->place[0])][a] -= J[a];
                impulse_[std::size_t(p->place[1])][a] += J[a];
            }
            change = std::max(change, std::sqrt(dot(J, J)));
            scale = std::max(scale, p->push);
        }
        if (end - begin == 1 || !(change > 1e-12 * scale))
            break;
    }
}

template <int dim>
void Contact<dim>::follow(state::TileGrid& nodes, int layer) const
{
    Record* records = nodes.place(layer);
    const auto one = [&](const Pair& p) {
        Record &r = records[p.place[0]], &s = records[p.place[1]];
        const Vector3 u = lanesOf<dim>(r, 1 + dim), v = lanesOf<dim>(s, 1 + dim);
        const Vector3 uStar = lanesOf<dim>(r, 1), vStar = lanesOf<dim>(s, 1);
        const Vector3 d{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
        const Vector3 star{uStar[0] - vStar[0], uStar[1] - vStar[1], uStar[2] - vStar[2]};
        const double open = std::max(p.gap, 0.0) / dt_;
        const double excess = dot(d, p.n) - (p.push > 0 ? dot(star, p.n) : open);
        Vector3 J{};
        const Vector3 inverse = inverseMasses(records, p);
        const double reduced = inverse[2];
        if (p.push > 0 || excess > 0)
            for (int a = 0; a < dim; ++a)
                J[a] = reduced * excess * p.n[a];
        if (p.sticks)
        {
            const Vector3 slip = across({d[0] - star[0], d[1] - star[1], d[2] - star[2]}, p.n);
            for (int a = 0; a < dim; ++a)
                J[a] += reduced * slip[a];
        }
        exchange<dim>(r, s, inverse, J);
    };
    const int count = int(boxes_.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int b = 0; b < count; ++b)
        for (const Pair& p : boxes_[std::size_t(b)].pairs)
            one(p);
}

template <int dim>
ContactSums Contact<dim>::book(const state::TileGrid& nodes, const std::vector<Record>& projected, double dt) const
{
    ContactSums sums;
    const Record* records = nodes.place(0);
    for (const Box& box : boxes_)
        for (const Pair& p : box.pairs)
        {
            if (!(p.push > 0))
                continue;
            const Record &r = records[p.place[0]], &s = records[p.place[1]];
            const Vector3 inverse = inverseMasses(records, p);
            const double slipping = dot(p.rub, p.rub);
            double work = 0, friction = 0;
            Vector3 d{}, change{}, force{}; // of the difference: v*, v_i - v*; the force that drives it
            for (int a = 0; a < dim; ++a)
            {
                d[a] = r[1 + a] - s[1 + a];
                change[a] = -dt * (r[1 + dim + a] - s[1 + dim + a]);
                force[a] = inverse[2] * (inverse[0] * projected[std::size_t(p.place[0])][1 + dim + a] -
                                         inverse[1] * projected[std::size_t(p.place[1])][1 + dim + a]);
                work -= (p.push * p.n[a] + p.rub[a]) * (d[a] + 0.5 * change[a]);
                friction += p.rub[a] * d[a];
            }
            const double along = dot(change, p.n) * dot(force, p.n);
            const double held = dt * (slipping > 0 ? dot(change, force) : along);
            sums.held += held;
            sums.friction += friction;
            sums.loss -= work + 0.5 * held + friction;
            ++sums.nodes;
        }
    return sums;
}

template class Contact<2>;
template class Contact<3>;
} // namespace mpm::nodal
