// What dictionaries mean: values, macros, scopes, includes, and the book-keeping of what was asked.
#include "dictionary/dictionary.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>

using namespace mpm;
using namespace mpm::dictionary;
namespace fs = std::filesystem;

namespace
{
const char* const soilText = R"(FoamFile
{
    version     2.0;
    format      ascii;
    class       dictionary;
    object      materialProperties;
}
/* a comment
   over lines */
stiffness       20e6;           // used by a macro
soil
{
    law             mohrCoulomb;
    density         [1 -3 0 0 0 0 0] 1000;
    E               [1 -1 -2 0 0] $stiffness;
    nu              0.42;
    frictionAngle   42;
    active          on;
    steps           12;
    initialVelocity (0 -1.5e-3 .5);
    title           "a \"soft\" soil";
    layers          (0 2 4.5);
    names           (soil "other soil" div(phi,U));
    points          2((0 0 0) (1 0 0));
    initialStress
    {
        type        K0;
        K0          $..nu;
        again       $..E;
    }
}
clay
{
    $soil;
    E               5e6;
    initialStress
    {
        K0          0.8;
    }
}
copy    $clay;
)";

double number(const Dictionary& dict, const std::string& word)
{
    return dict.get<double>({word, ""});
}

std::string messageOf(const std::function<void()>& action)
{
    try
    {
        action();
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "no error";
}

std::string messageOf(const std::string& text)
{
    return messageOf([&] { Dictionary::fromText(text, "t"); });
}

/// A case folder with the files a test writes.
struct Case : tests::TemporaryFolder
{
    Case()
    {
        fs::create_directories(path() / "system");
        fs::create_directories(path() / "constant");
    }
    fs::path write(const std::string& name, const std::string& text) const
    {
        std::ofstream(path() / name) << text;
        return path() / name;
    }
    std::string message(const std::string& text) const
    {
        const fs::path file = write("system/example", text);
        return messageOf([&] { Dictionary::readFile(file); });
    }
};
} // namespace

TEST_CASE("values of every type are read as they stand")
{
    const Dictionary dict = Dictionary::fromText(soilText, "materialProperties");
    CHECK(dict.dictNames() == std::vector<std::string>{"soil", "clay", "copy"});
    CHECK(dict.words() == std::vector<std::string>{"stiffness"});
    const Dictionary& soil = dict.subDict("soil");
    CHECK(soil.where().text() == "materialProperties:11");
    CHECK(soil.where("nu").text() == "materialProperties:16");
    CHECK(soil.choose("law", "", {{"linearElastic", ""}, {"mohrCoulomb", ""}}) == "mohrCoulomb");
    CHECK(soil.get<double>({"density", "", unit::density, Bound::positive()}) == 1000);
    CHECK(soil.get<double>({"E", "", unit::pressure}) == 20e6);
    CHECK(soil.get<double>({"nu", "", unit::none, Bound::rightOpen(0, 0.5)}) == 0.42);
    CHECK(soil.get<double>({"cohesion", "", unit::pressure, {}, 7.0}) == 7.0);
    CHECK(soil.get<bool>({"active", ""}));
    CHECK(soil.get<Index>({"steps", ""}) == 12);
    CHECK(soil.get<Vector3>({"initialVelocity", "", unit::velocity}) == Vector3{0, -1.5e-3, 0.5});
    CHECK(soil.get<std::string>({"title", ""}) == "a \"soft\" soil");
    CHECK(soil.get<std::vector<double>>({"layers", ""}) == std::vector<double>{0, 2, 4.5});
    CHECK(soil.get<std::vector<std::string>>({"names", ""}) ==
          std::vector<std::string>{"soil", "other soil", "div(phi,U)"});
    CHECK(soil.get<std::vector<Vector3>>({"points", ""}) == std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}});
    CHECK(number(soil, "frictionAngle") == 42);
    const Dictionary& stress = soil.subDict("initialStress");
    CHECK(number(stress, "K0") == 0.42);
    CHECK(stress.get<double>({"again", "", unit::pressure}) == 20e6);
    CHECK(stress.get<std::string>({"type", ""}) == "K0");
    soil.rejectUnread();

    const Dictionary& clay = dict.subDict("clay");
    CHECK(clay.get<double>({"E", "", unit::pressure}) == 5e6);
    CHECK(number(clay, "nu") == 0.42);
    CHECK(number(clay.subDict("initialStress"), "K0") == 0.8);
    CHECK(clay.subDict("initialStress").get<double>({"again", "", unit::pressure}) == 20e6);
    CHECK(dict.subDict("copy").get<double>({"E", "", unit::pressure}) == 5e6);
    CHECK_THROWS_WITH(dict.rejectUnread(), Catch::Contains("materialProperties:13: clay.law: found an unknown word"));
}

