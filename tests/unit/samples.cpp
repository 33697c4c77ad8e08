// Values and poses between the times they were said for: orders of interpolation, closed forms of rotations, mean
// velocities that arrive, what is forgotten, and bytes.
#include "coupling/couplingError.hpp"
#include "coupling/poseSamples.hpp"
#include "nodal/vectors.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace mpm;
using namespace mpm::coupling;
using Catch::Contains;
using Catch::Detail::Approx;
using nodal::length;
using nodal::minus;
using nodal::plus;
using nodal::times;

namespace
{
double f(double t)
{
    return std::sin(3 * t) + 0.3 * t * t;
}
double df(double t)
{
    return 3 * std::cos(3 * t) + 0.6 * t;
}

/// The largest error over [0, 1] of samples h apart.
double errorOf(Interpolation kind, bool slopes, int count)
{
    Samples values(1, kind), rates(1);
    for (int k = 0; k <= count; ++k)
    {
        const double t = double(k) / count, value = f(t), rate = df(t);
        values.set(t, {&value, 1});
        rates.set(t, {&rate, 1});
    }
    double most = 0;
    for (int n = 0; n <= 1000; ++n)
    {
        double found = 0;
        values.value(n / 1000.0, {&found, 1}, slopes ? &rates : nullptr);
        most = std::max(most, std::abs(found - f(n / 1000.0)));
    }
    return most;
}

double order(double coarse, double fine)
{
    return std::log2(coarse / fine);
}

double largestDifference(const nodal::Pose& a, const nodal::Pose& b)
{
    double most = length(minus(a.position, b.position));
    for (std::size_t n = 0; n < 9; ++n)
        most = std::max(most, std::abs(a.rotation[n] - b.rotation[n]));
    return most;
}

std::array<double, 7> valuesOf(const Vector3& x, const Quaternion& q)
{
    return {x[0], x[1], x[2], q[0], q[1], q[2], q[3]};
}

/// A coning motion: R = exp(a t e_z) exp(b t e_x), omega = a e_z + R_z b e_x.
struct Coning
{
    double a = 1.1, b = 0.7;
    Quaternion rotation(double t) const { return product(exponential({0, 0, a * t}), exponential({b * t, 0, 0})); }
    Vector3 place(double t) const { return {std::sin(2 * t), t * t, std::cos(t)}; }
    std::array<double, 7> pose(double t) const { return valuesOf(place(t), rotation(t)); }
    std::array<double, 6> twist(double t) const
    {
        return {2 * std::cos(2 * t), 2 * t, -std::sin(t), b * std::cos(a * t), b * std::sin(a * t), a};
    }
    double errorOf(const PoseSamples& samples, double end) const
    {
        double most = 0;
        for (int n = 0; n <= 200; ++n)
        {
            const double t = end * n / 200;
            most = std::max(most, largestDifference(samples.pose(t), {place(t), matrixOf(rotation(t))}));
        }
        return most;
    }
    double errorOf(Interpolation kind, bool twists, int count) const
    {
        PoseSamples samples(kind);
        for (int k = 0; k <= count; ++k)
        {
            const double t = double(k) / count;
            samples.setPose(t, pose(t));
            if (twists)
                samples.setTwist(t, twist(t));
        }
        return errorOf(samples, 1);
    }
};
} // namespace

TEST_CASE("values between samples are of order 1, 2, 3 and 4")
{
    const auto found = [](Interpolation kind, bool slopes) {
        return order(errorOf(kind, slopes, 20), errorOf(kind, slopes, 40));
    };
    CHECK(found(Interpolation::constant, false) == Approx(1).margin(0.1));
    CHECK(found(Interpolation::linear, false) == Approx(2).margin(0.1));
    CHECK(found(Interpolation::Hermite, false) == Approx(3).margin(0.2));
    CHECK(found(Interpolation::Hermite, true) == Approx(4).margin(0.1));
}

