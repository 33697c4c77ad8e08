// Drucker-Prager: strength where it is matched, the return's conditions one by one, neutral values, energy.
#include "constitutive/druckerPrager.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/vonMises.hpp"
#include "support/mohrCoulombStates.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <map>

using namespace mpm;
using namespace mpm::test;
using constitutive::ConeMatch;
using constitutive::DruckerPrager;
using constitutive::DruckerPragerParameters;
using constitutive::returnMap;
using constitutive::updatePoint;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity(), degree = M_PI / 180;
constexpr constitutive::ElasticModuli moduli{20e6, 0.3};
const std::vector<ConeMatch> matches = {ConeMatch::compression, ConeMatch::extension, ConeMatch::planeStrain};

std::vector<DruckerPragerParameters> materialsOf(std::initializer_list<double> limits)
{
    std::vector<DruckerPragerParameters> out;
    for (const ConeMatch match : matches)
        for (const double limit : limits)
            for (const auto& [c, phi, psi] :
                 {std::array{10e3, 30.0, 0.0}, std::array{10e3, 30.0, 10.0}, std::array{10e3, 30.0, 30.0},
                  std::array{10e3, 0.0, 0.0}, std::array{0.0, 35.0, 5.0}, std::array{1e3, 42.0, 0.0}})
                out.push_back({moduli, c, phi, psi, match, limit});
    return out;
}

double meanOf(const SymmetricTensor& s)
{
    return (s[0] + s[1] + s[2]) / 3;
}

double qOf(const SymmetricTensor& s)
{
    const Eigen::Matrix3d m = matrix(s);
    return std::sqrt(1.5) * (m - m.trace() / 3 * Eigen::Matrix3d::Identity()).norm();
}

template <class Random>
SymmetricTensor randomTrial(const DruckerPragerParameters& p, Random& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double scale = std::max(p.cohesion, 1e3) * std::pow(10.0, 1 + uniform(random));
    const double mean = scale * (uniform(random) - 0.5);
    const Eigen::Matrix3d axes = randomAxes(random);
    const Eigen::Vector3d values = scale * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    return tensor(axes * values.asDiagonal() * axes.transpose() + mean * Eigen::Matrix3d::Identity());
}

/// k s1 - s3 - sc of Mohr-Coulomb with the same c and phi, over its strength.
double mohrCoulombYield(const DruckerPragerParameters& p, const SymmetricTensor& s)
{
    return yieldOf({p.moduli, p.cohesion, p.frictionAngle, 0}, s);
}
} // namespace

TEST_CASE("the cone has Mohr-Coulomb's strength where it is matched, and lies inside or outside elsewhere")
{
    for (const double phi : {0.0, 20.0, 35.0})
        for (const double psi : {0.0, 0.5 * phi, phi})
            for (const ConeMatch match : matches)
            {
                const DruckerPragerParameters p{moduli, 10e3, phi, psi, match};
                const DruckerPrager law(p);
                const auto& cone = law.cone();
                // on the cone at p, triaxial: q = s_axial - s_radial
                const double mean = -50e3, q = cone.strength - cone.slope * mean;
                const SymmetricTensor compression{mean + q / 3, mean - 2 * q / 3, mean + q / 3, 0, 0, 0},
                    extension{mean - q / 3, mean + 2 * q / 3, mean - q / 3, 0, 0, 0};
                CHECK(std::abs(returnMap(law, compression).yield) <= 1e-14);
                const double inC = mohrCoulombYield(p, compression), inE = mohrCoulombYield(p, extension);
                INFO(phi << " " << psi << " " << int(match) << " " << inC << " " << inE);
                if (match == ConeMatch::compression)
                    CHECK(std::abs(inC) <= 1e-14);
                if (match == ConeMatch::extension)
                    CHECK(std::abs(inE) <= 1e-14);
                CHECK((match == ConeMatch::compression || inC <= 1e-14));
                CHECK((match != ConeMatch::compression || inE >= -1e-14));
                if (phi > 0)
                    CHECK(cone.apex == Approx(10e3 / std::tan(phi * degree)).epsilon(1e-13));
            }
    // Drucker & Prager 1952, associated plane strain: sqrt J2 = k - alpha I1, q = sqrt 3 sqrt J2, I1 = 3 p
    const double tan = std::tan(30 * degree), root = std::sqrt(9 + 12 * tan * tan);
    const auto cone = DruckerPrager({moduli, 10e3, 30, 30}).cone();
    CHECK(cone.slope == Approx(3 * std::sqrt(3.0) * tan / root).epsilon(1e-14));
    CHECK(cone.strength == Approx(3 * std::sqrt(3.0) * 10e3 / root).epsilon(1e-14));
    CHECK(cone.flow == Approx(cone.slope).epsilon(1e-14));
}

