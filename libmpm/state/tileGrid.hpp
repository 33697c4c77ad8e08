#pragma once
/// The nodes in use, and who adds to them. The lattice is cut into boxes of 2^bits cells a side (32 in 2D, 16 in 3D;
/// with `rest` 16 and 8):
///     tile    the particles whose support starts in one box, contiguous in memory, and the window of nodes they may
///             reach; a tile sums into its own window
///     block   the nodes of one box that any window reaches; each sums the windows over it in the order of the tiles
/// Sums are taken in an order the particles' keys fix, so they do not depend on the number of threads. Tiles and blocks
/// exist only where particles are: memory and time follow the material, not the box of the grid.
///
/// Where an axis is periodic, nodes are those of one period, and a window that reaches beyond it overlaps their blocks
/// after a move by whole periods.
///
/// Bodies that may move apart (nodal/contact.hpp) have tiles and blocks of their own: the body is the most significant
/// part of a key. So a kernel sees one body at a time, and a box that two bodies reach has a block of each. With one
/// body the keys are what they would be without.
///
/// Windows leave a margin of one cell for motion between two sorts; a particle that leaves its window calls for a sort
/// (stepping/explicitStepper.hpp). Verified in tests/unit/tileGrid.cpp.
#include "base/alignedVector.hpp"
#include "base/record.hpp"
#include "state/gridBox.hpp"
#include "state/particles.hpp"

#include <algorithm>
#include <vector>

namespace mpm::state
{
/// Added to the key of particles made since the last sort: they stand behind all others, in tiles of their own.
inline constexpr Index looseKey = Index(1) << 62;

/// Keys that order particles by body, tile (z, y, x), then by the first node of their support within it.
class TileLayout
{
  public:
    /// bodyOf: the body of each material; empty: all are one.
    /// bits: of the cells a side of a tile, at most bitsOf(grid.dim).
    explicit TileLayout(const GridBox& grid, std::vector<int> bodyOf = {}, int bits = 0);

    /// Key of a support that starts at lattice node `base`; nodes far outside the grid share the outermost tiles.
    Index key(const std::array<Index, 3>& base, int body = 0) const;
    /// The node a key stands for.
    std::array<Index, 3> base(Index key) const;
    /// The body a key stands for.
    int body(Index key) const { return int(tile(key & ~looseKey) / boxCount()); }
    /// The body of a material.
    int bodyOf(std::int32_t material) const { return bodyOf_.empty() ? 0 : bodyOf_[std::size_t(material)]; }
    /// Have materials bodies of their own?
    bool hasBodies() const { return !bodyOf_.empty(); }
    /// Tile of a key; tiles of loose particles (looseKey) count apart.
    Index tile(Index key) const { return key >> (dim_ * bits_); }

    int dim() const { return dim_; }
    int bits() const { return bits_; }
    /// Boxes along an axis, one beyond the grid on either side included.
    Index boxes(int axis) const { return boxes_[std::size_t(axis)]; }
    /// Index of the box that holds lattice index i along an axis.
    Index box(Index i) const { return (i >> bits_) + 1; }
    /// Nodes after which an axis repeats itself; 0 where it does not.
    Index period(int axis) const { return period_[std::size_t(axis)]; }
    Index boxKey(const std::array<Index, 3>& box, int body = 0) const
    {
        return ((body * boxes_[2] + box[2]) * boxes_[1] + box[1]) * boxes_[0] + box[0];
    }
    /// Boxes of one body: box keys of the same place differ by multiples of it.
    Index boxCount() const { return boxes_[0] * boxes_[1] * boxes_[2]; }
    std::array<Index, 3> firstNode(Index boxKey) const;

    /// Large tiles share fewer nodes; small ones tell apart better who sleeps (stepping/rest.hpp).
    static constexpr int bitsOf(int dim, bool rests = false) { return dim == 2 ? (rests ? 4 : 5) : (rests ? 3 : 4); }
    bool operator==(const TileLayout&) const = default;