TEST_CASE("what is said holds: at samples, before the first, after the last, and what replaces it")
{
    for (const auto kind : {Interpolation::constant, Interpolation::linear, Interpolation::Hermite})
    {
        Samples samples(2, kind);
        std::array<double, 2> out{9, 9};
        samples.value(1, out);
        CHECK(out == std::array{0.0, 0.0});
        samples.set(2, std::array{5.0, -5.0});
        samples.set(1, std::array{1.0, 2.0}); // in any order
        samples.set(0.1 + 0.2, std::array{7.0, 7.0});
        samples.set(0.3, std::array{0.5, 0.25}); // another sum, the same time
        CHECK(samples.times().size() == 3);
        for (const auto& [t, first] : {std::pair(0.0, 0.5), {0.3, 0.5}, {1.0, 1.0}, {2.0, 5.0}, {7.0, 5.0}})
        {
            samples.value(t, out);
            CHECK(out[0] == first);
        }
        CHECK_THROWS_WITH(samples.set(3, std::array{1.0}), Contains("wrongSize") && Contains("found 1"));
        CHECK_THROWS_WITH(samples.set(NAN, std::array{1.0, 1.0}), Contains("notFinite"));
    }
}

TEST_CASE("integrals and mean rates are those of the interpolant, and steps arrive")
{
    for (const auto kind : {Interpolation::constant, Interpolation::linear, Interpolation::Hermite})
    {
        Samples samples(1, kind);
        for (const double t : {0.0, 0.3, 0.5, 1.2})
        {
            const double value = f(t);
            samples.set(t, {&value, 1});
        }
        double sum = 0, found = 0;
        const int pieces = 150000; // midpoints
        for (int n = 0; n < pieces; ++n)
        {
            samples.value(-0.1 + 1.5 * (n + 0.5) / pieces, {&found, 1});
            sum += found * 1.5 / pieces;
        }
        samples.integral(-0.1, 1.4, {&found, 1});
        CHECK(found == Approx(sum).epsilon(1e-6));
        samples.mean(-0.1, 1.4, {&found, 1});
        CHECK(found == Approx(sum / 1.5).epsilon(1e-6));
        double x = 0, end = 0, rate = 0;
        samples.value(0, {&x, 1});
        for (int n = 0; n < 60; ++n)
        {
            samples.meanRate(0.02 * n, 0.02 * (n + 1), {&rate, 1});
            x += 0.02 * rate;
        }
        samples.value(1.2, {&end, 1});
        CHECK(x == Approx(end).margin(1e-13));
    }
}

TEST_CASE("velocities alone move a surface by their integral, whatever is forgotten on the way")
{
    Samples place(1), velocity(1);
    const double zero = 0;
    place.set(0, {&zero, 1});
    const auto exact = [](double t) { return t <= 1 ? t * t : 1 + 2 * (t - 1); };
    const double first = 0, second = 2;
    velocity.set(0, {&first, 1});
    velocity.set(1, {&second, 1});
    for (const double now : {0.0, 0.25, 0.7, 1.0, 1.6})
    {
        place.forget(now, &velocity);
        velocity.forget(std::min(now, place.times().front()));
        for (double t = now; t < 3; t += 0.21)
        {
            double found = 0;
            place.value(t, {&found, 1}, &velocity);
            CHECK(found == Approx(exact(t)).epsilon(1e-14).margin(1e-15));
        }
    }
    CHECK(place.times().size() == 1);
}

TEST_CASE("what is forgotten does not change what comes, bit by bit")
{
    for (const auto kind : {Interpolation::constant, Interpolation::linear, Interpolation::Hermite})
    {
        Samples all(1, kind);
        for (int k = 0; k <= 10; ++k)
        {
            const double value = f(0.1 * k);
            all.set(0.1 * k, {&value, 1});
        }
        Samples kept = all;
        kept.forget(0.63);
        CHECK(kept.times().size() < 7);
        for (int n = 0; n < 40; ++n)
        {
            double a = 0, b = 1;
            all.value(0.63 + 0.01 * n, {&a, 1});
            kept.value(0.63 + 0.01 * n, {&b, 1});
            CHECK(a == b);
        }
    }
}

