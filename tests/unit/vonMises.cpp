// von Mises: the exact solution of Krieg & Krieg, plane strain and 3D, work and energy, objectivity, wrong parameters.
#include "constitutive/vonMises.hpp"
#include "base/csvTable.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/singlePoint.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <Eigen/Dense>
#include <random>

using namespace mpm;
using namespace mpm::constitutive;
using Eigen::Matrix3d;

namespace
{
double deviator(const SymmetricTensor& s)
{
    const double p = (s[0] + s[1] + s[2]) / 3;
    double square = 0;
    for (int k = 0; k < 6; ++k)
        square += k < 3 ? (s[k] - p) * (s[k] - p) : 2 * s[k] * s[k];
    return std::sqrt(square);
}

double energy(const Law& law, const SymmetricTensor& s)
{
    const double sigma[6] = {s[0], s[1], s[2], s[3], s[4], s[5]};
    return elasticEnergyDensity<3>(sigma, law.bulkModulus(), law.shearModulus());
}

SymmetricTensor tensor(const Matrix3d& m)
{
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

/// A unit direction of stress and one orthogonal to it, both deviators.
struct Plane
{
    SymmetricTensor along, across;
};
const double root2 = std::sqrt(0.5), root6 = 1 / std::sqrt(6.0);
const Plane principalPlane{{2 * root6, -root6, -root6, 0, 0, 0}, {0, root2, -root2, 0, 0, 0}};
const Plane planeStrain{{root2, -root2, 0, 0, 0, 0}, {0, 0, 0, root2, 0, 0}};

SymmetricTensor combine(const Plane& plane, double a, double b)
{
    SymmetricTensor out;
    for (int k = 0; k < 6; ++k)
        out[k] = a * plane.along[k] + b * plane.across[k];
    return out;
}
} // namespace

// |s| = R, angle psi to the strain rate: tan(psi/2) = tan(psi_0/2) exp(-2 G |e'| t/R). G = 80, R = sqrt(2/3)/4,
// psi_0 = 2 rad, |e'| t = 0.01; errors of the return in n steps as in support/kriegKrieg.csv.
TEST_CASE("radial return against the exact solution of Krieg and Krieg")
{
    const double G = 80, R = std::sqrt(2.0 / 3) / 4, rate = 0.01;
    const VonMises law({2 * G * 1.3, 0.3}, 0.25);
    const double angle = 2 * std::atan(std::tan(1.0) * std::exp(-2 * G * rate / R));
    const CsvTable table = CsvTable::read(MPM_SOURCE_DIR "/tests/support/kriegKrieg.csv");
    int compared = 0;
    for (const auto& row : table.rows())
        if (row.cells[table.column("method")] == "radial return")
            for (const Plane& plane : {principalPlane, planeStrain})
            {
                const int n = int(table.number(row, table.column("rtol_or_steps")));
                const auto exact = combine(plane, R * std::cos(angle), R * std::sin(angle));
                const auto step = combine(plane, rate / n, 0);
                auto stress = combine(plane, R * std::cos(2), R * std::sin(2));
                Chunk<2> flat;
                for (int k = 0; k < 4; ++k)
                {
                    std::fill_n(flat.stress[k], lanes, stress[k]);
                    std::fill_n(flat.dStrain[k], lanes, step[k]);
                }
                for (int i = 0; i < n; ++i)
                {
                    const auto out = updatePoint(law, stress, step);
                    CHECK(out.yield <= 4e-16); // the rate points inwards at first: long steps begin inside
                    stress = out.stress;
                    law.update(flat);
                }
                SymmetricTensor error;
                for (int k = 0; k < 6; ++k)
                    error[k] = stress[k] - exact[k];
                CHECK(deviator(error) / R ==
                      Approx(table.number(row, table.column("relative_stress_error"))).epsilon(6e-5));
                if (plane.across[3] != 0)
                    for (int k = 0; k < 4; ++k)
                        CHECK(flat.stress[k][17] == stress[k]); // plane strain and 3D, to the last bit
                ++compared;
            }
    CHECK(compared == 16);
}

TEST_CASE("inside the surface elastic to the last bit; outside the mean stress stays, work is stored or dissipated")
{
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const ElasticModuli moduli{1e6, 0.45};
    const VonMises law(moduli, 20e3);
    const LinearElastic elastic(moduli);
    const double radius = std::sqrt(2.0 / 3) * 20e3;
    int yielded = 0;
    for (int i = 0; i < 200; ++i)
    {
        SymmetricTensor stress{}, strain{};
        for (int k = 0; k < 6; ++k)
            strain[k] = 0.02 * normal(random);
        stress = updatePoint(law, {}, strain).stress;
        for (int k = 0; k < 6; ++k)
            strain[k] = 0.004 * normal(random);
        const auto out = updatePoint(law, stress, strain);
        const auto trial = updatePoint(elastic, stress, strain).stress;
        if (out.region == Region::elastic)
        {
            CHECK(out.stress == trial);
            CHECK(out.yield <= 0);
            CHECK(out.plasticWork == 0);
            continue;
        }
        ++yielded;
        CHECK(deviator(out.stress) == Approx(radius).epsilon(1e-14));
        CHECK(out.stress[0] + out.stress[1] + out.stress[2] ==
              Approx(trial[0] + trial[1] + trial[2]).margin(1e-9 * 20e3));
        double work = 0;
        for (int k = 0; k < 6; ++k)
            work += (k < 3 ? 1 : 2) * 0.5 * (stress[k] + out.stress[k]) * strain[k];
        CHECK(work == Approx(energy(law, out.stress) - energy(law, stress) + out.plasticWork).margin(1e-12 * 20e3));
        const Matrix3d R =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
        const auto turn = [&](const SymmetricTensor& t) {
            Matrix3d m;
            m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
            return tensor(R * m * R.transpose());
        };
        const auto turned = updatePoint(law, turn(stress), turn(strain)).stress, expected = turn(out.stress);
        for (int k = 0; k < 6; ++k)
            CHECK(turned[k] == Approx(expected[k]).margin(1e-11 * 20e3));
    }
    CHECK(yielded > 50);
}

TEST_CASE("uniaxial stress and shear yield at yieldStress and yieldStress/sqrt 3")
{
    const VonMises law({1e6, 0.3}, 20e3);
    const double inside = 1 - 1e-12, outside = 1 + 1e-6;
    CHECK(returnMap(law, {-20e3 * inside, 0, 0, 0, 0, 0}).region == Region::elastic);
    CHECK(returnMap(law, {-20e3 * outside, 0, 0, 0, 0, 0}).region == Region::face);
    CHECK(returnMap(law, {0, 0, 0, 0, 20e3 / std::sqrt(3.0) * inside, 0}).region == Region::elastic);
    CHECK(returnMap(law, {0, 0, 0, 0, 20e3 / std::sqrt(3.0) * outside, 0}).region == Region::face);
    CHECK(returnMap(law, {-1e9, -1e9, -1e9, 0, 0, 0}).region == Region::elastic);
    CHECK(law.plastic());
}

TEST_CASE("parameters out of bounds are refused")
{
    CHECK_THROWS_AS(VonMises({0, 0.3}, 1), InputError);
    CHECK_THROWS_AS(VonMises({1e6, 0.3}, 0), InputError);
    CHECK_THROWS_AS(VonMises({1e6, 0.3}, std::nan("")), InputError);
}
