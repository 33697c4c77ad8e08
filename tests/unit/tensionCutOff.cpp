// The limit of tension on Mohr-Coulomb's and Tresca's surface: all subsets of the nine planes, neutral values, energy.
#include "constitutive/linearElastic.hpp"
#include "constitutive/tresca.hpp"
#include "support/mohrCoulombStates.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <map>

using namespace mpm;
using namespace mpm::test;
using constitutive::returnMap;
using constitutive::updatePoint;

namespace
{
double apexOf(const MohrCoulombParameters& p)
{
    return p.frictionAngle > 0 ? p.cohesion / std::tan(p.frictionAngle * std::acos(-1.0) / 180) : 1e300;
}

MohrCoulombParameters cut(MohrCoulombParameters p, double limit)
{
    p.tensionCutOff = limit;
    return p;
}

/// Materials whose limit acts.
const std::vector<MohrCoulombParameters> cutMaterials = {cut(paper, 0),
                                                         cut(paper, 500),
                                                         cut(assoc, 0),
                                                         cut(assoc, 9e3),
                                                         cut(nonassoc, 4e3),
                                                         cut(tresca, 0),
                                                         cut(tresca, 5e3),
                                                         cut(tresca, 30e3),
                                                         cut(nearIncompressible, 100),
                                                         cut({{20e6, -0.5}, 1e3, 30, 10}, 200),
                                                         cut({{20e6, 0}, 1e3, 20, 0}, 200)};

struct Solution
{
    Eigen::Vector3d stress, plasticStrain;
};

/// Every stress that solves the complementarity problem of the six planes k s_i - s_j = sc and the three s_i = T, of at
/// most three active ones (a cone of more is a union of such), no ordering assumed.
std::vector<Solution> solutions(const MohrCoulombParameters& p, const Eigen::Vector3d& trial)
{
    const double rad = std::acos(-1.0) / 180;
    const double sinPhi = std::sin(p.frictionAngle * rad), sinPsi = std::sin(p.dilationAngle * rad);
    const double k = (1 + sinPhi) / (1 - sinPhi), m = (1 + sinPsi) / (1 - sinPsi), sc = 2 * p.cohesion * std::sqrt(k);
    const Eigen::Matrix3d D =
        p.moduli.lame() * Eigen::Matrix3d::Ones() + 2 * p.moduli.shear() * Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 3, 9> A, B;
    Eigen::Matrix<double, 9, 1> strength;
    int n = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
            const bool limit = i == j;
            A.col(n) =
                limit ? Eigen::Vector3d::Unit(i) : (k * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j)).eval();
            B.col(n) =
                limit ? Eigen::Vector3d::Unit(i) : (m * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j)).eval();
            strength(n++) = limit ? p.tensionCutOff : sc;
        }
    const double size = std::max(trial.cwiseAbs().maxCoeff(), sc), small = 1e-11 * k * size;
    const Eigen::VectorXd f = A.transpose() * trial - strength;
    if (f.maxCoeff() <= 0)
        return {{trial, Eigen::Vector3d::Zero()}};
    std::vector<Solution> out;
    for (int subset = 1; subset < 512; ++subset)
    {
        std::vector<int> planes;
        for (int i = 0; i < 9; ++i)
            if (subset >> i & 1)
                planes.push_back(i);
        if (planes.size() > 3)
            continue;
        Eigen::MatrixXd a(3, planes.size()), b(3, planes.size());
        Eigen::VectorXd right(planes.size());
        for (std::size_t i = 0; i < planes.size(); ++i)
        {
            a.col(Eigen::Index(i)) = A.col(planes[i]);
            b.col(Eigen::Index(i)) = B.col(planes[i]);
            right(Eigen::Index(i)) = f(planes[i]);
        }
        Eigen::FullPivLU<Eigen::MatrixXd> lu(a.transpose() * D * b);
        lu.setThreshold(1e-9);
        if (!lu.isInvertible())
            continue;
        const Eigen::VectorXd multipliers = lu.solve(right);
        const Eigen::Vector3d stress = trial - D * b * multipliers;
        if (multipliers.minCoeff() >= 0 && (A.transpose() * stress - strength).maxCoeff() <= small)
            out.push_back({stress, b * multipliers});
    }
    return out;
}

/// Trials around the tensile corner too, which soil seldom sees.
template <class Random>
Eigen::Vector3d trialOf(const MohrCoulombParameters& p, Random& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double scale = std::max(strength(p), p.tensionCutOff) * std::pow(10.0, uniform(random));
    const double shift = uniform(random);
    return scale *
           (Eigen::Vector3d(uniform(random), uniform(random), uniform(random)) + Eigen::Vector3d::Constant(shift));
}
} // namespace