TEST_CASE("numbers are read to the last digit, whole and finite")
{
    const auto read = [](const std::string& text) { return number(Dictionary::fromText("x " + text + ";"), "x"); };
    CHECK(read("0.1") == 0.1);
    CHECK(read("1.7976931348623157e308") == 1.7976931348623157e308);
    CHECK(read("-.5E-3") == -0.5e-3);
    CHECK(read("5.") == 5);
    CHECK(read("uniform 3") == 3);
    CHECK(read("[0 0 0 0 0] 3") == 3);
    CHECK(read("x [0 0 0 0 0 0 0] 3") == 3); // the word again, as older OpenFOAM files have it
    for (const char* bad : {"1e309", "1e-400", "-1e99999", "+5", "5.5.5", "1e", "e5", "0x10", "1d3", "--5", "5-3",
                            "(5)", "\"5\"", "on", "-", ".", "5 5", ""})
    {
        INFO(bad);
        CHECK_THROWS_AS(read(bad), InputError);
    }
    const auto whole = [](const std::string& text) {
        return Dictionary::fromText("x " + text + ";").get<Index>({"x", ""});
    };
    CHECK(whole("-9223372036854775808") == std::numeric_limits<Index>::min());
    for (const char* bad : {"9223372036854775808", "2.0", "1e3", "two", "(2)"})
        CHECK_THROWS_AS(whole(bad), InputError);
}

TEST_CASE("switches have six spellings, and words may hold what OpenFOAM's words hold")
{
    for (const char* yes : {"on", "yes", "true"})
        CHECK(Dictionary::fromText(std::string("x ") + yes + ";").get<bool>({"x", ""}));
    for (const char* no : {"off", "no", "false"})
        CHECK_FALSE(Dictionary::fromText(std::string("x ") + no + ";").get<bool>({"x", ""}));
    for (const char* bad : {"ON", "1", "y", "none", "\"on\""})
        CHECK_THROWS_AS(Dictionary::fromText(std::string("x ") + bad + ";").get<bool>({"x", ""}), InputError);
    for (const char* word :
         {"a:b", "x=1", "a[1]", "div((phi,U))", "_x", "\xC3\xA9", "a|b", "a-b.c", "<x>", "a\\b", "a+b"})
        CHECK(Dictionary::fromText(std::string("x ") + word + "/**/;//").get<std::string>({"x", ""}) == word);
    CHECK(Dictionary::fromText("div(phi,U) 3;a.b 4;").words() == std::vector<std::string>{"div(phi,U)", "a.b"});
    CHECK(Dictionary::fromText("x \"a // b /* c \\\\ \\\" $d\";").get<std::string>({"x", ""}) ==
          "a // b /* c \\\\ \" $d");
}

