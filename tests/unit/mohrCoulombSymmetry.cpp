/// What Mohr-Coulomb's return map keeps: rotations, plane strain in 3D, energy, the elastic bits, units, zero; its
/// bounds.
#include "constitutive/linearElastic.hpp"
#include "support/mohrCoulombStates.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <map>

using namespace mpm;
using namespace mpm::test;
using constitutive::updatePoint;

TEST_CASE("turning the axes turns the answer")
{
    std::mt19937_64 random(17);
    for (int i = 0; i < 600; ++i)
    {
        const MohrCoulombParameters& p = materials[i % materials.size()];
        const Eigen::Matrix3d axes = randomAxes(random);
        const Eigen::Matrix3d start = randomTrial(p, random).asDiagonal();
        Eigen::Matrix3d strain = randomAxes(random);
        strain = 1e-4 * (strain + strain.transpose()).eval();
        const auto here = updatePoint(MohrCoulomb(p), tensor(start), tensor(strain));
        const auto there = updatePoint(MohrCoulomb(p), tensor(axes * start * axes.transpose()),
                                       tensor(axes * strain * axes.transpose()));
        const double size = largest(tensor(start)) + MohrCoulomb(p).waveModulus() * 1e-4;
        CHECK(distance(there.stress, tensor(axes * matrix(here.stress) * axes.transpose())) <= 1e-13 * size);
        CHECK(there.plasticWork == Approx(here.plasticWork).epsilon(1e-9).margin(1e-13 * size * size / p.moduli.young));
    }
}

TEST_CASE("plane strain equals 3D")
{
    std::mt19937_64 random(19);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::map<Region, int> hits;
    for (int i = 0; i < 100; ++i)
    {
        const MohrCoulombParameters& p = materials[i % materials.size()];
        Chunk<2> plane;
        Chunk<3> solid;
        double size = 0;
        for (int lane = 0; lane < lanes; ++lane)
        {
            const Eigen::Vector3d s = randomTrial(p, random);
            const SymmetricTensor stress{s(0), s(1), s(2), 0.5 * (s(0) - s(2)), 0, 0};
            const double e = s.norm() / p.moduli.young;
            const SymmetricTensor strain{e * uniform(random), e * uniform(random), 0, e * uniform(random), 0, 0};
            fill(plane, lane, stress, strain);
            fill(solid, lane, stress, strain);
            size = std::max(size, s.norm());
        }
        MohrCoulomb(p).update(plane);
        MohrCoulomb(p).update(solid);
        for (int lane = 0; lane < lanes; ++lane)
        {
            CHECK(distance(stressOf(plane, lane), stressOf(solid, lane)) <= 1e-13 * size);
            CHECK(std::abs(solid.stress[4][lane]) + std::abs(solid.stress[5][lane]) <= 1e-13 * size);
            CHECK(plane.region[lane] == solid.region[lane]);
            CHECK(plane.apexStrain[lane] == Approx(solid.apexStrain[lane]).epsilon(1e-9));
            ++hits[plane.region[lane]];
        }
    }
    for (const Region region : {Region::elastic, Region::face, Region::edge1, Region::edge2, Region::apex})
        CHECK(hits[region] >= 50);
}

TEST_CASE("associated flow dissipates: plastic work is never negative, and all energy is accounted for")
{
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> uniform(-1, 1);
    MohrCoulombParameters frictional = paper;
    frictional.dilationAngle = frictional.frictionAngle;
    for (const auto& p : {assoc, tresca, frictional})
    {
        const MohrCoulomb law(p);
        SymmetricTensor stress{};
        double plastic = 0;
        for (int i = 0; i < 2000; ++i)
        {
            SymmetricTensor strain;
            for (double& e : strain)
                e = 2e-4 * uniform(random);
            const auto out = updatePoint(law, stress, strain);
            const double before = constitutive::elasticEnergyDensity<3>(
                *reinterpret_cast<const double(*)[6]>(stress.data()), law.bulkModulus(), law.shearModulus());
            const double after = constitutive::elasticEnergyDensity<3>(
                *reinterpret_cast<const double(*)[6]>(out.stress.data()), law.bulkModulus(), law.shearModulus());
            const Eigen::Matrix3d middle = 0.5 * (matrix(stress) + matrix(out.stress));
            const double work = middle.cwiseProduct(matrix(strain)).sum();
            const double size = largest(out.stress) + largest(stress) + p.moduli.young * 2e-4;
            CHECK(work == Approx(after - before + out.plasticWork).margin(1e-13 * size * size / p.moduli.young));
            // dEps_p = C^-1 (trial - end); its work with the end stress is the dissipation of the backward step
            const double nu = p.moduli.poisson;
            const auto trial = updatePoint(constitutive::LinearElastic(p.moduli), stress, strain).stress;
            const Eigen::Matrix3d lost = matrix(trial) - matrix(out.stress);
            const Eigen::Matrix3d flow =
                ((1 + nu) * lost - nu * lost.trace() * Eigen::Matrix3d::Identity()) / p.moduli.young;
            CHECK(matrix(out.stress).cwiseProduct(flow).sum() >= -1e-12 * size * size / p.moduli.young);
            plastic += out.plasticWork;
            stress = out.stress;
        }
        CHECK(plastic > 0);
    }
}