TEST_CASE("in plane strain flow the matched cone fails at Mohr-Coulomb's in-plane strength and dilates by psi")
{
    for (const double phi : {0.0, 20.0, 35.0})
        for (const double psi : {0.0, 0.5 * phi, phi})
        {
            const DruckerPrager law({moduli, 10e3, phi, psi, ConeMatch::planeStrain});
            Chunk<2> chunk;
            for (int l = 0; l < lanes; ++l)
                fill(chunk, l, {-80e3, -80e3, -80e3, 0, 0, 0});
            // volume over shear strain is sin psi: the flow the angle of dilation means, so stress comes to rest
            const double de = 2e-5, sine = std::sin(psi * degree);
            SymmetricTensor before{};
            for (int i = 0; i < 4000; ++i)
            {
                before = stressOf(chunk, 0);
                for (int l = 0; l < lanes; ++l)
                {
                    chunk.dStrain[0][l] = de * (1 + sine);
                    chunk.dStrain[1][l] = -de * (1 - sine);
                    chunk.dStrain[2][l] = chunk.dStrain[3][l] = 0;
                }
                law.update(chunk);
            }
            const auto s = stressOf(chunk, 0);
            const double radius = 0.5 * (s[0] - s[1]), centre = 0.5 * (s[0] + s[1]);
            INFO(phi << " " << psi << ": " << radius << " " << centre);
            CHECK(chunk.region[0] == Region::face);
            CHECK(distance(s, before) <= 1e-9 * largest(s));
            CHECK(radius == Approx(10e3 * std::cos(phi * degree) - centre * std::sin(phi * degree)).epsilon(1e-9));
        }
}