TEST_CASE("rotation vectors, quaternions and matrices are one rotation")
{
    for (const Vector3& phi : {Vector3{0, 0, 0}, {1e-10, 0, 2e-10}, {0.3, -0.2, 0.9}, {0, 3.1, 0}, {-1.8, 1.8, 1.8}})
    {
        const auto q = exponential(phi);
        CHECK(length(minus(logarithm(q), phi)) < 1e-14);
        const auto R = matrixOf(q);
        CHECK(largestDifference({{}, matrixOf(quaternionOf(R))}, {{}, R}) < 1e-15);
    }
    const auto R = matrixOf(exponential({0, 0, M_PI / 2})); // e_x goes to e_y
    CHECK(R[3] == Approx(1));
    CHECK(R[1] == Approx(-1));
    // phi' of exponential(phi(t)): omega by differences of the rotation
    const Vector3 phi{0.4, -1.1, 0.8}, rate{0.3, 0.2, -0.7};
    const double h = 1e-5;
    const auto before = exponential(minus(phi, times(h, rate))), after = exponential(plus(phi, times(h, rate)));
    const Vector3 omega = times(0.5 / h, logarithm(product(after, conjugate(before))));
    CHECK(length(minus(rateOfVector(phi, omega), rate)) < 1e-9);
}

TEST_CASE("linear poses turn evenly along the shortest arc")
{
    PoseSamples samples;
    const Quaternion q = exponential({0, 0, 3.0});
    samples.setPose(0, valuesOf({1, 0, 0}, {2, 0, 0, 0})); // normalised
    samples.setPose(2, valuesOf({3, 4, 0}, {-q[0], -q[1], -q[2], -q[3]}));
    const auto pose = samples.pose(0.5);
    CHECK(largestDifference(pose, {{1.5, 1, 0}, matrixOf(exponential({0, 0, 0.75}))}) < 1e-14);
    CHECK(samples.meanTwist(0.2, 0.9).angularVelocity[2] == Approx(1.5).epsilon(1e-13));
    CHECK(samples.meanTwist(0.2, 0.9).velocity[1] == Approx(2).epsilon(1e-13));
    CHECK(largestDifference(samples.pose(5), {{3, 4, 0}, matrixOf(q)}) < 1e-14);
    CHECK_THROWS_WITH(samples.setPose(3, valuesOf({}, {0, 0, 0, 0})), Contains("badValue"));
    CHECK_THROWS_WITH(samples.setPose(3, std::array{1.0, 2.0}), Contains("wrongSize"));
}

TEST_CASE("poses of a coning body are of order 1, 2, 3 and 4")
{
    const Coning body;
    const auto found = [&](Interpolation kind, bool twists) {
        return order(body.errorOf(kind, twists, 10), body.errorOf(kind, twists, 20));
    };
    CHECK(found(Interpolation::constant, false) == Approx(1).margin(0.1));
    CHECK(found(Interpolation::linear, false) == Approx(2).margin(0.1));
    CHECK(found(Interpolation::Hermite, false) == Approx(3).margin(0.3));
    CHECK(found(Interpolation::Hermite, true) == Approx(4).margin(0.2));
}

TEST_CASE("mean twists take the body from pose to pose, step by step")
{
    const Coning body;
    for (const auto kind : {Interpolation::linear, Interpolation::Hermite})
    {
        PoseSamples samples(kind);
        for (int k = 0; k <= 4; ++k)
        {
            samples.setPose(0.25 * k, body.pose(0.25 * k));
            samples.setTwist(0.25 * k, body.twist(0.25 * k));
        }
        auto pose = samples.pose(0);
        for (int n = 0; n < 37; ++n)
        {
            const double t = 1.3 * n / 37, dt = 1.3 / 37;
            const auto twist = samples.meanTwist(t, t + dt);
            const auto between = twistBetween(samples.pose(t), samples.pose(t + dt), dt);
            CHECK(length(minus(twist.angularVelocity, between.angularVelocity)) < 1e-12);
            CHECK(length(minus(twist.velocity, between.velocity)) < 1e-12);
            pose.position = plus(pose.position, times(dt, twist.velocity));
            pose.rotation =
                matrixOf(product(exponential(times(dt, twist.angularVelocity)), quaternionOf(pose.rotation)));
            CHECK(largestDifference(pose, samples.pose(t + dt)) < 1e-13);
        }
    }
}

