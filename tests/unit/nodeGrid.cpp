// Windows of nodes: sums over slabs, and nodes no slab reaches.
#include "state/nodeGrid.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

TEST_CASE("a summed window holds the slabs' nodes and zero everywhere else, whatever it held before")
{
    state::NodeGrid grid;
    grid.slabs.resize(3); // the last one stays empty
    grid.slabs[0].cover({-1, 0, 0}, {2, 1, 0});
    grid.slabs[1].cover({2, 1, 0}, {6, 3, 0});
    grid.slabs[2].cover({0, 0, 0}, {-1, 0, 0});
    for (auto& slab : grid.slabs)
        slab.clear();
    grid.slabs[0].row(1, 0)[3][0] = 1; // node (2, 1)
    grid.slabs[1].row(1, 0)[0][0] = 2; // the same
    grid.slabs[1].row(3, 0)[4][0] = 4; // node (6, 3)
    grid.coverSlabs();
    CHECK(grid.common.lo == std::array<Index, 3>{-1, 0, 0});
    CHECK(grid.common.n == std::array<Index, 3>{8, 4, 1});
    for (Record& node : grid.common.nodes)
        for (int lane = 0; lane < 8; ++lane)
            node[lane] = 1e9; // left there by an earlier step
    for (Index j = 0; j < 4; ++j)
        grid.sumRow(j, 0);
    for (Index j = 0; j < 4; ++j)
        for (Index i = -1; i < 7; ++i)
        {
            const double expected = i == 2 && j == 1 ? 3 : i == 6 && j == 3 ? 4 : 0;
            CHECK(grid.common.nodes[std::size_t(grid.common.offset(i, j, 0))][0] == expected);
        }
    CHECK(grid.touched(0, 0) == std::pair<Index, Index>(-1, 3));
    CHECK(grid.touched(1, 0) == std::pair<Index, Index>(-1, 7));
}

TEST_CASE("without particles there are no nodes")
{
    state::NodeGrid grid;
    grid.slabs.resize(2);
    for (auto& slab : grid.slabs)
    {
        slab.cover({0, 0, 0}, {-1, 0, 0});
        slab.clear();
    }
    grid.coverSlabs();
    CHECK(grid.common.rows() == 0);
}
