// What happens to a chunk around its law in sweeps, against the functions of constitutive/kinematics.hpp one after the
// other, and the energy of a linear elastic body.
#include "support/scenes.hpp"
#include "support/sweptChunk.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace mpm;
using namespace sweeps;

namespace
{
double sumOfProducts(const double (&a)[lanes], const double (&b)[lanes], int count)
{
    double sum = 0;
    for (int l = 0; l < count; ++l)
        sum += a[l] * b[l];
    return sum;
}

bool near(double value, double expected, double scale)
{
    return std::abs(value - expected) <= 1e-13 * scale;
}
#define CHECK_NEAR(value, expected, scale)                                                                             \
    do                                                                                                                 \
    {                                                                                                                  \
        CAPTURE(double(value), double(expected));                                                                      \
        CHECK(near(value, expected, scale));                                                                           \
    } while (false)

template <int n>
void checkRows(const double (&rows)[n][lanes], const double (&expected)[n][lanes], double scale)
{
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < lanes; ++l)
            CHECK_NEAR(rows[k][l], expected[k][l], scale);
}

/// Of columns, by what belongs to others or to the particles of a part chunk: nothing changed.
template <int dim>
void checkOthers(const Case<dim>& now, const Case<dim>& before)
{
    const auto same = [&](const Column& a, const Column& b) {
        for (int i = 0; i < unused + lanes + unused; ++i)
            if (!now.whole() || i < unused || i >= unused + lanes)
                CHECK(a.values[i] == b.values[i]);
    };
    for (int k = 0; k < dim * dim; ++k)
        same(now.F[k], before.F[k]);
    for (int k = 0; k < stressSize<dim>; ++k)
        same(now.stress[k], before.stress[k]);
    same(now.volume, before.volume);
}

/// Opens the case's columns and sweeps over them; volume0: where a part chunk has copies.
template <int dim>
stepping::StrainColumns<dim> swept(Case<dim>& c, stepping::StrainLanes<dim>& chunk, double (&volume0)[lanes])
{
    const auto columns = open(c, chunk, volume0);
    transfer::Prefetch ahead;
    ahead.clear();
    ahead.begin(0);
    stepping::strainSweep(chunk, columns, c.step, ahead);
    return columns;
}

template <int dim>
void checkSweeps(Case<dim> c)
{
    CAPTURE(dim, c.count, c.large, int(c.step.takenOver), c.step.prepared, c.step.keeps, c.step.plastic);
    const Case<dim> given = c;
    const Expected<dim> expected(given);
    stepping::StrainLanes<dim> chunk;
    double volume0[lanes];
    const auto columns = swept(c, chunk, volume0);
    checkRows(chunk.L, expected.L, 1);
    checkRows(chunk.law.dStrain, expected.strain, 1);
    checkRows(chunk.law.stress, expected.turned, 1e5);
    checkRows(chunk.strainOfForces, expected.strainOfForces, 1);
    CHECK(chunk.inRange);
    for (int l = 0; l < lanes; ++l)
    {
        for (int k = 0; k < dim * dim; ++k)
            CHECK_NEAR(columns.F[k][l], expected.F[k][l], 1);
        CHECK_NEAR(chunk.J[l], expected.J[l], 1);
        CHECK_NEAR(chunk.volume[l], expected.after[l], 3);
        CHECK(chunk.volumeBefore[l] == expected.before[l]);
        CHECK(columns.volume[l] == chunk.volume[l]);
        if (c.step.prepared || c.step.keeps)
            CHECK_NEAR(chunk.workOfForces[l], expected.workBefore[l], 1e5);
    }

    scenes::elastic(E, nu).law->update(chunk.law);
    Numbers any(3);
    double plasticWork = 0, apexVolume = 0, maxYield = 0;
    for (int l = 0; l < lanes; ++l)
    {
        chunk.law.plasticWork[l] = any(10);
        chunk.law.apexStrain[l] = any(1);
        chunk.law.yield[l] = any(1);
        plasticWork += 0.5 * (expected.before[l] + expected.after[l]) * chunk.law.plasticWork[l];
        apexVolume += expected.after[l] * chunk.law.apexStrain[l];
        maxYield = std::max(maxYield, chunk.law.yield[l]);
    }
    stepping::bookSweep(chunk, columns, c.step);
    checkRows(chunk.law.stress, expected.end, 1e6);
    for (int k = 0; k < stressSize<dim>; ++k)
        for (int l = 0; l < lanes; ++l)
            CHECK(columns.stress[k][l] == chunk.law.stress[k][l]);
    checkOthers(c, given);

    stepping::TileSums sums;
    chunk.laneSums.addTo(sums);
    const double before = sumOfProducts(expected.before, expected.workBefore, c.count),
                 after = sumOfProducts(expected.after, expected.workAfter, c.count),
                 energyBefore = sumOfProducts(expected.before, expected.energyBefore, c.count),
                 energyAfter = sumOfProducts(expected.after, expected.energyAfter, c.count), scale = 1e7;
    CHECK_NEAR(sums.strainWorkBefore, c.step.prepared ? 0 : before, scale);
    CHECK_NEAR(sums.strainWork, after, scale);
    if (c.step.keeps)
    {
        CHECK(sums.strainEnergy == 0);
        CHECK(sums.finiteStrainWork == 0);
        for (int l = 0; l < lanes; ++l)
        {
            CHECK_NEAR(chunk.energy[l], expected.energyAfter[l], 1e5);
            CHECK_NEAR(chunk.workOfForcesAfter[l], expected.workAfter[l], 1e6);
            CHECK_NEAR(chunk.missed[l], expected.missed[l], 1e6);
        }
    }
    else
    {
        CHECK_NEAR(sums.strainEnergy, energyAfter, scale);
        // all that linear elasticity stores is the work of forces and what finite steps make out of nothing
        CHECK_NEAR(sums.finiteStrainWork + 0.5 * (before + after), sums.strainEnergy - energyBefore, scale);
    }
    CHECK_NEAR(sums.plasticWork, c.step.plastic ? plasticWork : 0, 1e4);
    CHECK_NEAR(sums.apexVolume, c.step.plastic ? apexVolume : 0, 1e3);
    CHECK(sums.maxYield == (c.step.plastic ? maxYield : 0));
    const double least = *std::min_element(expected.J, expected.J + c.count);
    REQUIRE(least < 1);
    CHECK_NEAR(sums.smallestJacobian, least, 1);
}