TEST_CASE("faces, edges and vertices of the cut-off pyramid solve the complementarity problem, which has one solution")
{
    std::mt19937_64 random(5);
    double worst = 0, worstYield = 0, worstWork = 0, spread = 0;
    std::map<Region, int> hits;
    int corners = 0;
    for (const auto& p : cutMaterials)
    {
        REQUIRE(p.tensionCutOff < apexOf(p));
        const MohrCoulomb law(p);
        CHECK(law.tensionLimit() == p.tensionCutOff);
        CHECK_FALSE(law.dropsApexVolume());
        for (int i = 0; i < 1500; ++i)
        {
            const Eigen::Vector3d trial = trialOf(p, random);
            const auto found = solutions(p, trial);
            REQUIRE_FALSE(found.empty());
            const double size = trial.cwiseAbs().maxCoeff();
            for (const auto& other : found)
                spread = std::max(spread, (other.stress - found.front().stress).norm() / size);
            const Eigen::Matrix3d axes = randomAxes(random);
            const auto out = returnMap(law, tensor(axes * trial.asDiagonal() * axes.transpose()));
            const Eigen::Vector3d& end = found.front().stress;
            worst = std::max(worst, distance(out.stress, tensor(axes * end.asDiagonal() * axes.transpose())) / size);
            worstYield = std::max(worstYield, out.yield);
            worstWork =
                std::max(worstWork, std::abs(out.plasticWork - 0.5 * (trial + end).dot(found.front().plasticStrain)) /
                                        (size * size / p.moduli.shear()));
            CHECK(out.apexStrain == 0);
            ++hits[out.region];
            corners += out.region == Region::tension && (end.array() < p.tensionCutOff - 1e-9 * size).count() < 2;
        }
    }
    std::printf("worst error %.1e of the trial stress, worst f %.1e, worst work %.1e, solutions differ by %.1e\n",
                worst, worstYield, worstWork, spread);
    CHECK(worst <= 1e-12);
    CHECK(spread <= 1e-10);
    CHECK(worstYield <= 1e-12);
    CHECK(worstWork <= 1e-12);
    for (const Region region :
         {Region::elastic, Region::face, Region::edge1, Region::edge2, Region::apex, Region::tension})
        CHECK(hits[region] >= 100);
    CHECK(corners >= 100);
}

TEST_CASE("a limit at or above the apex, and an infinite one, are none to the last bit")
{
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const auto& p : materials)
        for (const double limit : {MohrCoulomb(p).tensionLimit(), 2 * MohrCoulomb(p).tensionLimit() + 1})
        {
            const MohrCoulomb plain(p), limited(cut(p, limit));
            CHECK(limited.tensionLimit() == plain.tensionLimit());
            CHECK_FALSE(limited.cutsOff());
            CHECK(limited.dropsApexVolume() == plain.dropsApexVolume());
            const auto compare = [&](auto chunk) {
                for (int l = 0; l < lanes; ++l)
                    for (int k = 0; k < chunk.nc; ++k)
                    {
                        chunk.stress[k][l] = 1e4 * uniform(random) - (k < 3 ? 5e3 : 0);
                        chunk.dStrain[k][l] = 1e-3 * uniform(random);
                    }
                auto other = chunk;
                plain.update(chunk);
                limited.update(other);
                CHECK(std::memcmp(chunk.stress, other.stress, sizeof chunk.stress) == 0);
                CHECK(std::memcmp(chunk.plasticWork, other.plasticWork, sizeof chunk.plasticWork) == 0);
                CHECK(std::memcmp(chunk.apexStrain, other.apexStrain, sizeof chunk.apexStrain) == 0);
                CHECK(std::memcmp(chunk.region, other.region, sizeof chunk.region) == 0);
                CHECK(std::memcmp(chunk.yield, other.yield, sizeof chunk.yield) == 0);
            };
            compare(Chunk<2>());
            compare(Chunk<3>());
        }
}

