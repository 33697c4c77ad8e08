#include "state/particleOrder.hpp"

#include <algorithm>
#include <utility>

namespace mpm::state
{
namespace
{
struct Entry
{
    std::int64_t key, id;
    Index at;
    bool operator<(const Entry& other) const { return key != other.key ? key < other.key : id < other.id; }
};

constexpr int digitBits = 11;
constexpr int digits = (64 + digitBits - 1) / digitBits;
constexpr std::size_t digitValues = std::size_t(1) << digitBits;

std::size_t digit(std::int64_t key, std::int64_t lowest, int d)
{
    return (std::uint64_t(key) - std::uint64_t(lowest)) >> (digitBits * d) & (digitValues - 1);
}

/// Least significant digit first; digits that are the same for all are skipped.
void sortByKey(std::vector<Entry>& entries)
{
    std::int64_t lowest = entries.front().key;
    for (const Entry& e : entries)
        lowest = std::min(lowest, e.key);
    std::vector<std::size_t> count(digits * digitValues, 0);
    for (const Entry& e : entries)
        for (int d = 0; d < digits; ++d)
            ++count[std::size_t(d) * digitValues + digit(e.key, lowest, d)];
    std::vector<Entry> next;
    for (int d = 0; d < digits; ++d)
    {
        std::size_t* place = count.data() + std::size_t(d) * digitValues;
        if (place[digit(entries.front().key, lowest, d)] == entries.size())
            continue;
        std::size_t begin = 0;
        for (std::size_t v = 0; v < digitValues; ++v)
            begin += std::exchange(place[v], begin);
        next.resize(entries.size());
        for (const Entry& e : entries)
            next[place[digit(e.key, lowest, d)]++] = e;
        std::swap(entries, next);
    }
}

void sortEntries(std::vector<Entry>& entries)
{
    if (entries.size() < digitValues)
    {
        std::sort(entries.begin(), entries.end());
        return;
    }
    sortByKey(entries);
    for (auto from = entries.begin(); from != entries.end();)
    {
        const auto to = std::find_if(from, entries.end(), [&](const Entry& e) { return e.key != from->key; });
        if (!std::is_sorted(from, to))
            std::sort(from, to);
        from = to;
    }
}

std::vector<Index> merged(const Particles& p, const std::vector<Index>& kept, const std::vector<Entry>& moved)
{
    std::vector<Index> order(kept.size() + moved.size());
    auto out = order.begin();
    auto next = kept.begin();
    for (const Entry& e : moved)
    {
        while (next != kept.end() && Entry{p.sortKey[std::size_t(*next)], p.id[std::size_t(*next)], *next} < e)
            *out++ = *next++;
        *out++ = e.at;
    }
    std::copy(next, kept.end(), out);
    return order;
}
} // namespace

std::vector<Index> orderByKeyAndId(const Particles& p)
{
    const auto entry = [&](Index i) { return Entry{p.sortKey[std::size_t(i)], p.id[std::size_t(i)], i}; };
    Index first = 1;
    while (first < p.size() && !(entry(first) < entry(first - 1)))
        ++first;
    if (first >= p.size())
        return {};

    std::vector<Index> kept(static_cast<std::size_t>(p.size()));
    std::size_t keeps = std::size_t(first);
    for (Index i = 0; i < first; ++i)
        kept[std::size_t(i)] = i;
    std::vector<Entry> moved;
    const std::size_t many = std::size_t(p.size() / 4);
    Index i = first;
    for (; i < p.size() && moved.size() <= many; ++i)
    {
        const Entry e = entry(i);
        if (keeps == 0 || !(e < entry(kept[keeps - 1])))
        {
            kept[keeps++] = i;
            continue;
        }
        moved.push_back(entry(kept[--keeps]));
        moved.push_back(e);
    }
    if (i < p.size())
    {
        moved.resize(std::size_t(p.size()));
        for (i = 0; i < p.size(); ++i)
            moved[std::size_t(i)] = entry(i);
        keeps = 0;
    }
    kept.resize(keeps);
    sortEntries(moved);
    return merged(p, kept, moved);
}

bool sortByKeyAndId(Particles& p)
{
    const std::vector<Index> order = orderByKeyAndId(p);
    if (order.empty())
        return false;
    p.permute(order);
    return true;
}
} // namespace mpm::state
