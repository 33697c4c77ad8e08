// Keys of particles: eight positions at a time give what the layout says of one.
#include "stepping/sortParticles.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace mpm;

namespace
{
/// The key as METHOD has it: of the first node of the support; of node 0 along axes on which a particle is lost.
Index expectedKey(const state::State& state, const state::TileLayout& layout, int supportNodes, std::size_t i)
{
    const auto& grid = state.grid;
    std::array<Index, 3> base{};
    for (int a = 0; a < grid.dim; ++a)
    {
        const double s = (state.particles.x[a][i] - grid.origin[a]) * (1 / grid.h);
        if (s > -1 && s < double(grid.cells[a] + 1))
            base[a] = Index(std::floor(s - 0.5 * (supportNodes - 2)));
    }
    return layout.key(base, layout.bodyOf(state.particles.material[i]));
}

state::State cloud(int dim, Index count)
{
    state::State s(dim);
    s.grid.h = 0.3;
    s.grid.origin = {-2, 1, -0.7};
    s.grid.cells = {100, 37, dim == 3 ? 21 : 1};
    auto& p = s.particles;
    p.resize(count);
    std::mt19937 random(unsigned(7 * count + dim));
    for (std::size_t i = 0; i < std::size_t(count); ++i)
    {
        for (int a = 0; a < dim; ++a)
        {
            const double low = s.grid.origin[a], length = s.grid.upper(a) - low;
            p.x[a][i] = std::uniform_real_distribution<double>(low - 0.2 * length, low + 1.2 * length)(random);
            if (i % 5 == 0) // at nodes and in the middle of cells
                p.x[a][i] = low + 0.5 * s.grid.h * double(random() % std::uint64_t(2 * s.grid.cells[a]));
        }
        p.id[i] = std::int64_t(i);
        p.material[i] = std::int32_t(random() % 3);
    }
    const double lost[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, std::numeric_limits<double>::max()};
    for (std::size_t n = 0; n < std::size(lost) && Index(n) < count; ++n)
        p.x[int(n) % dim][n] = lost[n];
    p.padLastChunk();
    return s;
}
} // namespace

TEST_CASE("keys of many particles are those of each, also of lost ones and of bodies")
{
    for (const int dim : {2, 3})
        for (const Index count : {1, 63, 64, 65, 1000})
            for (const bool bodies : {false, true})
                for (const int supportNodes : {2, 3, 4})
                {
                    CAPTURE(dim, count, bodies, supportNodes);
                    auto s = cloud(dim, count);
                    const state::TileLayout layout(s.grid, bodies ? std::vector<int>{1, 0, 1} : std::vector<int>{});
                    std::map<std::int64_t, Index> keys;
                    for (std::size_t i = 0; i < std::size_t(count); ++i)
                        keys[s.particles.id[i]] = expectedKey(s, layout, supportNodes, i);
                    stepping::sortByPosition(s, layout, supportNodes);
                    for (std::size_t i = 0; i < std::size_t(count); ++i)
                    {
                        CHECK(s.particles.sortKey[i] == keys.at(s.particles.id[i]));
                        CHECK((i == 0 || s.particles.sortKey[i] >= s.particles.sortKey[i - 1]));
                    }
                }
}

TEST_CASE("the largest mass is found wherever it is")
{
    state::Particles p(2);
    for (const Index count : {1, 7, 8, 9, 64, 71})
        for (Index heavy = 0; heavy < count; ++heavy)
        {
            p.resize(0);
            p.resize(count);
            for (Index i = 0; i < count; ++i)
                p.mass[std::size_t(i)] = i == heavy ? 3 : 1;
            p.padLastChunk();
            CHECK(stepping::largestMass(p) == 3);
        }
}