TEST_CASE("every return meets the conditions of its region, in 3D and in plane strain")
{
    std::mt19937_64 random(3);
    std::map<Region, int> hits;
    double worstYield = 0, worstFlow = 0;
    for (const auto& p : materialsOf({infinity, 0.0, 3e3}))
    {
        const DruckerPrager law(p);
        const auto& cone = law.cone();
        const bool limited = cone.limit < cone.apex;
        Chunk<2> plane;
        std::vector<SymmetricTensor> planar;
        for (int i = 0; i < 300; ++i)
        {
            auto trial = randomTrial(p, random);
            if (i % 3 == 0)
                trial[4] = trial[5] = 0;
            const auto out = returnMap(law, trial);
            const double size = std::max(largest(trial), cone.strength);
            worstYield = std::max(worstYield, out.yield);
            const Eigen::Matrix3d lost = matrix(trial) - matrix(out.stress);
            const double volume = lost.trace() / 3 / law.bulkModulus(); // plastic
            const double shear = (qOf(trial) - qOf(out.stress)) / (3 * law.shearModulus());
            const double strain = size / law.shearModulus();
            ++hits[out.region];
            // the deviator keeps its direction
            const double share = qOf(trial) > 0 ? qOf(out.stress) / qOf(trial) : 0;
            const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(),
                                  expected = share * (matrix(trial) - meanOf(trial) * I) + meanOf(out.stress) * I;
            CHECK((expected - matrix(out.stress)).norm() <= 1e-13 * size);
            switch (out.region)
            {
            case Region::elastic:
                CHECK(out.stress == trial);
                CHECK(out.plasticWork == 0);
                break;
            case Region::face:
                worstFlow = std::max(worstFlow, std::abs(volume - cone.flow * shear) / strain);
                CHECK(shear > 0);
                CHECK(std::abs(out.yield) <= 1e-13);
                break;
            case Region::apex:
                REQUIRE_FALSE(limited);
                CHECK(qOf(out.stress) <= 1e-13 * size);
                CHECK(meanOf(out.stress) == Approx(cone.apex).margin(1e-13 * size));
                CHECK(volume >= cone.flow * shear - 1e-12 * strain);
                CHECK(out.apexStrain == Approx(p.dilationAngle > 0 ? 0 : volume).margin(1e-13 * strain));
                break;
            case Region::tension:
                REQUIRE(limited);
                CHECK(meanOf(out.stress) == Approx(cone.limit).margin(1e-13 * size));
                CHECK(shear >= -1e-13 * strain);
                CHECK(volume >= cone.flow * shear - 1e-12 * strain);
                if (qOf(out.stress) < cone.strength - cone.slope * cone.limit - 1e-12 * size)
                    CHECK(std::abs(shear) <= 1e-13 * strain); // the cone is not touched
                break;
            default:
                FAIL("no such region");
            }
            if (out.region != Region::apex)
                CHECK(out.apexStrain == 0);
            const double work =
                (0.5 * (matrix(trial) + matrix(out.stress)))
                    .cwiseProduct((lost - lost.trace() / 3 * I) / (2 * law.shearModulus()) + volume / 3 * I)
                    .sum();
            CHECK(out.plasticWork == Approx(work).margin(1e-12 * size * strain));
            if (trial[4] == 0 && trial[5] == 0 && planar.size() < std::size_t(lanes))
            {
                fill(plane, int(planar.size()), trial);
                planar.push_back(out.stress);
            }
        }
        law.update(plane);
        for (std::size_t l = 0; l < planar.size(); ++l)
            for (int k = 0; k < 4; ++k)
                CHECK(plane.stress[k][l] == planar[l][k]); // plane strain and 3D, to the last bit
    }
    std::printf("worst f %.1e, worst flow %.1e\n", worstYield, worstFlow);
    CHECK(worstYield <= 1e-12);
    CHECK(worstFlow <= 1e-13);
    for (const Region region : {Region::elastic, Region::face, Region::apex, Region::tension})
        CHECK(hits[region] >= 300);
}

TEST_CASE("turned trials return turned, and units by powers of two change no bit")
{
    std::mt19937_64 random(9);
    for (const auto& p : materialsOf({infinity, 3e3}))
        for (int i = 0; i < 20; ++i)
        {
            const auto trial = randomTrial(p, random);
            const auto out = returnMap(DruckerPrager(p), trial);
            const Eigen::Matrix3d R = randomAxes(random);
            const auto turned = returnMap(DruckerPrager(p), tensor(R * matrix(trial) * R.transpose()));
            CHECK(distance(turned.stress, tensor(R * matrix(out.stress) * R.transpose())) <= 1e-13 * largest(trial));
            DruckerPragerParameters big = p;
            const double unit = 0x1p20;
            big.moduli.young *= unit;
            big.cohesion *= unit;
            big.tensionCutOff *= unit;
            SymmetricTensor scaled = trial;
            for (double& s : scaled)
                s *= unit;
            const auto other = returnMap(DruckerPrager(big), scaled);
            for (int k = 0; k < 6; ++k)
                CHECK(other.stress[k] == unit * out.stress[k]);
            CHECK(other.region == out.region);
            CHECK(other.yield == out.yield);
        }
}

