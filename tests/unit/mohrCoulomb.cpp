/// Mohr-Coulomb's return map against the reference vectors and an independent brute force.
#include "base/csvTable.hpp"
#include "support/mohrCoulombStates.hpp"

#include <catch2/catch.hpp>
#include <map>

using namespace mpm;
using namespace mpm::test;
using constitutive::returnMap;

TEST_CASE("every reference vector returns to its stress and region, in 3D and in plane strain")
{
    const CsvTable table = CsvTable::read(MPM_SOURCE_DIR "/tests/support/mohrCoulombVectors.csv");
    REQUIRE(table.rows().size() == 18);
    int planar = 0;
    for (const auto& row : table.rows())
    {
        const auto value = [&](const std::string& name) { return table.number(row, table.column(name)); };
        const MohrCoulomb law({{value("E_Pa"), value("nu")}, value("c_Pa"), value("phi_deg"), value("psi_deg")});
        SymmetricTensor trial, expected;
        for (int k = 0; k < 6; ++k)
        {
            trial[k] = value(std::string("tr_") + stressNames[k]);
            expected[k] = value(std::string("ret_") + stressNames[k]);
        }
        INFO(row.cells[0]);
        // the table has 12 digits, so 1e-10 of the largest principal trial stress is what it can prove
        const double allowed = 1e-10 * std::max(std::abs(value("tr_1")), std::abs(value("tr_3")));
        const auto out = returnMap(law, trial);
        CHECK(distance(out.stress, expected) <= allowed);
        CHECK(constitutive::regionName(out.region) == row.cells[table.column("region")]);
        CHECK(out.yield <= 1e-9);
        if (trial[4] != 0 || trial[5] != 0)
            continue;
        ++planar;
        Chunk<2> chunk;
        for (int i = 0; i < lanes; ++i)
            fill(chunk, i, trial);
        law.update(chunk);
        CHECK(distance(stressOf(chunk, 37), expected) <= allowed);
        CHECK(chunk.region[37] == out.region);
        CHECK(chunk.apexReturns == (out.region == Region::apex ? lanes : 0));
    }
    CHECK(planar >= 12);
}

TEST_CASE("10,000 random plastic states solve the complementarity problem")
{
    std::mt19937_64 random(42);
    std::map<Region, int> hits;
    double worst = 0, worstYield = 0, worstWork = 0;
    int states = 0;
    for (std::size_t m = 0; states < 10000; m = (m + 1) % materials.size())
    {
        const MohrCoulombParameters& p = materials[m];
        const MohrCoulomb law(p);
        Chunk<3> chunk;
        std::vector<SymmetricTensor> expected(lanes);
        std::vector<Region> regions(lanes);
        std::vector<double> size(lanes), work(lanes), dropped(lanes);
        int apexes = 0;
        for (int i = 0; i < lanes;)
        {
            const Eigen::Vector3d trial = randomTrial(p, random);
            const Eigen::Matrix3d axes = randomAxes(random);
            auto solution = complementarity(p, trial);
            dropped[i] = 0;
            if (!solution)
            {
                // no solution of the flow rule: only psi = 0 beyond the apex may do that
                const double apex = p.cohesion / std::tan(p.frictionAngle * std::acos(-1.0) / 180);
                REQUIRE(p.dilationAngle == 0);
                REQUIRE(p.frictionAngle > 0);
                REQUIRE(trial.mean() > apex);
                const Eigen::Vector3d lost = trial - Eigen::Vector3d::Constant(apex);
                solution = {Eigen::Vector3d::Constant(apex), Region::apex,
                            ((1 + p.moduli.poisson) * lost - p.moduli.poisson * Eigen::Vector3d::Constant(lost.sum())) /
                                p.moduli.young};
                dropped[i] = (trial.mean() - apex) / p.moduli.bulk();
            }
            if (solution->region == Region::elastic)
                continue;
            fill(chunk, i, tensor(axes * trial.asDiagonal() * axes.transpose()));
            expected[i] = tensor(axes * solution->stress.asDiagonal() * axes.transpose());
            regions[i] = solution->region;
            size[i] = trial.cwiseAbs().maxCoeff();
            // zero strain increment: the step starts at the trial stress
            work[i] = 0.5 * (trial + solution->stress).dot(solution->plasticStrain);
            apexes += regions[i] == Region::apex;
            ++i;
        }
        law.update(chunk);
        CHECK(chunk.apexReturns == apexes);
        for (int i = 0; i < lanes; ++i)
        {
            const SymmetricTensor stress = stressOf(chunk, i);
            worst = std::max(worst, distance(stress, expected[i]) / size[i]);
            worstYield = std::max({worstYield, yieldOf(p, stress), chunk.yield[i]});
            worstWork =
                std::max(worstWork, std::abs(chunk.plasticWork[i] - work[i]) / (size[i] * size[i] / p.moduli.shear()));
            CHECK(chunk.region[i] == regions[i]);
            CHECK(chunk.apexStrain[i] == Approx(dropped[i]).epsilon(1e-9));
            ++hits[chunk.region[i]];
        }
        states += lanes;
    }
    std::printf("%d states, worst error %.1e of the trial stress, worst f %.1e, worst work %.1e\n", states, worst,
                worstYield, worstWork);
    CHECK(worst <= 1e-12);
    CHECK(worstYield <= 1e-9);
    CHECK(worstWork <= 1e-12);
    for (const Region region : {Region::face, Region::edge1, Region::edge2, Region::apex})
        CHECK(hits[region] >= 200);
}

