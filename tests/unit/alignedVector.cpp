// Memory on 64-byte boundaries: arrays of all sizes keep to themselves while others come and go.
#include "base/alignedVector.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>

using namespace mpm;

TEST_CASE("arrays begin on lines of 64 bytes and do not overlap, whatever is freed in between")
{
    std::mt19937 random(3);
    std::vector<AlignedVector<std::uint32_t>> arrays(60);
    for (std::uint32_t round = 0; round < 2000; ++round)
    {
        const std::size_t k = random() % arrays.size();
        for (const std::uint32_t value : {k < arrays.size() && !arrays[k].empty() ? arrays[k].front() : 0u})
            for (const std::size_t i : {std::size_t(0), arrays[k].size() / 2, arrays[k].size() - 1})
                if (!arrays[k].empty())
                    REQUIRE(arrays[k][i] == value); // nobody has written here
        const int kind = int(random() % 8);
        const std::size_t bytes = kind == 0  ? random() % 5000
                                  : kind < 7 ? 30000 + random() % 400000
                                             : 7000000 + random() % 4000000;
        arrays[k] = AlignedVector<std::uint32_t>(bytes / 4 + 1, round);
        if (round % 100 == 0)
            trimAligned();
        REQUIRE(reinterpret_cast<std::uintptr_t>(arrays[k].data()) % 64 == 0);
    }
}

TEST_CASE("columns read side by side do not all begin at the same place of a page")
{
    std::vector<AlignedVector<double>> columns(16, AlignedVector<double>(100000));
    std::vector<bool> taken(64, false);
    for (const auto& column : columns)
    {
        const std::size_t line = reinterpret_cast<std::uintptr_t>(column.data()) / 64 % 64;
        CHECK(!taken[line]);
        taken[line] = true;
    }
}
