#pragma once
/// Dictionaries in OpenFOAM's syntax, read once, asked by typed entries, every mistake reported with file:line.
///
///     // materialProperties
///     stiffness       20e6;
///     soil
///     {
///         law             mohrCoulomb;
///         E               [1 -1 -2 0 0 0 0] $stiffness;  // dimensions are optional and checked when given
///         frictionAngle   42;
///         initialVelocity (0 0 0);                       // or: uniform (0 0 0)
///         layers          3(0 2 4.5);                    // the count before a list is optional and checked
///         title           "soft soil";
///     }
///     clay { $soil; E 5e6; }                             // everything of soil, E replaced
///     copy $soil;                                        // a dictionary of its own
///     #include "../constant/other"                       // also <case>/ <system>/ <constant>/ <etc>/, #includeEtc
///
/// Macros find their words as in OpenFOAM 1912: `$E` here, then in the dictionaries around; `$sub.E` in sub of this
/// dictionary only; `$..E` one dictionary up, `$...E` two; `$:soil.E` from the top; `${E}` the same as `$E`. A word
/// must stand before the macro that uses it, and a dictionary has no name before its closing brace. The environment is
/// not looked into.
///
/// Stricter than OpenFOAM: a word given twice is an error (except the FoamFile header), unless it first came through
/// `$dict;` or #include and is then replaced by what stands in the dictionary itself, nested dictionaries being merged;
/// so is a missing ';'. Refused by name: regular expressions as words, #calc, #codeStream, #if and every other
/// directive, dictionaries inside lists, unit names in dimensions, numbers that are not finite in double precision.
///
/// A word nobody reads is an error: rejectUnread() after everything was asked. It knows the allowed words because every
/// question (get, choose, subDict, found) leaves its word in the dictionary's schema. A word only macros use counts as
/// read.
///
/// Text nobody vouches for does no harm: files up to 4 MB, 64 MB for the tree with its macros expanded, nesting up to
/// 100, includes up to 10 deep and 200 in all, and only from the case folder and the project's etc, symbolic links
/// followed. tests/unit/dictionaryMistakes.txt lists what is refused and the messages, word for word.
#include "base/error.hpp"
#include "base/types.hpp"

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm::dictionary
{
/// Exponents of [kg m s K mol A cd].
using Dimensions = std::array<double, 7>;

namespace unit
{
inline constexpr Dimensions none{};
inline constexpr Dimensions length{0, 1, 0};
inline constexpr Dimensions time{0, 0, 1};
inline constexpr Dimensions rate{0, 0, -1};
inline constexpr Dimensions velocity{0, 1, -1};
inline constexpr Dimensions acceleration{0, 1, -2};
inline constexpr Dimensions density{1, -3, 0};
inline constexpr Dimensions pressure{1, -1, -2};
} // namespace unit

/// A number or the text of a formula, as it was written (dictionary/expression.hpp).
struct FormulaText
{
    std::string text;
    Location where;
};

/// One row of a table: (t value), (t x y z) or (t (x y z)).
struct TableRow
{
    double at = 0;
    std::vector<double> values;
    Location where;
};

/// A word, or a list of words that stand for one thing.
struct WordGroup
{
    std::vector<std::string> words;
};

/// (disc plane 0.2): a number between two.
struct WordPair
{
    std::string one, other;
    double value = 0;
};

/// Interval of allowed values; an open end excludes its value.
struct Bound
{
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool lowOpen = false;
    bool highOpen = false;

    bool contains(double value) const;
    std::string text() const; ///< "> 0", ">= 0", "in [0, 0.5)"

    static Bound any() { return {}; }
    static Bound positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }
    static Bound nonNegative() { return {0, std::numeric_limits<double>::infinity(), false, false}; }
    static Bound atLeast(double low) { return {low, std::numeric_limits<double>::infinity(), false, false}; }
    static Bound between(double low, double high) { return {low, high, false, false}; } ///< closed
    static Bound open(double low, double high) { return {low, high, true, true}; }
    static Bound rightOpen(double low, double high) { return {low, high, false, true}; }
};

/// What is asked of a dictionary: the word, what it means, its unit, its bound (of every component), its default.
/// Without a default the entry is required.
template <class T>
struct Entry
{
    std::string word;
    std::string help;
    Dimensions dimensions = unit::none;
    Bound bound = {};
    std::optional<T> fallback = std::nullopt;
};

