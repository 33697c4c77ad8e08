#include "dictionary/token.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
constexpr std::size_t longestWord = 1000;

bool isBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}
bool isControl(char c)
{
    return (static_cast<unsigned char>(c) < 32 && !isBlank(c)) || c == 127;
}

/// Characters that end a word in any case; brackets end it only when they are not matched inside the word.
bool endsWord(char c)
{
    return isBlank(c) || c == '"' || c == '\'' || c == '/' || c == ';' || c == '{' || c == '}' || isControl(c);
}

/// [-](digits[.digits] | .digits)[(e|E)[+-]digits]
bool hasNumberShape(const std::string& s)
{
    std::size_t i = 0, digits = 0;
    const auto run = [&] {
        std::size_t n = 0;
        for (; i < s.size() && isDigit(s[i]); ++i)
            ++n;
        return n;
    };
    if (i < s.size() && s[i] == '-')
        ++i;
    digits += run();
    if (i < s.size() && s[i] == '.')
    {
        ++i;
        digits += run();
    }
    if (digits == 0)
        return false;
    if (i < s.size() && (s[i] == 'e' || s[i] == 'E'))
    {
        ++i;
        if (i < s.size() && (s[i] == '+' || s[i] == '-'))
            ++i;
        if (run() == 0)
            return false;
    }
    return i == s.size();
}
} // namespace

std::string shownText(const std::string& text)
{
    std::string out = "'";
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        if (i >= 60 && (text[i] & 0xC0) != 0x80) // not within a UTF-8 character
            return out + "...'";
        const auto c = static_cast<unsigned char>(text[i]);
        if (c < 32 || c == 127)
            out += fmt::format("\\x{:02x}", c);
        else
            out += text[i];
    }
    return out + "'";
}

std::string Token::shown() const
{
    return kind == Kind::end ? "the end of the file" : shownText(source());
}

std::string Token::source() const
{
    switch (kind)
    {
    case Kind::variable:
        return "$" + text;
    case Kind::directive:
        return "#" + text;
    case Kind::text: {
        std::string out = "\"";
        for (const char c : text)
            out += c == '"' ? std::string("\\\"") : std::string(1, c);
        return out + "\"";
    }
    default:
        return text;
    }
}

Tokenizer::Tokenizer(std::string text, std::string file)
    : text_(std::move(text)), file_(std::make_shared<const std::string>(std::move(file)))
{}

void Tokenizer::fail(int line, const std::string& what) const
{
    throw InputError({*file_, line}, what);
}

Token Tokenizer::make(Kind kind, std::string text, int line) const
{
    return {kind, std::move(text), file_, line};
}

void Tokenizer::skipBlockComment()
{
    const int begin = line_;
    for (at_ += 2; !(peek() == '*' && peek(1) == '/'); ++at_)
    {
        if (over())
            fail(begin, "found a comment '/*' without its '*/'");
        line_ += peek() == '\n';
    }
    at_ += 2;
}

void Tokenizer::skipBlanks()
{
    for (; !over();)
    {
        if (isBlank(peek()))
        {
            line_ += peek() == '\n';
            ++at_;
        }
        else if (peek() == '/' && peek(1) == '/')
            while (!over() && peek() != '\n')
                ++at_;
        else if (peek() == '/' && peek(1) == '*')
            skipBlockComment();
        else
            return;
    }
}

Token Tokenizer::next()
{
    skipBlanks();
    if (over())
        return make(Kind::end, "", line_);
    if (text_.compare(at_, 3, "\xEF\xBB\xBF") == 0)
        fail(line_, "found a byte order mark, allowed plain text without one");
    const char c = peek();
    switch (c)
    {
    case '(':
    case ')':
    case '[':
    case ']':
    case '{':
    case '}':
    case ';':
        ++at_;
        return make(Kind::punctuation, std::string(1, c), line_);
    case '"':
        return quoted();
    case '$':
        return variable();
    case '#':
        ++at_;
        return make(Kind::directive, takeWord(), line_);
    default:
        break;
    }
    if (isDigit(c) || c == '-' || c == '+' || c == '.')
        return numberOrSign();
    if (endsWord(c) || c == ',' || c == '=' || c == ':' || c == '*')
        refuseCharacter(c);
    return make(Kind::word, takeWord(), line_);
}

