#include "case/effectTables.hpp"

#include "base/terminal.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
std::string percent(double share)
{
    return fmt::format("{:.1f}", 100 * share);
}

/// The first line of a fault.
std::string brief(const std::string& fault)
{
    return fault.substr(0, fault.find('\n'));
}

std::string pricesOf(const EffectPrices& prices, bool used, const std::string& shareHead)
{
    Table table({"effect", "named by", shareHead, "+- [%]", "ns per particle and step", "bytes a particle"});
    std::string faults;
    for (const auto& price : prices.list)
    {
        if (price.used != used)
            continue;
        const auto& e = *price.effect;
        if (price.fault.empty())
            table.row({e.name, e.word, percent(price.share), percent(price.spread),
                       fmt::format("{:.1f}", price.nanoseconds), fmt::format("{:.0f}", price.bytes)});
        else
        {
            table.row({e.name, e.word, "", "", "", ""});
            faults += fmt::format("  {}: {}\n", e.name, brief(price.fault));
        }
    }
    return table.text(2) + faults;
}

std::string howMeasured(const EffectPrices& p)
{
    return fmt::format("copies of {}, stepped with and without each effect in turns of {} steps, medians of "
                       "processor time",
                       p.particles < p.all ? fmt::format("the first {} of {} particles", p.particles, p.all)
                                           : fmt::format("all {} particles", p.particles),
                       p.batch);
}
} // namespace

std::string effectsText(const EffectPrices& p, int dim)
{
    return fmt::format("\nEffects in use, and their share of a step ({:.1f} ns per particle and step in {} "
                       "dimensions)\n{}\nAvailable but off: how much dearer naming one makes a step, before it acts\n{}"
                       "\nMeasured in {}: {}; +- is half the range of the middle half of rounds.\n",
                       p.nanoseconds, dim, pricesOf(p, true, "share [%]"), pricesOf(p, false, "adds [%]"),
                       formatDuration(p.seconds), howMeasured(p));
}

namespace
{
std::string listOf(EffectFamily family)
{
    std::string text;
    for (const auto& e : effectCatalogue())
    {
        if (e.family != family)
            continue;
        const std::string neutral = e.neutralText.empty()
                                        ? "none: " + e.differs
                                        : e.neutralText + (e.differs.empty() ? "" : "; to round-off: " + e.differs);
        std::string fields;
        for (const auto& field : e.fields)
            fields += (fields.empty() ? "`" : ", `") + field + "`";
        text += fmt::format("| {} | `{}` in `{}` | {} | {} | {} |\n", e.name, e.word, e.file, e.help, neutral, fields);
    }
    return text;
}

std::string pageTable(const EffectPrices& prices, bool used)
{
    std::string text;
    for (const auto& price : prices.list)
        if (price.used == used)
            text += price.fault.empty()
                        ? fmt::format("| {} | {} | {} | {:.1f} | {:.0f} |\n", price.effect->name, percent(price.share),
                                      percent(price.spread), price.nanoseconds, price.bytes)
                        : fmt::format("| {} | - | - | - | - |\n", price.effect->name);
    return text;
}
} // namespace

std::string effectsPage(const EffectPrices& p, const std::string& caseName, int dim)
{
    std::string page = "# Effects\n\n"
                       "What a scene may name. What it does not name is absent: no pass, no column, no branch. At the "
                       "neutral value results are those of its absence, bit for bit unless said otherwise. "
                       "`mpmSolve -effects` measures what each costs in a scene of yours. This page is made by "
                       "`etc/effectsTable`.\n";
    for (const auto family : {EffectFamily::law, EffectFamily::boundary, EffectFamily::contact, EffectFamily::process,
                              EffectFamily::transfer, EffectFamily::treatment})
        if (const auto list = listOf(family); !list.empty())
            page += fmt::format("\n## Family {}\n\n| effect | named by | what it is | neutral value | columns |\n"
                                "| --- | --- | --- | --- | --- |\n{}",
                                familyName(family), list);
    page += fmt::format("\n## Prices\n\n`{}`, {} dimensions, {:.1f} ns per particle and step: {}.\n\n"
                        "| in use | share of a step [%] | +- [%] | ns per particle and step | bytes a particle |\n"
                        "| --- | --- | --- | --- | --- |\n{}\n"
                        "| off | adds to a step [%] | +- [%] | ns per particle and step | bytes a particle |\n"
                        "| --- | --- | --- | --- | --- |\n{}",
                        caseName, dim, p.nanoseconds, howMeasured(p), pageTable(p, true), pageTable(p, false));
    return page;
}

namespace
{
/// Time in the pass an effect acts in, of all steps.
std::string boundText(const Effect& e, const stepping::PassTimes& passes, double stepSeconds)
{
    const double share = stepSeconds > 0 ? 100 * (passes.*e.pass) / stepSeconds : 0;
    return (e.ownPass ? "" : "< ") + fmt::format("{:.1f}", share);
}

std::string costText(const Effect& e, const std::optional<EffectPrices>& prices, const stepping::PassTimes& passes,
                     double stepSeconds)
{
    if (!prices)
        return boundText(e, passes, stepSeconds);
    for (const auto& price : prices->list)
        if (price.effect == &e && price.fault.empty())
            return price.share < price.spread
                       ? fmt::format("< {:.1f}", 100 * (std::max(0.0, price.share) + price.spread))
                       : percent(price.share);
    return "-";
}
} // namespace

std::string deedsText(const EffectRun& run, const std::vector<const Effect*>& used,
                      const std::optional<EffectPrices>& prices, const stepping::PassTimes& passes, double stepSeconds)
{
    if (used.empty())
        return {};
    Table table({"effect", "share of a step [%]", "what it did"});
    for (const Effect* e : used)
        table.row({e->name, costText(*e, prices, passes, stepSeconds), e->did(run).text});
    return fmt::format("Effects ({})\n{}",
                       prices ? fmt::format("shares: at the last state, {}; it took {}", howMeasured(*prices),
                                            formatDuration(prices->seconds))
                              : "shares: at most the whole pass they act in, as timed in this run",
                       table.text(2));
}

std::vector<std::string> idleEffects(const EffectRun& run, const std::vector<const Effect*>& used)
{
    std::vector<std::string> idle;
    for (const Effect* e : used)
        if (const auto deed = e->did(run); !deed.acted && run.steps > 0)
            idle.push_back(fmt::format("{}: {} in {} steps", e->name, deed.text, run.steps));
    return idle;
}
} // namespace mpm::cases
