// Files: reading them within bounds, and #include kept inside the case folder and the project's etc.
#include "base/folders.hpp"
#include "base/version.hpp"
#include "dictionary/parser.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace fs = std::filesystem;

namespace mpm::dictionary
{
namespace
{
fs::path etcFolder()
{
    return fs::path(projectFolder()) / "etc";
}

struct KnownDirective
{
    const char* name;
    const char* answer;
};

constexpr const char* noCode = "nothing is calculated and no code is run here: write the value";
constexpr const char* noBranch = "there are no conditions here";
constexpr KnownDirective refused[] = {
    {"calc", noCode},
    {"codeStream", noCode},
    {"eval", noCode},
    {"if", noBranch},
    {"ifeq", noBranch},
    {"else", noBranch},
    {"endif", noBranch},
    {"inputMode", "a word replaces what came through #include or a macro, and nothing else"},
    {"inputSyntax", "there is one syntax here"},
    {"remove", "leave the word out"},
    {"includeFunc", "there are no function objects here"},
    {"message", "a dictionary says nothing by itself"},
    {"includeIfPresent", "a file that may be missing would change a run silently: use #include"},
    {"sinclude", "a file that may be missing would change a run silently: use #include"},
    {"sincludeEtc", "a file that may be missing would change a run silently: use #includeEtc"},
    {"neg", noCode},
    {"word", noCode},
};
} // namespace

std::unique_ptr<Node> Parser::parseFile(const fs::path& file)
{
    std::string text = load(file, nullptr);
    reading_.push_back(realPath(file));
    auto top = parseText(std::move(text), file.lexically_normal().string());
    reading_.pop_back();
    return top;
}

/// A file's text; `from` is the file name of the #include that asks for it, null at the top.
std::string Parser::load(const fs::path& file, const Token* from)
{
    const auto fail = [&](const std::string& what) {
        if (from)
            throw InputError(from->where(), fmt::format("#include {}: {}", shownText(from->text), what));
        throw InputError({file.lexically_normal().string(), 0}, what);
    };
    std::error_code error;
    const auto status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found)
        fail("no such file");
    if (fs::is_directory(status))
        fail("found a folder, allowed a file");
    if (!fs::is_regular_file(status))
        fail("found a device or a pipe, allowed a file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    std::string text;
    std::vector<char> piece(1 << 16);
    while (in.read(piece.data(), std::streamsize(piece.size())), in.gcount() > 0)
    {
        text.append(piece.data(), std::size_t(in.gcount()));
        if (text.size() > Limits::fileBytes)
            fail(fmt::format("found more than {} MB, too much for a dictionary", Limits::fileBytes >> 20));
    }
    if (in.bad())
        fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    return text;
}

void Parser::parseDirective(Node& node, Tokenizer& in, const Token& directive)
{
    if (directive.text == "include" || directive.text == "includeEtc")
    {
        const Token name = in.next();
        if (name.kind != Kind::text || name.line != directive.line)
            throw InputError(directive.where(),
                             fmt::format("#{}: found {}, allowed a file name in double quotes on the "
                                         "same line",
                                         directive.text, name.shown()));
        return include(node, directive, name);
    }
    const std::string answer = directiveAnswer(directive.text);
    throw InputError(directive.where(), fmt::format("found {}, allowed #include and #includeEtc{}{}", directive.shown(),
                                                    answer.empty() ? "" : "; ", answer));
}

std::string directiveAnswer(const std::string& name)
{
    for (const auto& known : refused)
        if (name == known.name)
            return known.answer;
    const std::string nearest = nearestWord(name, {"include", "includeEtc"});
    return nearest.empty()   ? "no such directive is known here"
           : nearest == name ? "files are included between entries"
                             : "did you mean '#" + nearest + "'?";
}

void Parser::include(Node& node, const Token& directive, const Token& name)
{
    const Location where = name.where();
    const auto fail = [&](const std::string& what) {
        throw InputError(where, fmt::format("#{} {}: {}", directive.text, shownText(name.text), what));
    };
    if (root_.empty())
        fail("files cannot be included here");
    if (name.text.empty() || name.text[0] == '$' || name.text[0] == '~')
        fail("allowed a path as it stands, or one that begins with <case>/, <constant>/, <system>/ or <etc>/");
    fs::path file = name.text;
    if (directive.text == "includeEtc")
        file = etcFolder() / file;
    else if (name.text[0] == '<')
    {
        const std::size_t close = name.text.find(">/");
        const std::string tag = close == std::string::npos ? "" : name.text.substr(1, close - 1);
        if (tag != "case" && tag != "constant" && tag != "system" && tag != "etc")
            fail("allowed <case>/, <constant>/, <system>/ or <etc>/ at its beginning");
        const fs::path rest = fs::path(name.text.substr(close + 2)).relative_path();
        file = tag == "etc" ? etcFolder() / rest : tag == "case" ? root_ / rest : root_ / tag / rest;
    }
    else if (file.is_relative())
        file = fs::path(*name.file).parent_path() / file;

    const fs::path real = realPath(file);
    if (!isWithinReach(real, root_))
        fail("lies outside the case folder and the project's etc");
    for (const auto& outer : reading_)
        if (outer == real)
            fail("includes itself, directly or through another file");
    if (reading_.size() > Limits::includeDepth)
        fail(fmt::format("is file within file deeper than {}", Limits::includeDepth));
    if (++includes_ > Limits::includeCount)
        fail(fmt::format("is more than {} files", Limits::includeCount));

    std::string text = load(file.lexically_normal(), &name);
    charge(text.size(), where);
    reading_.push_back(real);
    ++layer_;
    Tokenizer in(std::move(text), file.lexically_normal().string());
    parseBlock(node, in, nullptr);
    --layer_;
    reading_.pop_back();
}
} // namespace mpm::dictionary
