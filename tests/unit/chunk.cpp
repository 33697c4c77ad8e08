// What kernels of one chunk stand on: supports located in a window of nodes; lanes loaded, stored, summed and compared.
#include "support/particleCloud.hpp"

#include <cmath>
#include <limits>

using namespace mpm;
using test::Cloud, test::forShapes;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

template <int dim, class Shape>
void checkLocate(Cloud<dim, Shape> c)
{
    state::NodeBox tight{{0, 0, 0}, {1, 1, 1}};
    for (int a = 0; a < dim; ++a)
    {
        const auto [low, high] = std::minmax_element(c.w.axis[a].base, c.w.axis[a].base + c.count);
        tight.lo[a] = *low;
        tight.n[a] = *high - *low + Shape::nodes;
    }
    REQUIRE(c.w.locate(tight));
    const auto at = [&](int a, int l) { return a < dim ? Index(c.w.axis[a].base[l]) : 0; };
    for (int l = 0; l < lanes; ++l)
        CHECK(c.w.offset[l] == tight.offset(at(0, l), at(1, l), at(2, l)));
    for (int a = 0; a < dim; ++a)
    {
        CAPTURE(a);
        auto fromAbove = tight, fromBelow = tight, wider = tight;
        --fromAbove.n[a];
        --fromBelow.n[a];
        ++fromBelow.lo[a];
        --wider.lo[a];
        wider.n[a] += 2;
        CHECK_FALSE(c.w.locate(fromAbove));
        CHECK_FALSE(c.w.locate(fromBelow));
        REQUIRE(c.w.locate(wider));
        for (int l = 0; l < lanes; ++l)
            CHECK(c.w.offset[l] == wider.offset(at(0, l), at(1, l), at(2, l)));
        for (const int l : {0, c.count / 2, c.count - 1}) // one particle alone strays
            for (const Index base : {tight.lo[a] - 1, tight.lo[a] + tight.n[a] - Shape::nodes + 1})
            {
                auto w = c.w;
                w.axis[a].base[l] = std::int32_t(base);
                CHECK_FALSE(w.locate(tight));
            }
    }
}
} // namespace

TEST_CASE("supports are located in a window, and missed where they reach one node beyond it")
{
    forShapes<2>([](const auto& c) { checkLocate(c); });
    forShapes<3>([](const auto& c) { checkLocate(c); });
}

TEST_CASE("lanes are loaded from anywhere in a column and stored without a trace beyond the count")
{
    std::vector<double> column(80);
    for (std::size_t k = 0; k < column.size(); ++k)
        column[k] = 0.1 * double(k) + 1;
    for (const int count : {64, 63, 37, 8, 1})
    {
        CAPTURE(count);
        alignas(64) transfer::Lanes repeated, zeroed;
        transfer::loadLanes(column.data() + 3, count, repeated);
        transfer::loadLanesOrZero(column.data() + 3, count, zeroed);
        for (int l = 0; l < lanes; ++l)
        {
            CHECK(repeated[l] == column[std::size_t(3 + std::min(l, count - 1))]);
            CHECK(zeroed[l] == (l < count ? column[std::size_t(3 + l)] : 0));
        }
        std::vector<double> out(80, -5);
        transfer::storeLanes(out.data() + 3, count, repeated);
        for (int k = 0; k < 80; ++k)
            CHECK(out[std::size_t(k)] == (k >= 3 && k < 3 + count ? column[std::size_t(k)] : -5));
    }
}

TEST_CASE("extremes and sums are taken over every lane")
{
    alignas(64) transfer::Lanes a, b;
    for (int l = 0; l < lanes; ++l)
    {
        a[l] = l % 7 - 3;
        b[l] = l;
    }
    double sum = 0;
    for (int l = 0; l < lanes; ++l)
        sum += a[l] * b[l];
    CHECK(transfer::sumOfProducts(a, b) == sum); // of integers: exact in any order
    for (int l = 0; l < lanes; ++l)
    {
        CAPTURE(l);
        const double kept = a[l];
        for (const double extreme : {11.0, infinite})
        {
            a[l] = extreme;
            CHECK((transfer::largest(a) == extreme && transfer::smallest(a) == -3));
            a[l] = -extreme;
            CHECK((transfer::largest(a) == 3 && transfer::smallest(a) == -extreme));
        }
        a[l] = kept;
    }
}

TEST_CASE("within are the bounds and what lies between, but no NaN and no infinity")
{
    alignas(64) transfer::Lanes a;
    std::fill_n(a, lanes, 1.0);
    CHECK(transfer::allWithin(a, 1, 1));
    for (int l = 0; l < lanes; ++l)
    {
        CAPTURE(l);
        for (const double inside : {-2.0, 0.0, 5.0})
        {
            a[l] = inside;
            CHECK(transfer::allWithin(a, -2, 5));
        }
        for (const double outside :
             {std::nextafter(-2.0, -3.0), std::nextafter(5.0, 6.0), infinite, -infinite, notANumber})
        {
            a[l] = outside;
            CHECK_FALSE(transfer::allWithin(a, -2, 5));
        }
        a[l] = 1;
    }
    a[5] = infinite;
    CHECK(transfer::allWithin(a, -infinite, infinite));
    a[5] = notANumber;
    CHECK_FALSE(transfer::allWithin(a, -infinite, infinite));
}
