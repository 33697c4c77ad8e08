/// Soil tests at a single point: what theory says of them, how they are set up, and what is refused.
#include "constitutive/soilTests.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

using namespace mpm;
using namespace mpm::constitutive;
using Catch::Matchers::Contains;
using dictionary::Dictionary;

namespace
{
double slope(double degrees)
{
    const double sine = std::sin(degrees * std::acos(-1.0) / 180);
    return (1 + sine) / (1 - sine);
}

SoilTest setUp(const std::string& words, const std::string& path, double poisson)
{
    const Dictionary d = Dictionary::fromText("test { " + words + " }", "soil");
    const SoilTest test = readSoilTest(d, path, poisson);
    d.rejectUnread();
    return test;
}

std::string write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file) << text;
    return file.string();
}
} // namespace

TEST_CASE("oedometer: constrained modulus and K0 while elastic, the active ratio once a loose soil yields")
{
    const MohrCoulomb strong({{20e6, 0.3}, 1e6, 30, 0});
    for (const auto& point : runSoilTest(strong, setUp("", "oedometer", 0.3)))
    {
        CHECK(point.stress[1] == Approx(strong.waveModulus() * point.strain[1]).margin(1e-6));
        CHECK(point.stress[0] == Approx(0.3 / 0.7 * point.stress[1]).margin(1e-6));
        CHECK(point.region == Region::elastic);
    }
    const auto start = runSoilTest(strong, setUp("confiningStress 50e3; K0 0.6;", "oedometer", 0.3)).front();
    CHECK(start.stress == SymmetricTensor{-30e3, -50e3, -30e3, 0, 0, 0});

    // nu/(1 - nu) = 0.25 < 1/k: the specimen yields at once and stays on the edge
    const MohrCoulomb sand({{20e6, 0.2}, 0, 30, 0});
    const auto points = runSoilTest(sand, setUp("maxStrain 0.02; steps 100;", "oedometer", 0.2));
    REQUIRE(points.size() == 101);
    CHECK(points.back().strain[1] == Approx(-0.02).epsilon(1e-12));
    CHECK(points.back().region == Region::edge1);
    CHECK(points.back().stress[0] / points.back().stress[1] == Approx(1 / slope(30)).epsilon(1e-12));
    CHECK(points.back().stress[2] == Approx(points.back().stress[0]).epsilon(1e-12));
}

TEST_CASE("triaxial compression: Young's modulus, sigma_1 = K_p sigma_3 + 2 c sqrt(K_p), dilation by psi")
{
    for (const double psi : {0.0, 10.0, 30.0})
        for (const double phi : {0.0, 30.0, 42.0})
            for (const double cell : {0.0, 1e3, 100e3})
                for (const double nu : {0.0, 0.3, 0.49})
                {
                    if (psi > phi)
                        continue;
                    const double E = 20e6, c = 5e3, K = slope(phi);
                    const MohrCoulomb law({{E, nu}, c, phi, psi});
                    auto test = setUp("steps 100;", "triaxial", nu);
                    test.confiningStress = cell;
                    const auto points = runSoilTest(law, test);
                    INFO("phi " << phi << " psi " << psi << " cell " << cell << " nu " << nu);
                    const double strength = K * cell + 2 * c * std::sqrt(K);
                    CHECK(points.back().stress[1] == Approx(-strength).epsilon(1e-9));
                    for (const auto& point : points)
                    {
                        CHECK(point.stress[0] == Approx(-cell).margin(1e-9 * strength));
                        CHECK(point.stress[2] == Approx(-cell).margin(1e-9 * strength));
                        if (point.region == Region::elastic)
                            CHECK(point.stress[1] == Approx(-cell + E * point.strain[1]).margin(1e-9 * strength));
                    }
                    const auto& last = points.back().strain;
                    const auto& before = points[points.size() - 2].strain;
                    const double axial = last[1] - before[1], lateral = last[0] - before[0];
                    CHECK((axial + 2 * lateral) / -axial == Approx(slope(psi) - 1).margin(1e-8));
                    CHECK(points.back().plasticWork > 0);
                }
    const LinearElastic elastic({20e6, 0.3});
    const auto points = runSoilTest(elastic, setUp("", "triaxial", 0.3));
    REQUIRE(points.size() == 501);
    CHECK(points.back().stress[1] == Approx(-100e3 - 20e6 * 0.05).epsilon(1e-10));
}

