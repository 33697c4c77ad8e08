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
    for (auto* column : {&volume_, &content_, &weighted_})
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
                                               : std::int32_t(grid.place(node[0], node[1], node[2], from.body)));
                }
    }
}

template <class Work>
void CellAverage::forEachBlock(Work&& work)
{
    const int count = int(blocks_.size());
#pragma omp parallel
    {
        std::vector<double> values;
#pragma omp for schedule(dynamic, 4)
        for (int b = 0; b < count; ++b)
            work(blocks_[std::size_t(b)], values);
    }
}

void CellAverage::gather(const Block& block, const std::vector<double>& from, std::vector<double>& cells) const
{
    cells.resize(block.around.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
        cells[i] = block.around[i] >= 0 ? from[std::size_t(block.around[i])] : 0;
}

/// Along one axis after the other, in place.
void CellAverage::addPairs(std::vector<double>& values, std::array<std::size_t, 3> n) const
{
    std::size_t stride = 1;
    for (int a = 0; a < dim_; ++a)
    {
        const auto axis = std::size_t(a);
        const std::size_t outer = values.size() / (stride * n[axis]);
        for (std::size_t o = 0; o < outer; ++o)
        {
            const double* in = values.data() + o * stride * n[axis];
            double* out = values.data() + o * stride * (n[axis] - 1);
            for (std::size_t i = 0; i < stride * (n[axis] - 1); ++i)
                out[i] = in[i] + in[i + stride];
        }
        values.resize(outer * stride * (n[axis] - 1));
        stride *= n[axis] - 1;
    }
}

void CellAverage::average(int hats)
{
    for (std::size_t i = 0; i < content_.size(); ++i)
        content_[i] = volume_[i] > 0 ? content_[i] / volume_[i] : 0;
    if (hats == 0)
        return;
    const auto sides = [&](const Block& block, std::size_t more) {
        std::array<std::size_t, 3> n{1, 1, 1};
        for (std::size_t a = 0; a < std::size_t(dim_); ++a)
            n[a] = std::size_t(block.box.n[a]) + more;
        return n;
    };
    forEachBlock([&](Block& block, std::vector<double>& values) {
        gather(block, volume_, values);
        addPairs(values, sides(block, 2));
        block.perNode.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            block.perNode[i] = values[i] > 0 ? 1 / values[i] : 0;
    });
    const double share = dim_ == 2 ? 0.25 : 0.125;
    for (int r = 0; r < hats; ++r)
    {
        for (std::size_t i = 0; i < content_.size(); ++i)
            weighted_[i] = volume_[i] * content_[i];
        forEachBlock([&](Block& block, std::vector<double>& values) {
            gather(block, weighted_, values);
            addPairs(values, sides(block, 2));
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] *= block.perNode[i];
            addPairs(values, sides(block, 1));
            double* to = content_.data() + block.start;
            const double* volume = volume_.data() + block.start;
            for (std::size_t i = 0; i < values.size(); ++i)
                to[i] = volume[i] > 0 ? share * values[i] : 0;
        });
    }
}
} // namespace mpm::treatment
