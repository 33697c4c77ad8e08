#include "dictionary/parser.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
struct OpenBracket
{
    char close;
    Location where;
};

/// "a:1" beside "a:9" is "line 1"; elsewhere the file is named.
std::string seenFrom(const Location& place, const Location& from)
{
    return place.file == from.file ? fmt::format("line {}", place.line) : place.text();
}
} // namespace

std::unique_ptr<Node> Parser::parseText(std::string text, const std::string& name)
{
    if (text.size() > Limits::fileBytes)
        throw InputError({name, 0}, fmt::format("found {} bytes, allowed {}", text.size(), Limits::fileBytes));
    auto top = std::make_unique<Node>();
    top->where = {name, 0};
    Tokenizer in(std::move(text), name);
    parseBlock(*top, in, nullptr);
    return top;
}

std::vector<Token> Parser::parseValue(Node& node, const std::string& word, const std::string& text,
                                      const std::string& name)
{
    Tokenizer in(text + "\n;", name); // a comment at the end of the text hides no ';'
    Token key;
    key.kind = Kind::word;
    key.text = word;
    key.file = std::make_shared<const std::string>(name);
    Token first = in.next();
    auto value = readValue(node, in, key, std::move(first));
    if (const Token more = in.next(); more.kind != Kind::end)
        throw InputError(
            {name, 0}, fmt::format("{}: found {} after the value, allowed one value", node.pathOf(word), more.shown()));
    for (Token& token : value)
        token.line = 0;
    return value;
}

void Parser::charge(std::size_t bytes, const Location& where)
{
    bytes_ += bytes;
    if (bytes_ > Limits::treeBytes)
        throw InputError(where, fmt::format("found a dictionary that grows beyond {} MB when its macros are expanded",
                                            Limits::treeBytes >> 20));
}

int Parser::depthOf(const Node& node) const
{
    int depth = 0;
    for (const Node* up = node.parent; up; up = up->parent)
        ++depth;
    return depth;
}

/// Entries until the closing brace, or until the end of the file when `brace` is null.
void Parser::parseBlock(Node& node, Tokenizer& in, const Token* brace)
{
    for (;;)
    {
        const Token token = in.next();
        if (token.kind == Kind::end)
        {
            if (brace)
                throw InputError(brace->where(), fmt::format("{}: found '{{' without its '}}'", node.path));
            return;
        }
        if (token.is('}') && brace)
            return;
        if (token.is(';'))
            continue;
        if (token.kind == Kind::directive)
            parseDirective(node, in, token);
        else if (token.kind == Kind::variable)
        {
            const Token after = in.next();
            if (!after.is(';'))
                throw InputError(token.where(), fmt::format("found {} followed by {}, allowed '{};' (a macro cannot be "
                                                            "the word of an entry)",
                                                            token.shown(), after.shown(), token.source()));
            merge(node, token);
        }
        else
            parseEntry(node, in, token);
    }
}

void Parser::parseEntry(Node& node, Tokenizer& in, const Token& key)
{
    if (key.kind == Kind::text)
        throw InputError(key.where(), fmt::format("found {}, allowed a plain word (regular expressions as words are "
                                                  "not read here: write each word out)",
                                                  key.shown()));
    if (key.is('}'))
        throw InputError(key.where(), "found '}' without its '{'");
    if (key.kind != Kind::word)
        throw InputError(key.where(), fmt::format("found {}, allowed a word that begins an entry (is a ';' one too "
                                                  "many, or a word missing?)",
                                                  key.shown()));
    Token first = in.next();
    if (first.is('{'))
        parseDictionary(node, in, key, first);
    else
        parsePlain(node, in, key, std::move(first));
}

std::unique_ptr<Node> Parser::newNode(Node& parent, const std::string& word, const Location& where) const
{
    if (depthOf(parent) + 1 > Limits::nesting)
        throw InputError(where, fmt::format("found dictionaries nested deeper than {}", Limits::nesting));
    auto node = std::make_unique<Node>();
    node->parent = &parent;
    node->path = parent.pathOf(word);
    node->where = where;
    return node;
}

void Parser::parseDictionary(Node& node, Tokenizer& in, const Token& key, const Token& brace)
{
    if (key.text == "FoamFile" && node.find("FoamFile"))
    {
        Node header; // of an included file: read for its syntax only
        header.path = "FoamFile";
        header.parent = &node;
        return parseBlock(header, in, &brace);
    }
    NodeEntry entry;
    entry.word = key.text;
    entry.where = key.where();
    entry.layer = layer_;
    entry.dict = newNode(node, key.text, key.where());
    place(node, std::move(entry), key.where());
    Node& dict = *node.find(key.text)->dict;
    dict.beingRead = true;
    parseBlock(dict, in, &brace);
    dict.beingRead = false;
    if (NodeEntry* format = key.text == "FoamFile" ? dict.find("format") : nullptr)
        if (format->value.size() != 1 || format->value[0].text != "ascii")
            throw InputError(format->where, fmt::format("FoamFile.format: found {}, allowed ascii",
                                                        format->value.empty() ? "nothing" : format->value[0].shown()));
}

