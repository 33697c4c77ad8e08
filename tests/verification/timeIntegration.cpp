// Temporal errors on the manufactured bar, against the semi-discrete equations by CVODE (what checkIntegration -time
// prints), beside those of an independent 1D calculation.
//
// Set-up: neo-Hookean, E = 10 MPa, nu = 0, rho = 1000 kg/m^3, u = A sin(pi X) sin(c pi t), c = 100 m/s, the odd
// periodic bar on [0, 2) m; body force b = (pi^2 u/rho) (E/2 (1 + 1/F^2) - E). 32 cells a metre, two particles a cell,
// one cell thick between rollers; RMS position error at t = 0.015 s against c dt/h. Source of the table
// tests/support/mms1dWorkPrecision.csv: a 1D calculation with DOP853 as the reference; CD is USL with a staggered
// start.
#include "base/csvTable.hpp"
#include "case/timeCheck.hpp"
#include "constitutive/neoHookean.hpp"
#include "reference/semiDiscreteSolution.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <map>

using namespace mpm;

namespace
{
constexpr double E = 1e7, density = 1000, c = 100;

class BarForce : public stepping::BodyForce
{
  public:
    BarForce(double A, std::vector<double> X) : A_(A), X_(std::move(X)) {}
    void acceleration(const state::Particles& p, Index first, int count, double t, double (&b)[3][lanes]) const override
    {
        for (int l = 0; l < count; ++l)
        {
            const double X = X_[std::size_t(p.id[std::size_t(first + l)])];
            const double u = A_ * std::sin(M_PI * X) * std::sin(c * M_PI * t);
            const double F = 1 + M_PI * A_ * std::cos(M_PI * X) * std::sin(c * M_PI * t);
            b[0][l] = M_PI * M_PI * u / density * (0.5 * E * (1 + 1 / (F * F)) - E);
            b[1][l] = b[2][l] = 0;
        }
    }

  private:
    double A_;
    std::vector<double> X_;
};

struct Bar
{
    state::State state;
    cases::SceneOfCase scene;
    std::vector<double> X;
};

Bar makeBar(const std::string& shape, double A, Index N)
{
    const double h = 1.0 / double(N);
    Bar bar{
        scenes::seedBlock({.n = {4 * N, 2, 1}, .spacing = h / 2, .h = h, .density = density, .cells = {2 * N, 1, 1}}),
        {},
        {}};
    bar.state.grid.periodic[0] = true;
    auto& p = bar.state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        bar.X.push_back(p.x[0][i]);
        p.v[0][i] = A * M_PI * c * std::sin(M_PI * p.x[0][i]);
    }
    auto& scene = bar.scene.scene;
    scene.materials = {
        {"solid", density, std::make_shared<constitutive::NeoHookean>(constitutive::ElasticModuli{E, 0})}};
    scene.bodyForce = std::make_shared<BarForce>(A, bar.X);
    using nodal::WallType;
    scene.walls = {{"below", WallType::roller, 1, -1, 0, 0, false}, {"above", WallType::roller, 1, 1, 1, 0, false}};
    bar.scene.shape = shape;
    return bar;
}

std::vector<double> solve(semiDiscrete::SemiDiscrete& equations, const state::State& state,
                          const semiDiscrete::Model& model, double window, double tolerance)
{
    return reference::integrateSemiDiscrete(equations, state, model, window, tolerance).y;
}

constexpr int rowsPerScheme = 5; // c dt/h = 0.8, 0.4, 0.2, 0.1, 0.05

/// Errors of MUSL in a 1D calculation of the same bar that takes the very steps of ExplicitStepper: particles move by
/// v* and are strained by the second projection. The table's MUSL moves them by the second projection too, which makes
/// it of order 2. The table's staggered start knows the velocities at dt/2; a first kick of half a step is none here,
/// as no force acts at t = 0, so that staggered rows are those without.
const std::map<double, std::vector<double>> muslIn1D = {
    {1e-4, {7.4223e-08, 2.3077e-08, 8.0300e-09, 3.1378e-09, 1.3496e-09}},
    {0.05, {4.3032e-05, 1.5155e-05, 6.1050e-06, 2.7117e-06, 1.2757e-06}}};