TEST_CASE("bounds say what they allow, and hold at their ends")
{
    CHECK(Bound::any().text().empty());
    CHECK(Bound::positive().text() == "> 0");
    CHECK(Bound::nonNegative().text() == ">= 0");
    CHECK(Bound::between(1, 2).text() == "in [1, 2]");
    CHECK(Bound::open(0, 90).text() == "in (0, 90)");
    CHECK(Bound::rightOpen(0, 0.5).text() == "in [0, 0.5)");
    CHECK(Bound{-INFINITY, 5, false, true}.text() == "< 5");
    CHECK(Bound{-INFINITY, 5, false, false}.text() == "<= 5");
    CHECK_FALSE(Bound::positive().contains(0));
    CHECK(Bound::nonNegative().contains(0));
    CHECK(Bound::rightOpen(0, 0.5).contains(0));
    CHECK_FALSE(Bound::rightOpen(0, 0.5).contains(0.5));
    CHECK(Bound::between(0, 0.5).contains(0.5));
    CHECK_FALSE(Bound::open(0, 1).contains(0));
}

TEST_CASE("macros find their words by OpenFOAM's scopes")
{
    const Dictionary dict = Dictionary::fromText(R"(
        F 3;
        a.b 8;
        rock { E 20; c.d 9; sub { deep 7; up $..E; same $.deep; twice $...F; around $F; braces ${F}; top $:F; } }
        x $rock.E; y $rock.sub.deep; z $a.b; w $rock.c.d; v $.F; u $^rock.sub.up;
        list (0 $F 0);
        other { F $F; again $F; E $:rock.E; }
        )");
    const Dictionary& sub = dict.subDict("rock").subDict("sub");
    CHECK(number(sub, "up") == 20);
    CHECK(number(sub, "same") == 7);
    for (const char* word : {"twice", "around", "braces", "top"})
        CHECK(number(sub, word) == 3);
    CHECK(number(dict, "x") == 20);
    CHECK(number(dict, "y") == 7);
    CHECK(number(dict, "z") == 8);
    CHECK(number(dict, "w") == 9);
    CHECK(number(dict, "v") == 3);
    CHECK(number(dict, "u") == 20);
    CHECK(dict.get<Vector3>({"list", ""}) == Vector3{0, 3, 0});
    CHECK(number(dict.subDict("other"), "again") == 3);
    CHECK(number(dict.subDict("other"), "E") == 20);
    setenv("MPM_DICTIONARY_TEST", "5", 1); // the environment is no part of a case
    CHECK(messageOf("x $MPM_DICTIONARY_TEST;").find("t:1: found '$MPM_DICTIONARY_TEST'") == 0);
}

TEST_CASE("what came through a macro may be replaced afterwards, once; dictionaries are merged")
{
    const Dictionary dict = Dictionary::fromText(
        "base { a 1; b 2; in { c 3; d 4; } } one { $base; b 5; in { d 6; e 7; } } two { $one; a 8; }");
    const Dictionary& two = dict.subDict("two");
    CHECK(number(two, "a") == 8);
    CHECK(number(two, "b") == 5);
    CHECK(number(two.subDict("in"), "c") == 3);
    CHECK(number(two.subDict("in"), "d") == 6);
    CHECK(number(two.subDict("in"), "e") == 7);
    CHECK(number(dict.subDict("base"), "b") == 2);
    CHECK(messageOf("b { a 1; }\nc { $b; a 2;\na 3; }") == "t:3: c.a: found a second time, first in line 2");
    CHECK(messageOf("b { a 1; }\nc { $b; a { } }") == "t:2: c.a: found a dictionary, but line 1 makes it a value");
    CHECK(messageOf("b { a { } }\nc { $b; a 2; }") == "t:2: c.a: found a value, but line 1 makes it a dictionary");
    CHECK(messageOf("b { a 1; }\nd { a 2; }\nc { $b; $d; }").find("t:3: c.a: found a second time") == 0);
}

