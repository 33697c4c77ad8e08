#include "seeding/seedLattice.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm::seeding
{
namespace
{
using geometry::BoxPart;

struct RowOfSeeds
{
    Index layer, row;
    std::size_t begin, end; ///< its seeds
};

struct Sliver
{
    std::size_t seed, row; ///< index of the seed and of its row in the list of rows
    Index box;
    std::array<double, 6> contact;
};

/// Edge lengths whose product is the volume, in the proportions of the part's extents.
Vector3 edgeLengths(const BoxPart& part, int dim)
{
    const double side = std::pow(part.volume, 1.0 / dim);
    double product = 1;
    for (std::size_t k = 0; k < std::size_t(dim); ++k)
        product *= part.extent[k];
    Vector3 length{};
    const double factor = product > 0 ? std::pow(part.volume / product, 1.0 / dim) : 0;
    for (std::size_t k = 0; k < std::size_t(dim); ++k)
        length[k] = product > 0 ? part.extent[k] * factor : side;
    return length;
}

class Merger
{
  public:
    Merger(int dim, double fraction, std::size_t expected) : dim_(dim), fraction_(fraction)
    {
        seeds_.reserve(expected); // growing by doubling would need three times the memory
        box_.reserve(expected);
        boxVolume_.reserve(expected);
    }

    void addRow(Index row, Index layer, const std::vector<BoxPart>& parts, double wholeSide)
    {
        rows_.push_back({layer, row, seeds_.size(), seeds_.size() + parts.size()});
        for (const BoxPart& part : parts)
        {
            if (part.volume < fraction_ * part.boxVolume)
                slivers_.push_back({seeds_.size(), rows_.size() - 1, part.box, part.contact});
            Seed seed{part.centroid, {}, part.volume};
            // Equal boxes are equal to the last bit, whatever their planes were rounded to.
            if (part.whole && wholeSide > 0)
            {
                seed.volume = dim_ == 2 ? wholeSide * wholeSide : wholeSide * wholeSide * wholeSide;
                seed.length = {wholeSide, wholeSide, dim_ == 2 ? 0 : wholeSide};
            }
            else
                seed.length = edgeLengths(part, dim_);
            seeds_.push_back(seed);
            box_.push_back(part.box);
            boxVolume_.push_back(part.boxVolume);
        }
    }

    RegionSeeds finish()
    {
        RegionSeeds result;
        std::vector<std::size_t> order(slivers_.size());
        std::iota(order.begin(), order.end(), 0);
        const std::vector<Seed> original = slivers_.empty() ? std::vector<Seed>{} : seeds_;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return original[slivers_[a].seed].volume < original[slivers_[b].seed].volume;
        });
        // From the smallest up: what a sliver has taken in goes on with it.
        if (slivers_.empty())
        {
            result.seeds = std::move(seeds_);
            return result;
        }
        std::vector<bool> gone(seeds_.size(), false);
        for (const std::size_t s : order)
        {
            const Sliver& sliver = slivers_[s];
            int face = 0;
            const std::size_t into = target(sliver, original, face);
            if (into == none)
                continue;
            merge(seeds_[sliver.seed], seeds_[into], std::size_t(face / 2));
            gone[sliver.seed] = true;
            ++result.merged;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < seeds_.size(); ++i)
            if (!gone[i])
                seeds_[kept++] = seeds_[i];
        seeds_.resize(kept);
        result.seeds = std::move(seeds_);
        return result;
    }

  private:
    static constexpr std::size_t none = std::size_t(-1);

    void merge(const Seed& sliver, Seed& into, std::size_t axis) const
    {
        const double volume = into.volume + sliver.volume;
        for (std::size_t k = 0; k < std::size_t(dim_); ++k)
            into.centre[k] += (sliver.centre[k] - into.centre[k]) * (sliver.volume / volume);
        into.length[axis] *= volume / into.volume;
        into.volume = volume;
    }

    std::size_t target(const Sliver& sliver, const std::vector<Seed>& original, int& face) const
    {
        std::array<int, 6> faces = {0, 1, 2, 3, 4, 5};
        std::stable_sort(faces.begin(), faces.end(),
                         [&](int a, int b) { return sliver.contact[std::size_t(a)] > sliver.contact[std::size_t(b)]; });
        const double own = original[sliver.seed].volume;
        const bool dust = own < 1e-9 * boxVolume_[sliver.seed];
        for (const int f : faces)
        {
            face = f;
            const std::size_t other = f < 2 * dim_ ? neighbour(sliver, f, original) : none;
            if (other == none || (sliver.contact[std::size_t(f)] <= 0 && !dust))
                continue;
            if (original[other].volume >= fraction_ * boxVolume_[other] || own < fraction_ * original[other].volume)
                return other;
        }
        return none;
    }

    /// The seed of the box behind a face (x0, x1, y0, y1, z0, z1).
    std::size_t neighbour(const Sliver& sliver, int face, const std::vector<Seed>& original) const
    {
        const Index step = face % 2 == 0 ? -1 : 1;
        if (face < 2)
        {
            const std::size_t other = step < 0 ? sliver.seed - 1 : sliver.seed + 1;
            const RowOfSeeds& row = rows_[sliver.row];
            const bool inRow = step < 0 ? sliver.seed > row.begin : other < row.end;
            return inRow && box_[other] == sliver.box + step ? other : none;
        }
        const RowOfSeeds& own = rows_[sliver.row];
        const Index layer = own.layer + (face >= 4 ? step : 0), row = own.row + (face < 4 ? step : 0);
        const auto at =
            std::lower_bound(rows_.begin(), rows_.end(), std::pair(layer, row),
                             [](const RowOfSeeds& r, const auto& key) { return std::pair(r.layer, r.row) < key; });
        if (at == rows_.end() || at->layer != layer || at->row != row)
            return none;
        // Rows of a jittered lattice are shifted against each other by less than a box.
        const auto from = box_.begin() + std::ptrdiff_t(at->begin), to = box_.begin() + std::ptrdiff_t(at->end);
        std::size_t best = none;
        double nearest = std::numeric_limits<double>::infinity();
        for (auto b = std::lower_bound(from, to, sliver.box - 1); b != to && *b <= sliver.box + 1; ++b)
        {
            const std::size_t other = std::size_t(b - box_.begin());
            const double distance = std::abs(original[other].centre[0] - original[sliver.seed].centre[0]);
            if (distance < nearest)
                nearest = distance, best = other;
        }
        return best;
    }

    int dim_;
    double fraction_;
    std::vector<Seed> seeds_;
    std::vector<Index> box_;
    std::vector<double> boxVolume_;
    std::vector<RowOfSeeds> rows_;
    std::vector<Sliver> slivers_;
};
} // namespace

RegionSeeds seedRegion(const geometry::Region& region, const BoxLattice& lattice, double sliverFraction,
                       const geometry::Region::Row& visit)
{
    const double boxVolume = std::pow(lattice.spacing(), region.dim());
    const double most = 1e9; // a wrong unit is noticed elsewhere, not by running out of memory here
    Merger merger(region.dim(), sliverFraction, std::size_t(std::min(most, 1.05 * region.volume() / boxVolume + 1000)));
    region.forEachRow(lattice, [&](Index row, Index layer, const std::vector<BoxPart>& parts) {
        merger.addRow(row, layer, parts, lattice.jittered() ? 0 : lattice.spacing());
        if (visit)
            visit(row, layer, parts);
    });
    return merger.finish();
}
} // namespace mpm::seeding