/// The errors of the independent table.
std::vector<double> tableErrors(const std::string& shape, double A, const std::string& scheme)
{
    const CsvTable table = CsvTable::read(MPM_SOURCE_DIR "/tests/support/mms1dWorkPrecision.csv");
    const auto error = table.column("temporal_error_vs_semidiscrete_ODE"), amplitude = table.column("A");
    std::vector<double> out;
    for (const auto& row : table.rows())
        if (row.cells[table.column("basis")] == (shape == "cubicBSpline" ? "bs3" : shape) &&
            table.number(row, amplitude) == A && row.cells[table.column("scheme")] == scheme)
            out.push_back(table.number(row, error));
    return out;
}

struct Study
{
    cases::TimeCheckResult result;
    std::map<std::string, std::vector<cases::TimeCheckRow>> rows;
};

Study study(const std::string& shape, double A, const std::vector<std::string>& schemes)
{
    const Bar bar = makeBar(shape, A, 32);
    cases::TimeCheck check;
    check.window = 0.015;
    check.tolerance = 1e-13;
    check.schemes = schemes;
    for (const double courant : {0.8, 0.4, 0.2, 0.1, 0.05})
        check.deltaT.push_back(courant / 32 / c);
    check.exact = [A](const Vector3& X, double t) {
        return Vector3{A * std::sin(M_PI * X[0]) * std::sin(c * M_PI * t), 0, 0};
    };
    Study out;
    out.result = cases::runTimeCheck(check, bar.scene, bar.state, solve);
    fmt::print("{}, A = {}\n{}", shape, A, cases::timeCheckText(check, out.result, bar.scene, bar.state));
    for (const auto& row : out.result.rows)
    {
        REQUIRE(row.failure.empty());
        out.rows[row.scheme].push_back(row);
    }
    return out;
}

/// Within 1 % of known errors, as far as these lie above the reference's own.
void meets(const Study& s, const std::string& scheme, const std::vector<double>& known)
{
    const auto& rows = s.rows.at(scheme);
    REQUIRE(known.size() >= rowsPerScheme);
    REQUIRE(rows.size() == rowsPerScheme);
    int compared = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        INFO(scheme << " row " << i);
        if (known[i] < 5 * s.result.referenceError || known[i] < 1e-13)
            continue;
        CHECK(rows[i].error == Approx(known[i]).epsilon(0.01));
        ++compared;
    }
    CHECK(compared >= 2);
}
} // namespace

TEST_CASE("the bar in cubic splines: temporal errors and orders, without and with particles that cross cells", "[long]")
{
    for (const double A : {1e-4, 0.05})
    {
        const auto s = study("cubicBSpline", A, {"USL", "MUSL", "strainVelocityMUSL", "staggeredMUSL", "RK2", "RK4"});
        CHECK(*s.result.spatial == Approx(A == 0.05 ? 3.4853e-5 : 8.0818e-9).epsilon(1e-4));
        for (const std::string scheme : {"USL", "RK2", "RK4"})
            meets(s, scheme, tableErrors("cubicBSpline", A, scheme));
        for (const std::string scheme : {"MUSL", "staggeredMUSL"})
            meets(s, scheme, muslIn1D.at(A));
        meets(s, "strainVelocityMUSL", tableErrors("cubicBSpline", A, "MUSL"));
        if (A == 1e-4)
            CHECK(*s.rows.at("strainVelocityMUSL").back().order == Approx(2).margin(0.05));
        const auto& rk2 = s.rows.at("RK2");
        CHECK(*rk2.back().order == Approx(2).margin(A == 0.05 ? 0.05 : 0.3));
        CHECK(*s.rows.at("RK4")[1].order >= 3.8);
        // the total error hides the temporal one: that of RK4 is the spatial error
        CHECK(*s.rows.at("RK4").back().total == Approx(*s.result.spatial).epsilon(1e-3));
    }
}

