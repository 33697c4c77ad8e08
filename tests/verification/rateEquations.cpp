/// The rate equations by CVODE against independent solutions, and the return map against them.
#include "reference/rateEquations.hpp"
#include "base/csvTable.hpp"
#include "constitutive/linearElastic.hpp"
#include "reference/odeSolver.hpp"
#include "reference/vonMisesRates.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

using namespace mpm;
using namespace mpm::reference;
using Catch::Matchers::Contains;
using constitutive::MohrCoulomb;
using constitutive::MohrCoulombParameters;

namespace
{
const MohrCoulombParameters paper{{20e6, 0.42}, 1e3, 42, 0}, assoc{{20e6, 0.3}, 10e3, 30, 30},
    nonassoc{{20e6, 0.3}, 10e3, 30, 10}, tresca{{20e6, 0.3}, 10e3, 0, 0}, drySand{{10e6, 0.25}, 0, 35, 5};

struct Case
{
    std::string name;
    MohrCoulombParameters material;
    SymmetricTensor start;
    double xx, yy, xy, w;
};

/// Rotating axes: rates xx cos wt, yy cos wt, xy sin wt over one second.
const std::vector<Case> cases = {
    {"paper K0 start, rotating shear", paper, {-40e3, -60e3, -48e3, 0, 0, 0}, 1e-2, -1e-2, 1e-2, 2.4},
    {"nonassoc psi=10 rotating shear", nonassoc, {-50e3, -100e3, -70e3, 0, 0, 0}, 8e-3, -9e-3, 8e-3, 2},
    {"Tresca rotating shear", tresca, {-50e3, -60e3, -55e3, 0, 0, 0}, 5e-3, -5e-3, 5e-3, 2},
    {"associated phi=psi=30 rotating shear", assoc, {-150e3, -200e3, -170e3, 0, 0, 0}, 1e-2, -1.1e-2, 1e-2, 2},
};

StrainPath pathOf(const Case& c)
{
    return StrainPath::harmonic({Harmonic{c.xx, c.w}, {c.yy, c.w}, {}, {c.xy, c.w, true}, {}, {}}, 1);
}

double norm(const SymmetricTensor& s)
{
    double sum = 0;
    for (const double x : s)
        sum += x * x;
    return std::sqrt(sum);
}

double distance(SymmetricTensor a, const SymmetricTensor& b)
{
    for (int k = 0; k < 6; ++k)
        a[k] -= b[k];
    return norm(a);
}

std::vector<int> doubling(int last)
{
    std::vector<int> steps{1};
    while (steps.back() < last)
        steps.push_back(2 * steps.back());
    return steps;
}
} // namespace

TEST_CASE("four paths with rotating axes: reference stress to 1e-8, yield time, and every row of the return map")
{
    const CsvTable table = CsvTable::read(MPM_SOURCE_DIR "/tests/support/mohrCoulombOde.csv");
    const auto method = table.column("method"), error = table.column("relative_stress_error"),
               order = table.column("order"), steps = table.column("steps_or_nfev");
    for (const Case& c : cases)
    {
        INFO(c.name);
        const StrainPath path = pathOf(c);
        const RateSolution exact = integrateRates(c.material, c.start, path);
        const auto rows = judgeReturnMap(MohrCoulomb(c.material), c.start, path, exact, doubling(512));
        std::printf("%-38s drift %.1e, %ld evaluations, order %.3f\n", c.name.c_str(), exact.drift, exact.evaluations,
                    *rows.back().order);
        CHECK(exact.drift < 1e-9);
        CHECK(*rows.back().order == Approx(1.0).margin(0.05));
        int compared = 0;
        for (const auto& row : table.rows())
        {
            if (row.cells[0] != c.name)
                continue;
            if (row.cells[method].starts_with("ODE ref"))
            {
                double yieldTime = 0, xx = 0, yy = 0, zz = 0, xy = 0;
                REQUIRE(std::sscanf(row.cells[method].c_str(), "ODE ref: t_yield=%lf sxx,syy,szz,sxy=%lf %lf %lf %lf",
                                    &yieldTime, &xx, &yy, &zz, &xy) == 5);
                CHECK(*exact.yieldTime == Approx(yieldTime).margin(6e-9));
                const SymmetricTensor expected{xx, yy, zz, xy, 0, 0};
                CHECK(distance(exact.stress.back(), expected) <= 1e-8 * norm(expected));
                continue;
            }
            const auto& mine = rows.at(std::size_t(std::lround(std::log2(table.number(row, steps)))));
            // five digits are printed, and the reference behind them is good to 1e-11
            CHECK(mine.final == Approx(table.number(row, error)).epsilon(6e-5).margin(1e-10));
            if (mine.order)
                CHECK(*mine.order == Approx(table.number(row, order)).margin(0.0101));
            CHECK(std::abs(mine.yield) <= 1e-13);
            ++compared;
        }
        CHECK(compared == 10);
    }
}