TEST_CASE("plane strain is the 3D return, and in compression the limit is not felt")
{
    std::mt19937_64 random(19);
    std::map<Region, int> hits;
    for (const auto& p : cutMaterials)
    {
        MohrCoulombParameters without = p;
        without.tensionCutOff = std::numeric_limits<double>::infinity();
        Chunk<2> plane, plain;
        Chunk<3> solid;
        double size = 0;
        for (int l = 0; l < lanes; ++l)
        {
            const Eigen::Vector3d t = trialOf(p, random);
            const double c = std::cos(0.1 * l), s = std::sin(0.1 * l);
            const SymmetricTensor trial{
                c * c * t(0) + s * s * t(1), s * s * t(0) + c * c * t(1), t(2), c * s * (t(0) - t(1)), 0, 0};
            fill(plane, l, trial);
            fill(plain, l, trial);
            fill(solid, l, trial);
            size = std::max(size, t.cwiseAbs().maxCoeff());
        }
        MohrCoulomb(p).update(plane);
        MohrCoulomb(p).update(solid);
        MohrCoulomb(without).update(plain);
        for (int l = 0; l < lanes; ++l)
        {
            CHECK(distance(stressOf(plane, l), stressOf(solid, l)) <= 1e-13 * size);
            CHECK(plane.region[l] == solid.region[l]);
            ++hits[plane.region[l]];
            const auto s = stressOf(plain, l);
            if (matrix(s).selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() <
                p.tensionCutOff * (1 - 1e-9) - 1e-9 * size)
                CHECK(distance(stressOf(plane, l), s) <= 1e-15 * size);
        }
    }
    CHECK(hits[Region::tension] >= 50);
    CHECK(hits[Region::apex] >= 20);
}

TEST_CASE("work goes into elastic energy and dissipation, which is never negative")
{
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const auto& p : cutMaterials)
    {
        const MohrCoulomb law(p);
        SymmetricTensor stress{};
        double dissipated = 0;
        const auto energy = [&](const SymmetricTensor& s) {
            return constitutive::elasticEnergyDensity<3>({s[0], s[1], s[2], s[3], s[4], s[5]}, law.bulkModulus(),
                                                         law.shearModulus());
        };
        for (int i = 0; i < 500; ++i)
        {
            SymmetricTensor strain;
            for (double& e : strain)
                e = 1e-4 * uniform(random);
            const auto out = updatePoint(law, stress, strain);
            const Eigen::Matrix3d middle = 0.5 * (matrix(stress) + matrix(out.stress));
            const double size = largest(out.stress) + largest(stress) + p.moduli.young * 1e-4;
            CHECK(middle.cwiseProduct(matrix(strain)).sum() ==
                  Approx(energy(out.stress) - energy(stress) + out.plasticWork)
                      .margin(1e-13 * size * size / p.moduli.young));
            // the work of the end stress on C^-1 (trial - end): dissipation of the backward Euler step
            const double nu = p.moduli.poisson;
            const Eigen::Matrix3d lost =
                matrix(updatePoint(constitutive::LinearElastic(p.moduli), stress, strain).stress) - matrix(out.stress);
            const double released = matrix(out.stress)
                                        .cwiseProduct((1 + nu) * lost - nu * lost.trace() * Eigen::Matrix3d::Identity())
                                        .sum() /
                                    p.moduli.young;
            CHECK(released >= -1e-12 * size * size / p.moduli.young);
            dissipated += released;
            stress = out.stress;
        }
        CHECK(dissipated > 0);
    }
}

TEST_CASE("uniaxial tension of clay ends at its limit, elsewhere unchanged; tresca is mohrCoulomb without friction")
{
    const constitutive::Tresca clay(cut(tresca, 5e3));
    const auto pulled = returnMap(clay, {20e3, 0, 0, 0, 0, 0});
    // s1 = T; the sides give way by nu/(1 - nu) of what is dropped
    const double nu = tresca.moduli.poisson, side = -nu / (1 - nu) * 15e3;
    CHECK(pulled.region == Region::tension);
    CHECK(pulled.stress[0] == Approx(5e3).epsilon(1e-14));
    CHECK(pulled.stress[1] == Approx(side).epsilon(1e-14));
    CHECK(returnMap(clay, {3e3, 0, 0, 0, 0, 0}).region == Region::elastic);
    CHECK(clay.name() == "tresca");
    const auto read = [](const std::string& text) {
        return constitutive::makeLaw(dictionary::Dictionary::fromText(text));
    };
    const auto a = read("law tresca; E 20e6; nu 0.3; cohesion 10e3; tensionCutOff 5e3;");
    const auto b = read("law mohrCoulomb; E 20e6; nu 0.3; cohesion 10e3; frictionAngle 0; tensionCutOff 5e3;");
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i)
    {
        const auto trial = tensor(trialOf(tresca, random).asDiagonal());
        CHECK(returnMap(*a, trial).stress == returnMap(*b, trial).stress);
    }
    CHECK_THROWS_WITH(read("law mohrCoulomb; E 20e6; nu 0.3; cohesion 1e3; frictionAngle 30; tensionCutOff -1;"),
                      Catch::Matchers::Contains("tensionCutOff") && Catch::Matchers::Contains(">= 0"));
    CHECK_THROWS_AS(MohrCoulomb(cut(paper, std::nan(""))), InputError);
}