void Parser::parsePlain(Node& node, Tokenizer& in, const Token& key, Token first)
{
    NodeEntry entry;
    entry.word = key.text;
    entry.where = key.where();
    entry.layer = layer_;
    if (first.kind == Kind::variable) // `word $dict;` copies a dictionary
        if (NodeEntry* source = lookUp(node, first.text); source && source->dict)
        {
            expand(node, first);
            if (const Token after = in.next(); !after.is(';'))
                throw InputError(key.where(), fmt::format("{}: found {} after the dictionary {}, allowed ';'",
                                                          node.pathOf(key.text), after.shown(), first.source()));
            entry.dict = newNode(node, key.text, key.where());
            copyInto(*source->dict, *entry.dict, layer_ + 1, key.where());
            return place(node, std::move(entry), key.where());
        }
    entry.value = readValue(node, in, key, std::move(first));
    place(node, std::move(entry), key.where());
}

namespace
{
/// The value of `path` did not end before `token`; it ends in the line `last`, unless its last word begins a
/// dictionary.
[[noreturn]] void failMissingEnd(const std::string& path, Location last, const std::vector<Token>& value,
                                 const Token& token)
{
    const Token* found = &token;
    if (const std::size_t n = value.size();
        token.is('{') && n > 1 && value[n - 1].kind == Kind::word && value[n - 1].line > value[n - 2].line)
    {
        found = &value[n - 1];
        last.line = value[n - 2].line;
    }
    throw InputError(last, fmt::format("{}: missing ';' at the end of this line (found {}{})", path, found->shown(),
                                       found->line == last.line ? "" : fmt::format(" in line {}", found->line)));
}
} // namespace

/// The tokens up to ';', beginning with `token`, macros and includes put in place.
std::vector<Token> Parser::readValue(Node& node, Tokenizer& in, const Token& key, Token token)
{
    const std::string path = node.pathOf(key.text);
    std::vector<Token> value;
    std::vector<OpenBracket> open;
    int line = key.line;
    for (;; token = in.next())
    {
        const bool ends = token.kind == Kind::end || token.is('{') || token.is('}');
        if (!open.empty() && (ends || token.is(';')))
            throw InputError(open.back().where, fmt::format("{}: found '{}' without its '{}'{}", path,
                                                            open.back().close == ')' ? '(' : '[', open.back().close,
                                                            token.is('{') ? " (dictionaries inside a list are not "
                                                                            "read here)"
                                                                          : ""));
        if (ends)
            failMissingEnd(path, {*key.file, line}, value, token);
        if (token.is(';'))
            return value;
        line = token.line;
        charge(sizeof(Token) + token.text.size(), token.where());
        if (token.kind == Kind::variable)
        {
            appendVariable(node, key, token, value);
            continue;
        }
        if (token.kind == Kind::directive)
            throw InputError(token.where(), fmt::format("{}: found {}, allowed a value ({})", path, token.shown(),
                                                        directiveAnswer(token.text)));
        if (token.is('(') || token.is('['))
        {
            open.push_back({token.is('(') ? ')' : ']', token.where()});
            if (open.size() > Limits::nesting)
                throw InputError(token.where(),
                                 fmt::format("{}: found lists nested deeper than {}", path, Limits::nesting));
        }
        else if (token.is(')') || token.is(']'))
        {
            if (open.empty() || !token.is(open.back().close))
                throw InputError(token.where(), fmt::format("{}: found {} without its '{}'", path, token.shown(),
                                                            token.is(')') ? '(' : '['));
            open.pop_back();
        }
        value.push_back(std::move(token));
    }
}

/// Puts an entry into its dictionary; `where` is where the text says so.
void Parser::place(Node& node, NodeEntry entry, const Location& where)
{
    charge(sizeof(NodeEntry) + sizeof(Node) + 4 * entry.word.size() + node.path.size(), where);
    if (entry.dict)
        entry.dict->parent = &node; // a copy was made elsewhere
    NodeEntry* old = node.find(entry.word);
    if (!old)
    {
        node.add(std::move(entry));
        return;
    }
    const std::string path = node.pathOf(entry.word);
    const std::string before = seenFrom(old->where, where);
    if (old->layer <= entry.layer)
        throw InputError(where, fmt::format("{}: found a second time, first in {}{}", path, before,
                                            entry.layer > 0 ? " (what is included or merged comes first, what replaces "
                                                              "its words afterwards)"
                                                            : ""));
    if (!old->dict != !entry.dict)
        throw InputError(where,
                         fmt::format("{}: found {}, but {} makes it {}", path, entry.dict ? "a dictionary" : "a value",
                                     before, old->dict ? "a dictionary" : "a value"));
    old->where = where;
    old->layer = entry.layer;
    if (!entry.dict)
    {
        old->value = std::move(entry.value);
        return;
    }
    old->dict->where = where;
    for (NodeEntry& inner : entry.dict->entries) // filled already when it is the copy of another dictionary
        place(*old->dict, std::move(inner), where);
}
} // namespace mpm::dictionary
