#pragma once
/// Internal to dictionary/: the words, numbers, texts and brackets of OpenFOAM's syntax, one at a time.
///
/// A word runs until blank, quote, '/', ';', '{', '}' or an unmatched ')' or ']', so `div(phi,U)` is one word. A token
/// that starts like a number must be a number as a whole. Comments are skipped. Errors (InputError at the line where
/// the thing begins): comment or text without end, bytes that are not text, a word with unmatched brackets, over-long
/// words.
#include "base/error.hpp"

#include <memory>
#include <string>

namespace mpm::dictionary
{
enum class Kind
{
    word,
    number,      ///< shaped like a number, kept as text; convert.cpp makes the value
    text,        ///< quoted; `text` is what stands between the quotes, escapes resolved
    variable,    ///< `$name` or `${name}`; `text` is the name
    directive,   ///< `#name`; `text` is the name
    punctuation, ///< one of ( ) [ ] { } ;
    end          ///< the file is over
};

struct Token
{
    Kind kind = Kind::end;
    std::string text;
    std::shared_ptr<const std::string> file;
    int line = 0;

    bool is(char c) const { return kind == Kind::punctuation && text[0] == c; }
    Location where() const { return {file ? *file : std::string(), line}; }
    std::string shown() const;  ///< for messages: 'mu', "a text", end of file
    std::string source() const; ///< as it would stand in a dictionary
};

/// Text of a user made fit for a message: in quotes, control bytes as \xNN, cut after 60 characters.
std::string shownText(const std::string& text);

class Tokenizer
{
  public:
    Tokenizer(std::string text, std::string file);
    Token next();
    Location where() const { return {*file_, line_}; }

  private:
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool over() const { return at_ >= text_.size(); }
    void skipBlanks();
    void skipBlockComment();
    Token make(Kind kind, std::string text, int line) const;
    Token quoted();
    Token numberOrSign();
    Token variable();
    std::string takeWord();
    [[noreturn]] void fail(int line, const std::string& what) const;
    [[noreturn]] void refuseCharacter(char c) const;

    std::string text_;
    std::shared_ptr<const std::string> file_;
    std::size_t at_ = 0;
    int line_ = 1;
};
} // namespace mpm::dictionary
