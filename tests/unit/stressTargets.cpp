#include "smoothing/stressTargets.hpp"
#include "base/error.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <Eigen/Dense>
#include <omp.h>
#include <random>

using namespace mpm;
using namespace mpm::smoothing;

namespace
{
constexpr double h = 0.5;
constexpr StressTarget targets[] = {StressTarget::smoothed, StressTarget::filtered, StressTarget::leastSquares};
using Values = std::vector<double>;

/// Two particles an axis in each of `cells`; empty grid around them unless all axes are periodic.
state::State lattice(int dim, std::array<Index, 3> cells, bool periodic = false)
{
    state::State state(dim);
    const Index margin = periodic ? 0 : 3;
    state.grid = {dim, {}, h, {1, 1, 1}};
    Index particles = 1;
    for (std::size_t a = 0; a < std::size_t(dim); ++a)
    {
        state.grid.origin[a] = -h * double(margin);
        state.grid.cells[a] = cells[a] + 2 * margin;
        state.grid.periodic[a] = periodic;
        particles *= 2 * cells[a];
    }
    auto& p = state.particles;
    p.resize(particles);
    for (Index i = 0; i < particles; ++i)
    {
        Index rest = i;
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            p.x[a][std::size_t(i)] = h / 2 * (double(rest % (2 * cells[a])) + 0.5);
            p.length0[a][std::size_t(i)] = float(h / 2);
            rest /= 2 * cells[a];
        }
        p.mass[std::size_t(i)] = 1;
        p.id[std::size_t(i)] = i;
    }
    p.padLastChunk();
    state.nextId = particles;
    return state;
}

/// Particles out of their places, of all kinds of mass and stretch.
void disturb(state::State& state)
{
    auto& p = state.particles;
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.mass[i] = 0.1 + uniform(engine);
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
        {
            p.x[a][i] += 0.2 * h * (uniform(engine) - 0.5);
            p.F[a * std::size_t(p.dim + 1)][i] = 0.8 + 0.5 * uniform(engine);
        }
    }
    p.padLastChunk();
}

Values noise(Index n, unsigned seed)
{
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Values values(static_cast<std::size_t>(n));
    for (double& value : values)
        value = normal(engine);
    return values;
}

template <class Function>
Values field(const state::Particles& p, Function&& f)
{
    Values values;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        values.push_back(f(p.x[0][i], p.x[1][i], p.dim == 3 ? p.x[2][i] : 0.0));
    return values;
}

Values apply(StressTarget target, const state::State& state, const WeightTable& table, const Values& values)
{
    StressColumns out;
    stressTarget(target, {values.data()}, state.particles, table, out);
    return out.at(0);
}

double inner(const state::State& state, const Values& a, const Values& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += state.particles.mass[i] * a[i] * b[i];
    return sum;
}

Values minus(Values a, const Values& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] -= b[i];
    return a;
}

double largest(const Values& values)
{
    double most = 0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    return most;
}

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

/// Rayleigh quotient of I - O on a wave of `cells` along x in a periodic box.
double lost(StressTarget target, int dim, const std::string& shape, Index cells)
{
    const auto state = lattice(dim, {cells, 3, 3}, true);
    const double k = 2 * M_PI / (double(cells) * h);
    const Values wave = field(state.particles, [&](double x, double, double) { return std::sin(k * x + 0.3); });
    const Values kept = apply(target, state, weightTable(state, shape), wave);
    return 1 - inner(state, wave, kept) / inner(state, wave, wave);
}
} // namespace

TEST_CASE("targets are symmetric in the inner product of masses, between 0 and 1, keep constants and sums")
{
    for (const int dim : {2, 3})
        for (const bool periodic : {false, true})
        {
            auto state =
                lattice(dim, dim == 2 ? std::array<Index, 3>{5, 6, 1} : std::array<Index, 3>{4, 5, 4}, periodic);
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
        auto state = lattice(dim, {3, 3, 2});
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

TEST_CASE("least squares leave linear fields alone at corners, walls and a sloping surface")
{
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, dim == 2 ? std::array<Index, 3>{8, 8, 1} : std::array<Index, 3>{5, 5, 4});
        disturb(state);
        auto& p = state.particles;
        std::size_t kept = 0; // what lies below the slope
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            if (p.x[1][i] + 0.7 * p.x[0][i] < 2.9)
            {
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    p.x[a][kept] = p.x[a][i];
                p.mass[kept++] = p.mass[i];
            }
        REQUIRE(kept > 90);
        p.resize(Index(kept));
        p.padLastChunk();
        const Values linear = field(p, [](double x, double y, double z) { return 0.3 + 2 * x - 3 * y + 1.5 * z; });
        for (const auto& shape : shapeNames())
        {
            INFO(dim << "D " << shape);
            const auto table = weightTable(state, shape);
            CHECK(largest(minus(apply(StressTarget::leastSquares, state, table, linear), linear)) < 1e-12);
            CHECK(largest(minus(apply(StressTarget::smoothed, state, table, linear), linear)) > 0.1);
        }
    }
}

