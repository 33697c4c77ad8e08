#pragma once
/// Nodes in use. Particles are cut into a fixed number of contiguous slabs; each slab sums into its own window of node
/// records, and windows are added in slab order into the common window. Sums therefore do not depend on the number of
/// threads. Windows follow the material: memory and time go with the boxes around slabs, not with the grid's box.
#include "base/alignedVector.hpp"
#include "base/record.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <vector>

namespace mpm::state
{
/// A box of nodes: lattice indices lo .. lo + n - 1 an axis, x fastest.
struct NodeWindow
{
    std::array<Index, 3> lo{};
    std::array<Index, 3> n{};
    AlignedVector<Record> nodes;

    Index rows() const { return n[1] * n[2]; }
    Index offset(Index i, Index j, Index k) const { return ((k - lo[2]) * n[1] + (j - lo[1])) * n[0] + (i - lo[0]); }
    Record* row(Index j, Index k) { return nodes.data() + ((k - lo[2]) * n[1] + (j - lo[1])) * n[0]; }
    const Record* row(Index j, Index k) const { return nodes.data() + ((k - lo[2]) * n[1] + (j - lo[1])) * n[0]; }

    /// Covers [first, last] in every axis; memory only grows. Contents are undefined afterwards.
    void cover(const std::array<Index, 3>& first, const std::array<Index, 3>& last)
    {
        lo = first;
        for (int a = 0; a < 3; ++a)
            n[a] = std::max<Index>(0, last[a] - first[a] + 1);
        const std::size_t need = std::size_t(n[0] * n[1] * n[2]);
        if (nodes.size() < need)
            nodes.resize(need + need / 8);
    }
    void clear() { std::fill_n(nodes.data(), std::size_t(n[0] * n[1] * n[2]), Record{}); }
};

struct NodeGrid
{
    NodeWindow common;
    std::vector<NodeWindow> slabs;

    /// The range [begin, end) of lattice indices along x that any slab touches in row (j, k); empty if none does.
    std::pair<Index, Index> touched(Index j, Index k) const
    {
        Index begin = common.lo[0] + common.n[0], end = common.lo[0];
        for (const auto& s : slabs)
            if (s.n[0] > 0 && j >= s.lo[1] && j < s.lo[1] + s.n[1] && k >= s.lo[2] && k < s.lo[2] + s.n[2])
            {
                begin = std::min(begin, s.lo[0]);
                end = std::max(end, s.lo[0] + s.n[0]);
            }
        return {begin, std::max(begin, end)};
    }

    /// common row = sum of the slabs' rows, in slab order; zero where no slab reaches.
    void sumRow(Index j, Index k)
    {
        std::fill_n(common.row(j, k), std::size_t(common.n[0]), Record{});
        Record* out = common.row(j, k) - common.lo[0];
        for (const auto& s : slabs)
            if (s.n[0] > 0 && j >= s.lo[1] && j < s.lo[1] + s.n[1] && k >= s.lo[2] && k < s.lo[2] + s.n[2])
            {
                const Record* in = s.row(j, k) - s.lo[0];
                for (Index i = s.lo[0]; i < s.lo[0] + s.n[0]; ++i)
                    out[i] += in[i];
            }
    }

    /// The common window covers all slabs.
    void coverSlabs()
    {
        std::array<Index, 3> first{}, last{-1, -1, -1};
        bool any = false;
        for (const auto& s : slabs)
            if (s.n[0] > 0)
                for (int a = 0; a < 3; ++a)
                {
                    first[a] = any ? std::min(first[a], s.lo[a]) : s.lo[a];
                    last[a] = any ? std::max(last[a], s.lo[a] + s.n[a] - 1) : s.lo[a] + s.n[a] - 1;
                    any = any || a == 2;
                }
        common.cover(first, last);
    }
};
} // namespace mpm::state
