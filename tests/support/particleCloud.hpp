#pragma once
/// A chunk of random particles and its weights, for tests of the transfer between particles and nodes.
#include "shape/cpGIMP.hpp"
#include "shape/linear.hpp"
#include "shape/quadraticBSpline.hpp"
#include "shape/uGIMP.hpp"
#include "transfer/chunkColumns.hpp"
#include "transfer/chunkWeights.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace mpm::test
{
using LatticeNode = std::array<Index, 3>;

/// Position of sigma_ab in storage.
template <int dim>
inline int component(int a, int b)
{
    constexpr int in2D[2][2] = {{0, 3}, {3, 1}}, in3D[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    if constexpr (dim == 2)
        return in2D[a][b];
    else
        return in3D[a][b];
}

/// Up to a chunk of random particles in two by two (by one) cells, in the order of their first nodes, in the lanes as
/// a step loads them.
template <int dim, class Shape>
struct Cloud
{
    state::GridBox grid;
    state::NodeBox window;
    int count;
    alignas(64) double x[dim][lanes], half[dim][lanes], v[dim][lanes], mass[lanes], volume[lanes];
    alignas(64) double stress[stressSize<dim>][lanes], b[3][lanes];
    transfer::ChunkWeights<dim, Shape> w;

    Cloud(int particles, double lowHalf, double highHalf) : count(particles)
    {
        grid = {dim, {-0.7, 0.4, 1.1}, 0.3, {12, 12, dim == 3 ? 12 : 1}};
        window = {{1, 2, dim == 3 ? 2 : 0}, {9, 7, dim == 3 ? 8 : 1}};
        std::mt19937 random{unsigned(particles)};
        const auto numbers = [&](double low, double high) {
            std::uniform_real_distribution<double> number(low, high);
            std::vector<double> column(std::size_t(particles), 0.0);
            for (double& value : column)
                value = number(random);
            return column;
        };
        placeParticles(random);
        for (auto& column : half)
            transfer::loadLanes(numbers(lowHalf, highHalf).data(), count, column);
        for (auto& column : v)
            transfer::loadLanes(numbers(-3, 5).data(), count, column);
        for (auto& column : stress)
            transfer::loadLanes(numbers(-30e3, 10e3).data(), count, column);
        for (auto& column : b)
            transfer::loadLanes(numbers(-10, 10).data(), count, column);
        transfer::loadLanesOrZero(numbers(10, 40).data(), count, mass);
        transfer::loadLanesOrZero(numbers(0.01, 0.02).data(), count, volume);
        w.evaluate(x, half, grid, {{{5}, {5}, {}}}); // walls between the cells, for shapes that know them
        REQUIRE(w.locate(window));
    }

    void placeParticles(std::mt19937& random)
    {
        std::vector<std::array<double, dim>> places(std::size_t(count), std::array<double, dim>{});
        std::uniform_real_distribution<double> number(0, 1);
        for (auto& place : places)
            for (int a = 0; a < dim; ++a)
                place[a] = grid.origin[a] + grid.h * (4 + (a < 2 ? 2 : 1) * number(random));
        const auto first = [&](const std::array<double, dim>& place) {
            std::array<std::int32_t, dim> slowestFirst;
            for (int a = 0; a < dim; ++a)
                slowestFirst[dim - 1 - a] = shape::firstNode<Shape::nodes>(place[a], grid.origin[a], 1 / grid.h);
            return slowestFirst;
        };
        std::sort(places.begin(), places.end(), [&](auto& p, auto& q) { return first(p) < first(q); });
        for (int a = 0; a < dim; ++a)
        {
            std::vector<double> column;
            for (const auto& place : places)
                column.push_back(place[a]);
            transfer::loadLanes(column.data(), count, x[a]);
        }
    }

    int runs() const
    {
        int number = 1;
        for (int l = 1; l < count; ++l)
            number += w.offset[l] != w.offset[l - 1];
        return number;
    }

    bool reaches(int l, const LatticeNode& node) const
    {
        for (int a = 0; a < dim; ++a)
            if (node[a] < w.axis[a].base[l] || node[a] >= w.axis[a].base[l] + Shape::nodes)
                return false;
        return true;
    }
    /// N_ip.
    double weight(int l, const LatticeNode& node) const
    {
        double N = reaches(l, node) ? 1 : 0;
        for (int a = 0; a < dim && N != 0; ++a)
            N *= w.axis[a].N[node[a] - w.axis[a].base[l]][l];
        return N;
    }
    /// dN_ip/dx_b.
    double slope(int l, const LatticeNode& node, int b) const
    {
        if (!reaches(l, node))
            return 0;
        double G = 1;
        for (int a = 0; a < dim; ++a)
        {
            const Index n = node[a] - w.axis[a].base[l];
            G *= a == b ? w.axis[a].G[n][l] : w.axis[a].N[n][l];
        }
        return G;
    }

    /// body(node, number of the node in the window)
    template <class Body>
    void forNodes(Body&& body) const
    {
        Index at = 0;
        for (Index k = window.lo[2]; k < window.lo[2] + window.n[2]; ++k)
            for (Index j = window.lo[1]; j < window.lo[1] + window.n[1]; ++j)
                for (Index i = window.lo[0]; i < window.lo[0] + window.n[0]; ++i)
                    body(LatticeNode{i, j, k}, at++);
    }
};

/// Checks every shape: for each the chunk full, ragged, and of one particle; check(cloud).
template <int dim, class Check>
void forShapes(Check&& check)
{
    for (const int count : {64, 37, 1})
    {
        CAPTURE(dim, count);
        check(Cloud<dim, shape::Linear>(count, 0.1, 0.5));
        check(Cloud<dim, shape::UGIMP>(count, 0.1, 0.5));
        check(Cloud<dim, shape::QuadraticBSpline>(count, 0.1, 0.5));
        check(Cloud<dim, shape::CpGIMP>(count, 0.1, 0.5));
        check(Cloud<dim, shape::CpGIMP>(count, 0.5, 1)); // wider than a cell
    }
}
} // namespace mpm::test
