#pragma once
/// Shape weights N_ip of all particles at once. The solver never builds them; they serve sums over a stored state.
///
/// weightTable(state, "uGIMP") takes the weights of METHOD Eq. 4 from libmpm/shape. Nodes reach beyond the grid's box
/// where supports do (ghost nodes); they count like others, so that every row sums to one. Only nodes that a support
/// reaches are numbered, in the order z, y, x: memory follows the material, not its bounding box. Kept are the weights
/// along each axis, whose products are N_ip: with three nodes an axis 55 bytes a particle in 2D, 90 in 3D.
/// Throws InputError: unknown shape, no grid, particles outside the grid.
#include "state/state.hpp"

namespace mpm::smoothing
{
struct WeightTable
{
    int dim = 2;
    int nodesPerAxis = 2;           ///< 2, 3 or 4
    std::vector<std::int32_t> cell; ///< of each particle: which support it has
    std::vector<Index> rows;        ///< nodesPerAxis^(dim - 1) a support: the first node of each of its rows along x
    std::vector<double> weight;     ///< dim nodesPerAxis a particle: weights along x, then y, then z
    std::vector<Vector3> position;  ///< of the nodes [m]
    /// Nodes that are one across a periodic side, in groups of two and more.
    std::vector<std::vector<Index>> images;

    Index particles() const { return Index(cell.size()); }
    Index nodes() const { return Index(position.size()); }

    /// Sums over particles at nodes: those of one node with several images are added.
    template <class Value>
    void joinImages(std::vector<Value>& sums) const
    {
        for (const auto& group : images)
        {
            Value total = sums[std::size_t(group.front())];
            for (std::size_t k = 1; k < group.size(); ++k)
                add(total, sums[std::size_t(group[k])]);
            for (const Index node : group)
                sums[std::size_t(node)] = total;
        }
    }

    /// Calls visit(node, weight) for the nodes of particle p, x fastest; zero weights are left out.
    template <class Visitor>
    void visitNodes(Index p, Visitor&& visit) const
    {
        if (nodesPerAxis == 2)
            visitRows<2>(p, visit);
        else if (nodesPerAxis == 3)
            visitRows<3>(p, visit);
        else
            visitRows<4>(p, visit);
    }

  private:
    static void add(double& to, double value) { to += value; }
    template <std::size_t width>
    static void add(std::array<double, width>& to, const std::array<double, width>& values)
    {
        for (std::size_t c = 0; c < width; ++c)
            to[c] += values[c];
    }
    template <int n, class Visitor>
    void visitRows(Index p, Visitor& visit) const
    {
        const int layers = dim == 3 ? n : 1;
        const double* x = weight.data() + p * dim * n;
        const Index* row = rows.data() + Index(cell[std::size_t(p)]) * n * layers;
        for (int k = 0; k < layers; ++k)
            for (int j = 0; j < n; ++j, ++row)
                for (int i = 0; i < n; ++i)
                {
                    double w = x[i] * x[n + j];
                    if (dim == 3)
                        w *= x[2 * n + k];
                    if (w != 0)
                        visit(std::size_t(*row + i), w);
                }
    }
};

/// Words of the shapes, those of mpmSchemes. Smoothing with CPDI takes the boxes of cpGIMP around its domains.
const std::vector<std::string>& shapeNames();

WeightTable weightTable(const state::State& state, const std::string& shape);
} // namespace mpm::smoothing
