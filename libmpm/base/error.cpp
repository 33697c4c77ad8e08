#include "base/error.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace mpm
{
std::string Location::text() const
{
    return line > 0 ? fmt::format("{}:{}", file, line) : file;
}

InputError::InputError(const std::string& what) : std::runtime_error(what) {}

InputError::InputError(const Location& where, const std::string& what)
    : std::runtime_error(fmt::format("{}: {}", where.text(), what))
{}

StepError::StepError(const std::string& what) : std::runtime_error(what) {}

namespace
{
std::string lower(std::string s)
{
    std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return s;
}

std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}
} // namespace

std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates)
{
    constexpr std::size_t longestWord = 64, mostCandidates = 2000; // hostile text must not buy minutes of comparing
    std::string best;
    if (word.size() > longestWord)
        return best;
    std::size_t bestDistance = std::min(2 + word.size() / 3, word.size());
    for (std::size_t i = 0; i < std::min(candidates.size(), mostCandidates); ++i)
    {
        const std::string& candidate = candidates[i];
        if (candidate.size() > word.size() + bestDistance)
            continue;
        const std::size_t d = editDistance(lower(word), lower(candidate));
        if (d < bestDistance)
        {
            bestDistance = d;
            best = candidate;
        }
    }
    return best;
}

std::string joinWords(const std::vector<std::string>& words, const std::string& lastSeparator)
{
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? lastSeparator : ", ") + words[i];
    return out;
}
} // namespace mpm
