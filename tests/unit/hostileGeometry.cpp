// Geometry files made to do harm, and answers of gmsh's process that are no meshes: one InputError with the file's
// name.
#include "base/error.hpp"
#include "geometry/bodyGeometry.hpp"
#include "geometry/meshBytes.hpp"
#include "support/fileContents.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace mpm;
using namespace mpm::geometry;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using mpm::tests::contents;
using mpm::tests::TemporaryFolder;
using mpm::tests::writeContents;
namespace fs = std::filesystem;

namespace
{
const std::string square = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
                           "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                           "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Physical Surface(\"soil\") = {1};\n";

/// A case folder with a folder geometry in it.
struct Case : TemporaryFolder
{
    Case() { fs::create_directory(path() / "geometry"); }
    fs::path write(const std::string& name, const std::string& text) const
    {
        writeContents(path() / name, text);
        return path() / name;
    }
    /// What reading geometry/body.geo says.
    std::string message(const std::string& text, double seconds = 20,
                        const std::string& name = "geometry/body.geo") const
    {
        try
        {
            readGeometry(write(name, text), 2, 1, seconds);
        }
        catch (const InputError& error)
        {
            return error.what();
        }
        return "accepted";
    }
    std::size_t files() const
    {
        return std::size_t(std::distance(fs::recursive_directory_iterator(path()), fs::recursive_directory_iterator()));
    }
};

GmshMesh triangle()
{
    GmshMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.regions = {{"soil", {{{0, 1, -1}, {1, 2, -1}, {2, 0, -1}}}, true}};
    mesh.boundaries = {{"base", {{0, 1, -1}}}};
    mesh.notes = {"a note"};
    return mesh;
}

std::string refusal(const std::string& bytes, int dim = 2)
{
    try
    {
        meshFromBytes(bytes, "body.geo", dim);
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "accepted";
}
} // namespace

TEST_CASE("commands that write files or start programs are refused with their line, and do nothing")
{
    const Case folder;
    const std::string file = (folder / "geometry/body.geo").string();
    REQUIRE(folder.message(square) == "accepted");
    const std::size_t before = folder.files();
    for (const char* command :
         {"SystemCall \"touch made\";", "System \"touch made\";", "NonBlockingSystemCall \"touch made\";",
          "OnelabRun(\"a\", \"touch made\");", "Save \"made.msh\";", "Print \"made.msh\";", "CreateDir \"made\";",
          "Exit;", "Abort;", "Sleep 1000;", "Plugin(NewView).Run;", "x = GetEnv(\"HOME\");"})
    {
        INFO(command);
        const std::string name = std::string(command).substr(0, std::string(command).find_first_of(" (;"));
        CHECK_THAT(folder.message(square + command + "\n"), StartsWith(file + ":4: found the command "));
    }
    for (const char* redirection :
         {"Printf(\"x\") > \"made\";", "Printf(\"x\") >> \"made\";", "Printf(\"x\")/**/>\n\"made\";"})
        CHECK_THAT(folder.message(square + redirection + "\n"), StartsWith(file + ":") && Contains("writes no files"));
    // what the look at the text cannot see is stopped by the process
    CHECK(folder.message(square + "Printf(\"x\") > StrCat(\"ma\", \"de\");\n") != "");
    CHECK(folder.files() == before);
    CHECK(fs::exists("made") == false);
    // words that only look like commands
    CHECK(folder.message("// SystemCall \"x\";\n/* Save\n\"x\"; */\nSaved = 1; a = 2 > 1;\nPrintf(\"Print this\");\n" +
                         square) == "accepted");
}

TEST_CASE("a geometry reads files of its case only, and those are looked at as well")
{
    const Case folder;
    const TemporaryFolder other;
    writeContents(other / "secret.geo", square);
    folder.write("geometry/square.geo", square);
    folder.write("points.geo", "Point(1) = {0, 0, 0};\nSystemCall \"touch made\";\n");
    const std::string file = (folder / "geometry/body.geo").string();
    CHECK(folder.message("Include \"square.geo\";\n") == "accepted");
    CHECK(folder.message("Merge \"square.geo\";\n") == "accepted");
    for (const std::string command : {"Include", "Merge", "MergeWithBoundingBox", "v() = ShapeFromFile"})
    {
        const std::string open = command[0] == 'v' ? " (" : " ", close = command[0] == 'v' ? ");\n" : ";\n";
        const std::string begin = "\n" + command + open;
        INFO(begin);
        CHECK_THAT(folder.message(begin + "\"" + (other / "secret.geo").string() + "\"" + close),
                   StartsWith(file + ":2: ") && Contains("lies outside the case folder"));
        CHECK_THAT(folder.message(begin + "\"../../" + other.path().filename().string() + "/secret.geo\"" + close),
                   Contains("lies outside the case folder"));
        CHECK_THAT(folder.message(begin + "StrCat(\"squ\", \"are.geo\")" + close), Contains("nothing calculated"));
        CHECK_THAT(folder.message(begin + "\"none.geo\"" + close), Contains("\"none.geo\": no such file"));
        CHECK_THAT(folder.message(begin + "\"../points.geo\"" + close), Contains("points.geo:2: found the command"));
    }
    fs::create_symlink(other / "secret.geo", folder / "geometry/link.geo");
    CHECK_THAT(folder.message("Include \"link.geo\";\n"), Contains("lies outside the case folder"));
    CHECK_THAT(folder.message("Include \"body.geo\";\n"), Contains("includes itself"));
    folder.write("geometry/other.geo", "Include \"body.geo\";\n");
    CHECK_THAT(folder.message("Include \"other.geo\";\n", 5), Contains("body.geo"));
}

TEST_CASE("a mesh or a drawing that is a script in disguise is not run")
{
    const Case folder;
    const std::string script = square + "SystemCall \"touch made\";\n";
    CHECK_THAT(folder.message(script, 20, "geometry/body.msh"),
               Contains("body.msh:1: found 'Point(1)', allowed $MeshFormat"));
    CHECK_THAT(folder.message(script, 20, "geometry/body.Stl"), Contains("found the ending '.Stl', allowed '.stl'"));
    CHECK_THAT(folder.message("", 20, "geometry/empty.msh"), Contains("allowed $MeshFormat"));
    folder.write("geometry/body.geo.opt", "SystemCall \"touch made\";\n");
    CHECK_THAT(folder.message(square), Contains("body.geo.opt:1: found the command SystemCall"));
}

TEST_CASE("a geometry that takes for ever is ended, and named")
{
    const Case folder;
    const std::string file = (folder / "geometry/body.geo").string();
    CHECK(
        folder.message("For i In {0:1e9}\n  a = i;\nEndFor\n", 1) ==
        file +
            ": gmsh, which reads it, took longer than 1 s and was ended; meshingTime of seedParticlesDict allows more");
    const std::string recursion = folder.message("Macro Again\n  Call Again;\nReturn\nCall Again;\n", 3);
    CHECK_THAT(recursion, StartsWith(file + ": gmsh"));
}

TEST_CASE("what gmsh's process answers is believed only as far as it holds")
{
    const GmshMesh mesh = triangle();
    const std::string bytes = meshBytes(mesh);
    const GmshMesh back = meshFromBytes(bytes, "body.geo", 2);
    CHECK(back.points == mesh.points);
    CHECK(back.regions[0].name == "soil");
    CHECK(back.regions[0].parts == mesh.regions[0].parts);
    CHECK(back.boundaries[0].elements == mesh.boundaries[0].elements);
    CHECK(back.notes == mesh.notes);

    for (std::size_t keep = 0; keep < bytes.size(); ++keep)
        CHECK_THAT(refusal(bytes.substr(0, keep)), StartsWith("body.geo: "));
    CHECK_THAT(refusal(bytes + "x"), Contains("goes on after its end"));
    CHECK_THAT(refusal(bytes, 3), Contains("beginning is wrong"));
    CHECK(refusal(refusalBytes("body.geo:2: no")) == "body.geo:2: no");
    CHECK(refusal(refusalBytes("no")) == "body.geo: no");
    CHECK(refusal(refusalBytes(std::string(3, '\0'))) == "body.geo: gmsh gave no reason");
    CHECK(refusal(refusalBytes("\x1b[2J\nno")) == "body.geo:  [2J no");
    CHECK(refusal(refusalBytes(std::string(100000, 'x'))).size() < 5000);

    GmshMesh wrong = mesh;
    wrong.regions[0].parts[0][1][0] = 3;
    CHECK_THAT(refusal(meshBytes(wrong)), Contains("no such point"));
    wrong.regions[0].parts[0][1] = {1, 2, 0};
    CHECK_THAT(refusal(meshBytes(wrong)), Contains("no such point"));
    wrong = mesh;
    wrong.boundaries[0].elements[0][1] = -7;
    CHECK_THAT(refusal(meshBytes(wrong)), Contains("no such point"));
    wrong = mesh;
    wrong.points[2][0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(refusal(meshBytes(wrong)), Contains("allowed numbers up to 1e+30"));
    std::string many = bytes; // 2^60 points
    many[1 + 4 + 7] = 0x10;
    CHECK_THAT(refusal(many), Contains("counts more than it holds"));
}