TEST_CASE("stresses inside the surface are the elastic trial to the last bit; infinite cohesion is elasticity")
{
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const double cohesion : {1e3, 1e30, 1e200})
    {
        MohrCoulombParameters p = paper;
        p.cohesion = cohesion;
        const constitutive::LinearElastic elastic(p.moduli);
        int inside = 0;
        const auto compare = [&](auto chunk) {
            constexpr int nc = std::decay_t<decltype(chunk)>::nc;
            for (int i = 0; i < lanes; ++i)
                for (int k = 0; k < nc; ++k)
                {
                    chunk.stress[k][i] = 1e4 * uniform(random) - (k < 3 ? 2e4 : 0);
                    chunk.dStrain[k][i] = 1e-4 * uniform(random);
                }
            auto reference = chunk;
            MohrCoulomb(p).update(chunk);
            elastic.update(reference);
            for (int i = 0; i < lanes; ++i)
            {
                if (cohesion > 1e4)
                    REQUIRE(chunk.region[i] == Region::elastic);
                if (chunk.region[i] != Region::elastic)
                    continue;
                ++inside;
                for (int k = 0; k < nc; ++k)
                    CHECK(std::memcmp(&chunk.stress[k][i], &reference.stress[k][i], sizeof(double)) == 0);
                CHECK(chunk.plasticWork[i] == 0);
                CHECK(chunk.apexStrain[i] == 0);
                CHECK(chunk.yield[i] <= 0);
            }
        };
        compare(Chunk<2>());
        compare(Chunk<3>());
        CHECK(inside >= 20);
    }
}

TEST_CASE("units by powers of two change no bit")
{
    std::mt19937_64 random(31);
    for (const double unit : {0x1p-30, 0x1p10, 0x1p40})
        for (const auto& p : materials)
        {
            MohrCoulombParameters scaled = p;
            scaled.moduli.young *= unit;
            scaled.cohesion *= unit;
            Chunk<3> solid, solidScaled;
            Chunk<2> plane, planeScaled;
            for (int i = 0; i < lanes; ++i)
            {
                const Eigen::Matrix3d axes = randomAxes(random);
                const Eigen::Matrix3d s = axes * randomTrial(p, random).asDiagonal() * axes.transpose();
                const SymmetricTensor strain{1e-5, -2e-5, 0, 1e-5, 0, 0};
                fill(solid, i, tensor(s), strain);
                fill(solidScaled, i, tensor(unit * s), strain);
                fill(plane, i, tensor(s), strain);
                fill(planeScaled, i, tensor(unit * s), strain);
            }
            const auto compare = [&](auto& chunk, auto& big) {
                MohrCoulomb(p).update(chunk);
                MohrCoulomb(scaled).update(big);
                for (int i = 0; i < lanes; ++i)
                {
                    for (int k = 0; k < chunk.nc; ++k)
                        CHECK(big.stress[k][i] == unit * chunk.stress[k][i]);
                    CHECK(big.plasticWork[i] == unit * chunk.plasticWork[i]);
                    CHECK(big.apexStrain[i] == chunk.apexStrain[i]);
                    CHECK(big.yield[i] == chunk.yield[i]);
                    CHECK(big.region[i] == chunk.region[i]);
                }
            };
            compare(solid, solidScaled);
            compare(plane, planeScaled);
        }
}

TEST_CASE("dry sand without stress and strain stays zero to the last bit")
{
    Chunk<3> solid;
    Chunk<2> plane;
    for (int i = 0; i < lanes; ++i)
    {
        fill(solid, i, {});
        fill(plane, i, {});
    }
    const auto check = [](auto& chunk) {
        MohrCoulomb(drySand).update(chunk);
        for (int i = 0; i < lanes; ++i)
            for (int k = 0; k < chunk.nc; ++k)
            {
                const double zero = 0;
                CHECK(std::memcmp(&chunk.stress[k][i], &zero, sizeof(double)) == 0);
                CHECK(chunk.plasticWork[i] == 0);
                CHECK(chunk.yield[i] == 0);
                CHECK(chunk.region[i] == Region::elastic);
            }
        CHECK(chunk.apexReturns == 0);
    };
    check(solid);
    check(plane);
}

TEST_CASE("only lanes that count are counted as apex returns")
{
    Chunk<2> chunk;
    for (int i = 0; i < lanes; ++i)
        fill(chunk, i, {1e5, 1e5, 1e5, 0, 0, 0});
    chunk.count = 5;
    MohrCoulomb(paper).update(chunk);
    CHECK(chunk.apexReturns == 5);
}

TEST_CASE("parameters out of bounds are refused by name")
{
    const auto message = [](const MohrCoulombParameters& p) {
        try
        {
            MohrCoulomb law(p);
        }
        catch (const InputError& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(message({{20e6, 0.5}, 1e3, 42, 0}), Contains("nu: found 0.5") && Contains("(-1, 0.5)"));
    CHECK_THAT(message({{20e6, -1}, 1e3, 42, 0}), Contains("nu: found -1"));
    CHECK_THAT(message({{0, 0.3}, 1e3, 42, 0}), Contains("E: found 0"));
    CHECK_THAT(message({{20e6, 0.3}, -1, 42, 0}), Contains("cohesion: found -1"));
    CHECK_THAT(message({{20e6, 0.3}, 1e3, 90, 0}), Contains("frictionAngle: found 90") && Contains("[0, 90)"));
    CHECK_THAT(message({{20e6, 0.3}, 1e3, 30, 31}), Contains("dilationAngle: found 31") && Contains("30"));
    CHECK_THAT(message({{20e6, 0.3}, 1e3, 30, -1}), Contains("dilationAngle: found -1"));
    CHECK(message({{20e6, 0.3}, 0, 0, 0}).empty());
}
