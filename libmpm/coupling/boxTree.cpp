#include "coupling/boxTree.hpp"

#include <numeric>

namespace mpm::coupling
{
BoxTree::BoxTree(std::vector<Box> items) : order_(items.size())
{
    std::iota(order_.begin(), order_.end(), Index(0));
    if (!items.empty())
        make(items, 0, Index(items.size()));
}

Index BoxTree::make(const std::vector<Box>& items, Index first, Index count)
{
    Node node{items[std::size_t(order_[std::size_t(first)])], first, count};
    for (Index n = first; n < first + count; ++n)
        for (std::size_t a = 0; a < 3; ++a)
        {
            const Box& item = items[std::size_t(order_[std::size_t(n)])];
            node.box.low[a] = std::min(node.box.low[a], item.low[a]);
            node.box.high[a] = std::max(node.box.high[a], item.high[a]);
        }
    const Index me = Index(nodes_.size());
    nodes_.push_back(node);
    if (count <= 4)
        return me;
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (node.box.high[a] - node.box.low[a] > node.box.high[axis] - node.box.low[axis])
            axis = a;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](Index e, Index f) {
        const Box &a = items[std::size_t(e)], &b = items[std::size_t(f)];
        const double x = a.low[axis] + a.high[axis], y = b.low[axis] + b.high[axis];
        return x < y || (x == y && e < f);
    });
    const Index left = make(items, first, count / 2), right = make(items, first + count / 2, count - count / 2);
    nodes_[std::size_t(me)].left = left;
    nodes_[std::size_t(me)].right = right;
    return me;
}
} // namespace mpm::coupling
