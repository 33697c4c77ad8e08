// Targets of stress relaxation as operators: symmetry, spectrum, sums, definition, few particles, threads.
#include "base/error.hpp"
#include "support/particleValues.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <omp.h>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// What every target must be on any cloud.
void checkOperator(StressTarget target, const state::State& state, const WeightTable& table)
{
    const auto n = state.particles.size();
    const Values r = noise(n, 1), s = noise(n, 2), Or = apply(target, state, table, r),
                 Os = apply(target, state, table, s);
    const double norm = inner(state, s, s);
    CHECK(inner(state, r, Os) == Approx(inner(state, s, Or)).margin(1e-12 * norm));
    CHECK(inner(state, s, Os) >= -1e-13 * norm);
    CHECK(inner(state, s, Os) <= norm * (1 + 1e-13));
    CHECK(inner(state, Os, Os) <= inner(state, s, Os) + 1e-13 * norm); // no eigenvalue outside [0, 1]
    const Values one(std::size_t(n), 1.0);
    CHECK(largest(minus(apply(target, state, table, one), one)) < 1e-13);
    CHECK(inner(state, one, Os) == Approx(inner(state, one, s)).margin(1e-12 * norm));
    Values top = s, bottom = s; // the ends of the spectrum, of O and of I - O
    for (int k = 0; k < 10; ++k)
    {
        const Values next = apply(target, state, table, top);
        CHECK(inner(state, next, next) <= inner(state, top, top) * (1 + 1e-13));
        top = next;
        const Values left = minus(bottom, apply(target, state, table, bottom));
        CHECK(inner(state, left, left) <= inner(state, bottom, bottom) * (1 + 1e-13));
        bottom = left;
    }
}
} // namespace

TEST_CASE("targets are symmetric in the inner product of masses, between 0 and 1, keep constants and sums")
{
    for (const int dim : {2, 3})
        for (const bool periodic : {false, true})
        {
            auto state = block(dim, dim == 2 ? std::array<Index, 3>{5, 6, 1} : std::array<Index, 3>{4, 5, 4}, periodic);
            disturb(state);
            if (periodic)
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    for (double& x : state.particles.x[a])
                        x = x - std::floor(x / (h * double(state.grid.cells[a]))) * h * double(state.grid.cells[a]);
            for (const auto& shape : shapeNames())
            {
                const auto table = weightTable(state, shape);
                for (const auto target : targets)
                {
                    INFO(dim << "D " << shape << (periodic ? " periodic " : " ")
                             << stressTargetNames()[std::size_t(target)]);
                    checkOperator(target, state, table);
                }
            }
        }
}

TEST_CASE("targets are what their equations say")
{
    for (const int dim : {2, 3})
    {
        auto state = block(dim, {3, 3, 2});
        disturb(state);
        const auto& p = state.particles;
        const auto n = std::size_t(p.size());
        const auto table = weightTable(state, "uGIMP");
        const Values s = noise(p.size(), 3);
        const Values once = smoothColumns({s.data()}, p, table).smoothed[0];
        const Values twice = smoothColumns({once.data()}, p, table).smoothed[0];
        CHECK(largest(minus(apply(StressTarget::smoothed, state, table, s), once)) < 1e-13);
        Values expected(n);
        for (std::size_t i = 0; i < n; ++i)
            expected[i] = 2 * once[i] - twice[i];
        CHECK(largest(minus(apply(StressTarget::filtered, state, table, s), expected)) < 1e-13);

        // T by weighted least squares at one node after the other, by QR on the square roots of the weights
        Eigen::MatrixXd N = Eigen::MatrixXd::Zero(Eigen::Index(n), table.nodes());
        for (std::size_t i = 0; i < n; ++i)
            table.visitNodes(Index(i), [&](std::size_t node, double w) { N(Eigen::Index(i), Eigen::Index(node)) = w; });
        expected.assign(n, 0.0);
        for (Eigen::Index node = 0; node < table.nodes(); ++node)
        {
            Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(n), dim + 1);
            Eigen::VectorXd b = Eigen::VectorXd::Zero(Eigen::Index(n));
            const auto basis = [&](std::size_t i) {
                Eigen::RowVectorXd row(dim + 1);
                row[0] = 1;
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    row[Eigen::Index(a) + 1] = p.x[a][i] - table.position[std::size_t(node)][a];
                return row;
            };
            for (std::size_t i = 0; i < n; ++i)
            {
                const double root = std::sqrt(p.mass[i] * N(Eigen::Index(i), node));
                A.row(Eigen::Index(i)) = root * basis(i);
                b[Eigen::Index(i)] = root * s[i];
            }
            const Eigen::VectorXd c = A.completeOrthogonalDecomposition().solve(b);
            for (std::size_t i = 0; i < n; ++i)
                expected[i] += N(Eigen::Index(i), node) * basis(i).dot(c);
        }
        CHECK(largest(minus(apply(StressTarget::leastSquares, state, table, s), expected)) < 1e-11);
    }
}

TEST_CASE("only smoothing stays within the values there are")
{
    auto state = block(2, {6, 6, 1});
    disturb(state);
    const Values step = field(state.particles, [](double x, double, double) { return x < 3 * h ? -1.0 : 1.0; });
    for (const auto& shape : shapeNames())
    {
        const auto table = weightTable(state, shape);
        CHECK(largest(apply(StressTarget::smoothed, state, table, step)) <= 1 + 1e-14);
        CHECK(largest(apply(StressTarget::filtered, state, table, step)) > 1.01);
        CHECK(largest(apply(StressTarget::leastSquares, state, table, step)) > 1.01);
    }
}

