#include "benchmark/rowTable.hpp"

#include "base/terminal.hpp"
#include "base/version.hpp"
#include "stepping/timeStep.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::benchmark
{
namespace
{
std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", int(c));
        else
            out += c;
    return out + '"';
}

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
}

/// The first row that differs from this one in its threads alone and has one thread.
const Row* withOneThread(const std::vector<Row>& rows, const Row& row)
{
    for (const Row& other : rows)
        if (other.setting.threads == 1 && other.setting.dimension == row.setting.dimension &&
            other.setting.shape == row.setting.shape && other.setting.stressUpdate == row.setting.stressUpdate &&
            other.setting.law == row.setting.law && other.particles == row.particles)
            return &other;
    return nullptr;
}

std::vector<std::string> describe(const Row& row)
{
    const Setting& s = row.setting;
    return {std::to_string(s.dimension) + (storage() == "double" ? "" : ", " + storage()),
            s.shape,
            stepping::stressUpdateName(s.stressUpdate),
            s.law,
            std::to_string(row.particles),
            std::to_string(s.threads)};
}
} // namespace

std::string tableOf(const std::vector<Row>& rows)
{
    std::vector<std::string> heads{"dim", "shape", "update", "law", "particles", "threads"};
    auto passHeads = heads;
    for (const char* head : {"ns", "min", "max", "naive ns", "naive/ours", "speedup", "GB/s", "GF/s", "triad", "fma",
                             "roofline", "B/particle", "columns", "yielding"})
        heads.emplace_back(head);
    if (!rows.empty())
        for (const auto& [name, share] : rows[0].passes)
            passHeads.push_back(name + " %");
    Table times(heads), passes(passHeads);
    for (const Row& row : rows)
    {
        const auto ns = [](double seconds) { return fmt::format("{:.1f}", 1e9 * seconds); };
        const auto giga = [](double rate) { return fmt::format("{:.1f}", 1e-9 * rate); };
        const auto percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
        const Row* single = withOneThread(rows, row);
        auto cells = describe(row);
        for (const auto& cell :
             {ns(row.ours.median), ns(row.ours.fastest), ns(row.ours.slowest), row.naive ? ns(row.naive->median) : "-",
              row.naive ? fmt::format("{:.2f}", row.naive->median / row.ours.median) : "-",
              single ? fmt::format("{:.2f}", single->ours.median / row.ours.median) : "-", giga(row.bandwidth()),
              giga(row.flopRate()), giga(row.triad), giga(row.fmaPeak), percent(row.rooflineShare()),
              fmt::format("{:.0f}", row.residentBytes), fmt::format("{:.0f}", row.columnBytes), percent(row.yielding)})
            cells.push_back(cell);
        times.row(cells);
        auto shares = describe(row);
        for (const auto& [name, share] : row.passes)
            shares.push_back(fmt::format("{:.1f}", 100 * share));
        passes.row(shares);
    }
    return times.text() + "\n" + passes.text();
}

std::string jsonOf(const std::vector<Row>& rows)
{
    std::string text = "[";
    for (const Row& row : rows)
    {
        const Setting& s = row.setting;
        text += fmt::format("{}\n    {{\"dimension\": {}, \"shape\": {}, \"stressUpdate\": {}, \"law\": {}, ",
                            &row == &rows[0] ? "" : ",", s.dimension, quoted(s.shape),
                            quoted(stepping::stressUpdateName(s.stressUpdate)), quoted(s.law));
        text += fmt::format("\"real\": {}, \"particles\": {}, \"threads\": {}, ", quoted(storage()), row.particles,
                            s.threads);
        text += fmt::format("\"nsPerParticleStep\": {}, \"naiveNsPerParticleStep\": {}, \"bytesPerParticle\": {}, ",
                            number(1e9 * row.ours.median), row.naive ? number(1e9 * row.naive->median) : "null",
                            number(row.residentBytes));
        text += fmt::format("\"triadGBs\": {}, \"fmaGFs\": {}, \"rooflineShare\": {}}}", number(1e-9 * row.triad),
                            number(1e-9 * row.fmaPeak), number(row.rooflineShare()));
    }
    return text + "\n]\n";
}
} // namespace mpm::benchmark