TEST_CASE("von Mises with Krieg and Krieg's closed form: the ODE solver, and the radial return's rows")
{
    // pi-plane vectors: s' = 2G (e' - n (n.e')), |s| = R; tan(psi/2) = tan(psi0/2) exp(-2G |e'| t/R), e' along x
    const double G = 80, R = std::sqrt(2.0 / 3) / 4, rate = 0.01;
    const double half = std::tan(1.0) * std::exp(-2 * G * rate / R), angle = 2 * std::atan(half);
    const double exact[2] = {R * std::cos(angle), R * std::sin(angle)};

    OdeSolver ode(2, 1e-12, 1e-14, [&](double, const double* s, double* out) {
        const double nx = s[0] / R, ny = s[1] / R;
        out[0] = 2 * G * rate * (1 - nx * nx);
        out[1] = -2 * G * rate * nx * ny;
    });
    ode.restart(0, {R * std::cos(2), R * std::sin(2)});
    while (ode.advance(1) != OdeSolver::Stop::end)
    {}
    CHECK(std::hypot(ode.state()[0] - exact[0], ode.state()[1] - exact[1]) <= 1e-10 * R);

    const CsvTable table = CsvTable::read(MPM_SOURCE_DIR "/tests/support/kriegKrieg.csv");
    int compared = 0;
    for (const auto& row : table.rows())
    {
        if (row.cells[table.column("method")] != "radial return")
            continue;
        const int n = int(table.number(row, table.column("rtol_or_steps")));
        double s[2] = {R * std::cos(2), R * std::sin(2)};
        for (int i = 0; i < n; ++i)
        {
            s[0] += 2 * G * rate / n;
            const double size = std::hypot(s[0], s[1]);
            for (double& x : s)
                x *= size > R ? R / size : 1;
        }
        CHECK(std::hypot(s[0] - exact[0], s[1] - exact[1]) / R ==
              Approx(table.number(row, table.column("relative_stress_error"))).epsilon(6e-5));
        ++compared;
    }
    CHECK(compared == 8);
}

TEST_CASE("von Mises as a law: rate equations against Krieg and Krieg's closed form, in and out of the surface")
{
    // the same numbers as tensors: deviators along two orthonormal directions of the pi plane, turned off the axes
    const double G = 80, R = std::sqrt(2.0 / 3) / 4, rate = 0.01;
    const VonMisesParameters material{{2 * G * 1.3, 0.3}, 0.25};
    const auto tensor = [](double a, double b) {
        const double x = a / std::sqrt(2.0), y = b / std::sqrt(2.0); // (1 -1 0)/sqrt 2 and a shear of unit norm
        return SymmetricTensor{x, -x, 0, y, 0, 0};
    };
    const auto angleAt = [&](double from, double t) {
        return 2 * std::atan(std::tan(from / 2) * std::exp(-2 * G * rate * t / R));
    };
    const auto start = tensor(R * std::cos(2), R * std::sin(2));
    const auto straight = tensor(rate, 0);
    const auto exact = integrateRates(material, start, StrainPath::table({0, 1}, {SymmetricTensor{}, straight}));
    const double end = angleAt(2, 1);
    // at an angle of 2 rad the strain first leads inside: elastic across the circle to the angle pi - 2
    const double chord = -2 * R * std::cos(2) / (2 * G * rate);
    const double after = angleAt(std::acos(-1.0) - 2, 1 - chord);
    INFO(end);
    CHECK(distance(exact.stress.back(), tensor(R * std::cos(after), R * std::sin(after))) <= 1e-8 * R);
    REQUIRE(exact.yieldTime);
    CHECK(*exact.yieldTime == Approx(chord).epsilon(1e-9));
    CHECK(exact.drift <= 1e-10);

    // from an angle of 1 rad it is plastic at once
    const auto flow = integrateRates(material, tensor(R * std::cos(1), R * std::sin(1)),
                                     StrainPath::table({0, 1}, {SymmetricTensor{}, straight}));
    CHECK(distance(flow.stress.back(), tensor(R * std::cos(angleAt(1, 1)), R * std::sin(angleAt(1, 1)))) <= 1e-8 * R);
    CHECK(flow.yieldTime == std::optional(0.0));
    CHECK_THROWS_WITH(integrateRates(material, tensor(2 * R, 0), StrainPath::table({0, 1}, {{}, straight})),
                      Contains("start stress"));
}