void Tokenizer::refuseCharacter(char c) const
{
    if (isControl(c))
        fail(line_, fmt::format("found the byte 0x{:02x}, allowed only text", static_cast<unsigned char>(c)));
    const std::size_t bracket = text_.find_last_of("[]\n", at_);
    const bool inDimensions = bracket != std::string::npos && text_[bracket] == '[';
    const std::string hint = inDimensions ? "dimensions are 5 or 7 exponents [kg m s K mol A cd]"
                             : c == '='   ? "a word and its value are separated by a blank: 'word value;'"
                             : c == ','   ? "numbers and words of a list are separated by blanks"
                             : c == '/'   ? "a path stands in quotes, and nothing is calculated here"
                             : c == '*'   ? "nothing is calculated here, write the number"
                             : c == '\''  ? "a text stands in double quotes"
                                          : "a word begins with a letter or '_'";
    fail(line_, fmt::format("found '{}'; {}", c, hint));
}

Token Tokenizer::quoted()
{
    const int begin = line_;
    std::string out;
    for (++at_; peek() != '"' || over(); ++at_)
    {
        if (over() || peek() == '\n')
            fail(begin, "found a text without its closing '\"' on the same line");
        if (isControl(peek()))
            refuseCharacter(peek());
        if (peek() == '\\' && peek(1) == '"')
            ++at_;
        else if (peek() == '\\' && peek(1) == '\\') // kept as two, as OpenFOAM does
            out += text_[at_++];
        out += peek();
    }
    ++at_;
    return make(Kind::text, std::move(out), begin);
}

std::string Tokenizer::takeWord()
{
    const std::size_t begin = at_;
    std::string open;
    for (; !over() && !endsWord(peek()); ++at_)
    {
        const char c = peek();
        if (c == '(' || c == '[')
            open += c == '(' ? ')' : ']';
        else if (c == ')' || c == ']')
        {
            if (open.empty())
                break;
            if (open.back() != c)
                fail(line_, fmt::format("found {}, where '{}' is not closed by '{}'",
                                        shownText(text_.substr(begin, at_ + 1 - begin)), open.back() == ')' ? '(' : '[',
                                        open.back()));
            open.pop_back();
        }
    }
    const std::string word = text_.substr(begin, at_ - begin);
    if (word.size() > longestWord)
        fail(line_, fmt::format("found a word of {} characters, allowed {}", word.size(), longestWord));
    if (!open.empty())
        fail(line_, fmt::format("found {}, where a bracket is not closed; a list is separated from its word by a blank",
                                shownText(word)));
    return word;
}

Token Tokenizer::numberOrSign()
{
    const std::size_t begin = at_;
    while (!over() && !endsWord(peek()) && peek() != '(' && peek() != ')' && peek() != '[' && peek() != ']')
        ++at_;
    std::string word = text_.substr(begin, at_ - begin);
    if (!hasNumberShape(word))
    {
        const char* hint =
            word.find(',') != std::string::npos
                ? "numbers have a decimal point and are separated by blanks"
                : "SI units, none written; a text that begins with a digit, sign or point stands in quotes";
        fail(line_, fmt::format("found {}, allowed a number like -1.5e3 ({})", shownText(word), hint));
    }
    return make(Kind::number, std::move(word), line_);
}

Token Tokenizer::variable()
{
    const int line = line_;
    const auto slash = [this] { return peek() == '/' && peek(1) != '/' && peek(1) != '*'; };
    ++at_;
    std::string name;
    if (peek() == '{')
    {
        const std::size_t close = text_.find_first_of("}\n;", at_);
        if (close == std::string::npos || text_[close] != '}')
            fail(line, "found '${' without its '}'");
        name = text_.substr(at_ + 1, close - at_ - 1);
        at_ = close + 1;
        if (name.find(":-") != std::string::npos || name.find_first_of("{$ \t\"") != std::string::npos)
            fail(line, fmt::format("found {}, allowed a plain name: ${{word}}", shownText("${" + name + "}")));
    }
    else
    {
        if (slash())
            fail(line, "found '$/'; the top of the file is written $:word, the dictionary around $..word");
        while (!over() && !endsWord(peek()) && std::string("()[]$,").find(peek()) == std::string::npos)
            name += text_[at_++];
        if (slash())
            fail(line, fmt::format("found {}; the scopes of a macro are separated by points: $sub.word",
                                   shownText("$" + name + "/")));
    }
    if (name.empty())
        fail(line, "found '$' without a name");
    if (name.size() > longestWord)
        fail(line, fmt::format("found a macro of {} characters, allowed {}", name.size(), longestWord));
    return make(Kind::variable, std::move(name), line);
}
} // namespace mpm::dictionary
