#pragma once
/// Nodes of the naive step: one dense box around the particles, renewed every step. See naiveStepper.hpp.
#include "nodal/boundaries.hpp"
#include "state/gridBox.hpp"
#include "stepping/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mpm::benchmark
{
template <int dim>
struct Node
{
    double mass, momentum[dim], force[dim], velocity[dim], acceleration[dim], strainVelocity[dim];
    double pushed[dim]; ///< normal velocity each axis' walls took away
};

template <int dim>
class NaiveNodes
{
  public:
    explicit NaiveNodes(const state::GridBox& grid) : grid_(grid) {}

    Node<dim>& at(Index i, Index j, Index k)
    {
        return nodes_[std::size_t(((k - low_[2]) * count_[1] + (j - low_[1])) * count_[0] + (i - low_[0]))];
    }

    /// The box of cells that holds the particles, three nodes wider on each side.
    template <class Particles>
    void cover(const Particles& particles)
    {
        std::size_t size = 1;
        for (int a = 0; a < dim; ++a)
        {
            const auto place = [a](const auto& p, const auto& q) { return p.x[a] < q.x[a]; };
            const auto [low, high] = std::minmax_element(particles.begin(), particles.end(), place);
            low_[a] = Index(std::floor((low->x[a] - grid_.origin[a]) / grid_.h)) - 3;
            count_[a] = Index(std::floor((high->x[a] - grid_.origin[a]) / grid_.h)) + 4 - low_[a];
            size *= std::size_t(count_[a]);
        }
        nodes_.resize(size);
    }

    /// Before a projection; the second one of MUSL keeps masses, velocities and accelerations.
    void clear(bool mass, bool forces)
    {
        for (auto& node : nodes_)
        {
            if (mass)
                node.mass = 0;
            for (int a = 0; a < dim; ++a)
            {
                node.momentum[a] = 0;
                if (forces)
                    node.force[a] = 0;
            }
        }
    }

    /// v* and a from mass, momentum and force, gravity and walls.
    void solve(double dt, const stepping::Scene& scene)
    {
        for (auto& node : nodes_)
            for (int a = 0; a < dim; ++a)
            {
                node.acceleration[a] = node.mass > 0 ? node.momentum[a] / node.mass : 0; // v_i for now
                node.velocity[a] = node.acceleration[a];
                if (node.mass > 0)
                    node.velocity[a] += dt * node.force[a] / node.mass + (scene.gravity ? dt * (*scene.gravity)[a] : 0);
            }
        applyWalls(scene.walls);
        for (auto& node : nodes_)
            for (int a = 0; a < dim; ++a)
                node.acceleration[a] = (node.velocity[a] - node.acceleration[a]) / dt;
    }

    /// The projected velocity, held where walls hold that of solve().
    void strainVelocities(const std::vector<nodal::Wall>& walls)
    {
        for (auto& node : nodes_)
            for (int a = 0; a < dim; ++a)
                node.strainVelocity[a] = node.mass > 0 ? node.momentum[a] / node.mass : 0;
        for (const auto& wall : walls)
            forEachBehind(wall, [&](Node<dim>& node) {
                auto& w = node.strainVelocity;
                const bool sticks = wall.type != nodal::WallType::roller &&
                                    (wall.type == nodal::WallType::fixed || wall.mu > 0) &&
                                    std::all_of(node.velocity, node.velocity + dim, [](double v) { return v == 0; });
                for (int a = 0; a < dim; ++a)
                    if (sticks || (a == wall.axis && (node.velocity[a] == 0 || wall.side * w[a] > 0)))
                        w[a] = 0;
            });
    }

    void strainVelocitiesAreNew()
    {
        for (auto& node : nodes_)
            std::copy_n(node.velocity, dim, node.strainVelocity);
    }

  private:
    /// Calls visit(node) for the nodes on and behind a wall.
    template <class Visit>
    void forEachBehind(const nodal::Wall& wall, const Visit& visit)
    {
        for (Index k = low_[2]; k < low_[2] + count_[2]; ++k)
            for (Index j = low_[1]; j < low_[1] + count_[1]; ++j)
                for (Index i = low_[0]; i < low_[0] + count_[0]; ++i)
                {
                    const Index place[3] = {i, j, k};
                    if (wall.side * (place[wall.axis] - wall.plane) >= 0)
                        visit(at(i, j, k));
                }
    }

    void applyWalls(const std::vector<nodal::Wall>& walls)
    {
        for (auto& node : nodes_)
            std::fill_n(node.pushed, dim, 0.0);
        for (const auto& wall : walls)
            forEachBehind(wall, [&](Node<dim>& node) {
                auto& u = node.velocity;
                if (wall.separation && !(wall.side * u[wall.axis] > 0))
                    return;
                for (int a = 0; a < dim; ++a)
                    if (a == wall.axis || wall.type == nodal::WallType::fixed)
                    {
                        node.pushed[a] += u[a];
                        u[a] = 0;
                    }
            });
        for (const auto& wall : walls)
            if (wall.type == nodal::WallType::friction)
                forEachBehind(wall,
                              [&](Node<dim>& node) { rub(wall, node.pushed[wall.axis] * wall.side, node.velocity); });
    }

    static void rub(const nodal::Wall& wall, double into, double (&u)[dim])
    {
        if (!(into > 0))
            return;
        double square = 0;
        for (int a = 0; a < dim; ++a)
            square += a == wall.axis ? 0 : u[a] * u[a];
        const double keep = square > 0 ? std::max(0.0, 1 - wall.mu * into / std::sqrt(square)) : 0;
        for (int a = 0; a < dim; ++a)
            u[a] *= a == wall.axis ? 1 : keep;
    }

    const state::GridBox grid_;
    std::array<Index, 3> low_{}, count_{1, 1, 1};
    std::vector<Node<dim>> nodes_;
};
} // namespace mpm::benchmark
