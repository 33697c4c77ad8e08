// Columns of doubles and of floats, to and from the aligned arrays kernels work with.
#include "transfer/chunkColumns.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace mpm;

namespace
{
/// Numbers a float cannot hold.
double value(int i)
{
    return 1 / (3.0 + i);
}

template <class T>
void loadAndStore(int count)
{
    std::vector<T> column(lanes + 2, T(-1));
    for (int i = 0; i < count; ++i)
        column[std::size_t(i + 1)] = T(value(i));
    alignas(64) transfer::Lanes in, orZero;
    transfer::loadLanes(column.data() + 1, count, in);
    transfer::loadLanesOrZero(column.data() + 1, count, orZero);
    for (int l = 0; l < lanes; ++l)
    {
        CHECK(in[l] == double(T(value(l < count ? l : count - 1))));
        CHECK(orZero[l] == (l < count ? double(T(value(l))) : 0.0));
    }

    std::fill(column.begin(), column.end(), T(-1));
    for (int l = 0; l < lanes; ++l)
        in[l] = value(l);
    transfer::storeLanes(column.data() + 1, count, in);
    CHECK(column.front() == T(-1));
    CHECK(column[std::size_t(count + 1)] == T(-1));
    for (int l = 0; l < lanes; ++l)
    {
        CHECK(in[l] == double(T(value(l)))); // what a restart would load, in all lanes
        if (l < count)
            CHECK(column[std::size_t(l + 1)] == T(value(l)));
    }
}
} // namespace

TEST_CASE("full and part chunks of doubles and floats")
{
    for (const int count : {1, 37, 63, lanes})
    {
        loadAndStore<double>(count);
        loadAndStore<float>(count);
    }
    CHECK(value(0) != double(float(value(0))));
}
