// preciceCoupling of system/couplingDict: words, defaults, and what is refused, with file:line.
#include "precice/preciceDict.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fstream>

using namespace mpm;
using namespace mpm::precice;
using Catch::Contains;
using coupling::SurfaceKind;

namespace
{
const std::vector<KnownSurface> known = {{"wall", SurfaceKind::Rigid}, {"blade", SurfaceKind::Deformable}};

PreciceCoupling read(const std::string& text)
{
    const tests::TemporaryFolder folder;
    std::ofstream(folder.path() / "precice-config.xml") << "<precice-configuration/>";
    return readPrecice(dictionary::Dictionary::fromText(text, "couplingDict"), folder.path(), known);
}

std::string dictText(const std::string& words, const std::string& surface)
{
    return fmt::format(
        "surfaces {{ }}\npreciceCoupling\n{{\nconfig \"precice-config.xml\"; {}\nsurfaces {{\n{}\n}}\n}}\n", words,
        surface);
}
} // namespace

TEST_CASE("defaults, and data by other names")
{
    const auto plain = read(dictText("", "wall { read (Displacement); }"));
    CHECK(plain.participant == "Soil");
    CHECK_FALSE(plain.maxStep);
    CHECK(plain.samples == 1);
    CHECK(plain.windowAverage);
    REQUIRE(plain.surfaces.size() == 1);
    CHECK(plain.surfaces[0].mesh == "wall");
    CHECK(plain.surfaces[0].read[0].data == "Displacement");

    const auto all = read(dictText("participant Ground; maxStep 1e-3; samples 3; forces instantaneous;",
                                   "wall { mesh W; write { Force ForceOfSoil; Torque M; } }\n"
                                   "blade { read (Velocity Displacement); write (Traction); }"));
    CHECK(all.participant == "Ground");
    CHECK(all.maxStep == 1e-3);
    CHECK_FALSE(all.windowAverage);
    CHECK(all.surfaces[0].write[0].data == "ForceOfSoil");
    CHECK(all.surfaces[0].write[1].quantity == Quantity::Torque);
    CHECK(all.surfaces[1].kind == SurfaceKind::Deformable);
    CHECK(all.surfaces[1].read[0].quantity == Quantity::Velocity);
}

TEST_CASE("what is refused, where, and what is allowed")
{
    const auto refused = [](const std::string& words, const std::string& surface, const auto& says) {
        CHECK_THROWS_WITH(read(dictText(words, surface)), says);
    };
    const std::string good = "wall { read (Displacement); }";
    refused("", "", Contains("surfaces: found none, allowed wall or blade"));
    refused("", "wal { read (Displacement); }", Contains("couplingDict:6") && Contains("did you mean 'wall'?"));
    refused("", "wall { }", Contains("couplingDict:6") && Contains("neither read nor write"));
    refused("", "wall { read (Displacment); }", Contains("did you mean 'Displacement'?"));
    refused("", "wall { read (Traction); }",
            Contains("allowed Displacement, Rotation, Velocity and AngularVelocity for a Rigid surface"));
    refused("", "blade { write (Torque); }",
            Contains("allowed Force, Traction and ContactArea for a Deformable surface"));
    refused("", "wall { write (Force Force); }", Contains("found Force twice, allowed each once"));
    refused("", "wall { write { Force F; Torque F; } }", Contains("found F twice"));
    refused("", "wall { mesh M; write (Force); } blade { mesh M; write (Force); }",
            Contains("M, which is the mesh of wall already"));
    refused("", "wall { read (Displacement); raed 1; }", Contains("raed"));
    refused("maxStep 0;", good, Contains("couplingDict:4") && Contains("maxStep"));
    refused("samples 0;", good, Contains("samples"));
    refused("forces average;", good, Contains("windowAverage"));
    CHECK_THROWS_WITH(read("preciceCoupling { config \"none.xml\"; surfaces { wall { write (Force); } } }"),
                      Contains("couplingDict:1") && Contains("'none.xml', no such file"));
    CHECK_THROWS_WITH(read("surfaces { }"), Contains("preciceCoupling"));
}
