#include "treatment/volumetricAveraging.hpp"

namespace mpm::treatment
{
void CellAverage::build(const state::TileGrid& grid)
{
    dim_ = grid.dim();
    blocks_.clear();
    blocks_.resize(grid.blocks().size());
    std::size_t cells = 0;
    for (const auto& block : grid.blocks())
        cells = std::max(cells, block.start + std::size_t(block.box.size()));
    for (auto* column : {&volume_, &content_, &perHat_, &weighted_})
        column->assign(cells, 0.0);
    const int count = int(blocks_.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int b = 0; b < count; ++b)
    {
        const state::Block& from = grid.blocks()[std::size_t(b)];
        Block& block = blocks_[std::size_t(b)];
        block.box = from.box;
        block.start = from.start;
        const Index depth = dim_ == 3 ? 1 : 0;
        for (Index k = -depth; k < block.box.n[2] + depth; ++k)
            for (Index j = -1; j <= block.box.n[1]; ++j)
                for (Index i = -1; i <= block.box.n[0]; ++i)
                {
                    const std::array<Index, 3> node{block.box.lo[0] + i, block.box.lo[1] + j, block.box.lo[2] + k};
                    block.around.push_back(block.box.contains(node[0], node[1], node[2])
                                               ? std::int32_t(block.start) +
                                                     std::int32_t(block.box.offset(node[0], node[1], node[2]))
                                               : std::int32_t(grid.place(node[0], node[1], node[2])));
                }
    }
}

void CellAverage::takeMeans()
{
#pragma omp parallel for schedule(static)
    for (Index c = 0; c < Index(content_.size()); ++c)
    {
        const auto i = std::size_t(c);
        content_[i] = volume_[i] > 0 ? content_[i] / volume_[i] : 0;
    }
}

void CellAverage::weighHats()
{
    addHats(volume_, perHat_);
    for (std::size_t i = 0; i < perHat_.size(); ++i)
        perHat_[i] = volume_[i] > 0 ? 1 / perHat_[i] : 0;
}

void CellAverage::average(int hats)
{
    takeMeans();
    if (hats > 0)
        weighHats();
    for (int r = 0; r < hats; ++r)
    {
        for (std::size_t i = 0; i < content_.size(); ++i)
            weighted_[i] = volume_[i] * content_[i];
        addHats(weighted_, content_);
        for (std::size_t i = 0; i < content_.size(); ++i)
            content_[i] *= perHat_[i];
    }
}

void CellAverage::averageAdjoint(int hats)
{
    takeMeans();
    if (hats > 0)
        weighHats();
    for (int r = 0; r < hats; ++r)
    {
        for (std::size_t i = 0; i < content_.size(); ++i)
            weighted_[i] = volume_[i] * content_[i] * perHat_[i];
        addHats(weighted_, content_);
    }
}

/// The hats are products over axes: (1 2 1) along x, then y, then z.
void CellAverage::addHats(const std::vector<double>& in, std::vector<double>& out) const
{
    const int count = int(blocks_.size());
#pragma omp parallel
    {
        std::vector<double> cells, sums;
#pragma omp for schedule(dynamic, 4)
        for (int b = 0; b < count; ++b)
        {
            const Block& block = blocks_[std::size_t(b)];
            cells.resize(block.around.size());
            for (std::size_t i = 0; i < cells.size(); ++i)
                cells[i] = block.around[i] >= 0 ? in[std::size_t(block.around[i])] : 0;
            const auto& n = block.box.n;
            std::size_t nx = std::size_t(n[0]), rows = cells.size() / (nx + 2);
            sums.resize(rows * nx);
            for (std::size_t r = 0; r < rows; ++r)
            {
                const double* row = cells.data() + r * (nx + 2);
                for (std::size_t i = 0; i < nx; ++i)
                    sums[r * nx + i] = row[i] + 2 * row[i + 1] + row[i + 2];
            }
            const std::size_t ny = std::size_t(n[1]), layers = rows / (ny + 2);
            cells.resize(layers * ny * nx);
            for (std::size_t k = 0; k < layers; ++k)
                for (std::size_t j = 0; j < ny; ++j)
                    for (std::size_t i = 0; i < nx; ++i)
                    {
                        const double* at = sums.data() + (k * (ny + 2) + j) * nx + i;
                        cells[(k * ny + j) * nx + i] = at[0] + 2 * at[nx] + at[2 * nx];
                    }
            double* to = out.data() + block.start;
            const std::size_t layer = ny * nx;
            for (std::size_t c = 0; c < std::size_t(n[2]) * layer; ++c)
                to[c] = dim_ == 3 ? cells[c] + 2 * cells[c + layer] + cells[c + 2 * layer] : cells[c];
        }
    }
}
} // namespace mpm::treatment