TEST_CASE("a word nobody read is refused, but not headers, macros' words or what only macros use")
{
    const Dictionary used = Dictionary::fromText("FoamFile { any thing; } h 2; t { a 1; } x $h; s { $t; }");
    number(used, "x");
    number(used.subDict("s"), "a");
    used.rejectUnread();
    CHECK(messageOf([&] {
              const Dictionary dict = Dictionary::fromText("t { a 1; b 2; } s { $t; }", "f");
              number(dict.subDict("s"), "a");
              dict.rejectUnread();
          }) == "f:1: s.b: found an unknown word, allowed a");

    const Dictionary asked = Dictionary::fromText("mu 0.6;\ntype fixed;", "f");
    CHECK(asked.found("mu"));
    CHECK_FALSE(asked.found("nu"));
    asked.get<std::string>({"type", ""});
    CHECK(messageOf([&] { asked.rejectUnread(); }) ==
          "f:1: mu: found a word that has no effect here, allowed mu, nu or type");
    const Dictionary none = Dictionary::fromText("a 1;", "f");
    CHECK(messageOf([&] { none.rejectUnread(); }) == "f:1: a: found an unknown word, allowed no words here");
    const Dictionary closed = Dictionary::fromText("a { b 1; }", "f");
    closed.found("c");
    CHECK(messageOf([&] { closed.rejectUnread(); }) == "f:1: a: found an unknown word, allowed c");
}

TEST_CASE("the schema keeps every question, those of nested dictionaries behind a point")
{
    const Dictionary dict = Dictionary::fromText("soil { E 5; }");
    dict.subDict("soil", "a material").get<double>({"E", "stiffness", unit::pressure, Bound::positive(), 2.5e6});
    dict.choose("law", "which", {{"a", ""}, {"b", ""}}, "a");
    dict.get<std::vector<Vector3>>({"p", "", unit::length, {}, std::vector<Vector3>{{0, 1, 2}}});
    const auto schema = dict.schema();
    REQUIRE(schema.size() == 4);
    CHECK(schema[0].word == "soil");
    CHECK(schema[0].type == "dictionary");
    CHECK(schema[1].word == "law");
    CHECK(schema[1].boundText == "a or b");
    CHECK(schema[1].defaultText == "a");
    CHECK(schema[2].defaultText == "((0 1 2))");
    CHECK(schema[3].word == "soil.E");
    CHECK(schema[3].type == "number");
    CHECK(schema[3].help == "stiffness");
    CHECK(schema[3].unitText == "Pa");
    CHECK(schema[3].boundText == "> 0");
    CHECK(schema[3].defaultText == "2500000");
}

TEST_CASE("the text of a dictionary reads back as the same dictionary")
{
    const Dictionary dict = Dictionary::fromText(soilText, "f");
    const Dictionary again = Dictionary::fromText(dict.text(), "g");
    CHECK(again.text() == dict.text());
    CHECK(again.subDict("clay").get<double>({"E", "", unit::pressure}) == 5e6);
    CHECK(again.subDict("soil").get<std::string>({"title", ""}) == "a \"soft\" soil");
}

TEST_CASE("an entry can be set from outside, by its path, and is checked like any other")
{
    Dictionary dict = Dictionary::fromText("soil { E 5; stress { type K0; } }", "f");
    dict.set("soil.E", "7 // stiffer");
    dict.set("soil.nu", "$E");
    dict.set("steps", "many");
    CHECK(number(dict.subDict("soil"), "E") == 7);
    CHECK(number(dict.subDict("soil"), "nu") == 7);
    CHECK(messageOf([&] {
              dict.get<Index>({"steps", ""});
          }) == "command line: steps: found 'many', allowed an integer");
    CHECK(messageOf([&] { dict.set("sol.E", "7"); }) ==
          "command line: 'sol.E': found no dictionary 'sol'; did you mean 'soil'?");
    CHECK(messageOf([&] { dict.set("soil.stress", "7"); }) ==
          "command line: soil.stress: found a value, but f:1 makes it a dictionary");
    CHECK(messageOf([&] { dict.set("a", "7; b 8"); }) ==
          "command line: a: found 'b' after the value, allowed one value");
    CHECK(messageOf([&] { dict.set("a", "{ b 8; }"); }).find("command line: a: ") == 0);
}

