#include "benchmark/settings.hpp"

#include "base/error.hpp"
#include "benchmark/roofline.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mpm::benchmark
{
namespace
{
constexpr double mostParticles = 1e9;
constexpr int mostThreads = 1024;

std::vector<std::string> split(const std::string& option, const std::string& text)
{
    std::vector<std::string> words(1);
    for (const char c : text)
        if (c == ',' || c == ' ')
            words.emplace_back();
        else
            words.back() += c;
    std::erase(words, "");
    if (words.empty())
        throw InputError(
            fmt::format("-{}: found '{}', allowed one or several values, separated by commas", option, text));
    return words;
}

std::vector<std::string> readWords(const cases::Options& options, const std::string& option,
                                   const std::vector<std::string>& allowed, const std::string& fallback)
{
    const auto words = split(option, options.value(option, fallback));
    for (const auto& word : words)
        if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
        {
            const std::string near = nearestWord(word, allowed);
            throw InputError(fmt::format("-{}: found '{}', allowed {}{}", option, word, joinWords(allowed),
                                         near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
        }
    return words;
}

/// "7200", "7.2k", "1.04M".
double readCount(const std::string& option, const std::string& word, double most)
{
    const double unit = word.ends_with('k') ? 1e3 : word.ends_with('M') ? 1e6 : 1;
    const std::string digits = unit > 1 ? word.substr(0, word.size() - 1) : word;
    double count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    count = std::round(count * unit);
    if (error != std::errc() || end != digits.data() + digits.size() || !(count >= 1 && count <= most))
        throw InputError(fmt::format("-{}: found '{}', allowed a number from 1 to {:g}{}", option, word, most,
                                     most > 1e3 ? ", like 7200, 115k or 1.04M" : ""));
    return count;
}

stepping::StressUpdate updateOf(const std::string& word)
{
    return word == "USF"   ? stepping::StressUpdate::USF
           : word == "USL" ? stepping::StressUpdate::USL
                           : stepping::StressUpdate::MUSL;
}

/// Copies every row once for each value.
template <class Value, class Set>
void multiply(std::vector<Setting>& rows, const std::vector<Value>& values, const Set& set)
{
    std::vector<Setting> all;
    for (const Setting& row : rows)
        for (const Value& value : values)
        {
            all.push_back(row);
            set(all.back(), value);
        }
    rows = std::move(all);
}
} // namespace

std::vector<cases::ExtraOption> settingOptions()
{
    return {{"dimension", "LIST", "2, 3 (default: 2)"},
            {"shape", "LIST", joinWords(countedShapes(), ", ") + " (default: uGIMP)"},
            {"stressUpdate", "LIST", "USF, USL, MUSL (default: MUSL)"},
            {"law", "LIST", joinWords(countedLaws(), ", ") + " (default: mohrCoulomb)"},
            {"particles", "LIST", "how many, like 7200, 115k, 1.04M (default: 7.2k,115k; in 3D 93k)"},
            {"threads", "LIST", "numbers of threads (default: 1)"},
            {"splitting", "", "with the column's splitting"},
            {"picRate", "R", "share of PIC velocity a second [1/s] (default: 2, the case's)"},
            {"json", "FILE", "writes the rows as an array of objects, too"},
            {"naive", "WORD", "on or off: measure the naive step beside it (default: on)"},
            {"quick", "", "coarser first columns, fewer and shorter blocks"}};
}

std::vector<Setting> readSettings(const cases::Options& options)
{
    std::vector<Setting> rows(1);
    rows[0].splitting = options.has("splitting");
    rows[0].quick = options.has("quick");
    rows[0].picRate = options.number("picRate", rows[0].picRate);
    if (rows[0].picRate < 0)
        throw InputError(fmt::format("-picRate: found {:g}, allowed is >= 0", rows[0].picRate));
    const auto naive = readWords(options, "naive", {"on", "off"}, "on");
    if (naive.size() > 1)
        throw InputError(fmt::format("-naive: found '{}', allowed on or off", options.value("naive")));
    rows[0].naive = naive[0] == "on" && !rows[0].splitting;

    const auto shapes = readWords(options, "shape", countedShapes(), "uGIMP");
    const auto updates = readWords(options, "stressUpdate", {"USF", "USL", "MUSL"}, "MUSL");
    const auto laws = readWords(options, "law", countedLaws(), "mohrCoulomb");
    std::vector<int> threads;
    for (const auto& word : split("threads", options.value("threads", "1")))
        threads.push_back(int(readCount("threads", word, mostThreads)));

    multiply(rows, readWords(options, "dimension", {"2", "3"}, "2"),
             [](Setting& row, const std::string& word) { row.dimension = word == "2" ? 2 : 3; });
    multiply(rows, shapes, [](Setting& row, const std::string& word) { row.shape = word; });
    multiply(rows, updates, [](Setting& row, const std::string& word) { row.stressUpdate = updateOf(word); });
    multiply(rows, laws, [](Setting& row, const std::string& word) { row.law = word; });
    std::vector<Setting> all;
    for (const Setting& row : rows)
    {
        std::vector<Setting> sizes{row};
        const std::string fallback = row.dimension == 3 ? "93312" : row.quick ? "7200" : "7200,115200";
        multiply(sizes, split("particles", options.value("particles", fallback)),
                 [](Setting& r, const std::string& word) {
                     r.particles = Index(readCount("particles", word, mostParticles));
                 });
        multiply(sizes, threads, [](Setting& r, int n) { r.threads = n; });
        all.insert(all.end(), sizes.begin(), sizes.end());
    }
    return all;
}
} // namespace mpm::benchmark
