#include "case/writtenTimes.hpp"

#include "base/error.hpp"
#include "output/csvSeries.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace mpm::cases
{
namespace
{
const std::string turnMark = "outOfTurn", purgeMark = "purgeWrite";

std::vector<std::string> words(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> list;
    for (std::string word; stream >> word;)
        list.push_back(word);
    return list;
}

bool isNamed(const std::vector<TimeFolder>& times, const std::string& name)
{
    return std::any_of(times.begin(), times.end(), [&](const TimeFolder& time) { return time.name == name; });
}
} // namespace

WrittenTimes::WrittenTimes(const CaseDirectory& folder, Index keep, int precision)
    : folder_(folder), keep_(keep), precision_(precision)
{}

void WrittenTimes::goOnFrom(state::State& state, const std::string& name)
{
    const auto times = folder_.times();
    start_ = inTurn_ = name;
    inTurnTime_ = state.time;
    const auto turn = words(state.provenance[turnMark]);
    double before = 0;
    const bool marked = turn.size() == 2 &&
                        std::from_chars(turn[1].data(), turn[1].data() + turn[1].size(), before).ec == std::errc() &&
                        before <= state.time && std::isfinite(before);
    if (marked)
    {
        inTurn_ = turn[0];
        inTurnTime_ = before;
        outOfTurn_ = name;
    }
    if (keep_ > 0 && state.provenance.count(purgeMark))
    {
        for (const auto& old : words(state.provenance[purgeMark]))
            if (old != name && isNamed(times, old))
                purged_.push_back(old);
        if (!marked)
            purged_.push_back(name);
    }
    forgetTurn(state);
}

std::string WrittenTimes::next(state::State& state, bool outOfTurn)
{
    forgetTurn(state);
    if (outOfTurn)
        state.provenance[turnMark] = inTurn_ + " " + output::shortest(inTurnTime_);
    if (keep_ > 0)
    {
        std::string list;
        for (const auto& old : purged_)
            list.append(list.empty() ? "" : " ").append(old);
        state.provenance[purgeMark] = list;
    }
    name_ = distinctTimeName(state.time, inTurnTime_, precision_);
    nameOutOfTurn_ = outOfTurn;
    if (!outOfTurn)
    {
        before_.push_back({inTurn_, inTurnTime_});
        inTurn_ = name_;
        inTurnTime_ = state.time;
    }
    return name_;
}

std::string WrittenTimes::goBack(double time)
{
    const auto times = folder_.times();
    const auto stands = [&](const Time& one) { return isNamed(times, one.name); };
    // what purgeWrite has left must not become nothing
    while (inTurnTime_ > time && std::any_of(before_.begin(), before_.end(), stands))
    {
        folder_.removeTime(inTurn_);
        purged_.erase(std::remove(purged_.begin(), purged_.end(), inTurn_), purged_.end());
        inTurn_ = before_.back().name;
        inTurnTime_ = before_.back().value;
        before_.pop_back();
    }
    return folder_.latestTime().name;
}

void WrittenTimes::committed()
{
    if (!outOfTurn_.empty() && outOfTurn_ != name_)
        drop(outOfTurn_);
    outOfTurn_ = nameOutOfTurn_ ? name_ : "";
    if (nameOutOfTurn_)
        return;
    purged_.push_back(name_);
    folder_.purge(purged_, keep_);
}

void WrittenTimes::tidy()
{
    folder_.purge(purged_, keep_);
    const auto times = folder_.times();
    auto before = std::find_if(times.rbegin(), times.rend(), [&](const auto& time) { return time.name == start_; });
    if (before != times.rend())
        while (++before != times.rend() && drop(before->name))
            ;
}

/// False if that time is in turn, was worked on, or cannot be read and so is not ours.
bool WrittenTimes::drop(const std::string& outOfTurn) const
{
    try
    {
        const auto summary = output::readSummary(folder_.statePath(outOfTurn));
        const auto turn = words(summary.outOfTurn);
        return !turn.empty() && turn[0] != outOfTurn && summary.derived.empty() && isNamed(folder_.times(), turn[0]) &&
               folder_.removeTime(outOfTurn);
    }
    catch (const InputError&)
    {
        return false;
    }
}

void forgetTurn(state::State& state)
{
    state.provenance.erase(turnMark);
    state.provenance.erase(purgeMark);
}
} // namespace mpm::cases
