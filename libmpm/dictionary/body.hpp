#pragma once
/// Internal to dictionary/: what a Dictionary keeps beside its tree: the questions asked and the dictionaries opened.
#include "dictionary/dictionary.hpp"
#include "dictionary/node.hpp"

#include <map>

namespace mpm::dictionary
{
struct Rest;

struct Dictionary::Body
{
    std::unique_ptr<Node> owned; ///< the tree, at its top only
    Node* node = nullptr;
    std::filesystem::path root; ///< what #include may reach
    std::vector<Asked> asked;
    std::unordered_map<std::string, std::size_t> askedAt; ///< word -> place in asked
    std::map<std::string, std::unique_ptr<Dictionary>> opened;

    void remember(Asked question);
    std::vector<std::string> knownWords() const;
    Dictionary& open(NodeEntry& entry);
    static Rest skipPrefix(const Dictionary& self, const std::string& word, Rest all, const Dimensions& dimensions,
                           bool mayBeUniform);
};

/// "Pa", or "kg m^-1 s^-3" where there is no name; empty for pure numbers.
std::string unitText(const Dimensions& dimensions);
/// "[1 -1 -2 0 0 0 0]"
std::string exponentsText(const Dimensions& dimensions);
/// " (did you mean 'x'?)", or nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);
} // namespace mpm::dictionary
