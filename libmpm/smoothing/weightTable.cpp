#include "smoothing/weightTable.hpp"

#include "base/error.hpp"
#include "constitutive/kinematics.hpp"
#include "shape/cpGIMP.hpp"
#include "shape/cubicBSpline.hpp"
#include "shape/linear.hpp"
#include "shape/quadraticBSpline.hpp"
#include "shape/uGIMP.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace mpm::smoothing
{
namespace
{
/// Half lengths over h of one chunk's domains, as the solver takes them: initial edges or edges that follow the
/// stretch, not wider than the support allows.
template <int dim, class Shape>
void domains(const state::Particles& p, double h, Index first, double (&lambda)[dim][lanes])
{
    constitutive::TensorLanes<dim> F;
    double stretch[dim][lanes];
    for (int k = 0; k < dim * dim; ++k)
        std::copy_n(p.F[std::size_t(k)].data() + first, lanes, F[k]);
    constitutive::stretchDiagonal(F, stretch);
    for (int a = 0; a < dim; ++a)
        for (int l = 0; l < lanes; ++l)
        {
            const double half = 0.5 * p.length0[std::size_t(a)][std::size_t(first + l)] / h;
            lambda[a][l] =
                std::min(Shape::followsStretch ? 1.0 : 0.5, Shape::followsStretch ? half * stretch[a][l] : half);
        }
}

/// Lattice nodes as numbers that grow along x, then y, then z; the box they count in holds all supports.
template <int dim, class Shape>
class NodeKeys
{
  public:
    explicit NodeKeys(const state::State& state) : grid_(state.grid)
    {
        const auto& p = state.particles;
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            const auto [low, high] = std::minmax_element(p.x[a].begin(), p.x[a].begin() + p.size());
            first_[a] = shape::firstNode<Shape::nodes>(*low, grid_.origin[a], 1 / grid_.h) - 1;
            count_[a] =
                shape::firstNode<Shape::nodes>(*high, grid_.origin[a], 1 / grid_.h) + Shape::nodes + 1 - first_[a];
        }
    }
    Index stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? count_[0] : count_[0] * count_[1]; }
    Index key(const std::array<Index, 3>& node) const
    {
        Index out = 0;
        for (int a = dim - 1; a >= 0; --a)
            out = out * count_[std::size_t(a)] + node[std::size_t(a)] - first_[std::size_t(a)];
        return out;
    }
    /// The same node for all images of it; `key` itself where no axis is periodic.
    Index original(Index key) const
    {
        std::array<Index, 3> node{};
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            node[a] = first_[a] + key % count_[a];
            key /= count_[a];
            if (grid_.periodic[a])
                node[a] -= grid_.cells[a] * Index(std::floor(double(node[a]) / double(grid_.cells[a])));
        }
        return (node[2] * (Index(1) << 20) + node[1]) * (Index(1) << 20) + node[0];
    }
    bool periodic() const { return grid_.periodic[0] || grid_.periodic[1] || grid_.periodic[2]; }
    Vector3 position(Index key) const
    {
        Vector3 x{};
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            x[a] = grid_.origin[a] + grid_.h * double(first_[a] + key % count_[a]);
            key /= count_[a];
        }
        return x;
    }

  private:
    const state::GridBox& grid_;
    std::array<Index, 3> first_{}, count_{1, 1, 1};
};

/// Ascending keys, and with each those of the n - 1 nodes that follow it along an axis.
std::vector<Index> spread(const std::vector<Index>& keys, int n, Index stride)
{
    std::vector<Index> all = keys, shifted(keys.size()), next;
    for (int s = 1; s < n; ++s)
    {
        std::transform(keys.begin(), keys.end(), shifted.begin(), [&](Index key) { return key + s * stride; });
        next.clear();
        next.reserve(all.size() + keys.size());
        std::set_union(all.begin(), all.end(), shifted.begin(), shifted.end(), std::back_inserter(next));
        std::swap(all, next);
    }
    return all;
}