TEST_CASE("nearly repeated principal stresses return as exactly as distinct ones")
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    double worst = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const MohrCoulombParameters& p = materials[i % materials.size()];
        Eigen::Vector3d trial = randomTrial(p, random);
        const double gap = std::pow(10.0, -16 * uniform(random)) * trial.cwiseAbs().maxCoeff();
        trial(1) = trial(i % 2 ? 0 : 2) + (i % 5 ? gap : 0);
        if (i % 7 == 0)
            trial(2) = trial(0) + gap * uniform(random);
        const auto solution = complementarity(p, trial);
        if (!solution)
            continue;
        const Eigen::Matrix3d axes = randomAxes(random);
        const auto out = returnMap(MohrCoulomb(p), tensor(axes * trial.asDiagonal() * axes.transpose()));
        const SymmetricTensor expected = tensor(axes * solution->stress.asDiagonal() * axes.transpose());
        worst = std::max(worst, distance(out.stress, expected) / trial.cwiseAbs().maxCoeff());
    }
    CHECK(worst <= 1e-12);
}

TEST_CASE("the surface is met however far out the trial stress was")
{
    std::mt19937_64 random(11);
    for (const auto& p : materials)
        for (const double far : {1e2, 1e5, 1e9, 1e13})
            for (int i = 0; i < 50; ++i)
            {
                const Eigen::Matrix3d axes = randomAxes(random);
                const Eigen::Vector3d trial = far * randomTrial(p, random);
                const auto out3 = returnMap(MohrCoulomb(p), tensor(axes * trial.asDiagonal() * axes.transpose()));
                CHECK(yieldOf(p, out3.stress) <= 1e-9);
                Chunk<2> chunk;
                for (int lane = 0; lane < lanes; ++lane)
                    fill(chunk, lane, {trial(0), trial(1), trial(2), 0.3 * trial(0) - 0.7 * trial(1), 0, 0});
                MohrCoulomb(p).update(chunk);
                CHECK(yieldOf(p, stressOf(chunk, 0)) <= 1e-9);
            }
}

TEST_CASE("friction near 90 degrees, a touch of friction, a touch of dilation and a negative Poisson ratio")
{
    std::mt19937_64 random(13);
    for (const MohrCoulombParameters& p :
         {MohrCoulombParameters{{20e6, 0.3}, 1e3, 85, 0}, MohrCoulombParameters{{20e6, 0.3}, 1e3, 1e-4, 0},
          MohrCoulombParameters{{20e6, 0.3}, 1e3, 42, 0.5}, MohrCoulombParameters{{20e6, -0.9}, 1e3, 30, 20}})
        for (int i = 0; i < 300; ++i)
        {
            const Eigen::Vector3d trial = randomTrial(p, random);
            const auto solution = complementarity(p, trial);
            if (!solution)
                continue;
            const Eigen::Matrix3d axes = randomAxes(random);
            const auto out = returnMap(MohrCoulomb(p), tensor(axes * trial.asDiagonal() * axes.transpose()));
            const SymmetricTensor expected = tensor(axes * solution->stress.asDiagonal() * axes.transpose());
            CHECK(distance(out.stress, expected) <= 1e-10 * trial.cwiseAbs().maxCoeff());
            CHECK(out.region == solution->region);
        }
}