TEST_CASE("files are included from the case and from etc, by path or by place, with their own lines in messages")
{
    const Case folder;
    fs::create_directories(folder / "project/etc/caseDicts");
    const fs::path outside = folder / "project";
    folder.write("project/etc/caseDicts/soil", "FoamFile { class dictionary; } rho 1000;");
    const Case inner;
    inner.write("constant/common", "FoamFile { class dictionary; } nu 0.3;\nE 5;\n");
    const fs::path file = inner.write("system/example", "FoamFile { class dictionary; }\n"
                                                        "#include \"../constant/common\"\n"
                                                        "a { #include \"<constant>/common\" }\n"
                                                        "b { #include \"<case>/constant/common\" E 6; }\n"
                                                        "#includeEtc \"caseDicts/soil\"\n"
                                                        "c { #include \"<etc>/caseDicts/soil\" }\n"
                                                        "nu 0.4;\n");
    CHECK(messageOf([&] { Dictionary::readFile(file); }).find("'caseDicts/soil': no such file") != std::string::npos);
    setenv("MPM_PROJECT_DIR", outside.c_str(), 1);
    const Dictionary dict = Dictionary::readFile(file);
    unsetenv("MPM_PROJECT_DIR");
    CHECK(number(dict, "nu") == 0.4);
    CHECK(number(dict.subDict("a"), "nu") == 0.3);
    CHECK(number(dict.subDict("b"), "E") == 6);
    CHECK(number(dict, "rho") == 1000);
    CHECK(number(dict.subDict("c"), "rho") == 1000);
    CHECK(dict.dictNames() == std::vector<std::string>{"a", "b", "c"});
    CHECK(dict.where("E").text() == (inner / "constant/common").string() + ":2");
    CHECK(messageOf("#include \"x\"") == "t:1: #include 'x': files cannot be included here");
}

TEST_CASE("no include leaves the case folder, hangs, or runs away")
{
    const Case folder;
    const Case other;
    const fs::path secret = other.write("secret", "key 42;");
    CHECK(folder.message("#include \"" + secret.string() + "\"").find("lies outside") != std::string::npos);
    fs::create_symlink(secret, folder / "system/link");
    CHECK(folder.message("#include \"link\"").find("lies outside") != std::string::npos);
    fs::create_directory_symlink(other.path(), folder / "system/door");
    CHECK(folder.message("#include \"door/secret\"").find("lies outside") != std::string::npos);
    CHECK(folder.message("#include \"door/none\"").find("lies outside") != std::string::npos);
    CHECK(folder.message("#include \"../../" + other.path().filename().string() + "/secret\"").find("lies outside") !=
          std::string::npos);
    CHECK(folder.message("#include \"<case>/../x\"").find("lies outside") != std::string::npos);
    fs::create_symlink(folder / "system/inside", folder / "system/fine");
    folder.write("system/inside", "a 1;");
    CHECK(folder.message("#include \"fine\"") == "no error");
    mkfifo((folder / "system/pipe").c_str(), 0600);
    CHECK(folder.message("#include \"pipe\"").find("a device or a pipe") != std::string::npos);
    for (const char* path : {"$HOME/x", "~/x", "<home>/x", "", "<case"})
        CHECK(folder.message("#include \"" + std::string(path) + "\"").find("allowed") != std::string::npos);

    for (int i = 0; i < 12; ++i)
        folder.write(fmt::format("system/deep{}", i), fmt::format("#include \"deep{}\"", i + 1));
    CHECK(folder.message("#include \"deep0\"").find("deeper than 10") != std::string::npos);
    folder.write("system/empty", "");
    std::string many;
    for (int i = 0; i < 201; ++i)
        many += "#include \"empty\"\n";
    CHECK(folder.message(many).find("more than 200 files") != std::string::npos);
    folder.write("system/twice", "#include \"empty\"\n#include \"empty\"\n");
    CHECK(folder.message("#include \"twice\"") == "no error"); // twice is no cycle
    folder.write("system/big", std::string((4u << 20) + 1, ' '));
    CHECK(folder.message("#include \"big\"").find("more than 4 MB") != std::string::npos);
    CHECK(messageOf([&] { Dictionary::readFile(folder / "system/none"); }) ==
          (folder / "system/none").string() + ": no such file");
    CHECK(messageOf([&] { Dictionary::readFile(folder / "system"); }) ==
          (folder / "system").string() + ": found a folder, allowed a file");
}

