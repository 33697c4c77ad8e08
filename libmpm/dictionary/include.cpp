// Files: reading them within bounds, and #include kept inside the case folder and the project's etc.
#include "base/version.hpp"
#include "dictionary/parser.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace fs = std::filesystem;

namespace mpm::dictionary {
namespace {
bool isInside(const fs::path& file, const fs::path& folder)
{
    if (folder.empty())
        return false;
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

fs::path realPath(const fs::path& path)
{
    std::error_code none;
    return fs::canonical(path, none); // empty when it does not exist
}

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
    {"inputSyntax", nullptr},
    {"remove", "leave the word out"},
    {"includeFunc", nullptr},
    {"message", nullptr},
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
    auto top = parseText(std::move(text), file.string());
    reading_.pop_back();
    return top;
}

/// A file's text; `from` is the #include that asks for it.
std::string Parser::load(const fs::path& file, const Location* from)
{
    const auto fail = [&](const std::string& what) {
        if (from)
            throw InputError(*from, fmt::format("#include {}: {}", shownText(file.string()), what));
        throw InputError({file.string(), 0}, what);
    };
    std::error_code error;
    const auto status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found)
        fail("no such file");
    if (fs::is_directory(status))
        fail("found a folder, allowed a dictionary file");
    if (!fs::is_regular_file(status))
        fail("found something that is not a regular file");
    const auto size = fs::file_size(file, error);
    if (!error && size > Limits::fileBytes)
        fail(fmt::format("found {} bytes, allowed {}", size, Limits::fileBytes));
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    std::string text(size, '\0');
    in.read(text.data(), std::streamsize(size));
    text.resize(std::size_t(in.gcount()));
    return text;
}

void Parser::parseDirective(Node& node, Tokenizer& in, const Token& directive)
{
    if (directive.text == "include" || directive.text == "includeEtc") {
        const Token name = in.next();
        if (name.kind != Kind::text || name.line != directive.line)
            throw InputError(directive.where(),
                             fmt::format("#{}: found {}, allowed a file name in double quotes on the "
                                         "same line",
                                         directive.text, name.shown()));
        return include(node, directive, name);
    }
    for (const auto& known : refused)
        if (directive.text == known.name)
            throw InputError(directive.where(),
                             fmt::format("found {}, allowed #include and #includeEtc{}", directive.shown(),
                                         known.answer ? std::string("; ") + known.answer : ""));
    const std::string nearest = nearestWord(directive.text, {"include", "includeEtc"});
    throw InputError(directive.where(), fmt::format("found {}, allowed #include and #includeEtc{}", directive.shown(),
                                                    nearest.empty() ? "" : "; did you mean '#" + nearest + "'?"));
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
    else if (name.text[0] == '<') {
        const std::size_t close = name.text.find(">/");
        const std::string tag = close == std::string::npos ? "" : name.text.substr(1, close - 1);
        if (tag != "case" && tag != "constant" && tag != "system" && tag != "etc")
            fail("allowed <case>/, <constant>/, <system>/ or <etc>/ at its beginning");
        const fs::path rest = fs::path(name.text.substr(close + 2)).relative_path();
        file = tag == "etc" ? etcFolder() / rest : tag == "case" ? root_ / rest : root_ / tag / rest;
    } else if (file.is_relative())
        file = fs::path(*name.file).parent_path() / file;

    std::error_code none;
    const fs::path real = fs::weakly_canonical(file, none); // links and '..' followed as far as the path exists
    if (real.empty() || !(isInside(real, realPath(root_)) || isInside(real, realPath(etcFolder()))))
        fail("lies outside the case folder and the project's etc");
    for (const auto& outer : reading_)
        if (outer == real)
            fail("includes itself, directly or through another file");
    if (reading_.size() > Limits::includeDepth)
        fail(fmt::format("is file within file deeper than {}", Limits::includeDepth));
    if (++includes_ > Limits::includeCount)
        fail(fmt::format("is more than {} files", Limits::includeCount));

    std::string text = load(file.lexically_normal(), &where);
    charge(text.size(), where);
    reading_.push_back(real);
    ++layer_;
    Tokenizer in(std::move(text), file.lexically_normal().string());
    parseBlock(node, in, nullptr);
    --layer_;
    reading_.pop_back();
}
} // namespace mpm::dictionary
