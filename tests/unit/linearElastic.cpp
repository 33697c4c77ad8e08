/// Linear elasticity: closed forms, scaling, and parameters that are refused.
#include "constitutive/linearElastic.hpp"
#include "constitutive/singlePoint.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace mpm;
using namespace mpm::constitutive;

TEST_CASE("confined compression, uniaxial stress and shear have the textbook moduli")
{
    const double E = 20e6, nu = 0.42, e = -1e-3;
    const LinearElastic law({E, nu});
    const double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));

    const auto confined = updatePoint(law, {}, {0, e, 0, 0, 0, 0});
    CHECK(confined.stress[1] == Approx(M * e).epsilon(1e-14));
    CHECK(confined.stress[0] == Approx(nu / (1 - nu) * M * e).epsilon(1e-13));
    CHECK(confined.stress[2] == confined.stress[0]);

    const auto uniaxial = updatePoint(law, {}, {e, -nu * e, -nu * e, 0, 0, 0});
    CHECK(uniaxial.stress[0] == Approx(E * e).epsilon(1e-13));
    CHECK(std::abs(uniaxial.stress[1]) <= 1e-13 * E * std::abs(e));

    const auto shear = updatePoint(law, {1, 2, 3, 4, 5, 6}, {0, 0, 0, e, 2 * e, 3 * e});
    CHECK(shear.stress[3] == Approx(4 + 2 * G * e).epsilon(1e-14));
    CHECK(shear.stress[4] == Approx(5 + 4 * G * e).epsilon(1e-14));
    CHECK(shear.stress[5] == Approx(6 + 6 * G * e).epsilon(1e-14));
    CHECK(shear.stress[0] == 1);

    CHECK(law.waveModulus() == Approx(M).epsilon(1e-14));
    CHECK(law.poissonRatio() == Approx(nu).epsilon(1e-14));
    CHECK_FALSE(law.plastic());
}

TEST_CASE("many small steps of confined compression give M ln F")
{
    const LinearElastic law({1e6, 0.3});
    const double stretch = 0.5;
    SymmetricTensor stress{};
    for (int i = 0; i < 100; ++i)
        stress = updatePoint(law, stress, {0, std::log(stretch) / 100, 0, 0, 0, 0}).stress;
    CHECK(stress[1] == Approx(law.waveModulus() * std::log(stretch)).epsilon(1e-12));
}

TEST_CASE("the work of the mid-step stress is the change of elastic energy, and nothing else is reported")
{
    const LinearElastic law({20e6, 0.499});
    Chunk<2> chunk;
    for (int i = 0; i < lanes; ++i)
        for (int k = 0; k < 4; ++k)
        {
            chunk.stress[k][i] = 100 * (k + 1) - i;
            chunk.dStrain[k][i] = k == 2 ? 0 : 1e-4 * (k - 1.5) + 1e-6 * i;
        }
    const Chunk<2> before = chunk;
    law.update(chunk);
    for (int i = 0; i < lanes; ++i)
    {
        double start[4], end[4], work = 0;
        for (int k = 0; k < 4; ++k)
        {
            start[k] = before.stress[k][i];
            end[k] = chunk.stress[k][i];
            work += (k < 3 ? 1 : 2) * 0.5 * (start[k] + end[k]) * before.dStrain[k][i];
        }
        const double stored = elasticEnergyDensity<2>(end, law.bulkModulus(), law.shearModulus()) -
                              elasticEnergyDensity<2>(start, law.bulkModulus(), law.shearModulus());
        CHECK(work == Approx(stored).epsilon(1e-10));
        CHECK(chunk.plasticWork[i] == 0);
        CHECK(chunk.apexStrain[i] == 0);
        CHECK(chunk.yield[i] == 0);
        CHECK(chunk.region[i] == Region::elastic);
    }
    CHECK(chunk.apexReturns == 0);
}

TEST_CASE("plane strain and 3D agree to the last bit, units of powers of two change none")
{
    const LinearElastic law({20e6, 0.3}), scaled({20e6 * 0x1p20, 0.3});
    Chunk<2> plane, big;
    Chunk<3> solid;
    for (int i = 0; i < lanes; ++i)
        for (int k = 0; k < 6; ++k)
        {
            const double s = k < 4 ? 1e3 * std::sin(1.7 * i + k) : 0,
                         e = k < 4 && k != 2 ? 1e-3 * std::cos(i * k + 0.3) : 0;
            solid.stress[k][i] = s;
            solid.dStrain[k][i] = e;
            if (k < 4)
            {
                plane.stress[k][i] = s;
                plane.dStrain[k][i] = e;
                big.stress[k][i] = s * 0x1p20;
                big.dStrain[k][i] = e;
            }
        }
    law.update(plane);
    law.update(solid);
    scaled.update(big);
    for (int i = 0; i < lanes; ++i)
        for (int k = 0; k < 4; ++k)
        {
            CHECK(plane.stress[k][i] == solid.stress[k][i]);
            CHECK(big.stress[k][i] == plane.stress[k][i] * 0x1p20);
        }
}

TEST_CASE("moduli out of bounds are refused")
{
    CHECK_THROWS_AS(LinearElastic({0, 0.3}), InputError);
    CHECK_THROWS_AS(LinearElastic({1e6, 0.5}), InputError);
    CHECK_THROWS_AS(LinearElastic({1e6, -1}), InputError);
    CHECK_NOTHROW(LinearElastic({1e6, -0.2}));
}