TEST_CASE("simple shear at constant volume: G, then the surface at constant mean stress for psi = 0")
{
    const MohrCoulomb law({{20e6, 0.42}, 1e3, 42, 0});
    const auto points = runSoilTest(law, setUp("confiningStress 80e3;", "simpleShear", 0.42));
    const double K0 = 0.42 / 0.58, mean = -80e3 * (1 + 2 * K0) / 3;
    for (const auto& point : points)
    {
        CHECK((point.stress[0] + point.stress[1] + point.stress[2]) / 3 == Approx(mean).epsilon(1e-10));
        CHECK(point.strain[0] + point.strain[1] + point.strain[2] == 0);
        if (point.region == Region::elastic)
            CHECK(point.stress[3] == Approx(2 * law.shearModulus() * point.strain[3]).margin(1e-6));
    }
    CHECK(points.back().strain[3] == Approx(0.025).epsilon(1e-12));
    const auto& s = points.back().stress;
    const double centre = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[3]);
    const double k = slope(42), sc = 2e3 * std::sqrt(k);
    const double s1 = std::max(centre + radius, s[2]), s3 = std::min(centre - radius, s[2]);
    CHECK(k * s1 - s3 == Approx(sc).margin(1e-9 * 80e3));
}

TEST_CASE("a table of strains drives the law as the test it repeats; its mistakes are named")
{
    const tests::TemporaryFolder folder;
    const MohrCoulomb law({{20e6, 0.2}, 0, 30, 0});
    const std::string header = "exx,eyy,ezz,exy,eyz,ezx\n";
    const auto file = write(folder / "path.csv", header + "0,0,0,0,0,0\n0,-0.01,0,0,0,0\n0,-0.02,0,0,0,0\n");
    const auto points = runSoilTest(law, setUp("steps 50;", file, 0.2));
    const auto same = runSoilTest(law, setUp("maxStrain 0.02; steps 100;", "oedometer", 0.2));
    REQUIRE(points.size() == same.size());
    for (int k = 0; k < 6; ++k)
        CHECK(points.back().stress[k] == Approx(same.back().stress[k]).epsilon(1e-12).margin(1e-9));
    const auto loaded = runSoilTest(law, setUp("startStress (-1e3 -2e3 -1e3 0 0 0);", file, 0.2));
    CHECK(loaded.front().stress[1] == -2e3);
    CHECK(loaded.size() == 3);

    const auto refused = [&](const std::string& text) { return setUp("", write(folder / "bad.csv", text), 0.2); };
    CHECK_THROWS_WITH(runSoilTest(law, refused("exx,eyy,ezz,exy,eyz,ezz2\n0,0,0,0,0,0\n")),
                      Contains("ezx") && Contains("ezz2"));
    CHECK_THROWS_WITH(runSoilTest(law, refused(header + "0,0,0,0,0,0\n0,x,0,0,0,0\n")),
                      Contains("bad.csv:3: eyy: found 'x'") && Contains("a finite number"));
    CHECK_THROWS_WITH(runSoilTest(law, refused(header + "0,0,0,0,0,0\n")), Contains("two"));
}

TEST_CASE("the set-up has defaults, bounds, and words of other tests beside its own")
{
    const std::string all = "confiningStress 1e3; K0 0.5; maxStrain 0.1; steps 10; startStress (0 0 0 0 0 0);";
    for (const char* path : {"oedometer", "triaxial", "simpleShear", "path.csv"})
        CHECK(setUp(all, path, 0.3).steps == 10);
    CHECK(setUp("", "oedometer", 0.3).confiningStress == 0);
    CHECK(setUp("", "triaxial", 0.3).confiningStress == 100e3);
    CHECK(setUp("", "simpleShear", 0.3).K0 == Approx(3.0 / 7));
    CHECK_THROWS_WITH(setUp("stepps 3;", "triaxial", 0.3), Contains("soil:1") && Contains("steps"));
    CHECK_THROWS_WITH(setUp("steps 0;", "triaxial", 0.3), Contains("soil:1") && Contains("[1, 10000000]"));
    CHECK_THROWS_WITH(setUp("confiningStress -1;", "triaxial", 0.3), Contains(">= 0"));
    CHECK_THROWS_WITH(setUp("startStress (1 2);", "path.csv", 0.3), Contains("2 numbers") && Contains("6"));
}