TEST_CASE("Drucker-Prager: the return map converges to the cone's rate equations, with order 1 where axes turn")
{
    using constitutive::ConeMatch;
    using constitutive::DruckerPrager;
    const constitutive::ElasticModuli moduli{20e6, 0.3};
    const std::vector<constitutive::DruckerPragerParameters> soils = {{moduli, 10e3, 30, 30, ConeMatch::planeStrain},
                                                                      {moduli, 10e3, 30, 10, ConeMatch::compression},
                                                                      {moduli, 1e3, 42, 0, ConeMatch::extension}};
    for (const auto& soil : soils)
        for (const Case& c : {cases[0], cases[3]})
        {
            const RateSolution exact = integrateRates(soil, c.start, pathOf(c));
            const auto rows = judgeReturnMap(DruckerPrager(soil), c.start, pathOf(c), exact, {1, 256, 512});
            INFO(DruckerPrager(soil).describe() << ", " << c.name);
            CHECK(exact.yieldTime);
            CHECK(exact.drift <= 1e-9);
            CHECK(rows[0].final > 10 * rows[2].final);
            CHECK(rows[2].final <= 2e-3);
            CHECK(*rows[2].order == Approx(1.0).margin(0.05));
            CHECK(std::abs(rows[2].yield) <= 1e-13);
        }
    // without friction: von Mises
    const SymmetricTensor start{-50e3, -60e3, -55e3, 0, 0, 0};
    const auto cone = integrateRates(constitutive::DruckerPragerParameters{moduli, 10e3, 0, 0, ConeMatch::compression},
                                     start, pathOf(cases[2]));
    const auto mises = integrateRates(VonMisesParameters{moduli, 20e3}, start, pathOf(cases[2]));
    CHECK(distance(cone.stress.back(), mises.stress.back()) <= 1e-9 * norm(mises.stress.back()));
    // beyond the apex there are no rates
    CHECK_THROWS_AS(
        integrateRates(soils[0], {}, StrainPath::table({0, 1}, {SymmetricTensor{}, {1e-2, 1e-2, 1.01e-2, 0, 0, 0}})),
        StepError);
}

TEST_CASE("laws in sub-steps: one step of turning axes is as good as its tolerance, at a price that is told")
{
    // the paths of `cases` whose rates are a constant rate in axes that turn: 35 % and 11 % in one plain step
    struct Turning
    {
        const Case& of;
        double spin;
    };
    for (const auto& [of, spin] : {Turning{cases[0], 1.2}, Turning{cases[2], 1.0}})
    {
        std::array<Harmonic, 6> components{}, constant{};
        components[0] = {of.xx, of.w, false};
        components[1] = {of.yy, of.w, false};
        components[3] = {of.xy, of.w, true};
        constant[0] = {of.xx, 0, false};
        constant[1] = {of.yy, 0, false};
        const StrainPath path = StrainPath::turning(constant, spin, 1);
        const auto known = StrainPath::harmonic(components, 1).increment(0, 0.1, 0.7);
        CHECK(distance(path.increment(0, 0.1, 0.7), known) <= 1e-15);
        const RateSolution exact = integrateRates(of.material, of.start, path);
        const MohrCoulomb plain(of.material);
        double before = 1;
        for (const double tolerance : {1e-3, 1e-4, 1e-5})
        {
            const auto rows = judgeSubsteps(MohrCoulomb(of.material, constitutive::Substep{tolerance}), plain, of.start,
                                            path, exact, {1, 4, 64});
            INFO(of.name << ", tolerance " << tolerance);
            for (const auto& row : rows)
            {
                std::printf("%-32s tolerance %.0e, %2d steps: error %.2e, %6.1f law calls a step\n", of.name.c_str(),
                            tolerance, row.steps, row.final, row.calls);
                CHECK(row.final <= tolerance * (row.steps == 1 ? 1 : 3)); // each step's error is held, their sum is not
                CHECK(std::abs(row.yield) <= 1e-13);
            }
            CHECK(rows[0].calls > rows[2].calls); // short steps need fewer parts
            CHECK(rows[0].final < before);
            before = rows[0].final;
        }
        CHECK(judgeReturnMap(plain, of.start, path, exact, {1}).front().final > 0.1);
    }
}

