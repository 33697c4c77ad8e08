// What dictionaries mean: values, macros, scopes, and the book-keeping of what was asked.
#include "support/dictionaryHelp.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

using namespace mpm;
using namespace mpm::dictionary;
using namespace mpm::tests;

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

TEST_CASE("what came through a macro may be replaced afterwards, once, and dictionaries are merged")
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
    // a dictionary merged into a dictionary: '..' leads to the one around, not to where it came from
    Dictionary deep = Dictionary::fromText("base { in { b 4; } } rich { in { deep { c 3; } } }"
                                           "one { $base; in $:rich.in; }");
    deep.set("one.in.deep.d", "$..b");
    CHECK(number(deep.subDict("one").subDict("in").subDict("deep"), "d") == 4);
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