TEST_CASE("text made to exhaust memory, stack or time is refused")
{
    std::string deep;
    for (int i = 0; i < 100000; ++i)
        deep += "a{";
    CHECK(messageOf(deep) == "t:1: found dictionaries nested deeper than 100");
    CHECK(messageOf("a " + std::string(100000, '(')) == "t:1: a: found lists nested deeper than 100");
    CHECK(messageOf(std::string(2000, 'a') + " 1;") == "t:1: found a word of 2000 characters, allowed 1000");
    CHECK(messageOf("a $" + std::string(2000, 'a') + ";") == "t:1: found a macro of 2000 characters, allowed 1000");

    std::string laughs = "a0 (lol lol lol lol lol lol lol lol lol lol);\n";
    for (int i = 1; i < 12; ++i)
    {
        laughs += fmt::format("a{} (", i);
        for (int k = 0; k < 10; ++k)
            laughs += fmt::format(" $a{}", i - 1);
        laughs += ");\n";
    }
    CHECK(messageOf(laughs).find("grows beyond 64 MB") != std::string::npos);
    std::string trees = "a0 { x { y 1; } z 2; }\n";
    for (int i = 1; i < 40; ++i)
        trees += fmt::format("a{0} {{ x $:a{1}; z $:a{1}; }}\n", i, i - 1);
    CHECK(messageOf(trees).find("grows beyond 64 MB") != std::string::npos);

    std::string many; // a hundred thousand words, none of which the macro means
    for (int i = 0; i < 100000; ++i)
        many += fmt::format("w{} 1;\n", i);
    CHECK(messageOf(many + "x $wrong;").find("found '$wrong'") != std::string::npos);
}

TEST_CASE("text that is no text is refused, and never reaches the terminal raw")
{
    CHECK(messageOf(std::string("a 1;\n\0b 2;", 10)) == "t:2: found the byte 0x00, allowed only text");
    CHECK(messageOf("a \"\x1b[31m\";") == "t:1: found the byte 0x1b, allowed only text");
    CHECK(messageOf("\xEF\xBB\xBF"
                    "a 1;") == "t:1: found a byte order mark, allowed plain text without one");
    CHECK(messageOf("a 1;\r\nb 2;\r\n") == "no error");
    CHECK(messageOf("") == "no error");
    CHECK(messageOf("// only a comment") == "no error");
}

TEST_CASE("broken copies of a good dictionary are read or refused, never worse")
{
    // a linear congruential generator: the same broken copies everywhere
    std::uint32_t seed = 1;
    const auto random = [&seed](std::size_t below) {
        seed = seed * 1664525u + 1013904223u;
        return std::size_t(seed >> 8) % below;
    };
    const std::string good = soilText, pieces = "{}()[];$#\"/*.:,-0e \n\\a";
    int refused = 0;
    for (int copy = 0; copy < 3000; ++copy)
    {
        std::string text = good;
        for (std::size_t change = random(4) + 1; change > 0; --change)
        {
            const std::size_t at = random(text.size());
            if (random(2))
                text.erase(at, random(20));
            else
                text.insert(at, 1, random(10) ? pieces[random(pieces.size())] : char(random(256)));
        }
        const std::string message = messageOf([&] {
            const Dictionary dict = Dictionary::fromText(text, "t");
            Dictionary::fromText(dict.text(), "secondTime");
            dict.rejectUnread();
        });
        INFO(text);
        REQUIRE(message.find("secondTime:") == std::string::npos);
        REQUIRE((message == "no error" || message.rfind("t:", 0) == 0));
        refused += message != "no error";
    }
    CHECK(refused > 1000);
}
