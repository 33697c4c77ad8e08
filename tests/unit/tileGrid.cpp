// Tiles of particles and blocks of nodes: keys, windows, sums in the order of the tiles, nothing where nothing is.
#include "state/tileGrid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace mpm;

TEST_CASE("keys name their node, sort by tile first, and tiles are boxes of nodes")
{
    for (const int dim : {2, 3})
    {
        const state::GridBox grid{dim, {0, 0, 0}, 0.5, {70, 33, dim == 3 ? 20 : 1}};
        const state::TileLayout layout(grid);
        const Index side = Index(1) << layout.bits();
        std::mt19937 random(5);
        for (int n = 0; n < 2000; ++n)
        {
            std::array<Index, 3> a{}, b{};
            for (int axis = 0; axis < dim; ++axis)
            {
                std::uniform_int_distribution<Index> place(-3, grid.cells[axis] + 2);
                a[axis] = place(random);
                b[axis] = place(random);
            }
            CHECK(layout.base(layout.key(a)) == a);
            CHECK(layout.base(layout.key(a) + state::looseKey) == a);
            bool same = true;
            for (int axis = 0; axis < dim; ++axis)
                same = same && std::floor(double(a[axis]) / double(side)) == std::floor(double(b[axis]) / double(side));
            CHECK((layout.tile(layout.key(a)) == layout.tile(layout.key(b))) == same);
        }
    }
}

namespace
{
/// Particles at the given first nodes, sorted by their keys.
state::Particles particlesAt(const state::TileLayout& layout, const std::vector<std::array<Index, 3>>& bases)
{
    state::Particles p(layout.dim());
    p.resize(Index(bases.size()));
    std::vector<Index> keys;
    for (const auto& base : bases)
        keys.push_back(layout.key(base));
    std::sort(keys.begin(), keys.end());
    std::copy(keys.begin(), keys.end(), p.sortKey.begin());
    return p;
}
} // namespace

TEST_CASE("blocks sum every window that reaches them, and windows read back what blocks hold")
{
    const state::GridBox grid{2, {0, 0, 0}, 1, {100, 40, 1}};
    const int bits = GENERATE(4, 5);
    const state::TileLayout layout(grid, {}, bits);
    const auto p = particlesAt(layout, {{0, 0, 0}, {15, 15, 0}, {16, 15, 0}, {17, 3, 0}, {31, 20, 0}, {90, 38, 0}});
    state::TileGrid nodes;
    nodes.build(p, layout, 0, 2);
    REQUIRE(nodes.tiles().size() == (bits == 4 ? 4 : 2));
    Index particles = 0;
    for (const auto& tile : nodes.tiles())
    {
        CHECK(tile.first == particles);
        particles += tile.count;
        for (Index n = 0; n < tile.window.size(); ++n) // every window holds 1 at each of its nodes
            nodes.window<Record>(tile)[n] = splat<Record>(1);
    }
    CHECK(particles == p.size());
    for (const auto& block : nodes.blocks())
        for (Index j = block.box.lo[1]; j < block.box.lo[1] + block.box.n[1]; ++j)
        {
            std::vector<double> sum(std::size_t(block.box.n[0]), 0.0);
            Index last = -1;
            nodes.forEachWindow<Record>(block, j, 0, [&](Index i0, Index i1, const Record* in) {
                for (Index i = i0; i < i1; ++i)
                    sum[std::size_t(i - block.box.lo[0])] += in[i - i0][3];
            });
            for (const auto& overlap : block.tiles)
            {
                CHECK(overlap.tile > last);
                last = overlap.tile;
            }
            for (Index i = block.box.lo[0]; i < block.box.lo[0] + block.box.n[0]; ++i)
            {
                double expected = 0;
                for (const auto& tile : nodes.tiles())
                    expected += tile.window.contains(i, j, 0);
                CHECK(sum[std::size_t(i - block.box.lo[0])] == expected);
                Record* node = nodes.find(i, j, 0);
                REQUIRE(node != nullptr);
                (*node)[0] = double(1000 * j + i);
            }
        }
    for (const auto& tile : nodes.tiles())
    {
        std::vector<double> seen(std::size_t(tile.window.size()), -1);
        nodes.copyToWindow(tile, seen.data(), [](const Record& r) { return r[0]; });
        for (Index j = tile.window.lo[1]; j < tile.window.lo[1] + tile.window.n[1]; ++j)
            for (Index i = tile.window.lo[0]; i < tile.window.lo[0] + tile.window.n[0]; ++i)
                CHECK(seen[std::size_t(tile.window.offset(i, j, 0))] == double(1000 * j + i));
    }
    CHECK(nodes.find(60, 10, 0) == nullptr);
    CHECK(nodes.find(-30, 500, 0) == nullptr);
}

