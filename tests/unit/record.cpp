// Records: arithmetic and shuffles lane by lane, whatever registers they are made of.
#include "base/record.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace mpm;

namespace
{
/// 100 i + k in lane k of record i.
template <class R, int n>
void number(R (&r)[n])
{
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
            r[i][k] = 100 * i + k;
}

template <class R, int n>
void checkTransposed()
{
    R r[n];
    number(r);
    transpose(r);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
            CHECK(r[i][k] == 100 * k + i);
}

template <class R, int n>
void checkArithmetic()
{
    R a{}, b = splat<R>(3);
    for (int k = 0; k < n; ++k)
    {
        CHECK(a[k] == 0);
        a[k] = k + 1;
    }
    const R sum = a + b, difference = a - b, product = a * b, negative = -a, scaled = 2.0 * a;
    R all = a;
    all += b;
    all *= splat<R>(0.5);
    for (int k = 0; k < n; ++k)
    {
        CHECK(sum[k] == k + 4);
        CHECK(difference[k] == k - 2);
        CHECK(product[k] == 3 * (k + 1));
        CHECK(negative[k] == -k - 1);
        CHECK(scaled[k] == 2 * k + 2);
        CHECK(all[k] == 0.5 * (k + 4));
    }
    const R quotient = 12 / b, shifted = 1 - a * 2.0 + 1;
    R more = a;
    more -= 1;
    more /= splat<R>(2);
    for (int k = 0; k < n; ++k)
    {
        CHECK(quotient[k] == 4);
        CHECK(shifted[k] == 2 - 2 * (k + 1));
        CHECK(more[k] == 0.5 * k);
    }
    const R given{1, 2, 3};
    CHECK((given[0] == 1 && given[1] == 2 && given[2] == 3 && given[3] == 0 && given[n - 1] == 0));
}
} // namespace

TEST_CASE("a transposed block has rows for columns")
{
    checkTransposed<Record, 8>();
    checkTransposed<HalfRecord, 4>();
}

TEST_CASE("records calculate lane by lane")
{
    checkArithmetic<Record, 8>();
    checkArithmetic<HalfRecord, 4>();
}

TEST_CASE("masks choose lane by lane, and a NaN is not within")
{
    Record r[8];
    number(r);
    r[0][3] = std::nan("");
    const Record low = splat<Record>(2), high = splat<Record>(5), larger = largerOf(r[0], high);
    const Record smaller = smallerOf(r[0], low), size = select(r[0] < high, -r[0], r[0]);
    Mask within = (r[0] >= low) & (r[0] <= high), outside = (r[0] < low) | (r[0] > high);
    const double expectedSize[8] = {-0.0, -1, -2, 0, -4, 5, 6, 7};
    for (int k = 0; k < 8; ++k)
    {
        CHECK((within[k] != 0) == (k >= 2 && k <= 5 && k != 3));
        CHECK((outside[k] != 0) == (k < 2 || k > 5));
        CHECK(larger[k] == (k > 5 ? k : 5)); // also in the lane of the NaN
        CHECK(smaller[k] == (k < 2 ? k : 2));
        if (k != 3)
            CHECK(size[k] == expectedSize[k]);
    }
    within |= r[0] == high;
    within &= r[0] != high;
    CHECK((within[4] != 0 && within[5] == 0));

    const Record some = choose(Mask{-1, 0, 0, -1, -1, 0, 0, -1}, 1, 2);
    const HalfRecord half = choose(HalfMask{0, -1, 0, -1}, 1, 2);
    CHECK((some[0] == 1 && some[1] == 2 && some[2] == 2 && some[3] == 1 && some[6] == 2 && some[7] == 1));
    CHECK((half[0] == 2 && half[1] == 1 && half[2] == 2 && half[3] == 1));
    CHECK(sumOf(some) == 12);
}

TEST_CASE("shuffles take any lane of two records, also from many registers at once")
{
    Record r[8];
    number(r);
    const Record mixed = shuffle<0, 13, 6, 11, 3, 3, 8, 15>(r[1], r[2]);
    const double expected[8] = {100, 205, 106, 203, 103, 103, 200, 207};
    for (int k = 0; k < 8; ++k)
        CHECK(mixed[k] == expected[k]);
    const HalfRecord low = shuffle<0, 1, 2, 3>(r[3], r[3]), high = shuffle<4, 5, 6, 7>(r[3], r[3]),
                     turned = shuffle<3, 4, 0, 6>(low, high);
    for (int k = 0; k < 4; ++k)
    {
        CHECK(low[k] == 300 + k);
        CHECK(high[k] == 304 + k);
    }
    const HalfRecord far = shuffle<1, 2, 13, 4>(r[1], r[2]);
    CHECK((far[0] == 101 && far[1] == 102 && far[2] == 205 && far[3] == 104));
    CHECK((turned[0] == 303 && turned[1] == 304 && turned[2] == 300 && turned[3] == 306));
}

TEST_CASE("records are loaded from and stored to columns")
{
    alignas(64) double column[16], copy[16] = {};
    for (int k = 0; k < 16; ++k)
        column[k] = k;
    store(copy + 8, load(column + 8));
    const Record first = load(column);
    store(copy + 4, shuffle<4, 5, 6, 7>(first, first));
    for (int k = 4; k < 16; ++k)
        CHECK(copy[k] == k);
    CHECK(copy[0] == 0);
}

TEST_CASE("records are loaded from and stored to any address, and touch nothing beside it")
{
    alignas(64) double column[24], copy[24];
    for (int k = 0; k < 24; ++k)
        column[k] = k;
    for (int at = 0; at < 16; ++at)
    {
        std::fill_n(copy, 24, -1.0);
        const Record r = loadAnywhere(column + at);
        storeAnywhere(copy + 16 - at, r);
        for (int k = 0; k < 8; ++k)
            CHECK(r[k] == at + k);
        for (int k = 0; k < 24; ++k)
            CHECK(copy[k] == (k >= 16 - at && k < 24 - at ? k + 2 * at - 16 : -1));
    }
}

TEST_CASE("one lane is calculated with as many are")
{
    const double one = splat<double>(3), other = splat<double>(4);
    CHECK(one == 3);
    CHECK(select(one < other, one, other) == 3);
    CHECK(select(one > other, one, other) == 4);
}