/// Numbers the nodes of all supports. On entry cell[p] is the place of p's first node in `corners`, which may hold a
/// node several times; afterwards that of its support in `rows`.
template <int dim, class Shape>
void numberNodes(const NodeKeys<dim, Shape>& keys, const std::vector<Index>& corners, WeightTable& table)
{
    constexpr int n = Shape::nodes;
    std::vector<std::pair<Index, std::int32_t>> byKey;
    byKey.reserve(corners.size());
    for (std::size_t c = 0; c < corners.size(); ++c)
        byKey.emplace_back(corners[c], std::int32_t(c));
    if (!std::is_sorted(byKey.begin(), byKey.end()))
        std::sort(byKey.begin(), byKey.end());
    std::vector<Index> supports;
    std::vector<std::int32_t> place(corners.size());
    for (const auto& [key, c] : byKey)
    {
        if (supports.empty() || supports.back() != key)
            supports.push_back(key);
        place[std::size_t(c)] = std::int32_t(supports.size() - 1);
    }
    byKey = {};
    for (auto& cell : table.cell)
        cell = place[std::size_t(cell)];

    std::vector<Index> nodes = supports;
    for (int a = 0; a < dim; ++a)
        nodes = spread(nodes, n, keys.stride(a));
    constexpr std::size_t perSupport = dim == 3 ? n * n : n;
    table.rows.resize(supports.size() * perSupport);
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
        {
            std::size_t node = 0; // both lists ascend
            for (std::size_t s = 0; s < supports.size(); ++s)
            {
                const Index wanted = supports[s] + j * keys.stride(1) + k * keys.stride(2);
                while (nodes[node] != wanted)
                    ++node;
                table.rows[s * perSupport + std::size_t(k * n + j)] = Index(node);
            }
        }
    table.position.reserve(nodes.size());
    for (const Index key : nodes)
        table.position.push_back(keys.position(key));
    if (!keys.periodic())
        return;
    std::map<Index, std::vector<Index>> images;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        images[keys.original(nodes[n])].push_back(Index(n));
    for (auto& [node, group] : images)
        if (group.size() > 1)
            table.images.push_back(std::move(group));
}

template <int dim, class Shape>
WeightTable fill(const state::State& state)
{
    constexpr int n = Shape::nodes;
    static_assert(n >= 2 && n <= 4, "the table walks supports of two to four nodes an axis");
    const auto& p = state.particles;
    const auto& grid = state.grid;
    const NodeKeys<dim, Shape> keys(state);
    WeightTable table;
    table.dim = dim;
    table.nodesPerAxis = n;
    table.cell.resize(std::size_t(p.size()));
    table.weight.resize(std::size_t(p.size() * dim * n));
    std::vector<Index> corners; // first nodes of the particles, repetitions left out
    shape::AxisWeights<n> w[dim];
    alignas(64) double lambda[dim][lanes];
    double* out = table.weight.data();
    for (Index first = 0; first < p.size(); first += lanes)
    {
        domains<dim, Shape>(p, grid.h, first, lambda);
        for (int a = 0; a < dim; ++a)
            Shape::evaluate(p.x[std::size_t(a)].data() + first, lambda[a], grid.origin[std::size_t(a)], 1 / grid.h,
                            w[a]);
        for (int l = 0; l < std::min<Index>(lanes, p.size() - first); ++l)
        {
            std::array<Index, 3> corner{};
            for (int a = 0; a < dim; ++a)
            {
                corner[std::size_t(a)] = w[a].base[l];
                for (int i = 0; i < n; ++i)
                    *out++ = w[a].N[i][l];
            }
            const Index key = keys.key(corner);
            if (corners.empty() || corners.back() != key)
                corners.push_back(key);
            table.cell[std::size_t(first + l)] = std::int32_t(corners.size() - 1);
        }
    }
    numberNodes(keys, corners, table);
    return table;
}

template <int dim>
WeightTable fillBy(const state::State& state, const std::string& shape)
{
    if (shape == "linear")
        return fill<dim, shape::Linear>(state);
    if (shape == "uGIMP")
        return fill<dim, shape::UGIMP>(state);
    if (shape == "quadraticBSpline")
        return fill<dim, shape::QuadraticBSpline>(state);
    if (shape == "cubicBSpline")
        return fill<dim, shape::CubicBSpline>(state);
    return fill<dim, shape::CpGIMP>(state);
}
} // namespace

const std::vector<std::string>& shapeNames()
{
    static const std::vector<std::string> names{"linear",           "uGIMP",       "cpGIMP", "CPDI",
                                                "quadraticBSpline", "cubicBSpline"};
    return names;
}

WeightTable weightTable(const state::State& state, const std::string& shape)
{
    const auto& names = shapeNames();
    if (std::find(names.begin(), names.end(), shape) == names.end())
        throw InputError(fmt::format("shape: found {}, allowed {}", shape, joinWords(names)));
    if (!(state.grid.h > 0))
        throw InputError("the state has no grid yet");
    const auto& p = state.particles;
    for (Index i = 0; i < p.size(); ++i)
    {
        Vector3 x{};
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
            x[a] = p.x[a][std::size_t(i)];
        if (!state.grid.contains(x))
            throw InputError(fmt::format("particle with id {} lies outside the grid", p.id[std::size_t(i)]));
    }
    if (p.size() == 0)
        return {};
    return p.dim == 2 ? fillBy<2>(state, shape) : fillBy<3>(state, shape);
}
} // namespace mpm::smoothing
