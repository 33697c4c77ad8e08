#pragma once
/// Shape weights N_ip of all particles at once, row by row (compressed rows): particle p has the entries
/// start[p] ... start[p + 1] - 1. The solver never builds it; it serves sums over a stored state.
///
/// weightTable(state, "uGIMP") takes the weights of METHOD Eq. 4 from libmpm/shape. Nodes reach beyond the grid's box
/// where supports do (ghost nodes); they count like others, so that every row sums to one.
/// Throws InputError: unknown shape, no grid, particles outside the grid.
#include "state/state.hpp"

namespace mpm::smoothing
{
struct WeightTable
{
    std::vector<Index> start{0};
    std::vector<Index> node;
    std::vector<double> weight;
    std::vector<Vector3> position; ///< of the nodes [m]

    Index particles() const { return Index(start.size()) - 1; }
    Index nodes() const { return Index(position.size()); }

    /// Appends an entry to the row under way; zero weights are left out.
    void add(Index nodeIndex, double nodeWeight)
    {
        if (nodeWeight == 0)
            return;
        node.push_back(nodeIndex);
        weight.push_back(nodeWeight);
    }
    void endRow() { start.push_back(Index(node.size())); }

    /// Calls visit(node, weight) for the nodes of particle p.
    template <class Visitor>
    void visitNodes(Index p, Visitor&& visit) const
    {
        for (Index k = start[std::size_t(p)]; k < start[std::size_t(p) + 1]; ++k)
            visit(std::size_t(node[std::size_t(k)]), weight[std::size_t(k)]);
    }
};

/// Words of the shapes: linear, uGIMP, cpGIMP.
const std::vector<std::string>& shapeNames();

WeightTable weightTable(const state::State& state, const std::string& shape);
} // namespace mpm::smoothing
