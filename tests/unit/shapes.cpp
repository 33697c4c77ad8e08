// Shape functions against what defines them: partition of unity, the mean of the hat over the particle's domain
// (METHOD Eq. 4, integrated numerically), derivatives, and the limit of vanishing domains.
#include "shape/cpGIMP.hpp"
#include "shape/cubicBSpline.hpp"
#include "shape/linear.hpp"
#include "shape/quadraticBSpline.hpp"
#include "shape/uGIMP.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace mpm;

namespace
{
constexpr double h = 0.3, origin = -0.7;

double hat(double d)
{
    return std::max(0.0, 1 - std::abs(d) / h);
}

/// Mean of the hat of `node` over [x - l, x + l]: exact by Simpson's rule between the hat's kinks.
double meanOfHat(double node, double x, double l)
{
    std::vector<double> cuts = {x - l, x + l};
    for (const double kink : {node - h, node, node + h})
        if (kink > x - l && kink < x + l)
            cuts.push_back(kink);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
        sum += 0.5 * (cuts[i + 1] - cuts[i]) * (hat(cuts[i] - node) + hat(cuts[i + 1] - node));
    return sum / (2 * l);
}

struct Lanes
{
    alignas(64) double x[lanes], lambda[lanes];
};

Lanes randomLanes(double lowLambda, double highLambda)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0, 8 * h), size(lowLambda, highLambda);
    Lanes out;
    for (int l = 0; l < lanes; ++l)
    {
        out.x[l] = origin + place(random);
        out.lambda[l] = size(random);
    }
    // places where branches meet
    out.x[0] = origin + h;
    out.x[1] = origin + 1.5 * h;
    out.x[2] = origin + h * (1 + out.lambda[2]);
    out.x[3] = origin + h * (2 - out.lambda[3]);
    return out;
}

template <class Shape>
shape::AxisWeights<Shape::nodes> weights(const Lanes& at)
{
    shape::AxisWeights<Shape::nodes> w;
    Shape::evaluate(at.x, at.lambda, origin, 1 / h, w);
    return w;
}

template <class Shape>
void checkSums(const Lanes& at)
{
    const auto w = weights<Shape>(at);
    for (int l = 0; l < lanes; ++l)
    {
        double sum = 0, slope = 0, first = 0;
        for (int n = 0; n < Shape::nodes; ++n)
        {
            CHECK(w.N[n][l] >= 0);
            sum += w.N[n][l];
            slope += w.G[n][l];
            first += w.N[n][l] * (origin + h * (w.base[l] + n));
        }
        CHECK(sum == Approx(1).epsilon(1e-14));
        CHECK(std::abs(slope) < 1e-13 / h);
        CHECK(first == Approx(at.x[l]).margin(1e-14)); // linear fields are reproduced
    }
}

template <class Shape>
void checkAgainstIntegral(const Lanes& at)
{
    const auto w = weights<Shape>(at);
    for (int l = 0; l < lanes; ++l)
    {
        const double half = at.lambda[l] * h;
        double caught = 0;
        for (int n = 0; n < Shape::nodes; ++n)
        {
            const double node = origin + h * (w.base[l] + n);
            CHECK(w.N[n][l] == Approx(meanOfHat(node, at.x[l], half)).margin(1e-13));
            CHECK(w.G[n][l] * h ==
                  Approx((hat(at.x[l] + half - node) - hat(at.x[l] - half - node)) / (2 * half) * h).margin(1e-12));
            caught += meanOfHat(node, at.x[l], half);
        }
        CHECK(caught == Approx(1).epsilon(1e-13)); // no node of the support is missed
    }
}
} // namespace

TEST_CASE("weights sum to one, gradients to zero, linear fields are kept")
{
    checkSums<shape::Linear>(randomLanes(0.1, 0.5));
    checkSums<shape::UGIMP>(randomLanes(0.01, 0.5));
    checkSums<shape::CpGIMP>(randomLanes(0.01, 1.0));
    checkSums<shape::QuadraticBSpline>(randomLanes(0.1, 0.5));
    checkSums<shape::CubicBSpline>(randomLanes(0.1, 0.5));
}

