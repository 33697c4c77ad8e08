// Macros: what `$name` means, and putting it in place.
#include "dictionary/parser.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
/// An entry of `node`; a dictionary still being read cannot be found by its name, as in OpenFOAM.
NodeEntry* visible(Node& node, std::string_view name)
{
    NodeEntry* entry = node.find(std::string(name));
    return entry && entry->dict && entry->dict->beingRead ? nullptr : entry;
}

/// Looks for `a`, `a.b`, `.a`, `..a` from `node`; never in the dictionaries around unless dots say so.
NodeEntry* lookUpScoped(Node* node, std::string_view name)
{
    for (;;)
    {
        for (bool up = false; !name.empty() && name[0] == '.'; name.remove_prefix(1), up = true)
            if (up && !(node = node->parent))
                return nullptr;
        // the shortest piece that names an entry; words may hold points themselves
        std::size_t end = name.find('.');
        NodeEntry* entry = visible(*node, name.substr(0, end));
        while (!entry && end != std::string_view::npos)
        {
            end = name.find('.', end + 1);
            entry = visible(*node, name.substr(0, end));
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
        if (NodeEntry* entry = visible(*here, name))
            return entry;
    return nullptr;
}

namespace
{
/// "; did you mean '$:soil.E'?" for what is visible under another name, or is spelled almost so.
std::string hintFor(Node& node, const std::string& name)
{
    const std::string bare = name.substr(std::min(name.find_first_not_of(":^."), name.size() - 1));
    const std::string last = bare.substr(bare.rfind('.') + 1);
    std::vector<std::string> known;
    for (Node* here = &node; here; here = here->parent)
    {
        if (bare.find('.') != std::string::npos && lookUpScoped(here, bare))
            return fmt::format("; did you mean '$:{}'?", here->pathOf(bare));
        if (bare != name && bare.find('.') == std::string::npos && visible(*here, bare))
            return fmt::format("; did you mean '${}'?", bare);
        if (here->beingRead && bare == here->pathOf(last) && visible(*here, last))
            return fmt::format("; did you mean '${}'? (a dictionary has no name before its '}}')", last);
        for (auto& word : here->words())
            known.push_back(std::move(word));
    }
    const std::string nearest = nearestWord(name, known);
    return nearest.empty() || nearest == name ? "" : fmt::format("; did you mean '${}'?", nearest);
}
} // namespace

/// The entry behind a macro, marked as used; an error with the nearest name if there is none.
NodeEntry& Parser::expand(Node& node, const Token& variable)
{
    if (NodeEntry* entry = lookUp(node, variable.text))
    {
        entry->expanded = true;
        return *entry;
    }
    throw InputError(variable.where(), fmt::format("found {}, allowed a macro whose word was given before it{}",
                                                   variable.shown(), hintFor(node, variable.text)));
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
    for (NodeEntry& entry : copy.entries)
        place(node, std::move(entry), variable.where());
}

void Parser::copyInto(const Node& from, Node& to, int layer, const Location& where)
{
    for (const NodeEntry& entry : from.entries)
    {
        NodeEntry copy;
        copy.word = entry.word;
        copy.value = entry.value;
        copy.where = entry.where;
        copy.layer = layer;
        for (const Token& token : copy.value)
            charge(sizeof(Token) + token.text.size(), where);
        if (entry.dict)
        {
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
    for (std::size_t i = 0; i < count; ++i)
    {
        charge(sizeof(Token) + source.value[i].text.size(), variable.where());
        value.push_back(source.value[i]);
        value.back().file = variable.file;
        value.back().line = variable.line;
    }
}
} // namespace mpm::dictionary
