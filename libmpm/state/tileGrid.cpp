#include "state/tileGrid.hpp"

#include <bit>
#include <tuple>

namespace mpm::state
{
TileLayout::TileLayout(const GridBox& grid, std::vector<int> bodyOf, int bits)
    : dim_(grid.dim), bits_(bits > 0 ? bits : bitsOf(grid.dim)), bodyOf_(std::move(bodyOf))
{
    for (int a = 0; a < dim_; ++a)
    {
        boxes_[a] = box(grid.cells[a] + (Index(1) << bits_)) + 1;
        period_[a] = grid.periodic[a] ? grid.cells[a] : 0;
    }
}

Index TileLayout::key(const std::array<Index, 3>& base, int body) const
{
    const Index side = Index(1) << bits_;
    std::array<Index, 3> boxes{};
    Index inside = 0;
    for (int a = dim_ - 1; a >= 0; --a)
    {
        const Index i = std::clamp(base[a], -side, (boxes_[a] - 1) * side - 1);
        boxes[a] = box(i);
        inside = (inside << bits_) + (i & (side - 1));
    }
    return (boxKey(boxes, body) << (dim_ * bits_)) + inside;
}

std::array<Index, 3> TileLayout::firstNode(Index key) const
{
    std::array<Index, 3> node{};
    for (int a = 0; a < dim_; ++a)
    {
        node[a] = (key % boxes_[a] - 1) * (Index(1) << bits_);
        key /= boxes_[a];
    }
    return node;
}

std::array<Index, 3> TileLayout::base(Index key) const
{
    key &= ~looseKey;
    std::array<Index, 3> node = firstNode(key >> (dim_ * bits_));
    for (int a = 0; a < dim_; ++a)
        node[a] += (key >> (a * bits_)) & ((Index(1) << bits_) - 1);
    return node;
}

void TileGrid::build(const Particles& particles, const TileLayout& layout, int below, int above)
{
    const bool known = layout_.size() == 1 && layout_.front() == layout;
    if (!known)
        layout_.assign(1, layout);
    if (findTiles(particles, below, above) || !known)
    {
        findBlocks();
        findSharedBoxes();
    }
}

namespace
{
/// Of the particles from `first` on, the one behind the last of the same tile.
std::size_t endOfTile(const Column<std::int64_t>& key, std::size_t first, std::size_t end, const TileLayout& layout)
{
    const Index own = layout.tile(key[first]);
    const auto stays = [&](std::size_t i) { return i < end && layout.tile(key[i]) == own; };
    std::size_t last = first, step = 1; // doubled until it is too far, then halved
    for (; stays(last + step); step *= 2)
        last += step;
    for (; step > 0; step /= 2)
        if (stays(last + step))
            last += step;
    return last + 1;
}

/// Nodes from `first` to the particle before `end`, all of one tile: the smallest and largest base of each axis.
NodeBox basesOf(const Column<std::int64_t>& key, std::size_t first, std::size_t end, const TileLayout& layout)
{
    const Index inside = (Index(1) << layout.bits()) - 1;
    const auto corner = layout.base(key[first] & ~((Index(1) << (layout.dim() * layout.bits())) - 1));
    NodeBox box;
    box.n = {1, 1, 1};
    for (int a = 0; a < layout.dim(); ++a)
    {
        const int shift = a * layout.bits();
        static_assert(TileLayout::bitsOf(2) <= 5 && TileLayout::bitsOf(3) <= 5);
        std::uint32_t found = 0; // bit i: node i of the tile
        for (std::size_t i = first; i < end; ++i)
            found |= std::uint32_t(1) << ((key[i] >> shift) & inside);
        const Index low = std::countr_zero(found), high = std::bit_width(found) - 1;
        box.lo[a] = corner[a] + low;
        box.n[a] = high - low + 1;
    }
    return box;
}
} // namespace

bool TileGrid::findTiles(const Particles& particles, int below, int above)
{
    const TileLayout& layout = layout_.front();
    constexpr Index margin = 1;
    const auto& key = particles.sortKey;
    const std::size_t end = std::size_t(particles.size());
    std::size_t count = 0, records = 0;
    bool changed = false;
    largestWindow_ = 0;
    for (std::size_t i = 0; i < end; ++count)
    {
        const std::size_t first = i;
        i = endOfTile(key, first, end, layout);
        NodeBox window = basesOf(key, first, i, layout);
        for (int a = 0; a < layout.dim(); ++a)
        {
            window.lo[a] -= below + margin;
            window.n[a] += below + above + 2 * margin;
        }
        const int body = layout.hasBodies() ? layout.body(key[first]) : 0;
        if (count == tiles_.size())
            tiles_.emplace_back();
        Tile& tile = tiles_[count];
        changed = changed || tile.body != body || !(tile.window == window);
        tile.first = Index(first);
        tile.count = Index(i - first);
        tile.body = body;
        tile.window = window;
        tile.reach = window;
        tile.start = records;
        tile.resting = false;
        records += std::size_t(window.size());
        largestWindow_ = std::max(largestWindow_, window.size());
    }
    changed = changed || count != tiles_.size();
    tiles_.resize(count);
    if (windows_.size() < records)
        windows_.resize(records + records / 8);
    return changed;
}

namespace
{
/// Moves by whole periods that bring part of a window among the nodes of one period.
std::vector<std::array<Index, 3>> movesOf(const NodeBox& window, const TileLayout& layout)
{
    std::array<Index, 3> least{}, most{};
    for (int a = 0; a < layout.dim(); ++a)
        if (const Index period = layout.period(a))
        {
            const auto down = [&](Index i) { return (i >= 0 ? i : i - period + 1) / period; };
            least[a] = -down(window.lo[a] + window.n[a] - 1);
            most[a] = -down(window.lo[a]);
        }
    std::vector<std::array<Index, 3>> moves;
    for (Index k = least[2]; k <= most[2]; ++k)
        for (Index j = least[1]; j <= most[1]; ++j)
            for (Index i = least[0]; i <= most[0]; ++i)
                moves.push_back({i * layout.period(0), j * layout.period(1), k * layout.period(2)});
    return moves;
}

/// The nodes a block may have: its box, within one period.
NodeBox nodesOf(const TileLayout& layout, Index key)
{
    NodeBox box;
    box.lo = layout.firstNode(key);
    box.n = {1, 1, 1};
    for (int a = 0; a < layout.dim(); ++a)
    {
        box.n[a] = Index(1) << layout.bits();
        if (const Index period = layout.period(a))
        {
            const Index end = std::min(box.lo[a] + box.n[a], period);
            box.lo[a] = std::max<Index>(box.lo[a], 0);
            box.n[a] = std::max<Index>(0, end - box.lo[a]);
        }
    }
    return box;
}
} // namespace

void TileGrid::findBlocks()
{
    const TileLayout& layout = layout_.front();
    struct Meeting
    {
        Index key;
        Overlap overlap;
    };
    std::vector<Meeting> overlaps;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        for (const auto& move : movesOf(tiles_[t].window, layout))
        {
            const NodeBox w = tiles_[t].window.moved(move);
            std::array<Index, 3> low{}, high{};
            for (int a = 0; a < layout.dim(); ++a)
            {
                const Index period = layout.period(a), last = w.lo[a] + w.n[a] - 1;
                low[a] = layout.box(period ? std::max<Index>(w.lo[a], 0) : w.lo[a]);
                high[a] = layout.box(period ? std::min(last, period - 1) : last);
            }
            for (Index k = low[2]; k <= high[2]; ++k)
                for (Index j = low[1]; j <= high[1]; ++j)
                    for (Index i = low[0]; i <= high[0]; ++i)
                        overlaps.push_back({layout.boxKey({i, j, k}, tiles_[t].body), {Index(t), 0, move, {}, 0}});
        }
    std::sort(overlaps.begin(), overlaps.end(), [](const Meeting& a, const Meeting& b) {
        return std::tie(a.key, a.overlap.tile, a.overlap.move) < std::tie(b.key, b.overlap.tile, b.overlap.move);
    });
    blocks_.clear();
    for (Tile& tile : tiles_)
        tile.blocks.clear();
    std::size_t records = 0;
    for (std::size_t o = 0; o < overlaps.size();)
    {
        Block block;
        block.key = overlaps[o].key;
        block.body = tiles_[std::size_t(overlaps[o].overlap.tile)].body;
        const NodeBox whole = nodesOf(layout, block.key);
        std::array<Index, 3> low{}, end{};
        for (; o < overlaps.size() && overlaps[o].key == block.key; ++o)
        {
            Overlap overlap = overlaps[o].overlap;
            overlap.block = Index(blocks_.size());
            Tile& tile = tiles_[std::size_t(overlap.tile)];
            const NodeBox window = tile.window.moved(overlap.move), both = whole.common(window);
            overlap.nodes = both;
            overlap.first = window.offset(both.lo[0], both.lo[1], both.lo[2]);
            for (int a = 0; a < 3; ++a)
            {
                low[a] = block.tiles.empty() ? both.lo[a] : std::min(low[a], both.lo[a]);
                end[a] = block.tiles.empty() ? both.lo[a] + both.n[a] : std::max(end[a], both.lo[a] + both.n[a]);
            }
            block.tiles.push_back(overlap);
            tile.blocks.push_back(overlap);
        }
        for (int a = 0; a < 3; ++a)
        {
            block.box.lo[a] = low[a];
            block.box.n[a] = end[a] - low[a];
        }
        block.start = records;
        records += std::size_t(block.box.size());
        blocks_.push_back(std::move(block));
    }
    if (nodes_[0].size() < records)
        nodes_[0].resize(records + records / 8);
}

/// Blocks stand by body, then by box.
void TileGrid::findSharedBoxes()
{
    sharedBoxes_.clear();
    if (blocks_.empty() || blocks_.front().body == blocks_.back().body)
        return;
    const Index boxes = layout_.front().boxCount();
    std::vector<std::pair<Index, Index>> byBox;
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        byBox.emplace_back(blocks_[b].key % boxes, Index(b));
    std::sort(byBox.begin(), byBox.end());
    for (std::size_t from = 0, to = 0; from < byBox.size(); from = to)
    {
        std::vector<Index> sharing;
        for (; to < byBox.size() && byBox[to].first == byBox[from].first; ++to)
            sharing.push_back(byBox[to].second);
        if (sharing.size() > 1)
            sharedBoxes_.push_back(std::move(sharing));
    }
}

Record* TileGrid::find(Index i, Index j, Index k, int body)
{
    const Index at = place(i, j, k, body);
    return at < 0 ? nullptr : nodes_[0].data() + at;
}

Index TileGrid::place(Index i, Index j, Index k, int body) const
{
    if (layout_.empty())
        return -1;
    const TileLayout& layout = layout_.front();
    std::array<Index, 3> node{i, j, k}, box{};
    for (int a = 0; a < layout.dim(); ++a)
    {
        if (const Index period = layout.period(a))
            node[a] = ((node[a] % period) + period) % period;
        box[a] = layout.box(node[a]);
    }
    const Index key = layout.boxKey(box, body);
    const auto found = std::lower_bound(blocks_.begin(), blocks_.end(), key,
                                        [](const Block& b, Index wanted) { return b.key < wanted; });
    if (found == blocks_.end() || found->key != key || !found->box.contains(node[0], node[1], node[2]))
        return -1;
    return Index(found->start) + found->box.offset(node[0], node[1], node[2]);
}
} // namespace mpm::state