TEST_CASE("the ODE solver finds events in their direction and starts anew")
{
    OdeSolver ode(1, 1e-12, 1e-14, [](double t, const double*, double* rate) { rate[0] = std::cos(t); });
    const auto zero = [](double, const double* y, double* values) { values[0] = values[1] = y[0]; };
    ode.restart(1, {std::sin(1.0)}, {zero, {1, -1}});
    while (ode.advance(10) == OdeSolver::Stop::step)
    {}
    CHECK(ode.time() == Approx(std::acos(-1.0)).epsilon(1e-10));
    CHECK(ode.happened() == std::vector<bool>{false, true});
    ode.restart(ode.time(), ode.state(), {zero, {1, 1}});
    while (ode.advance(10) == OdeSolver::Stop::step)
    {}
    CHECK(ode.time() == Approx(2 * std::acos(-1.0)).epsilon(1e-10));
    OdeSolver bad(1, 1e-12, 1e-14, [](double t, const double*, double* rate) { rate[0] = std::sqrt(1 - t); });
    bad.restart(0, {0});
    CHECK_THROWS_AS(
        [&] {
            for (int i = 0; i < 100000; ++i)
                if (bad.advance(2) == OdeSolver::Stop::end)
                    return;
        }(),
        StepError);
}

TEST_CASE("with fixed axes and a straight path the return map is exact: ODE and map agree on face, edges and apex")
{
    const double e = 1e-2;
    struct Straight
    {
        MohrCoulombParameters material;
        SymmetricTensor start, strain;
        Region end;
    };
    const std::vector<Straight> paths = {
        {nonassoc, {-50e3, -50e3, -50e3, 0, 0, 0}, {e, -2 * e, 1.1 * e, 0, 0, 0}, Region::edge1},
        {nonassoc, {-50e3, -50e3, -50e3, 0, 0, 0}, {e, -2 * e, e, 0, 0, 0}, Region::edge1},
        {assoc, {-50e3, -50e3, -50e3, 0, 0, 0}, {2 * e, -1.2 * e, -1.2 * e, 0, 0, 0}, Region::edge2},
        {tresca, {-50e3, -50e3, -50e3, 0, 0, 0}, {e, -2 * e, e, 0, 0, 0}, Region::edge1},
        {tresca, {-50e3, -50e3, -50e3, 0, 0, 0}, {2 * e, -e, -1.1 * e, 0, 0, 0}, Region::edge2},
        {paper, {-50e3, -80e3, -65e3, 0, 0, 0}, {e, -e, 0, 0, 0, 0}, Region::face},
        {nonassoc, {-50e3, -50e3, -50e3, 0, 0, 0}, {e, e, e, 0, 0, 0}, Region::apex},
        {paper, {-50e3, -50e3, -50e3, 0, 0, 0}, {e, e, e, 0, 0, 0}, Region::apex},
        {drySand, {}, {e, e, e, 0, 0, 0}, Region::apex},
        {drySand, {}, {-e, -1.1 * e, -1.05 * e, 0, 0, 0}, Region::elastic},
    };
    for (const auto& c : paths)
    {
        const StrainPath path = StrainPath::table({0, 1}, {SymmetricTensor{}, c.strain});
        const RateSolution exact = integrateRates(c.material, c.start, path);
        const auto map = constitutive::updatePoint(MohrCoulomb(c.material), c.start, c.strain);
        INFO(constitutive::regionName(c.end));
        CHECK(exact.events.back().region == c.end);
        CHECK(map.region == c.end);
        CHECK(distance(exact.stress.back(), map.stress) <= 1e-9 * std::max(norm(c.start), norm(map.stress)));
    }
}