TEST_CASE("a node that a particle has a gradient towards gets some of its mass")
{
    Lanes at = randomLanes(0.5, 0.5);
    for (int l = 0; l < 8; ++l)
        at.x[l] = origin + h * l; // on nodes in every bit
    const auto w = weights<shape::Linear>(at);
    for (int l = 0; l < lanes; ++l)
        for (int n = 0; n < 2; ++n)
            CHECK(w.N[n][l] > 0);
}

TEST_CASE("cubic splines are the mean of the quadratic ones over one cell")
{
    const auto at = randomLanes(0.5, 0.5);
    const auto w = weights<shape::CubicBSpline>(at);
    // the mean of a cubic's derivative is a difference of quadratics half a cell away on either side
    Lanes left = at, right = at;
    for (int l = 0; l < lanes; ++l)
    {
        left.x[l] -= 0.5 * h;
        right.x[l] += 0.5 * h;
    }
    const auto a = weights<shape::QuadraticBSpline>(left), b = weights<shape::QuadraticBSpline>(right);
    const auto at3 = [](const shape::AxisWeights<3>& q, int l, int node) {
        const int n = node - q.base[l];
        return n >= 0 && n < 3 ? q.N[n][l] : 0.0;
    };
    for (int l = 0; l < lanes; ++l)
        for (int n = 0; n < 4; ++n)
        {
            const int node = w.base[l] + n;
            CHECK(w.G[n][l] * h == Approx(at3(b, l, node) - at3(a, l, node)).margin(1e-13));
        }
    // and the values are those of their own slopes
    Lanes moved = at;
    const double step = 1e-5 * h;
    for (int l = 0; l < lanes; ++l)
        moved.x[l] += step;
    const auto c = weights<shape::CubicBSpline>(moved);
    for (int l = 0; l < lanes; ++l)
        for (int n = 0; n < 4; ++n)
            if (c.base[l] == w.base[l])
                CHECK((c.N[n][l] - w.N[n][l]) / step == Approx(0.5 * (c.G[n][l] + w.G[n][l])).margin(1e-8 / h));
}

TEST_CASE("beside a wall the cubic spline leaves out the node behind, keeps linear fields and joins smoothly")
{
    using shape::CubicBSpline;
    const std::int32_t plane = 3;
    for (const double side : {1.0, -1.0})
    {
        Lanes at = randomLanes(0.5, 0.5);
        for (int l = 0; l < lanes; ++l)
            at.x[l] = origin + h * (plane + side * (l + 0.25) / lanes);
        at.x[60] = origin + h * plane;
        at.x[62] = origin + h * (plane + side * (1 - 1e-13));
        at.x[63] = origin + h * (plane + side * (1 + 1e-13));
        auto w = weights<CubicBSpline>(at);
        CubicBSpline::foldAtWall(at.x, origin, 1 / h, plane, w);
        const auto of = [&](const double(&value)[4][lanes], int l, int node) {
            const int n = node - w.base[l];
            return n >= 0 && n < 4 ? value[n][l] : 0.0;
        };
        for (int l = 0; l < lanes - 1; ++l)
        {
            double sum = 0, slope = 0, first = 0;
            for (int n = 0; n < 4; ++n)
            {
                CHECK(w.N[n][l] >= 0);
                sum += w.N[n][l];
                slope += w.G[n][l];
                first += w.N[n][l] * (w.base[l] + n);
            }
            CHECK(sum == Approx(1).epsilon(1e-14));
            CHECK(std::abs(slope) < 1e-13 / h);
            CHECK(first == Approx((at.x[l] - origin) / h).epsilon(1e-14));
            if (l != 60)
                CHECK(of(w.N, l, plane - int(side)) == 0);
        }
        CHECK(of(w.N, 60, plane) == Approx(1).epsilon(1e-14)); // the field at the wall is its own node's
        for (int node = plane - 3; node <= plane + 3; ++node)
        {
            CHECK(of(w.N, 62, node) == Approx(of(w.N, 63, node)).margin(1e-12));
            CHECK(of(w.G, 62, node) * h == Approx(of(w.G, 63, node) * h).margin(1e-11));
        }
    }
}