  private:
    int dim_, bits_;
    std::array<Index, 3> boxes_{1, 1, 1}, period_{};
    std::vector<int> bodyOf_;
};

/// A box of lattice nodes, x fastest.
struct NodeBox
{
    std::array<Index, 3> lo{}, n{};
    bool operator==(const NodeBox&) const = default;
    Index size() const { return n[0] * n[1] * n[2]; }
    Index offset(Index i, Index j, Index k) const { return ((k - lo[2]) * n[1] + (j - lo[1])) * n[0] + (i - lo[0]); }
    /// What the offset grows by with j and k.
    Index stride(Index j, Index k) const { return (k * n[1] + j) * n[0]; }
    bool contains(Index i, Index j, Index k) const
    {
        return i >= lo[0] && i < lo[0] + n[0] && j >= lo[1] && j < lo[1] + n[1] && k >= lo[2] && k < lo[2] + n[2];
    }
    NodeBox moved(const std::array<Index, 3>& by) const
    {
        NodeBox box = *this;
        for (int a = 0; a < 3; ++a)
            box.lo[a] += by[a];
        return box;
    }
    /// The smallest box around both.
    NodeBox around(const NodeBox& o) const
    {
        NodeBox all;
        for (int a = 0; a < 3; ++a)
        {
            all.lo[a] = std::min(lo[a], o.lo[a]);
            all.n[a] = std::max(lo[a] + n[a], o.lo[a] + o.n[a]) - all.lo[a];
        }
        return all;
    }
    /// The nodes both boxes hold; empty boxes have n = 0 somewhere.
    NodeBox common(const NodeBox& o) const
    {
        NodeBox both;
        for (int a = 0; a < 3; ++a)
        {
            both.lo[a] = std::max(lo[a], o.lo[a]);
            both.n[a] = std::max<Index>(0, std::min(lo[a] + n[a], o.lo[a] + o.n[a]) - both.lo[a]);
        }
        return both;
    }
};

/// A tile's window over a block: the window's nodes are the block's after a move by whole periods.
struct Overlap
{
    Index tile = 0, block = 0;
    std::array<Index, 3> move{};
    NodeBox nodes;   ///< of the block that the window holds
    Index first = 0; ///< place of the first of them in the window
};

struct Tile
{
    Index first = 0, count = 0;  ///< its particles
    int body = 0;                ///< they belong to
    NodeBox window;              ///< nodes they may reach
    NodeBox reach;               ///< of these: beyond it the window holds zeros
    std::size_t start = 0;       ///< of the window in the windows' memory, in records
    std::vector<Overlap> blocks; ///< blocks its window overlaps
    bool resting = false;        ///< its window keeps masses and forces, momenta are none (stepping/rest.hpp)
};

struct Block
{
    Index key = 0;
    int body = 0;
    NodeBox box;
    std::size_t start = 0;      ///< of its nodes in the nodes' memory
    std::vector<Overlap> tiles; ///< tiles whose windows overlap it, ascending
};

class TileGrid
{
  public:
    /// Tiles of particles in the order of their keys. Supports reach `below` nodes before and `above` nodes beyond the
    /// base of the key.
    void build(const Particles& particles, const TileLayout& layout, int below, int above);

    int dim() const { return layout_.empty() ? 2 : layout_.front().dim(); }

    const std::vector<Tile>& tiles() const { return tiles_; }
    const std::vector<Block>& blocks() const { return blocks_; }
    /// The blocks of each box that several bodies reach, by body.
    const std::vector<std::vector<Index>>& sharedBoxes() const { return sharedBoxes_; }
    Index largestWindow() const { return largestWindow_; }
    std::size_t bytes() const
    {
        return (windows_.capacity() + nodes_[0].capacity() + nodes_[1].capacity()) * sizeof(Record);
    }

    /// A tile's window: records of type R (Record or HalfRecord), as the box `window` orders them.
    template <class R>
    R* window(const Tile& tile)
    {
        return reinterpret_cast<R*>(windows_.data() + tile.start);
    }
    /// sameReach: it will be filled by particles where they were when its reach was found.
    template <class R>
    void clearWindow(const Tile& tile, bool sameReach = false)
    {
        std::fill_n(window<R>(tile), std::size_t(tile.window.size()), R{});
        if (!sameReach)
            tiles_[std::size_t(&tile - tiles_.data())].reach = tile.window;
    }
    /// After a projection of masses: the reach, from the layers of zeros at the sides of the window. Most windows have
    /// them, the margin for motion: 40 % of the nodes in 3D, that need not be fetched to be summed, or copied.
    template <class R>
    void findReach(const Tile& tile)
    {
        NodeBox& reach = tiles_[std::size_t(&tile - tiles_.data())].reach;
        for (int a = dim() - 1; a >= 0; --a)
        {
            NodeBox layer = reach;
            layer.n[a] = 1;
            for (; reach.n[a] > 1 && isZero<R>(tile, layer); ++layer.lo[a])
            {
                ++reach.lo[a];
                --reach.n[a];
            }
            layer.lo[a] = reach.lo[a] + reach.n[a] - 1;
            for (; reach.n[a] > 1 && isZero<R>(tile, layer); --layer.lo[a])
                --reach.n[a];
        }
    }
    /// A block's nodes, x fastest. Layer 0 is always there, layer 1 after openLayer().
    Record* nodes(const Block& block, int layer = 0) { return nodes_[std::size_t(layer)].data() + block.start; }
    const Record* nodes(const Block& block, int layer = 0) const
    {
        return nodes_[std::size_t(layer)].data() + block.start;
    }
    /// The first node of all blocks; node n of them is at place n (Block::start).
    Record* place(int layer) { return nodes_[std::size_t(layer)].data(); }
    const Record* place(int layer) const { return nodes_[std::size_t(layer)].data(); }
    void openLayer() { nodes_[1].resize(nodes_[0].size()); }

    void setResting(Index tile, bool resting) { tiles_[std::size_t(tile)].resting = resting; }

