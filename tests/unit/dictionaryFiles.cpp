// Includes that stay where they may reach, and text made to harm: refused, never worse.
#include "support/dictionaryHelp.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>

using namespace mpm;
using namespace mpm::dictionary;
using namespace mpm::tests;
namespace fs = std::filesystem;

namespace
{
/// A case folder with the files a test writes.
struct Case : TemporaryFolder
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
    CHECK(messageOf("a 1;\n\xEF\xBB\xBF"
                    "b 1;")
              .find("t:2: found a byte order mark") == 0);
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
