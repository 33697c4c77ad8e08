#pragma once
/// Internal to dictionary/: the tree a file becomes.
#include "dictionary/token.hpp"

#include <unordered_map>
#include <vector>

namespace mpm::dictionary
{
struct Node;

/// `word value;` or `word { ... }`.
struct NodeEntry
{
    std::string word;
    std::vector<Token> value;   ///< macros expanded; empty when `dict` is set
    std::unique_ptr<Node> dict; ///< the nested dictionary, or null
    Location where;
    int layer = 0;         ///< 0 written in the file itself; +1 for every #include or `$dict;` it came through
    bool read = false;     ///< somebody asked for its value
    bool expanded = false; ///< a macro used it
};

struct Node
{
    std::vector<NodeEntry> entries;
    std::unordered_map<std::string, std::size_t> index; ///< word -> place in entries
    Node* parent = nullptr;
    std::string path; ///< "soil.initialStress"; empty at the top
    Location where;
    bool beingRead = false;

    NodeEntry* find(const std::string& word)
    {
        const auto found = index.find(word);
        return found == index.end() ? nullptr : &entries[found->second];
    }
    NodeEntry& add(NodeEntry entry)
    {
        index.emplace(entry.word, entries.size());
        entries.push_back(std::move(entry));
        return entries.back();
    }
    Node* top() { return parent ? parent->top() : this; }
    std::string pathOf(const std::string& word) const { return path.empty() ? word : path + "." + word; }
    std::vector<std::string> words() const
    {
        std::vector<std::string> out;
        for (const auto& entry : entries)
            out.push_back(entry.word);
        return out;
    }
};

std::string dictionaryText(const Node& node, int indent = 0);
} // namespace mpm::dictionary
