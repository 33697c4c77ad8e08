#include "geometry/gmshScript.hpp"

#include "base/error.hpp"
#include "base/folders.hpp"
#include "geometry/geometryFile.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;

namespace mpm::geometry
{
namespace
{
constexpr std::uintmax_t longestScript = 64u << 20; // bytes
constexpr std::size_t mostFiles = 200;

struct Refusal
{
    const char* command;
    const char* why;
};

constexpr const char* runs = "a geometry starts no programs";
constexpr const char* writes = "a geometry writes no files";
constexpr const char* pointless = "a geometry only draws";
constexpr Refusal refusals[] = {{"SystemCall", runs}, {"System", runs},       {"NonBlockingSystemCall", runs},
                                {"OnelabRun", runs},  {"SendToServer", runs}, {"Save", writes},
                                {"Print", writes},    {"CreateDir", writes},  {"Plugin", pointless},
                                {"Exit", pointless},  {"Abort", pointless},   {"Sleep", pointless},
                                {"GetEnv", pointless}};
constexpr const char* readers[] = {"Include", "Merge", "MergeWithBoundingBox", "ShapeFromFile"};

/// One script: its words and brackets looked at, comments and texts stepped over.
class Script
{
  public:
    Script(const fs::path& file, std::vector<fs::path>& known, const fs::path& root)
        : file_(file), known_(known), root_(root)
    {
        std::ifstream in(file, std::ios::binary);
        if (fs::file_size(file) > longestScript)
            throw InputError({file.string(), 0}, fmt::format("found more than {} MB, too much for a script of gmsh; "
                                                             "a mesh is read from .msh, .step or .stl",
                                                             longestScript >> 20));
        text_.assign(std::istreambuf_iterator<char>(in), {});
    }

    void check()
    {
        while (skipToToken(), at_ < text_.size())
        {
            const char c = text_[at_];
            if (c == '"' || c == '\'')
                takeText(c);
            else if (std::isalpha(static_cast<unsigned char>(c)) || c == '_')
                checkWord(takeWord());
            else if (++at_; c == '>')
                checkRedirection();
        }
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw InputError({file_.string(), line_}, what); }

    bool starts(const char* what) const { return text_.compare(at_, 2, what) == 0; }

    void skipToToken()
    {
        while (at_ < text_.size())
        {
            if (std::isspace(static_cast<unsigned char>(text_[at_])))
                line_ += text_[at_++] == '\n';
            else if (starts("//"))
                at_ = std::min(text_.find('\n', at_), text_.size());
            else if (starts("/*"))
            {
                const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
                line_ +=
                    int(std::count(text_.begin() + std::ptrdiff_t(at_), text_.begin() + std::ptrdiff_t(end), '\n'));
                at_ = std::min(end + 2, text_.size());
            }
            else
                return;
        }
    }

    std::string takeText(char quote)
    {
        std::string out;
        for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_)
        {
            line_ += text_[at_] == '\n';
            if (text_[at_] == '\\' && at_ + 1 < text_.size())
                out += text_[at_++];
            out += text_[at_];
        }
        at_ = std::min(at_ + 1, text_.size());
        return out;
    }

    std::string takeWord()
    {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }

    void checkWord(const std::string& word)
    {
        for (const Refusal& refusal : refusals)
            if (word == refusal.command)
                fail(fmt::format("found the command {}, which is not allowed: {}", word, refusal.why));
        if (std::find(std::begin(readers), std::end(readers), word) == std::end(readers))
            return;
        skipToToken();
        if (at_ < text_.size() && text_[at_] == '(') // ShapeFromFile("...")
            ++at_, skipToToken();
        if (at_ >= text_.size() || text_[at_] != '"')
            fail(fmt::format("{}: allowed is a file name in double quotes, nothing calculated", word));
        const std::string name = takeText('"');
        const fs::path other = fs::path(name).is_absolute() ? fs::path(name) : file_.parent_path() / name;
        if (!isWithinReach(other, root_))
            fail(fmt::format("{} \"{}\": lies outside the case folder and the project's etc", word, name));
        if (!fs::is_regular_file(other))
            fail(fmt::format("{} \"{}\": no such file", word, name));
        if (known_.size() >= mostFiles)
            fail(fmt::format("{} \"{}\": is more than {} files", word, name, mostFiles));
        if (std::find(known_.begin(), known_.end(), realPath(other)) == known_.end())
        {
            known_.push_back(realPath(other));
            checkFile(other, lowerEnding(other));
        }
        else if (word == "Include" && fs::equivalent(other, file_))
            fail(fmt::format("{} \"{}\": includes itself", word, name));
    }

    void checkRedirection()
    {
        at_ += at_ < text_.size() && text_[at_] == '>';
        skipToToken();
        if (at_ < text_.size() && text_[at_] == '"')
            fail(fmt::format("found > and a file name, which is not allowed: {}", writes));
    }

  public:
    /// A script, a mesh that begins like one, or CAD that gmsh knows by its ending.
    void checkFile(const fs::path& file, const std::string& ending) { checkAny(file, ending, known_, root_); }
    static void checkAny(const fs::path& file, const std::string& ending, std::vector<fs::path>& known,
                         const fs::path& root);

  private:
    const fs::path file_;
    std::vector<fs::path>& known_;
    const fs::path& root_;
    std::string text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

void Script::checkAny(const fs::path& file, const std::string& ending, std::vector<fs::path>& known,
                      const fs::path& root)
{
    if (ending == ".step" || ending == ".stp" || ending == ".stl" || ending == ".brep" || ending == ".iges" ||
        ending == ".igs")
    {
        // gmsh recognises these in lower or upper case only, and runs what it does not recognise
        const std::string written = file.extension().string();
        std::string upper = ending;
        std::transform(upper.begin(), upper.end(), upper.begin(),
                       [](unsigned char c) { return char(std::toupper(c)); });
        if (written != ending && written != upper)
            throw InputError({file.string(), 0}, fmt::format("found the ending '{}', allowed '{}'", written, ending));
        return;
    }
    if (ending == ".msh")
    {
        std::string first;
        std::ifstream in(file, std::ios::binary);
        in >> first;
        first.resize(std::min<std::size_t>(first.size(), 40));
        for (char& c : first)
            c = std::isprint(static_cast<unsigned char>(c)) ? c : '?';
        if (in.seekg(0), in.get() != '$' || (first != "$MeshFormat" && first != "$Comments"))
            throw InputError({file.string(), 1},
                             fmt::format("found '{}', allowed $MeshFormat: a mesh of format 2.2 or 4.1", first));
        return;
    }
    Script(file, known, root).check();
}
} // namespace

void checkScript(const fs::path& file, const std::string& ending)
{
    const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
    const fs::path root = realPath(folder).filename() == "geometry" ? folder / ".." : folder;
    std::vector<fs::path> known = {realPath(file)};
    Script::checkAny(file, ending, known, root);
    if (const fs::path options = file.string() + ".opt"; fs::is_regular_file(options))
        Script::checkAny(options, ".opt", known, root);
}
} // namespace mpm::geometry
