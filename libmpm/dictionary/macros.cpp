// Macros: what `$name` means, and putting it in place.
#include "dictionary/parser.hpp"

#include <fmt/format.h>

namespace mpm::dictionary {
namespace {
/// Looks for `a`, `a.b`, `.a`, `..a` from `node`; never in the dictionaries around unless dots say so.
NodeEntry* lookUpScoped(Node* node, std::string_view name)
{
    for (;;) {
        for (bool up = false; !name.empty() && name[0] == '.'; name.remove_prefix(1), up = true)
            if (up && !(node = node->parent))
                return nullptr;
        // the shortest piece that names an entry; words may hold points themselves
        std::size_t end = name.find('.');
        NodeEntry* entry = node->find(std::string(name.substr(0, end)));
        while (!entry && end != std::string_view::npos) {
            end = name.find('.', end + 1);
            entry = node->find(std::string(name.substr(0, end)));
        }
        if (!entry || end == std::string_view::npos)
            return entry;
        if (!entry->dict)
            return nullptr;
        node = entry->dict.get();
        name.remove_prefix(end);
    }
}
} // namespace

NodeEntry* lookUp(Node& node, const std::string& name)
{
    if (name[0] == ':' || name[0] == '^')
        return name.size() > 1 ? lookUpScoped(node.top(), std::string_view(name).substr(1)) : nullptr;
    if (name.find('.') != std::string::npos)
        return lookUpScoped(&node, name);
    for (Node* here = &node; here; here = here->parent)
        if (NodeEntry* entry = here->find(name))
            return entry;
    return nullptr;
}

/// The entry behind a macro, marked as used; an error with the nearest name if there is none.
NodeEntry& Parser::expand(Node& node, const Token& variable)
{
    if (NodeEntry* entry = lookUp(node, variable.text)) {
        entry->expanded = true;
        return *entry;
    }
    std::string hint;
    std::vector<std::string> known;
    for (Node* here = &node; here; here = here->parent) {
        if (here != &node && hint.empty() && variable.text.find('.') != std::string::npos &&
            lookUpScoped(here, variable.text))
            hint = fmt::format("; did you mean '$:{}'?", here->pathOf(variable.text));
        for (auto& word : here->words())
            known.push_back(std::move(word));
    }
    const std::string nearest = nearestWord(variable.text, known);
    if (hint.empty() && !nearest.empty())
        hint = fmt::format("; did you mean '${}'?", nearest);
    throw InputError(variable.where(),
                     fmt::format("found {}, allowed a macro whose word was given before it{}", variable.shown(), hint));
}

/// `$dict;` as an entry: everything of that dictionary, copied here.
void Parser::merge(Node& node, const Token& variable)
{
    const NodeEntry& source = expand(node, variable);
    if (!source.dict)
        throw InputError(variable.where(), fmt::format("found {}, which is a value ({}), allowed a dictionary here",
                                                       variable.shown(), source.where.text()));
    Node copy;
    copy.parent = node.parent;
    copy.path = node.path;
    copyInto(*source.dict, copy, layer_ + 1, variable.where());
    for (NodeEntry& entry : copy.entries) {
        if (entry.dict)
            entry.dict->parent = &node;
        place(node, std::move(entry), variable.where());
    }
}

void Parser::copyInto(const Node& from, Node& to, int layer, const Location& where)
{
    if (from.beingRead)
        throw InputError(where, "found a macro for the dictionary in which it stands");
    for (const NodeEntry& entry : from.entries) {
        NodeEntry copy;
        copy.word = entry.word;
        copy.value = entry.value;
        copy.where = entry.where;
        copy.lastLine = entry.lastLine;
        copy.layer = layer;
        for (const Token& token : copy.value)
            charge(sizeof(Token) + token.text.size(), where);
        if (entry.dict) {
            copy.dict = newNode(to, entry.word, entry.where);
            copyInto(*entry.dict, *copy.dict, layer, where);
        }
        place(to, std::move(copy), where);
    }
}

/// `$name` inside a value: its tokens, which from now on stand in this line.
void Parser::appendVariable(Node& node, const Token& key, const Token& variable, std::vector<Token>& value)
{
    const NodeEntry& source = expand(node, variable);
    if (source.dict)
        throw InputError(variable.where(), fmt::format("{}: found {}, which is a dictionary ({}), allowed a value",
                                                       node.pathOf(key.text), variable.shown(), source.where.text()));
    const std::size_t count = source.value.size();
    for (std::size_t i = 0; i < count; ++i) {
        charge(sizeof(Token) + source.value[i].text.size(), variable.where());
        value.push_back(source.value[i]);
        value.back().file = variable.file;
        value.back().line = variable.line;
    }
}
} // namespace mpm::dictionary
