#include "dictionary/dictionary.hpp"

#include "base/folders.hpp"
#include "dictionary/body.hpp"
#include "dictionary/parser.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
constexpr const char* header = "FoamFile";

/// The case folder of case/system/file and case/constant/file; another file's own folder.
std::filesystem::path caseOf(const std::filesystem::path& file)
{
    const auto folder = std::filesystem::absolute(file).lexically_normal().parent_path();
    const auto name = folder.filename();
    return name == "system" || name == "constant" ? folder.parent_path() : folder;
}
} // namespace

Dictionary::Dictionary() : body_(std::make_unique<Body>())
{
    body_->owned = std::make_unique<Node>();
    body_->node = body_->owned.get();
    body_->node->where = {"dictionary", 0};
}

Dictionary::~Dictionary() = default;
Dictionary::Dictionary(Dictionary&&) noexcept = default;
Dictionary& Dictionary::operator=(Dictionary&&) noexcept = default;

Dictionary Dictionary::readFile(const std::filesystem::path& file, const std::filesystem::path& root)
{
    Dictionary dict;
    dict.body_->root = root.empty() ? caseOf(file) : root;
    dict.body_->owned = Parser(dict.body_->root).parseFile(file);
    dict.body_->node = dict.body_->owned.get();
    return dict;
}

Dictionary Dictionary::fromText(const std::string& text, const std::string& name)
{
    Dictionary dict;
    dict.body_->owned = Parser().parseText(text, name);
    dict.body_->node = dict.body_->owned.get();
    return dict;
}

Location Dictionary::where() const
{
    return body_->node->where;
}

Location Dictionary::where(const std::string& word) const
{
    const NodeEntry* entry = body_->node->find(word);
    return entry ? entry->where : where();
}

void Dictionary::Body::remember(Asked question)
{
    const auto [place, isNew] = askedAt.emplace(question.word, asked.size());
    if (isNew)
        asked.push_back(std::move(question));
    else if (asked[place->second].type.empty()) // known by found() only
        asked[place->second] = std::move(question);
}

std::vector<std::string> Dictionary::Body::knownWords() const
{
    std::vector<std::string> out;
    for (const Asked& question : asked)
        out.push_back(question.word);
    return out;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates)
{
    const std::string nearest = nearestWord(word, candidates);
    return nearest.empty() || nearest == word ? "" : fmt::format("; did you mean '{}'?", nearest);
}

Dictionary& Dictionary::Body::open(NodeEntry& entry)
{
    entry.read = true;
    auto& place = opened[entry.word];
    if (!place)
    {
        place = std::make_unique<Dictionary>();
        place->body_->owned.reset();
        place->body_->node = entry.dict.get();
        place->body_->root = root;
    }
    return *place;
}

bool Dictionary::found(const std::string& word) const
{
    body_->remember({word, "", "", "", "", ""});
    return body_->node->find(word) != nullptr;
}

const Dictionary* Dictionary::findDict(const std::string& word, const std::string& help) const
{
    body_->remember({word, "dictionary", help, "", "", ""});
    NodeEntry* entry = body_->node->find(word);
    if (!entry)
        return nullptr;
    if (!entry->dict)
        fail(word, "a value", fmt::format("a dictionary: {} {{ ... }}", word));
    return &body_->open(*entry);
}

const Dictionary& Dictionary::subDict(const std::string& word, const std::string& help) const
{
    if (const Dictionary* dict = findDict(word, help))
        return *dict;
    fail(word, "nothing", fmt::format("a dictionary: {} {{ ... }}", word) + (help.empty() ? "" : ", " + help));
}

std::vector<std::string> Dictionary::dictNames() const
{
    std::vector<std::string> out;
    for (const NodeEntry& entry : body_->node->entries)
        if (entry.dict && entry.word != header)
            out.push_back(entry.word);
    return out;
}

std::vector<std::string> Dictionary::words() const
{
    std::vector<std::string> out;
    for (const NodeEntry& entry : body_->node->entries)
        if (!entry.dict)
            out.push_back(entry.word);
    return out;
}

void Dictionary::set(const std::string& word, const std::string& value, const std::string& where)
{
    Node* node = body_->node;
    std::string last = word;
    for (std::size_t dot; (dot = last.find('.')) != std::string::npos; last = last.substr(dot + 1))
    {
        NodeEntry* outer = node->find(last.substr(0, dot));
        if (!outer || !outer->dict)
            throw InputError({where, 0}, fmt::format("{}: found no dictionary {}{}", shownText(word),
                                                     shownText(last.substr(0, dot)),
                                                     didYouMean(last.substr(0, dot), node->words())));
        node = outer->dict.get();
    }
    NodeEntry entry;
    entry.word = last;
    entry.where = {where, 0};
    entry.value = Parser(body_->root).parseValue(*node, last, value, where);
    NodeEntry* old = node->find(last);
    if (old && old->dict)
        throw InputError({where, 0}, fmt::format("{}: found a value, but {} makes it a dictionary", node->pathOf(last),
                                                 old->where.text()));
    if (old)
        *old = std::move(entry);
    else
        node->add(std::move(entry));
}

