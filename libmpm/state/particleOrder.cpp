#include "state/particleOrder.hpp"

#include "state/permutation.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>
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

/// Keys that differ in their last bits alone stand for neighbouring rows of cells of one tile.
constexpr int groupBits = 8;
constexpr std::size_t keysOfGroup = std::size_t(1) << groupBits;

std::int64_t groupOf(std::int64_t key)
{
    return key >> groupBits;
}

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

/// Particles of one group of keys on their way into order.
class Group
{
  public:
    Group(const Particles& p, std::uint32_t* order) : key_(p.sortKey.data()), id_(p.id.data()), order_(order) {}

    /// Those of `kept`, in the order they stand in, and `moved`: to order[at] and on.
    void sort(const std::uint32_t* kept, std::size_t keptCount, const Entry* moved, std::size_t movedCount,
              std::size_t at)
    {
        std::uint32_t* const out = order_ + at;
        if (movedCount == 0 && std::is_sorted(kept, kept + keptCount, [&](auto a, auto b) { return before(a, b); }))
        {
            std::copy_n(kept, keptCount, out);
            return;
        }
        members_.assign(kept, kept + keptCount);
        for (std::size_t m = 0; m < movedCount; ++m)
            members_.push_back(std::uint32_t(moved[m].at));
        if (members_.size() < keysOfGroup / 4 || !countByKey())
        {
            std::sort(members_.begin(), members_.end(), [&](auto a, auto b) { return before(a, b); });
            std::copy(members_.begin(), members_.end(), out);
            return;
        }
        placeByKey(out);
        sortByIds(out);
    }

  private:
    bool before(std::uint32_t a, std::uint32_t b) const
    {
        return key_[a] != key_[b] ? key_[a] < key_[b] : id_[a] < id_[b];
    }

    /// Where each key begins; false if one has so many that an insertion sort would be slow.
    bool countByKey()
    {
        constexpr std::uint32_t most = 64;
        begin_.fill(0);
        for (const auto i : members_)
            ++begin_[inGroup(key_[i])];
        std::uint32_t next = 0, fullest = 0;
        for (auto& b : begin_)
        {
            fullest = std::max(fullest, b);
            next += std::exchange(b, next);
        }
        return fullest <= most;
    }

    void placeByKey(std::uint32_t* out)
    {
        ids_.resize(members_.size());
        keys_.resize(members_.size());
        for (const auto i : members_)
        {
            const std::size_t key = inGroup(key_[i]), place = begin_[key]++;
            out[place] = i;
            ids_[place] = id_[i];
            keys_[place] = std::uint8_t(key);
        }
    }

    /// Neighbours in a cell stand nearly in order.
    void sortByIds(std::uint32_t* out)
    {
        for (std::size_t i = 1; i < ids_.size(); ++i)
        {
            if (int(keys_[i] != keys_[i - 1]) | int(ids_[i - 1] < ids_[i])) // one branch instead of two
                continue;
            const auto id = ids_[i];
            const auto particle = out[i];
            std::size_t to = i;
            for (; to > 0 && keys_[to - 1] == keys_[i] && ids_[to - 1] > id; --to)
            {
                ids_[to] = ids_[to - 1];
                out[to] = out[to - 1];
            }
            ids_[to] = id;
            out[to] = particle;
        }
    }

    static std::size_t inGroup(std::int64_t key) { return std::size_t(key) & (keysOfGroup - 1); }

    const std::int64_t *key_, *id_;
    std::uint32_t* order_;
    std::array<std::uint32_t, keysOfGroup> begin_{};
    Order members_;
    std::vector<std::int64_t> ids_;
    std::vector<std::uint8_t> keys_;
};

struct Span
{
    std::size_t kept, keptEnd, moved, movedEnd;
};

/// Where the groups of both lists lie.
std::vector<Span> spansOf(const Particles& p, const Order& kept, const std::vector<Entry>& moved)
{
    const auto keptGroup = [&](std::size_t k) { return groupOf(p.sortKey[kept[k]]); };
    std::vector<Span> spans;
    for (std::size_t k = 0, m = 0; k < kept.size() || m < moved.size();)
    {
        std::int64_t group = std::numeric_limits<std::int64_t>::max();
        if (k < kept.size())
            group = keptGroup(k);
        if (m < moved.size())
            group = std::min(group, groupOf(moved[m].key));
        Span span{k, k, m, m};
        if (k < kept.size() && keptGroup(k) == group)
        {
            std::size_t step = 1; // doubled until it is too far, then halved
            for (; k + step < kept.size() && keptGroup(k + step) == group; step *= 2)
                k += step;
            for (; step > 0; step /= 2)
                if (k + step < kept.size() && keptGroup(k + step) == group)
                    k += step;
            span.keptEnd = ++k;
        }
        while (m < moved.size() && groupOf(moved[m].key) == group)
            span.movedEnd = ++m;
        spans.push_back(span);
    }
    return spans;
}
} // namespace

Order orderByKeyAndId(const Particles& p)
{
    if (std::uint64_t(p.size()) > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("more than 4294967295 particles cannot be sorted");
    const std::size_t n = std::size_t(p.size()), many = n / 4;
    const auto entry = [&](std::size_t i) { return Entry{p.sortKey[i], p.id[i], Index(i)}; };
    std::size_t i = 1;
    while (i < n && !(entry(i) < entry(i - 1)))
        ++i;
    if (i >= n)
        return {};

    Order kept(n);
    std::iota(kept.begin(), kept.begin() + std::ptrdiff_t(i), 0);
    std::size_t keeps = i;
    std::vector<Entry> moved;
    for (std::int64_t last = groupOf(p.sortKey[i - 1]); i < n && moved.size() <= many; ++i)
    {
        const std::int64_t group = groupOf(p.sortKey[i]);
        if (group >= last)
        {
            kept[keeps++] = std::uint32_t(i);
            last = group;
            continue;
        }
        moved.push_back(entry(kept[--keeps]));
        moved.push_back(entry(i));
        last = keeps > 0 ? groupOf(p.sortKey[kept[keeps - 1]]) : std::numeric_limits<std::int64_t>::min();
    }
    if (i < n)
    {
        moved.resize(n);
        for (i = 0; i < n; ++i)
            moved[i] = entry(i);
        keeps = 0;
    }
    kept.resize(keeps);
    if (!moved.empty())
        sortEntries(moved);
    Order order(n);
    if (kept.empty())
    {
        std::transform(moved.begin(), moved.end(), order.begin(), [](const Entry& e) { return std::uint32_t(e.at); });
        return order;
    }
    const std::vector<Span> spans = spansOf(p, kept, moved);
#pragma omp parallel if (p.size() > manyParticles)
    {
        Group group(p, order.data());
#pragma omp for schedule(static)
        for (std::size_t s = 0; s < spans.size(); ++s)
        {
            const Span& span = spans[s];
            group.sort(kept.data() + span.kept, span.keptEnd - span.kept, moved.data() + span.moved,
                       span.movedEnd - span.moved, span.kept + span.moved);
        }
    }
    return order;
}

bool sortByKeyAndId(Particles& p)
{
    Order order = orderByKeyAndId(p);
    if (order.empty())
        return false;
    p.permute(std::move(order));
    return true;
}
} // namespace mpm::state