/// One name of a catalogue (laws, shapes, wall types ...) and what it is, for messages and -help.
struct Choice
{
    std::string name;
    std::string help;
};

/// A question that was asked, kept for -help and for the list of allowed words.
struct Asked
{
    std::string word, type, help, unitText, boundText, defaultText;
};

class Dictionary
{
  public:
    /// Reads a file. #include may reach files below `root` (default: the case folder of a file in system or constant,
    /// else the file's own folder) and below the project's etc folder, nothing else.
    /// Throws InputError: unreadable file, missing ';', unbalanced braces, unknown directive or macro, word given
    /// twice.
    static Dictionary readFile(const std::filesystem::path& file, const std::filesystem::path& root = {});
    /// Reads text; `name` stands for the file in messages.
    static Dictionary fromText(const std::string& text, const std::string& name = "text");

    Dictionary();
    ~Dictionary();
    Dictionary(Dictionary&&) noexcept;
    Dictionary& operator=(Dictionary&&) noexcept;

    /// Where the dictionary (or one of its entries) stands.
    Location where() const;
    Location where(const std::string& word) const;

    /// The value, converted, checked against dimensions and bound. T: double, Index (an integer), bool (on/off,
    /// yes/no, true/false), std::string (a word or a quoted text), Dimensions, Vector3 (three numbers),
    /// std::vector<double>, std::vector<std::string>, std::vector<Vector3>, FormulaText, std::vector<FormulaText>,
    /// std::vector<TableRow> (the word `table` may stand before it), std::vector<WordGroup>, std::vector<WordPair>.
    template <class T>
    T get(const Entry<T>& entry) const;

    /// Does the entry hold a table: `table ( ... )` or `((0 ...`? Asking makes the word known (not read).
    bool holdsTable(const std::string& word) const;
    /// Is the entry a nested dictionary? Asking makes the word known (not read).
    bool holdsDict(const std::string& word) const;

    /// The file an entry names, relative to the case folder; InputError if there is none, or if it lies outside what
    /// #include may reach.
    std::filesystem::path file(const std::string& word, const std::string& help) const;

    /// A name out of a catalogue; an unknown one is an error with the list and the nearest name.
    std::string choose(const std::string& word, const std::string& help, const std::vector<Choice>& catalogue,
                       const std::optional<std::string>& fallback = std::nullopt) const;

    /// The entry `dimensions [0 1 -2 0 0 0 0];` of constant/g and its like: an error if it is there and says otherwise.
    void checkDimensions(const Dimensions& expected, const std::string& word = "dimensions") const;

    /// Is the entry or dictionary there? Asking makes the word known (not read).
    bool found(const std::string& word) const;

    /// A nested dictionary; an error if it is not there. The reference lives as long as this dictionary.
    const Dictionary& subDict(const std::string& word, const std::string& help = "") const;
    /// The same, or null.
    const Dictionary* findDict(const std::string& word, const std::string& help = "") const;
    /// Names of all nested dictionaries except FoamFile, in file order (free names: materials, walls ...).
    std::vector<std::string> dictNames() const;
    /// All words of plain entries, in file order.
    std::vector<std::string> words() const;

    /// Sets or replaces an entry, as a command-line override does; `where` is what messages will name.
    void set(const std::string& word, const std::string& value, const std::string& where = "command line");

    /// Takes an entry or a nested dictionary away, if it is there.
    void drop(const std::string& word);

    /// The text of the dictionary as it was understood: macros expanded, includes merged (provenance).
    std::string text() const;

    /// Throws InputError at the first entry that nobody read, here and in all nested dictionaries that were opened;
    /// a nested dictionary nobody opened is itself unread. FoamFile headers are exempt.
    void rejectUnread() const;

    /// Leaves an entry or a nested dictionary, if it is there, to another utility that reads and checks it.
    void passOver(const std::string& word, const std::string& help) const;

    /// Throws InputError at an entry: "file:line: word: found ..., allowed ...".
    [[noreturn]] void fail(const std::string& word, const std::string& found, const std::string& allowed) const;

    /// Every question asked so far.
    std::vector<Asked> schema() const;

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};
} // namespace mpm::dictionary