TEST_CASE("beyond its reach a window is neither summed nor copied, and any record that is not zero widens the reach")
{
    const auto check = [](auto record, int dim) {
        using R = decltype(record);
        const state::GridBox grid{dim, {0, 0, 0}, 1, {60, 40, dim == 3 ? 40 : 1}};
        const state::TileLayout layout(grid);
        state::TileGrid nodes;
        nodes.build(particlesAt(layout, {{3, 2, 0}, {30, 20, 0}, {37, 29, 0}}), layout, 0, 2);
        for (const auto& tile : nodes.tiles())
        {
            nodes.clearWindow<R>(tile);
            CHECK(tile.reach.n == tile.window.n);
            const auto at = [&](Index i, Index j) -> R& {
                return nodes.window<R>(tile)[tile.window.offset(tile.window.lo[0] + i, tile.window.lo[1] + j,
                                                                tile.window.lo[2] + (dim == 3))];
            };
            at(1, 2)[3] = 1e-300; // no mass, but a force or momentum
            at(tile.window.n[0] - 2, 1)[0] = 2;
            nodes.findReach<R>(tile);
            CHECK(tile.reach.lo[0] == tile.window.lo[0] + 1);
            CHECK(tile.reach.n[0] == tile.window.n[0] - 2);
            CHECK(tile.reach.lo[1] == tile.window.lo[1] + 1);
            CHECK(tile.reach.n[1] == 2);
            CHECK(tile.reach.n[2] == 1);
            CHECK(tile.reach.lo[2] == tile.window.lo[2] + (dim == 3));
        }
        double summed = 0, held = 0;
        Index visited = 0, reached = 0;
        for (const auto& block : nodes.blocks())
            for (Index k = block.box.lo[2]; k < block.box.lo[2] + block.box.n[2]; ++k)
                for (Index j = block.box.lo[1]; j < block.box.lo[1] + block.box.n[1]; ++j)
                    nodes.forEachWindow<R>(block, j, k, [&](Index i0, Index i1, const R* in) {
                        visited += i1 - i0;
                        for (Index i = i0; i < i1; ++i)
                            summed += in[i - i0][0] + in[i - i0][3];
                    });
        for (const auto& block : nodes.blocks())
            for (Index n = 0; n < block.box.size(); ++n)
                nodes.nodes(block)[n] = splat<Record>(5);
        for (const auto& tile : nodes.tiles())
        {
            reached += tile.reach.size();
            held += 2 + 1e-300;
            std::vector<double> part(std::size_t(tile.window.size()), -1), whole = part;
            const auto first = [](const Record& r) { return r[0]; };
            nodes.copyToWindow(tile, part.data(), first, 0, true);
            nodes.copyToWindow(tile, whole.data(), first);
            const Index copied = tile.window.n[0] * tile.reach.n[1] * tile.reach.n[2]; // whole rows
            CHECK(std::count(part.begin(), part.end(), 5) == copied);
            CHECK(std::count(part.begin(), part.end(), 0) == tile.window.size() - copied);
            CHECK(std::count(whole.begin(), whole.end(), 5) == tile.window.size());
            for (Index j = tile.reach.lo[1]; j < tile.reach.lo[1] + tile.reach.n[1]; ++j)
                CHECK(part[std::size_t(tile.window.offset(tile.reach.lo[0], j, tile.reach.lo[2]))] == 5);
        }
        CHECK(visited == reached);
        CHECK(summed == held);
    };
    check(Record{}, 2);
    check(HalfRecord{}, 2);
    check(Record{}, 3);
    check(HalfRecord{}, 3);
}

TEST_CASE("a window leaves a cell for motion around the support of its particles")
{
    const state::GridBox grid{3, {0, 0, 0}, 1, {50, 50, 50}};
    const state::TileLayout layout(grid);
    const auto p = particlesAt(layout, {{9, 10, 11}, {12, 10, 15}});
    state::TileGrid nodes;
    nodes.build(p, layout, 1, 3);
    REQUIRE(nodes.tiles().size() == 1);
    const auto& window = nodes.tiles()[0].window;
    CHECK(window.lo == std::array<Index, 3>{7, 8, 9});
    CHECK(window.n == std::array<Index, 3>{10, 7, 11});
}

TEST_CASE("memory follows the particles, not the box of the grid")
{
    const auto bytes = [](Index cells) {
        const state::GridBox grid{2, {0, 0, 0}, 1, {cells, cells, 1}};
        const state::TileLayout layout(grid);
        const auto p = particlesAt(layout, {{1, 1, 0}, {cells - 3, cells - 3, 0}});
        state::TileGrid nodes;
        nodes.build(p, layout, 0, 2);
        return nodes.bytes();
    };
    CHECK(bytes(100000) == bytes(100));
}

TEST_CASE("without particles there are no nodes")
{
    const state::GridBox grid{2, {0, 0, 0}, 1, {10, 10, 1}};
    state::TileGrid nodes;
    CHECK(nodes.find(0, 0, 0) == nullptr);
    nodes.build(state::Particles(2), state::TileLayout(grid), 0, 2);
    CHECK(nodes.tiles().empty());
    CHECK(nodes.blocks().empty());
    CHECK(nodes.find(0, 0, 0) == nullptr);
}