template <int dim>
void checkAllWays()
{
    for (const int count : {lanes, 37})
        for (const bool large : {false, true})
            for (const auto takenOver : {TakenOver::start, TakenOver::end})
                for (const bool prepared : {false, true})
                    for (const bool keeps : {false, true})
                        checkSweeps(Case<dim>(count, large, takenOver, prepared, keeps, !keeps));
}

template <int dim>
bool staysInRange(int lane, double xx)
{
    Case<dim> c(lanes, false, TakenOver::start, false, false, false);
    for (int k = 0; k < dim; ++k)
        c.F[k * dim + k].data()[lane] = k == 0 ? xx : 1;
    for (int k = 0; k < dim * dim; ++k)
        if (k % (dim + 1) != 0)
            c.F[k].data()[lane] = 0;
    stepping::StrainLanes<dim> chunk;
    double volume0[lanes];
    swept(c, chunk, volume0);
    return chunk.inRange;
}
} // namespace

TEST_CASE("sweeps around the law do what the functions of motion do one after the other, and book its energy")
{
    checkAllWays<2>();
    checkAllWays<3>();
}

TEST_CASE("short series are taken where all motion is small, and nowhere else")
{
    // one lane turns by 0.3: short series would leave 2e-9
    Case<2> c(lanes, false, TakenOver::start, false, false, true);
    c.L[1][61] = -0.6;
    c.L[2][61] = 0.6;
    checkSweeps(c);
}

TEST_CASE("a volume that is not positive, or no number, is seen in every lane")
{
    for (const int lane : {0, 7, 8, 45, 63})
    {
        CHECK(staysInRange<2>(lane, 1));
        CHECK(staysInRange<3>(lane, 1));
        for (const double bad : {0.0, -1.0, 1e31, double(NAN), double(INFINITY)})
        {
            CAPTURE(lane, bad);
            CHECK_FALSE(staysInRange<2>(lane, bad));
            CHECK_FALSE(staysInRange<3>(lane, bad));
        }
    }
}

TEST_CASE("sums of lanes add to those of a tile")
{
    stepping::LaneSums mine;
    for (int l = 0; l < 8; ++l)
    {
        mine.kinetic[l] = l + 1;
        for (int a = 0; a < 3; ++a)
            mine.momentum[a][l] = (l + 1) * (a + 1);
        mine.fastest[l] = l == 5 ? 9 : l;
        mine.smallestJacobian[l] = l == 6 ? 0.5 : 0.75;
        mine.largestJacobian[l] = l == 2 ? 1.5 : 1.25;
    }
    stepping::TileSums sums;
    sums.kinetic = 100;
    sums.momentum = {1, 2, 3};
    mine.addTo(sums);
    CHECK(sums.kinetic == 136);
    CHECK(sums.momentum == Vector3{37, 74, 111});
    CHECK(sums.fastest == 9);
    CHECK(sums.smallestJacobian == 0.5);
    CHECK(sums.largestJacobian == 1.5);
    stepping::LaneSums none;
    none.addTo(sums);
    CHECK(sums.kinetic == 136);
    CHECK(sums.smallestJacobian == 0.5);
    CHECK(sums.largestJacobian == 1.5);
    CHECK(sums.fastest == 9);
}