TEST_CASE("a checkerboard of particles goes entirely inside")
{
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, {4, 4, 4}, true);
        for (double& x : state.particles.x[0])
            x += 0.07; // wherever the lattice lies in the cells
        const Values board = field(state.particles, [](double x, double y, double z) {
            const auto index = [](double v) { return int(std::floor(v / (h / 2))); };
            return (index(x) + index(y) + index(z)) % 2 ? 1.0 : -1.0;
        });
        for (const auto& shape : shapeNames())
        {
            const auto table = weightTable(state, shape);
            for (const auto target : targets)
            {
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)]);
                CHECK(largest(apply(target, state, table, board)) < 1e-13);
            }
        }
    }
}

TEST_CASE("stripes at a free surface leave what can be worked out by hand")
{
    // linear shapes, stripes +1, -1, +1, ... from the surface y = 0 on, at h/4, 3h/4, ...: only the node at the surface
    // sees them (3/4 - 1/4 = 1/2; its line is that of the two particles next to it, which it cannot tell from noise)
    const auto state = lattice(2, {4, 6, 1});
    const Values stripes =
        field(state.particles, [](double, double y, double) { return int(y / (h / 2)) % 2 ? -1.0 : 1.0; });
    const auto table = weightTable(state, "linear");
    const double expected[3][4] = {
        {3. / 8, 1. / 8, 0, 0}, {63. / 128, 13. / 128, -9. / 128, -3. / 128}, {3. / 4, -1. / 4, 0, 0}};
    for (const auto target : targets)
    {
        const Values out = apply(target, state, table, stripes);
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t i = 0; i < 8; ++i)
                CHECK(out[8 * row + i] == Approx(expected[int(target)][row]).margin(1e-13));
    }
}

TEST_CASE("waves lose the second order of k h under smoothing, the fourth under the others")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapeNames())
            for (const auto target : targets)
            {
                const double coarse = lost(target, dim, shape, 16), fine = lost(target, dim, shape, 32);
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)] << " " << fine);
                CHECK(std::log2(coarse / fine) == Approx(target == StressTarget::smoothed ? 2 : 4).margin(0.06));
            }
    CHECK(lost(StressTarget::smoothed, 2, "linear", 64) == Approx(0.1875 * std::pow(2 * M_PI / 64, 2)).epsilon(0.01));
}

TEST_CASE("only smoothing stays within the values there are")
{
    auto state = lattice(2, {6, 6, 1});
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

TEST_CASE("no place along a periodic axis is special")
{
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, {5, 4, 4}, true);
        disturb(state);
        auto& p = state.particles;
        const Values s = noise(p.size(), 4);
        const auto wrap = [&] {
            for (std::size_t a = 0; a < std::size_t(dim); ++a)
                for (double& x : p.x[a])
                    x -= std::floor(x / (h * double(state.grid.cells[a]))) * h * double(state.grid.cells[a]);
        };
        wrap();
        for (const auto& shape : shapeNames())
            for (const auto target : targets)
            {
                const Values before = apply(target, state, weightTable(state, shape), s);
                const auto places = p.x;
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    for (double& x : p.x[a])
                        x += h * double(1 + a);
                wrap();
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)]);
                CHECK(largest(minus(apply(target, state, weightTable(state, shape), s), before)) < 1e-11);
                p.x = places;
            }
    }
}

TEST_CASE("one, two and three threads give the same bits")
{
    const int before = omp_get_max_threads();
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, dim == 2 ? std::array<Index, 3>{160, 160, 1} : std::array<Index, 3>{24, 24, 24});
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
                CHECK(apply(target, state, table, s) == one);
            }
        }
    }
    omp_set_num_threads(before);
}

TEST_CASE("fits to few particles: one, coincident ones, a line, a plane")
{
    const auto cloud = [](int dim, const std::vector<Vector3>& places) {
        auto state = lattice(dim, {2, 2, 2});
        auto& p = state.particles;
        p.resize(Index(places.size()));
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            for (std::size_t a = 0; a < std::size_t(dim); ++a)
            {
                p.x[a][i] = places[i][a];
                p.length0[a][i] = float(h / 2);
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
                if (distance <= 1e-8)
                    CHECK(apart == Approx(0).margin(1e-3));
                last = apart;
            }
        }
}

TEST_CASE("columns do not mix, the particles' own stresses are taken, a foreign table is refused")
{
    auto state = lattice(3, {3, 3, 3});
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
    CHECK_THROWS_AS(stressTarget(StressTarget::smoothed, lattice(2, {1, 1, 1}).particles, table, out), InputError);
    CHECK_NOTHROW(stressTarget(StressTarget::leastSquares, state::Particles(2), {}, out));
}