    /// Calls add(i0, i1, in) for each window over row (j, k) of the block, in the order of the tiles: in[0] belongs to
    /// node i0. Windows of momenta (HalfRecord) leave out tiles at rest, which have none.
    template <class R, class Add>
    void forEachWindow(const Block& block, Index j, Index k, Add&& add)
    {
        for (const Overlap& overlap : block.tiles)
        {
            const NodeBox& nodes = overlap.nodes;
            if (j < nodes.lo[1] || j >= nodes.lo[1] + nodes.n[1] || k < nodes.lo[2] || k >= nodes.lo[2] + nodes.n[2])
                continue;
            const Tile& tile = tiles_[std::size_t(overlap.tile)];
            const NodeBox reach = tile.reach.moved(overlap.move);
            const Index i0 = std::max(nodes.lo[0], reach.lo[0]);
            const Index i1 = std::min(nodes.lo[0] + nodes.n[0], reach.lo[0] + reach.n[0]);
            if (i0 >= i1 || !reach.contains(i0, j, k) || (sizeof(R) < sizeof(Record) && tile.resting))
                continue;
            const R* row = window<R>(tile) + overlap.first + tile.window.stride(j - nodes.lo[1], k - nodes.lo[2]) +
                           (i0 - nodes.lo[0]);
            prefetch(row + tile.window.n[0], i1 - i0);
            add(i0, i1, row);
        }
    }

    /// out[window order] = repack(node record) for all nodes of a tile's window; inReach: zero in rows beyond its
    /// reach.
    template <class R, class Repack>
    void copyToWindow(const Tile& tile, R* out, Repack&& repack, int layer = 0, bool inReach = false) const
    {
        copyRows(tile, inReach ? tile.reach : tile.window, nodes_[std::size_t(layer)].data(), out, repack);
    }

    /// The same for values the caller keeps of all nodes, in the order of the blocks (Block::start).
    void copyToWindow(const Tile& tile, const std::vector<double>& values, double* out) const
    {
        copyRows(tile, tile.window, values.data(), out, [](double value) { return value; });
    }

    /// Place of a body's node among those of all blocks, -1 where no window of the body reaches.
    Index place(Index i, Index j, Index k, int body = 0) const;

    /// The record of a body's node, null where no window of the body reaches.
    Record* find(Index i, Index j, Index k, int body = 0);
    const Record* find(Index i, Index j, Index k, int body = 0) const
    {
        return const_cast<TileGrid*>(this)->find(i, j, k, body);
    }

  private:
    template <class From, class To, class Repack>
    void copyRows(const Tile& tile, const NodeBox& part, const From* values, To* out, Repack&& repack) const
    {
        for (const Overlap& overlap : tile.blocks)
        {
            const Block& block = blocks_[std::size_t(overlap.block)];
            const NodeBox& nodes = overlap.nodes;
            const NodeBox wanted = part.moved(overlap.move);
            const From* first = values + block.start + block.box.offset(nodes.lo[0], nodes.lo[1], nodes.lo[2]);
            for (Index k = 0; k < nodes.n[2]; ++k)
                for (Index j = 0; j < nodes.n[1]; ++j)
                {
                    const From* from = first + block.box.stride(j, k);
                    To* to = out + overlap.first + tile.window.stride(j, k);
                    if (!wanted.contains(wanted.lo[0], nodes.lo[1] + j, nodes.lo[2] + k))
                    {
                        std::fill_n(to, nodes.n[0], To{});
                        continue;
                    }
                    prefetch(from + block.box.n[0], nodes.n[0]);
                    for (Index i = 0; i < nodes.n[0]; ++i)
                        to[i] = repack(from[i]);
                }
        }
    }
    /// Are there only zeros in this part of a window?
    template <class R>
    bool isZero(const Tile& tile, const NodeBox& part)
    {
        auto other = R{} != R{};
        for (Index k = part.lo[2]; k < part.lo[2] + part.n[2]; ++k)
            for (Index j = part.lo[1]; j < part.lo[1] + part.n[1]; ++j)
            {
                const R* row = window<R>(tile) + tile.window.offset(part.lo[0], j, k);
                for (Index i = 0; i < part.n[0]; ++i)
                    other |= row[i] != R{};
            }
        for (int l = 0; l < int(sizeof(R) / sizeof(double)); ++l)
            if (other[l])
                return false;
        return true;
    }
    /// Asks for the next row while one is worked on.
    template <class R>
    static void prefetch(const R* row, Index count)
    {
        for (Index i = 0; i < count; i += 64 / sizeof(R))
            __builtin_prefetch(row + i);
    }
    /// False if windows are where they were.
    bool findTiles(const Particles& particles, int below, int above);
    void findBlocks();
    void findSharedBoxes();

    std::vector<Tile> tiles_;
    std::vector<Block> blocks_; ///< by key
    std::vector<std::vector<Index>> sharedBoxes_;
    AlignedVector<Record> windows_;
    std::array<AlignedVector<Record>, 2> nodes_;
    Index largestWindow_ = 0;
    std::vector<TileLayout> layout_; ///< one, once built
};
} // namespace mpm::state