TEST_CASE("a law file is one material, one nested material, or needs a name")
{
    const Dictionary flat = Dictionary::fromText("law linearElastic; E 1e6; nu 0.3;");
    CHECK(&lawDictionary(flat) == &flat);
    const Dictionary one = Dictionary::fromText("soil { law linearElastic; E 1e6; nu 0.3; } test { steps 3; }");
    CHECK(lawDictionary(one).found("law"));
    const Dictionary two = Dictionary::fromText("soil { E 1e6; } rock { E 1e9; }", "both");
    CHECK_THROWS_WITH(lawDictionary(two),
                      Contains("both") && Contains("-material") && Contains("soil") && Contains("rock"));
    CHECK(lawDictionary(two, "rock").get<double>({"E", ""}) == 1e9);
    CHECK_NOTHROW(two.rejectUnread());
    CHECK_THROWS_WITH(lawDictionary(two, "clay"), Contains("clay") && Contains("soil"));
    CHECK_THROWS_WITH(lawDictionary(Dictionary::fromText("E 1;")), Contains("no law"));
}

TEST_CASE("laws are made from their dictionaries, mistakes named with their line")
{
    const Dictionary d =
        Dictionary::fromText("law mohrCoulomb;\nE 20e6;\nnu 0.42;\ncohesion 1e3;\nfrictionAngle 42;\n");
    const auto law = makeLaw(d);
    d.rejectUnread();
    CHECK(law->name() == "mohrCoulomb");
    CHECK(law->plastic());
    CHECK(law->poissonRatio() == Approx(0.42));
    CHECK(law->describe() ==
          "mohrCoulomb: E 2e+07 Pa, nu 0.42, cohesion 1000 Pa, frictionAngle 42 deg, dilationAngle 0 deg");
    CHECK(makeLaw(Dictionary::fromText("law linearElastic; E 1e6; nu -0.2;"))->name() == "linearElastic");

    const auto refused = [](const std::string& text) { makeLaw(Dictionary::fromText(text, "soil")); };
    CHECK_THROWS_WITH(refused("law mohrColumb; E 1;"), Contains("soil:1") && Contains("mohrCoulomb"));
    CHECK_THROWS_WITH(refused("law linearElastic;\nE 1e6;\nnu 0.5;"), Contains("soil:3") && Contains("(-1, 0.5)"));
    CHECK_THROWS_WITH(refused("law linearElastic;\nE 0;\nnu 0.3;"), Contains("soil:2") && Contains("> 0"));
    CHECK_THROWS_WITH(refused("law linearElastic;\nnu 0.3;"), Contains("E"));
    const std::string sand = "law mohrCoulomb; E 1e6; nu 0.3;\n";
    CHECK_THROWS_WITH(refused(sand + "cohesion -1; frictionAngle 30;"), Contains("soil:2") && Contains(">= 0"));
    CHECK_THROWS_WITH(refused(sand + "cohesion 0; frictionAngle 90;"), Contains("[0, 90)"));
    CHECK_THROWS_WITH(refused(sand + "cohesion 0; frictionAngle 30; dilationAngle 31;"), Contains("[0, 30]"));
}

TEST_CASE("hyperelastic laws: logarithmic strains from F = I, which reach the stress at the start")
{
    const Hencky law({1e6, 0.3});
    for (const auto& point : runSoilTest(law, setUp("maxStrain 0.4; steps 20;", "oedometer", 0.3)))
        CHECK(point.stress[1] ==
              Approx(law.waveModulus() * point.strain[1] * std::exp(-point.strain[1])).epsilon(1e-12).margin(1e-9));
    const auto points = runSoilTest(law, setUp("confiningStress 50e3; steps 20;", "triaxial", 0.3));
    for (const auto& point : points)
    {
        CHECK(point.stress[0] == Approx(-50e3).epsilon(1e-11));
        CHECK(point.stress[2] == point.stress[0]);
    }
    const double e = points.front().strain[1]; // all round: J sigma = 3 K e
    CHECK(3 * law.bulkModulus() * e * std::exp(-3 * e) == Approx(-50e3).epsilon(1e-11));
    CHECK(points.back().strain[1] == Approx(e - 0.05).epsilon(1e-12));
    CHECK_THROWS_WITH(runSoilTest(law, setUp("confiningStress 1e9;", "triaxial", 0.3)), Contains("found no strain"));
    const Dictionary d = Dictionary::fromText("test { startStress (1 0 0 0 0 0); }", "soil");
    CHECK_THROWS_WITH(readSoilTest(d, "path.csv", 0.3, true), Contains("soil:1: test.startStress: found a stress"));
}