void Dictionary::drop(const std::string& word)
{
    Node& node = *body_->node;
    const auto found = node.index.find(word);
    if (found == node.index.end())
        return;
    node.entries.erase(node.entries.begin() + std::ptrdiff_t(found->second));
    node.index.clear();
    for (std::size_t i = 0; i < node.entries.size(); ++i)
        node.index.emplace(node.entries[i].word, i);
}

void Dictionary::checkDimensions(const Dimensions& expected, const std::string& word) const
{
    const Dimensions given = get<Dimensions>({word, "exponents of kg m s K mol A cd", unit::none, {}, expected});
    if (given != expected)
        fail(word, exponentsText(given), fmt::format("{} ({})", exponentsText(expected), unitText(expected)));
}

std::string Dictionary::text() const
{
    return dictionaryText(*body_->node);
}

void Dictionary::fail(const std::string& word, const std::string& found, const std::string& allowed) const
{
    throw InputError(where(word), fmt::format("{}: found {}, allowed {}", body_->node->pathOf(word), found, allowed));
}

std::vector<Asked> Dictionary::schema() const
{
    std::vector<Asked> out = body_->asked;
    for (const auto& [name, dict] : body_->opened)
        for (Asked inner : dict->schema())
        {
            inner.word = name + "." + inner.word;
            out.push_back(std::move(inner));
        }
    return out;
}

void Dictionary::rejectUnread() const
{
    const auto known = body_->knownWords();
    const std::vector<std::string> shown(known.begin(),
                                         known.begin() + std::min<std::ptrdiff_t>(40, std::ssize(known)));
    for (const NodeEntry& entry : body_->node->entries)
    {
        if (entry.word == header || (entry.expanded && !entry.read))
            continue;
        const auto opened = body_->opened.find(entry.word);
        if (entry.dict && opened != body_->opened.end())
            opened->second->rejectUnread();
        else if (!entry.read)
        {
            const bool isKnown = body_->askedAt.count(entry.word) > 0;
            fail(entry.word, isKnown ? "a word that has no effect here" : "an unknown word",
                 known.empty() ? "no words here"
                               : joinWords(shown, known.size() > shown.size() ? ", " : " or ") +
                                     (known.size() > shown.size() ? " ..." : "") + didYouMean(entry.word, known));
        }
    }
}

bool Dictionary::holdsDict(const std::string& word) const
{
    body_->remember({word, "", "", "", "", ""});
    const NodeEntry* entry = body_->node->find(word);
    return entry && entry->dict;
}

std::filesystem::path Dictionary::file(const std::string& word, const std::string& help) const
{
    const auto name = get<std::string>({word, help});
    const auto path = (body_->root.empty() ? std::filesystem::path(name) : body_->root / name).lexically_normal();
    if (!body_->root.empty() && !isWithinReach(realPath(path), body_->root))
        fail(word, "'" + name + "', which lies outside the case folder", "a file of the case, as \"constant/file\"");
    if (!std::filesystem::is_regular_file(path))
        fail(word, "'" + name + "', no such file", "a file of the case, as \"constant/file\"");
    const auto here = path.lexically_relative(std::filesystem::current_path()); // as dictionaries are named in messages
    return here.empty() || *here.begin() == ".." ? path : here;
}

void Dictionary::passOver(const std::string& word, const std::string& help) const
{
    body_->remember({word, "", help, "", "", ""});
    if (NodeEntry* entry = body_->node->find(word))
        entry->read = true;
}

std::string dictionaryText(const Node& node, int indent)
{
    const std::string blanks(std::size_t(indent), ' ');
    std::string out;
    for (const NodeEntry& entry : node.entries)
    {
        if (entry.dict)
        {
            out +=
                fmt::format("{0}{1}\n{0}{{\n{2}{0}}}\n", blanks, entry.word, dictionaryText(*entry.dict, indent + 4));
            continue;
        }
        out += fmt::format("{}{:<15}", blanks, entry.word);
        const Token* before = nullptr;
        for (const Token& token : entry.value)
        {
            if (!before || !(before->is('(') || before->is('[') || token.is(')') || token.is(']')))
                out += ' ';
            out += token.source();
            before = &token;
        }
        out += ";\n";
    }
    return out;
}
} // namespace mpm::dictionary