TEST_CASE("twists alone move a body: exactly about one axis, with order 2 in their distance about a moving one")
{
    PoseSamples spin;
    spin.setPose(0, valuesOf({0, 1, 0}, {1, 0, 0, 0}));
    spin.setTwist(0, std::array{0.0, 0.0, 0.0, 0.0, 0.0, 2.0});
    spin.setTwist(1, std::array{4.0, 0.0, 0.0, 0.0, 0.0, 6.0}); // angle 2 t + 2 t^2, then 4 + 6 (t - 1)
    for (const double now : {0.0, 0.4, 1.5})
    {
        spin.forget(now);
        for (const double t : {1.5, 2.5})
        {
            const auto pose = spin.pose(t);
            const double angle = 4 + 6 * (t - 1);
            CHECK(largestDifference(pose, {{2 + 4 * (t - 1), 1, 0}, matrixOf(exponential({0, 0, angle}))}) < 1e-13);
        }
    }

    const Coning body;
    const auto errorOf = [&](int count) {
        PoseSamples samples;
        samples.setPose(0, body.pose(0));
        for (int k = 0; k <= count; ++k)
            samples.setTwist(double(k) / count, body.twist(double(k) / count));
        return body.errorOf(samples, 1);
    };
    CHECK(order(errorOf(10), errorOf(20)) == Approx(2).margin(0.1)); // of the linear twists
    CHECK(errorOf(400) < 1e-5);

    // an axis that turns from x to y, against a hundred thousand small turns
    PoseSamples samples;
    samples.setPose(0, valuesOf({}, {1, 0, 0, 0}));
    samples.setTwist(0, std::array{0.0, 0.0, 0.0, 2.0, 0.0, 0.0});
    samples.setTwist(1, std::array{0.0, 0.0, 0.0, 0.0, 2.0, 0.0});
    Quaternion q{1, 0, 0, 0};
    const int turns = 100000;
    for (int n = 0; n < turns; ++n)
    {
        const double t = (n + 0.5) / turns;
        q = product(exponential(times(1.0 / turns, {2 * (1 - t), 2 * t, 0})), q);
    }
    CHECK(largestDifference(samples.pose(1), {{}, matrixOf(q)}) < 1e-6);
}

TEST_CASE("poses come as they would have, whatever is forgotten")
{
    const Coning body;
    for (const bool twists : {true, false})
    {
        PoseSamples all(Interpolation::Hermite);
        for (int k = 0; k <= 5; ++k)
            all.setPose(0.3 * k, body.pose(0.3 * k));
        for (int k = 0; twists && k <= 20; ++k) // more often than poses, and further
            all.setTwist(0.1 * k, body.twist(0.1 * k));
        for (const double now : {0.0, 0.61, 0.89, 1.1, 1.7})
        {
            auto kept = all;
            kept.forget(now);
            for (double t = now; t < 2.5; t += 0.07)
                CHECK(largestDifference(all.pose(t), kept.pose(t)) < (now < 1.5 ? 1e-300 : 1e-7));
        }
    }
}

TEST_CASE("bytes bring back every bit; what is no state is refused")
{
    const Coning body;
    PoseSamples samples(Interpolation::Hermite);
    for (int k = 0; k < 4; ++k)
    {
        samples.setPose(0.1 * k, body.pose(0.1 * k));
        samples.setTwist(0.1 * k, body.twist(0.1 * k));
    }
    std::vector<std::byte> bytes;
    samples.serialise(bytes);
    std::span<const std::byte> rest(bytes);
    CHECK(PoseSamples::deserialise(rest) == samples);
    CHECK(rest.empty());
    for (std::size_t size = 0; size < bytes.size(); ++size)
    {
        std::span<const std::byte> part(bytes.data(), size);
        CHECK_THROWS_WITH(PoseSamples::deserialise(part), Contains("badState"));
    }
    for (std::size_t n = 0; n < bytes.size(); ++n) // any byte may be wrong: refused or read, never a crash
    {
        auto damaged = bytes;
        damaged[n] = std::byte(~unsigned(damaged[n]));
        std::span<const std::byte> part(damaged);
        try
        {
            PoseSamples::deserialise(part).pose(0.2);
        }
        catch (const CouplingError& e)
        {
            CHECK(e.fault() == Fault::badState);
        }
    }
}