TEST_CASE("yield, unloading and reloading are found at their times")
{
    // oedometer of Tresca's law: yield at 2 G |e| = 2 c, unloading elastic, yield again after twice that
    const double G = tresca.moduli.shear(), first = tresca.cohesion / G;
    const std::vector<double> times{0, 2, 3, 6};
    std::vector<SymmetricTensor> strains(4);
    strains[1][1] = -2 * first;
    strains[2][1] = -first;
    strains[3][1] = -4 * first;
    const StrainPath path = StrainPath::table(times, strains);
    const RateSolution exact = integrateRates(tresca, {-50e3, -50e3, -50e3, 0, 0, 0}, path);
    std::vector<Region> regions;
    for (const auto& event : exact.events)
        regions.push_back(event.region);
    REQUIRE(regions == std::vector<Region>{Region::elastic, Region::edge1, Region::elastic, Region::edge1});
    CHECK(exact.events[1].time == Approx(1).epsilon(1e-9));
    CHECK(exact.events[2].time == 2);
    CHECK(exact.events[3].time == Approx(4).epsilon(1e-9));
    const auto& s = exact.stress.back();
    CHECK(s[0] - s[1] == Approx(2 * tresca.cohesion).epsilon(1e-9));
    const double K = tresca.moduli.bulk();
    CHECK((s[0] + s[1] + s[2]) / 3 == Approx(-50e3 - 4 * K * first).epsilon(1e-9));
}

TEST_CASE("random paths over every region: the return map converges to the ODE's stress")
{
    std::map<Region, int> entered;
    const std::vector<MohrCoulombParameters> materials = {paper, assoc, nonassoc, tresca, drySand};
    for (int seed = 100; seed < 140; ++seed)
    {
        std::mt19937 random(seed);
        const auto uniform = [&random] { return 2.0 * random() / random.max() - 1; };
        const bool plane = seed % 2, harmonic = seed % 4 < 2;
        const auto& material = materials[seed % materials.size()];
        const double amplitude = 1e-2;
        SymmetricTensor start{-50e3, -60e3, -55e3, 0, 0, 0};
        if (seed % 3 == 0)
            start = {-50e3, -50e3, -50e3, 0, 0, 0};
        std::array<Harmonic, 6> rates{};
        std::vector<double> times;
        std::vector<SymmetricTensor> strains;
        SymmetricTensor strain{};
        for (int i = 0; i <= 20; ++i)
        {
            times.push_back(0.05 * i);
            strains.push_back(strain);
            for (int k = 0; k < 6; ++k)
                if (!plane || k < 2 || k == 3)
                    strain[k] += 0.1 * amplitude * uniform();
        }
        for (int k = 0; k < 6; ++k)
            if (!plane || k < 2 || k == 3)
                rates[k] = {amplitude * uniform(), 3 + uniform(), uniform() > 0};
        const StrainPath path = harmonic ? StrainPath::harmonic(rates, 1) : StrainPath::table(times, strains);

        const RateSolution exact = integrateRates(material, start, path);
        const int most = harmonic ? 4096 : 512;
        const auto rows = judgeReturnMap(MohrCoulomb(material), start, path, exact, {most / 8, most});
        INFO("seed " << seed);
        CHECK(exact.drift <= 1e-9);
        CHECK(rows[1].largest <= 2e-4);
        CHECK((rows[1].largest <= 1e-9 || rows[1].largest <= 0.25 * rows[0].largest));
        for (const auto& event : exact.events)
            ++entered[event.region];
    }
    for (const Region region : {Region::elastic, Region::face, Region::edge1, Region::edge2, Region::apex})
        CHECK(entered[region] >= 5);
}

TEST_CASE("what the reference cannot answer is refused")
{
    const StrainPath path = StrainPath::table({0, 1}, {SymmetricTensor{}, SymmetricTensor{1e-3, 0, 0, 0, 0, 0}});
    CHECK_THROWS_WITH(integrateRates(paper, {1e5, 0, 0, 0, 0, 0}, path), Contains("start stress"));
    CHECK_THROWS_WITH(integrateRates(MohrCoulombParameters{{20e6, 0.5}, 1e3, 42, 0}, {}, path), Contains("nu"));
    CHECK_THROWS_WITH(StrainPath::table({0, 1, 1}, std::vector<SymmetricTensor>(3)), Contains("growing"));
    CHECK_THROWS_WITH(StrainPath::table({0}, std::vector<SymmetricTensor>(1)), Contains("at least 2"));
    CHECK_THROWS_WITH(StrainPath::harmonic({}, 0), Contains("> 0"));
}
