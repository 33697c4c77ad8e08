#pragma once
/// Internal to dictionary/: OpenFOAM's dictionary grammar, from text to a tree.
///
///     file   = { entry }
///     entry  = word { token } ';'  |  word '{' { entry } '}'  |  '$' name ';'  |  '#include' "file"
///
/// What OpenFOAM settles silently is an error here: a word given twice, a missing ';', an unknown macro. A word that
/// came through #include or `$dict;` may be given again afterwards, which replaces it (nested dictionaries are merged).
/// Bounds for text nobody vouches for: see Limits.
#include "dictionary/node.hpp"

#include <filesystem>

namespace mpm::dictionary
{
struct Limits
{
    static constexpr int nesting = 100;                             ///< braces, and brackets of a list
    static constexpr int includeDepth = 10;                         ///< files within files
    static constexpr int includeCount = 200;                        ///< #include directives of one dictionary
    static constexpr std::uintmax_t fileBytes = 4u << 20;           ///< size of one file
    static constexpr std::size_t treeBytes = std::size_t(64) << 20; ///< memory of the tree, macros expanded
};

class Parser
{
  public:
    /// `root` is the folder #include may reach; empty forbids #include.
    explicit Parser(std::filesystem::path root = {}) : root_(std::move(root)) {}

    std::unique_ptr<Node> parseFile(const std::filesystem::path& file);
    std::unique_ptr<Node> parseText(std::string text, const std::string& name);
    /// The tokens of one value for `word` of `node`, as a command line gives it.
    std::vector<Token> parseValue(Node& node, const std::string& word, const std::string& text,
                                  const std::string& name);

  private:
    void parseBlock(Node& node, Tokenizer& in, const Token* brace);
    void parseEntry(Node& node, Tokenizer& in, const Token& key);
    void parseDictionary(Node& node, Tokenizer& in, const Token& key, const Token& brace);
    void parsePlain(Node& node, Tokenizer& in, const Token& key, Token first);
    std::vector<Token> readValue(Node& node, Tokenizer& in, const Token& key, Token token);
    void parseDirective(Node& node, Tokenizer& in, const Token& directive);
    void include(Node& node, const Token& directive, const Token& name);
    void merge(Node& node, const Token& variable);
    void place(Node& node, NodeEntry entry, const Location& where);
    void copyInto(const Node& from, Node& to, int layer, const Location& where);
    void appendVariable(Node& node, const Token& key, const Token& variable, std::vector<Token>& value);
    NodeEntry& expand(Node& node, const Token& variable);
    std::unique_ptr<Node> newNode(Node& parent, const std::string& word, const Location& where) const;
    std::string load(const std::filesystem::path& file, const Token* from);
    void charge(std::size_t bytes, const Location& where);
    int depthOf(const Node& node) const;

    std::filesystem::path root_;
    std::vector<std::filesystem::path> reading_; ///< canonical names of the files being read, outermost first
    int layer_ = 0;
    int includes_ = 0;
    std::size_t bytes_ = 0;
};

/// Why a directive other than #include is refused, and what to write instead.
std::string directiveAnswer(const std::string& name);

/// Finds what `$name` means inside `node`, by OpenFOAM's rules: `name` here or in a dictionary around; `sub.name` here;
/// `.name` here, `..name` one dictionary up, and so on; `:name` from the top. Null when there is no such entry.
NodeEntry* lookUp(Node& node, const std::string& name);
} // namespace mpm::dictionary
