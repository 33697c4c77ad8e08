#pragma once
/// The item nearest to a point, through a tree of boxes: of points, segments or triangles, whose distances the caller
/// knows. Of several as near, the first. (J. L. Bentley 1975, Commun. ACM 18, 509-517, for boxes instead of points.)
#include "base/types.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace mpm::coupling
{
class BoxTree
{
  public:
    struct Box
    {
        Vector3 low{}, high{};
    };
    struct Hit
    {
        Index item = -1;
        double distance2 = std::numeric_limits<double>::infinity();
    };

    BoxTree() = default;
    explicit BoxTree(std::vector<Box> items);

    /// distance2(item): the square of its distance from x, not less than that of its box.
    template <class Distance2>
    Hit nearest(const Vector3& x, Distance2 distance2) const
    {
        Hit best;
        std::array<Index, 128> stack{};
        std::size_t depth = nodes_.empty() ? 0 : 1;
        while (depth > 0)
        {
            const Node& node = nodes_[std::size_t(stack[--depth])];
            if (away(node.box, x) > best.distance2)
                continue;
            if (node.left < 0)
            {
                for (Index n = node.first; n < node.first + node.count; ++n)
                {
                    const Index item = order_[std::size_t(n)];
                    const double d = distance2(item);
                    if (d < best.distance2 || (d == best.distance2 && item < best.item))
                        best = {item, d};
                }
                continue;
            }
            const bool leftFirst =
                away(nodes_[std::size_t(node.left)].box, x) <= away(nodes_[std::size_t(node.right)].box, x);
            stack[depth++] = leftFirst ? node.right : node.left;
            stack[depth++] = leftFirst ? node.left : node.right;
        }
        return best;
    }

  private:
    struct Node
    {
        Box box;
        Index first = 0, count = 0; ///< items of a leaf, in the order of order_
        Index left = -1, right = -1;
    };
    static double away(const Box& box, const Vector3& x)
    {
        double sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
        {
            const double d = std::max({box.low[a] - x[a], 0.0, x[a] - box.high[a]});
            sum += d * d;
        }
        return sum;
    }
    Index make(const std::vector<Box>& items, Index first, Index count);

    std::vector<Node> nodes_;
    std::vector<Index> order_;
};
} // namespace mpm::coupling
