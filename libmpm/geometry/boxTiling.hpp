#pragma once
/// A tiling of the grid by axis-aligned boxes, row by row: z planes cut layers, y planes cut a layer into rows, x
/// planes cut a row into boxes. Rows need not share their planes (jittered lattices), yet the boxes never overlap nor
/// leave gaps. In 2D there is one layer.
#include "base/types.hpp"

#include <vector>

namespace mpm::geometry
{
class BoxTiling
{
  public:
    virtual ~BoxTiling() = default;

    /// Ascending planes [m]; n boxes have n + 1 planes.
    virtual std::vector<double> zPlanes() const = 0;
    virtual std::vector<double> yPlanes(Index layer) const = 0;
    virtual void xPlanes(Index row, Index layer, std::vector<double>& planes) const = 0;
};
} // namespace mpm::geometry
