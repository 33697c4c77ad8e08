// The order of particles in memory against std::sort, for everything a run may hand over.
#include "state/particleOrder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace mpm;

namespace
{
/// Particles with these keys, unique ids in random order, and columns that tell who is who.
state::Particles particles(const std::vector<std::int64_t>& keys, unsigned seed)
{
    state::Particles p(2);
    p.resize(Index(keys.size()));
    std::vector<std::int64_t> ids(keys.size());
    std::iota(ids.begin(), ids.end(), 0);
    std::shuffle(ids.begin(), ids.end(), std::mt19937(seed));
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
        p.sortKey[i] = keys[i];
        p.id[i] = ids[i];
        p.x[0][i] = double(ids[i]);
        p.F[3][i] = 2.0 * double(ids[i]);
        p.mass[i] = 1;
        p.generation[i] = std::int32_t(ids[i] % 7);
    }
    p.padLastChunk();
    return p;
}

using Pair = std::pair<std::int64_t, std::int64_t>;

std::vector<Pair> pairs(const state::Particles& p)
{
    std::vector<Pair> out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        out.emplace_back(p.sortKey[i], p.id[i]);
    return out;
}

void requireSorts(state::Particles p)
{
    auto expected = pairs(p);
    const bool sorted = std::is_sorted(expected.begin(), expected.end());
    std::sort(expected.begin(), expected.end());
    REQUIRE(state::sortByKeyAndId(p) != sorted);
    REQUIRE(pairs(p) == expected);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        REQUIRE(p.x[0][i] == double(p.id[i]));
        REQUIRE(p.F[3][i] == 2.0 * double(p.id[i]));
        REQUIRE(p.generation[i] == std::int32_t(p.id[i] % 7));
    }
    const auto n = std::size_t(p.size());
    for (std::size_t i = n; i < p.mass.size(); ++i)
    {
        REQUIRE(p.mass[i] == 0);
        REQUIRE(p.x[0][i] == p.x[0][n - 1]);
    }
    REQUIRE_FALSE(state::sortByKeyAndId(p));
}
} // namespace

TEST_CASE("particles come into the order (key, id), from any order")
{
    std::mt19937_64 engine(1);
    constexpr auto low = std::numeric_limits<std::int64_t>::min(), high = std::numeric_limits<std::int64_t>::max();
    const std::vector<std::pair<std::int64_t, std::int64_t>> ranges = {
        {0, 0}, {0, 9}, {-1000, 1000}, {0, 1 << 20}, {Index(1) << 40, (Index(1) << 40) + 5000}, {low, high}};
    for (const Index n : {0, 1, 2, 63, 64, 65, 1000, 5000})
        for (const auto& [from, to] : ranges)
        {
            std::uniform_int_distribution<std::int64_t> key(from, to);
            std::vector<std::int64_t> keys(static_cast<std::size_t>(n));
            std::generate(keys.begin(), keys.end(), [&] { return key(engine); });
            INFO(n << " keys in [" << from << ", " << to << "]");
            requireSorts(particles(keys, unsigned(n)));
            std::sort(keys.begin(), keys.end());
            requireSorts(particles(keys, unsigned(n))); // ids out of order within keys
            std::reverse(keys.begin(), keys.end());
            requireSorts(particles(keys, unsigned(n)));
        }
}

TEST_CASE("a few particles out of place, near and far, and children at the end")
{
    std::mt19937_64 engine(2);
    for (const double moved : {1e-4, 1e-3, 1e-2, 0.1, 0.3})
    {
        std::vector<std::int64_t> keys(21000); // enough for threads
        for (std::size_t i = 0; i < keys.size(); ++i)
            keys[i] = std::int64_t(i / 4);
        auto p = particles(keys, 3);
        state::sortByKeyAndId(p);
        std::bernoulli_distribution moves(moved);
        std::uniform_int_distribution<std::int64_t> anywhere(0, 5000), near(-2, 2);
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (moves(engine))
                p.sortKey[i] = i % 3 == 0 ? anywhere(engine) : p.sortKey[i] + near(engine);
        requireSorts(p);
        for (std::size_t i = 19000; i < keys.size(); ++i)
            p.sortKey[i] = std::numeric_limits<std::int64_t>::max();
        requireSorts(p);
    }
}

TEST_CASE("particles in order stay where they are")
{
    auto p = particles({1, 1, 2, 5}, 1);
    std::iota(p.id.begin(), p.id.begin() + 4, 10);
    CHECK(state::orderByKeyAndId(p).empty());
    const double* before = p.x[0].data();
    CHECK_FALSE(state::sortByKeyAndId(p));
    CHECK(p.x[0].data() == before);
}

TEST_CASE("new particles are zero with F = I, whatever the padding held")
{
    state::Particles p(3);
    p.resize(70);
    for (std::size_t i = 0; i < 70; ++i)
    {
        p.forEachColumn([&](auto& column) { column[i] = 3; });
    }
    p.padLastChunk();
    for (const Index n : {100, 128, 129, 500, 90, 300})
    {
        const Index before = p.size();
        p.resize(n);
        for (auto i = std::size_t(before); i < std::size_t(n); ++i)
        {
            for (std::size_t k = 0; k < 9; ++k)
                REQUIRE(p.F[k][i] == (k % 4 == 0 ? 1 : 0));
            REQUIRE(p.x[2][i] == 0);
            REQUIRE(p.mass[i] == 0);
            REQUIRE(p.id[i] == 0);
        }
        REQUIRE(p.x[0][69] == 3);
        for (auto i = std::size_t(before); i < std::size_t(n); ++i)
            p.forEachColumn([&](auto& column) { column[i] = 3; });
        p.padLastChunk();
    }
}