TEST_CASE("the bar in cpGIMP: kinks of the shape show in RK4 alone", "[long]")
{
    const auto s = study("cpGIMP", 0.05, {"RK2", "RK4"});
    CHECK(*s.result.spatial == Approx(2.1696e-5).epsilon(1e-4));
    for (const std::string scheme : {"RK2", "RK4"})
        meets(s, scheme, tableErrors("cpGIMP", 0.05, scheme));
}

TEST_CASE("where there is no ODE each scheme is its own reference, as good as the ODE's")
{
    const Bar smooth = makeBar("cubicBSpline", 0.05, 32);
    Bar other = makeBar("cubicBSpline", 0.05, 32);
    for (auto& wall : other.scene.scene.walls)
        wall.separation = true; // nothing ever leaves them: the same motion, but no ODE
    cases::TimeCheck check;
    check.window = 0.015;
    check.schemes = {"MUSL"};
    for (const double courant : {0.4, 0.2, 0.1})
        check.deltaT.push_back(courant / 32 / c);
    const auto exact = cases::runTimeCheck(check, smooth.scene, smooth.state, solve);
    const auto own = cases::runTimeCheck(check, other.scene, other.state, solve);
    CHECK(exact.noOde.empty());
    CHECK(own.noOde == "the wall 'below' separates: its force jumps");
    CHECK(cases::whyNotScheme("RK4", other.scene) == own.noOde);
    REQUIRE(own.pairErrors.size() == 1);
    REQUIRE(own.rows.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(own.rows[i].error - exact.rows[i].error) <= own.pairErrors[0].second);
    CHECK(own.pairErrors[0].second < own.rows[2].error);
}

TEST_CASE("a scheme that fails is a row that says why")
{
    const Bar bar = makeBar("cubicBSpline", 0.05, 16);
    cases::TimeCheck check;
    check.window = 0.05;
    check.tolerance = 1e-8;
    check.schemes = {"USL"};
    check.deltaT = {4.0 / 16 / c, 0.2 / 16 / c}; // four times the Courant number there can be
    const auto result = cases::runTimeCheck(check, bar.scene, bar.state, solve);
    REQUIRE(result.rows.size() == 2);
    CHECK(!result.rows[0].failure.empty());
    CHECK(result.rows[1].failure.empty());
    const auto table = cases::timeCheckTable(result, bar.state.grid.h);
    CHECK(table.rows()[0].cells[table.column("temporalError")].empty());
    CHECK(!table.rows()[0].cells[table.column("failure")].empty());
}

TEST_CASE("what checkIntegrationDict says of time")
{
    const Bar bar = makeBar("cubicBSpline", 0.05, 32);
    const auto read = [&](const std::string& words) {
        const auto dict = dictionary::Dictionary::fromText("time { " + words + " }", "checkIntegrationDict");
        return cases::readTimeCheck(dict, bar.scene, bar.state);
    };
    const auto check = read("window 0.015; courant (0.4 0.2); schemes (MUSL RK4); "
                            "exact { displacement (\"A*sin(pi*X)*sin(c*pi*t)\" 0); constants { A 0.05; c 100; } }");
    CHECK(check.window == 0.015);
    CHECK(check.schemes == std::vector<std::string>{"MUSL", "RK4"});
    REQUIRE(check.deltaT.size() == 2);
    CHECK(check.deltaT[1] == Approx(0.2 / 32 / c));
    CHECK(check.exact({0.3, 0, 0}, 0.004)[0] == Approx(0.05 * std::sin(0.3 * M_PI) * std::sin(0.4 * M_PI)));
    CHECK(read("window 1;").schemes.size() == 8); // all of them
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(read("window 1; courant (0.1 0.2);"), Contains("falling"));
    CHECK_THROWS_WITH(read("window 1; schemes (USL RK5);"), Contains("RK5") && Contains("staggeredUSL"));
    CHECK_THROWS_WITH(read("window 1; scheme (USL);"), Contains("scheme"));
    CHECK_THROWS_WITH(read("window 0;"), Contains("> 0"));
    CHECK_THROWS_WITH(read("window 1; exact { displacement (\"A*X\" 0); }"), Contains("A"));
}
