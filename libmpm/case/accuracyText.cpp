#include "case/accuracyText.hpp"

namespace mpm::cases
{
namespace
{
/// Where an entry stands: its word, its value (braces included), the end behind ';' or '}'.
struct Span
{
    std::size_t word = 0, value = 0, valueEnd = 0, end = 0;
};

class Scanner
{
  public:
    explicit Scanner(const std::string& text) : text_(text) {}

    std::optional<Span> find(const std::string& wanted)
    {
        for (at_ = 0; skipBlanks(), at_ < text_.size();)
        {
            const Span entry = next();
            if (text_.compare(entry.word, wordLength(entry.word), wanted) == 0)
                return entry;
        }
        return std::nullopt;
    }

  private:
    bool at(const char* what) const { return text_.compare(at_, std::string(what).size(), what) == 0; }

    void skipLine() { at_ = std::min(text_.find('\n', at_), text_.size()); }

    /// A comment or a text in quotes that begins here; false if none does.
    bool skipOpaque()
    {
        if (at("//"))
            return skipLine(), true;
        if (at("/*"))
            return at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2, true;
        if (!at("\""))
            return false;
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
            at_ += text_[at_] == '\\';
        ++at_;
        return true;
    }

    void skipBlanks()
    {
        while (at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) || at("//") || at("/*")))
            if (!skipOpaque())
                ++at_;
    }

    std::size_t wordLength(std::size_t begin) const { return text_.find_first_of(" \t\r\n;{", begin) - begin; }

    /// The statement that begins here; leaves at_ behind it.
    Span next()
    {
        Span s;
        s.word = at_;
        if (text_[at_] == '#') // a directive takes its line
        {
            skipLine();
            s.value = s.valueEnd = s.end = at_;
            return s;
        }
        at_ += std::min(wordLength(at_), text_.size() - at_);
        skipBlanks();
        s.value = at_;
        int depth = 0;
        const bool isDict = at("{");
        while (at_ < text_.size())
        {
            if (skipOpaque())
                continue;
            const char c = text_[at_];
            depth += c == '{' || c == '(' || c == '[';
            depth -= c == '}' || c == ')' || c == ']';
            if (depth == 0 && (isDict ? c == '}' : c == ';'))
                break;
            ++at_;
        }
        s.end = std::min(at_ + 1, text_.size());
        s.valueEnd = isDict ? s.end : std::min(at_, text_.size());
        at_ = s.end;
        return s;
    }

    const std::string& text_;
    std::size_t at_ = 0;
};
} // namespace

std::string replaceEntry(const std::string& text, const std::string& word, const std::string& value)
{
    const auto found = Scanner(text).find(word);
    if (!found)
        return text + (text.empty() || text.back() == '\n' ? "" : "\n") + word + " " + value + ";\n";
    const bool isDict = text[found->value] == '{';
    return text.substr(0, found->value) + value + (isDict ? ";" : "") + text.substr(found->valueEnd);
}

std::string removeEntry(const std::string& text, const std::string& word)
{
    const auto found = Scanner(text).find(word);
    if (!found)
        return text;
    std::size_t begin = found->word, end = found->end;
    const std::size_t before = text.find_last_not_of(" \t", begin - (begin > 0));
    const bool first = begin == 0 || before == std::string::npos || text[before] == '\n';
    const std::size_t after = text.find_first_not_of(" \t", end);
    if (first && (after == std::string::npos || text[after] == '\n'))
    {
        begin = begin == 0 || before == std::string::npos ? 0 : before + 1;
        end = after == std::string::npos ? text.size() : after + 1;
    }
    return text.substr(0, begin) + text.substr(end);
}

std::optional<std::string> entryText(const std::string& text, const std::string& word)
{
    const auto found = Scanner(text).find(word);
    if (!found)
        return std::nullopt;
    return text.substr(found->value, found->valueEnd - found->value);
}
} // namespace mpm::cases