TEST_CASE("neutral values: no friction is von Mises, endless cohesion elasticity, a limit above the apex none")
{
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto compare = [&](const constitutive::Law& a, const constitutive::Law& b, double tolerance, auto chunk) {
        for (int l = 0; l < lanes; ++l)
            for (int k = 0; k < chunk.nc; ++k)
            {
                chunk.stress[k][l] = 2e4 * uniform(random);
                chunk.dStrain[k][l] = 1e-3 * uniform(random);
            }
        auto other = chunk;
        a.update(chunk);
        b.update(other);
        for (int l = 0; l < lanes; ++l)
        {
            for (int k = 0; k < chunk.nc; ++k)
                CHECK(std::abs(chunk.stress[k][l] - other.stress[k][l]) <= tolerance * 4e4);
            CHECK(std::abs(chunk.plasticWork[l] - other.plasticWork[l]) <= tolerance * 4e4 * 1e-2);
            CHECK(chunk.region[l] == other.region[l]);
        }
    };
    for (const ConeMatch match : matches)
    {
        const DruckerPrager law({moduli, 10e3, 0, 0, match});
        const double yieldStress = match == ConeMatch::planeStrain ? std::sqrt(3.0) * 10e3 : 20e3;
        CHECK(law.cone().strength == Approx(yieldStress).epsilon(1e-15));
        const constitutive::VonMises mises(moduli, yieldStress);
        compare(law, mises, 1e-14, Chunk<2>());
        compare(law, mises, 1e-14, Chunk<3>());
        for (const double cohesion : {1e30, 1e200})
        {
            compare(DruckerPrager({moduli, cohesion, 30, 10, match}), constitutive::LinearElastic(moduli), 0,
                    Chunk<2>());
            compare(DruckerPrager({moduli, cohesion, 30, 10, match}), constitutive::LinearElastic(moduli), 0,
                    Chunk<3>());
        }
        const DruckerPrager none({moduli, 10e3, 30, 0, match});
        for (const double limit : {none.cone().apex, 1e9})
            compare(DruckerPrager({moduli, 10e3, 30, 0, match, limit}), none, 0, Chunk<3>());
    }
}

TEST_CASE("associated flow dissipates and the energy of every step is accounted for")
{
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const double limit : {infinity, 2e3})
    {
        const DruckerPrager law({moduli, 10e3, 30, 30, ConeMatch::compression, limit});
        SymmetricTensor stress{};
        for (int i = 0; i < 1000; ++i)
        {
            SymmetricTensor strain;
            for (double& e : strain)
                e = 4e-4 * uniform(random);
            const auto out = updatePoint(law, stress, strain);
            const auto energy = [&](const SymmetricTensor& s) {
                return constitutive::elasticEnergyDensity<3>({s[0], s[1], s[2], s[3], s[4], s[5]}, law.bulkModulus(),
                                                             law.shearModulus());
            };
            const double work = (0.5 * (matrix(stress) + matrix(out.stress))).cwiseProduct(matrix(strain)).sum();
            CHECK(work == Approx(energy(out.stress) - energy(stress) + out.plasticWork).margin(1e-10));
            const Eigen::Matrix3d lost =
                matrix(updatePoint(constitutive::LinearElastic(moduli), stress, strain).stress) - matrix(out.stress);
            const Eigen::Matrix3d flow =
                ((1 + moduli.poisson) * lost - moduli.poisson * lost.trace() * Eigen::Matrix3d::Identity()) /
                moduli.young;
            CHECK(matrix(out.stress).cwiseProduct(flow).sum() >= -1e-10);
            stress = out.stress;
        }
    }
}

TEST_CASE("words are read and refused by name")
{
    const auto read = [](const std::string& words) {
        return constitutive::makeLaw(dictionary::Dictionary::fromText(
            "law druckerPrager; E 20e6; nu 0.3; cohesion 1e3; frictionAngle 30; " + words));
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(read("")->describe(), Contains("match planeStrain"));
    CHECK_THAT(read("match extension; tensionCutOff 0;")->describe(),
               Contains("match extension") && Contains("tensionCutOff 0"));
    CHECK(read("tensionCutOff 100;")->tensionLimit() == 100);
    CHECK_THROWS_WITH(read("match compresion;"), Contains("compresion") && Contains("compression"));
    CHECK_THROWS_WITH(read("dilationAngle 31;"), Contains("dilationAngle") && Contains("30"));
    CHECK_THROWS_WITH(read("tensionCutOff -1;"), Contains("tensionCutOff"));
    CHECK_THROWS_AS(DruckerPrager({moduli, -1, 30, 0}), InputError);
    CHECK_THROWS_AS(DruckerPrager({moduli, 1, 30, 40}), InputError);
    CHECK_THROWS_AS(DruckerPrager({moduli, 1, 30, 0, ConeMatch::compression, -1}), InputError);
}
