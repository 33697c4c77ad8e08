#include "smoothing/weightTable.hpp"

#include "base/error.hpp"
#include "constitutive/kinematics.hpp"
#include "shape/cpGIMP.hpp"
#include "shape/linear.hpp"
#include "shape/uGIMP.hpp"

#include <algorithm>
#include <fmt/format.h>

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

/// The box of lattice nodes that supports may touch.
template <int dim, class Shape>
class NodeBox
{
  public:
    explicit NodeBox(const state::State& state) : grid_(state.grid)
    {
        const auto& p = state.particles;
        for (int a = 0; a < dim; ++a)
        {
            const auto& x = p.x[std::size_t(a)];
            const auto [low, high] = std::minmax_element(x.begin(), x.begin() + p.size());
            first_[std::size_t(a)] =
                shape::firstNode<Shape::nodes>(*low, grid_.origin[std::size_t(a)], 1 / grid_.h) - 1;
            count_[std::size_t(a)] = shape::firstNode<Shape::nodes>(*high, grid_.origin[std::size_t(a)], 1 / grid_.h) +
                                     Shape::nodes + 1 - first_[std::size_t(a)];
        }
    }
    Index index(const std::array<Index, 3>& node) const
    {
        Index out = 0;
        for (int a = dim - 1; a >= 0; --a)
            out = out * count_[std::size_t(a)] + node[std::size_t(a)] - first_[std::size_t(a)];
        return out;
    }
    std::vector<Vector3> positions() const
    {
        std::vector<Vector3> out;
        for (Index k = 0; k < count_[2]; ++k)
            for (Index j = 0; j < count_[1]; ++j)
                for (Index i = 0; i < count_[0]; ++i)
                {
                    Vector3 x{};
                    const std::array<Index, 3> node{i, j, k};
                    for (std::size_t a = 0; a < std::size_t(dim); ++a)
                        x[a] = grid_.origin[a] + grid_.h * double(first_[a] + node[a]);
                    out.push_back(x);
                }
        return out;
    }

  private:
    const state::GridBox& grid_;
    std::array<Index, 3> first_{}, count_{1, 1, 1};
};

template <int dim, class Shape>
WeightTable fill(const state::State& state)
{
    constexpr int n = Shape::nodes;
    const auto& p = state.particles;
    const auto& grid = state.grid;
    const NodeBox<dim, Shape> box(state);
    WeightTable table;
    table.position = box.positions();
    shape::AxisWeights<n> w[dim];
    alignas(64) double lambda[dim][lanes];
    for (Index first = 0; first < p.size(); first += lanes)
    {
        domains<dim, Shape>(p, grid.h, first, lambda);
        for (int a = 0; a < dim; ++a)
            Shape::evaluate(p.x[std::size_t(a)].data() + first, lambda[a], grid.origin[std::size_t(a)], 1 / grid.h,
                            w[a]);
        for (int l = 0; l < std::min<Index>(lanes, p.size() - first); ++l)
        {
            for (int k = 0; k < (dim == 3 ? n : 1); ++k)
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                    {
                        double weight = w[0].N[i][l] * w[1].N[j][l];
                        std::array<Index, 3> node{w[0].base[l] + i, w[1].base[l] + j, 0};
                        if constexpr (dim == 3)
                        {
                            weight *= w[2].N[k][l];
                            node[2] = w[2].base[l] + k;
                        }
                        table.add(box.index(node), weight);
                    }
            table.endRow();
        }
    }
    return table;
}

template <int dim>
WeightTable fillBy(const state::State& state, const std::string& shape)
{
    if (shape == "linear")
        return fill<dim, shape::Linear>(state);
    if (shape == "uGIMP")
        return fill<dim, shape::UGIMP>(state);
    return fill<dim, shape::CpGIMP>(state);
}
} // namespace

const std::vector<std::string>& shapeNames()
{
    static const std::vector<std::string> names{"linear", "uGIMP", "cpGIMP"};
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