TEST_CASE("one, two and three threads give the same bits")
{
    const int before = omp_get_max_threads();
    for (const int dim : {2, 3})
    {
        auto state = block(dim, dim == 2 ? std::array<Index, 3>{160, 160, 1} : std::array<Index, 3>{24, 24, 24});
        disturb(state);
        REQUIRE(state.particles.size() > 100000);
        const auto table = weightTable(state, "uGIMP");
        const Values s = noise(state.particles.size(), 5);
        for (const auto target : targets)
        {
            omp_set_num_threads(1);
            const Values one = apply(target, state, table, s);
            for (const int threads : {2, 3})
            {
                omp_set_num_threads(threads);
                CHECK((apply(target, state, table, s) == one));
            }
        }
    }
    omp_set_num_threads(before);
}

TEST_CASE("fits to few particles: one, coincident ones, a line, a plane")
{
    const auto cloud = [](int dim, const std::vector<Vector3>& places) {
        auto state = block(dim, {2, 2, 2});
        auto& p = state.particles;
        p.resize(Index(places.size()));
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            for (std::size_t a = 0; a < std::size_t(dim); ++a)
            {
                p.x[a][i] = places[i][a];
                p.length0[a][i] = state::Stored(h / 2);
            }
            p.mass[i] = 1 + double(i % 3);
        }
        p.padLastChunk();
        return state;
    };
    const auto linear = [](double x, double y, double z) { return 1 + x - 2 * y + 3 * z; };
    for (const int dim : {2, 3})
        for (const auto& shape : shapeNames())
        {
            INFO(dim << "D " << shape);
            std::vector<Vector3> line, slanting, plane;
            for (int i = 0; i < 7; ++i)
            {
                line.push_back({0.1 + 0.13 * i, 0.3, 0.2});
                slanting.push_back({0.1 + 0.13 * i, 0.9 - 0.11 * i, 0.2 + 0.07 * i});
                for (int j = 0; j < 5; ++j)
                    plane.push_back({0.1 + 0.13 * i, 0.1 + 0.17 * j, 0.3 + 0.05 * i - 0.04 * j});
            }
            const std::vector<Vector3> one{{0.3, 0.3, 0.3}}, same{one[0], one[0]};
            for (const auto& places : {one, same, line, slanting, plane})
            {
                const auto state = cloud(dim, places);
                const auto table = weightTable(state, shape);
                for (const auto target : targets)
                    checkOperator(target, state, table);
                const Values exact = field(state.particles, linear);
                CHECK(largest(minus(apply(StressTarget::leastSquares, state, table, exact), exact)) < 1e-11);
            }
            // two at one place with masses 1 and 2 share their mean; the nearer they come the more they do
            double last = 1;
            for (const double distance : {0.1, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8, 0.0})
            {
                const auto state = cloud(dim, {{0.3, 0.3, 0.3}, {0.3 + distance * h, 0.3, 0.3}});
                const Values out = apply(StressTarget::leastSquares, state, weightTable(state, shape), {1, 4});
                const double apart = (out[1] - out[0]) / 3;
                CHECK(apart <= last + 1e-9);
                CHECK(out[0] + 2 * out[1] == Approx(9));
                if (distance >= 1e-5)
                    CHECK(apart == Approx(1).epsilon(1e-9));
                const double t = 2. / 9 * distance * distance / 1e-12; // second moment over the bound of the ramp
                CHECK(apart == Approx(t < 1 ? t * t * (3 - 2 * t) : 1).epsilon(1e-3).margin(1e-6));
                if (distance <= 1e-8)
                    CHECK(apart == Approx(0).margin(1e-3));
                last = apart;
            }
        }
}

TEST_CASE("columns do not mix, the particles' own stresses are taken, a foreign table is refused")
{
    auto state = block(3, {3, 3, 3});
    disturb(state);
    auto& p = state.particles;
    for (std::size_t c = 0; c < 6; ++c)
    {
        const Values s = noise(p.size(), unsigned(c));
        std::copy(s.begin(), s.end(), p.stress[c].begin());
    }
    const auto table = weightTable(state, "cpGIMP");
    StressColumns many;
    for (unsigned c = 0; c < 11; ++c)
        many.push_back(noise(p.size(), c % 6));
    for (const auto target : targets)
        for (std::size_t count = 0; count <= 11; ++count)
        {
            std::vector<const double*> columns;
            for (std::size_t c = 0; c < count; ++c)
                columns.push_back(many[c].data());
            StressColumns out(20); // left over from another call
            stressTarget(target, columns, p, table, out);
            REQUIRE(out.size() == count);
            for (std::size_t c = 0; c < count; ++c)
                CHECK(largest(minus(out[c], apply(target, state, table, many[c]))) < 1e-13);
            if (count != 6)
                continue;
            StressColumns own;
            stressTarget(target, p, table, own);
            for (std::size_t c = 0; c < 6; ++c)
                CHECK(largest(minus(own[c], out[c])) < (std::is_same_v<state::Stored, float> ? 1e-5 : 1e-15));
        }
    StressColumns out;
    CHECK_THROWS_AS(stressTarget(StressTarget::smoothed, block(2, {1, 1, 1}).particles, table, out), InputError);
    CHECK_NOTHROW(stressTarget(StressTarget::leastSquares, state::Particles(2), {}, out));
}
