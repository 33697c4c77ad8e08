/// Mohr-Coulomb's return map against published-style vectors, an independent brute force, and its symmetries.
#include "base/csvTable.hpp"
#include "constitutive/linearElastic.hpp"
#include "support/principalReturn.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <map>

using namespace mpm;
using namespace mpm::test;
using constitutive::returnMap;
using constitutive::updatePoint;

namespace
{
const MohrCoulombParameters paper{{20e6, 0.42}, 1e3, 42, 0}, assoc{{20e6, 0.3}, 10e3, 30, 30},
    nonassoc{{20e6, 0.3}, 10e3, 30, 10}, tresca{{20e6, 0.3}, 10e3, 0, 0}, drySand{{10e6, 0.25}, 0, 35, 5},
    nearIncompressible{{20e6, 0.499}, 1e3, 42, 0};
const std::vector<MohrCoulombParameters> materials = {paper, assoc, nonassoc, tresca, drySand, nearIncompressible};

template <int dim>
void fill(Chunk<dim>& chunk, int lane, const SymmetricTensor& stress, const SymmetricTensor& dStrain = {})
{
    for (int k = 0; k < stressSize<dim>; ++k)
    {
        chunk.stress[k][lane] = stress[k];
        chunk.dStrain[k][lane] = dStrain[k];
    }
}

template <int dim>
SymmetricTensor stressOf(const Chunk<dim>& chunk, int lane)
{
    SymmetricTensor s{};
    for (int k = 0; k < stressSize<dim>; ++k)
        s[k] = chunk.stress[k][lane];
    return s;
}

double strength(const MohrCoulombParameters& p)
{
    const double sine = std::sin(p.frictionAngle * std::acos(-1.0) / 180);
    return 2 * p.cohesion * std::sqrt((1 + sine) / (1 - sine));
}

/// f over max(|sigma|, sc), by Eigen.
double yieldOf(const MohrCoulombParameters& p, const SymmetricTensor& s)
{
    const double sine = std::sin(p.frictionAngle * std::acos(-1.0) / 180), k = (1 + sine) / (1 - sine);
    const Eigen::Vector3d values = matrix(s).selfadjointView<Eigen::Lower>().eigenvalues();
    const double scale = std::max(values.cwiseAbs().maxCoeff(), strength(p));
    return scale > 0 ? (k * values(2) - values(0) - strength(p)) / scale : 0;
}

/// A principal trial stress outside the surface, sizes from far below to far above the strength.
template <class Random>
Eigen::Vector3d randomTrial(const MohrCoulombParameters& p, Random& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double scale = std::max(strength(p), 1e3) * std::pow(10.0, 1 + uniform(random));
    return scale * (Eigen::Vector3d(uniform(random), uniform(random), uniform(random)) -
                    Eigen::Vector3d::Constant(1 + uniform(random)));
}
} // namespace

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
                            ((1 + p.moduli.poisson) * lost -
                             p.moduli.poisson * Eigen::Vector3d::Constant(lost.sum())) / p.moduli.young};
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
            worstWork = std::max(worstWork, std::abs(chunk.plasticWork[i] - work[i]) / (size[i] * size[i] / p.moduli.shear()));
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
            const double before = constitutive::elasticEnergyDensity<3>(*reinterpret_cast<const double(*)[6]>(stress.data()),
                                                                        law.bulkModulus(), law.shearModulus());
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