TEST_CASE("quadratic splines are the mean of the hat over one cell")
{
    auto at = randomLanes(0.5, 0.5);
    const auto w = weights<shape::QuadraticBSpline>(at);
    for (int l = 0; l < lanes; ++l)
        for (int n = 0; n < 3; ++n)
        {
            const double node = origin + h * (w.base[l] + n), x = at.x[l];
            CHECK(w.N[n][l] == Approx(meanOfHat(node, x, 0.5 * h)).margin(1e-14));
            CHECK(w.G[n][l] == Approx((hat(x + 0.5 * h - node) - hat(x - 0.5 * h - node)) / h).margin(1e-12));
        }
}

TEST_CASE("beside a wall the spline leaves out the node behind, keeps linear fields and has no kink")
{
    using shape::QuadraticBSpline;
    const std::int32_t plane = 3;
    const double wall = origin + h * plane;
    Lanes at = randomLanes(0.5, 0.5);
    for (int l = 0; l < lanes; ++l)
        at.x[l] = wall + h * (l + 0.25) / lanes; // the first cell
    at.x[62] = wall + 0.5 * h * (1 - 1e-14);
    at.x[63] = wall + 0.5 * h * (1 + 1e-14);
    auto w = weights<QuadraticBSpline>(at);
    QuadraticBSpline::foldAtWall(at.x, origin, 1 / h, plane, w);
    for (int l = 0; l < lanes; ++l)
    {
        double sum = 0, first = 0, slope = 0, slopeOfX = 0;
        for (int n = 0; n < 3; ++n)
        {
            const double node = origin + h * (w.base[l] + n);
            CHECK(w.N[n][l] >= 0);
            if (node < wall - 0.5 * h)
                CHECK(w.N[n][l] == 0);
            sum += w.N[n][l];
            first += w.N[n][l] * node;
            slope += w.G[n][l];
            slopeOfX += w.G[n][l] * node;
        }
        CHECK(sum == Approx(1).epsilon(1e-14));
        CHECK(first == Approx(at.x[l]).margin(1e-14));
        CHECK(std::abs(slope) < 1e-13 / h);
        CHECK(slopeOfX == Approx(1).epsilon(1e-13));
    }
    REQUIRE(w.base[62] + 1 == plane);
    REQUIRE(w.base[63] == plane);
    for (int n = 0; n < 2; ++n) // nodes on the wall and next to it, on both sides of half a cell
    {
        CHECK(w.N[n + 1][62] == Approx(w.N[n][63]).margin(1e-13));
        CHECK(w.G[n + 1][62] == Approx(w.G[n][63]).margin(1e-11));
    }
}

TEST_CASE("GIMP weights are means of the hat over the particle's domain")
{
    checkAgainstIntegral<shape::UGIMP>(randomLanes(0.02, 0.5));
    checkAgainstIntegral<shape::CpGIMP>(randomLanes(0.02, 0.5));
    checkAgainstIntegral<shape::CpGIMP>(randomLanes(0.5, 1.0)); // wider than a cell: four nodes
}

TEST_CASE("vanishing domains give the original method")
{
    auto at = randomLanes(1e-12, 1e-12);
    for (int l = 0; l < 4; ++l)
        at.x[l] = origin + h * (l + 0.37); // away from cell faces, where the linear gradient jumps
    const auto exact = weights<shape::Linear>(at);
    const auto u = weights<shape::UGIMP>(at);
    const auto cp = weights<shape::CpGIMP>(at);
    for (int l = 0; l < lanes; ++l)
        for (int n = 0; n < 2; ++n)
        {
            const int inU = exact.base[l] + n - u.base[l], inCp = exact.base[l] + n - cp.base[l];
            REQUIRE((inU >= 0 && inU < 3 && inCp >= 0 && inCp < 4));
            CHECK(u.N[inU][l] == Approx(exact.N[n][l]).margin(1e-11));
            CHECK(cp.N[inCp][l] == Approx(exact.N[n][l]).margin(1e-11));
            CHECK(u.G[inU][l] == Approx(exact.G[n][l]).epsilon(1e-11));
            CHECK(cp.G[inCp][l] == Approx(exact.G[n][l]).epsilon(1e-11));
        }
}
