#include "smoothing/overburden.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::smoothing
{
Overburden::Overburden(const state::State& state, const Vector3& gravity)
    : dim_(state.particles.dim), width_(state.grid.h), origin_(state.grid.origin)
{
    if (!defined(gravity, dim_))
        throw InputError(fmt::format("overburden needs gravity along one axis, found ({:g} {:g} {:g})", gravity[0],
                                     gravity[1], gravity[2]));
    up_ = int(std::find_if(gravity.begin(), gravity.end(), [](double g) { return g != 0; }) - gravity.begin());
    if (!(width_ > 0))
        throw InputError("overburden needs the state's grid");
    g_ = std::abs(gravity[std::size_t(up_)]);
    sign_ = gravity[std::size_t(up_)] < 0 ? 1 : -1;
    area_ = dim_ == 2 ? width_ : width_ * width_;
    for (Index p = 0; p < state.particles.size(); ++p)
        addParticle(state, p);
    for (auto& [cell, column] : columns_)
        std::sort(column.begin(), column.end(), [](const Share& a, const Share& b) { return a.top > b.top; });
}

bool Overburden::defined(const Vector3& gravity, int dim)
{
    const auto isZero = [](double g) { return g == 0; };
    return std::count_if(gravity.begin(), gravity.end(), isZero) == 2 &&
           std::count_if(gravity.begin(), gravity.begin() + dim, isZero) == dim - 1;
}

void Overburden::addParticle(const state::State& state, Index particle)
{
    const auto& p = state.particles;
    const auto i = std::size_t(particle);
    Vector3 edge[3]{};
    int parts[3] = {1, 1, 1};
    double thickness = 0; // height of a part
    for (int k = 0; k < dim_; ++k)
    {
        double reach = 0;
        for (int a = 0; a < dim_; ++a)
        {
            edge[k][std::size_t(a)] = p.F[std::size_t(a * dim_ + k)][i] * p.length0[std::size_t(k)][i];
            if (a != up_)
                reach += std::abs(edge[k][std::size_t(a)]);
        }
        parts[k] = std::clamp(int(std::ceil(8 * reach / width_ - 1e-9)), 1, 64);
        thickness += std::abs(edge[k][std::size_t(up_)]) / parts[k];
    }
    const double partMass = p.mass[i] / (parts[0] * parts[1] * parts[2]);

    std::map<Cell, Share> shares;
    for (int c = 0; c < parts[2]; ++c)
        for (int b = 0; b < parts[1]; ++b)
            for (int a = 0; a < parts[0]; ++a)
            {
                const int number[3] = {a, b, c};
                Vector3 x{};
                for (int axis = 0; axis < dim_; ++axis)
                {
                    const auto d = std::size_t(axis);
                    x[d] = p.x[d][i];
                    for (int k = 0; k < dim_; ++k)
                        x[d] += edge[k][d] * ((number[k] + 0.5) / parts[k] - 0.5);
                }
                Cell cell{};
                for (int axis = 0, j = 0; axis < dim_; ++axis)
                    if (axis != up_)
                        cell[std::size_t(j++)] =
                            Index(std::floor((x[std::size_t(axis)] - origin_[std::size_t(axis)]) / width_));
                const double height = sign_ * x[std::size_t(up_)];
                auto& share = shares.try_emplace(cell, Share{height, height, 0}).first->second;
                share.bottom = std::min(share.bottom, height - 0.5 * thickness);
                share.top = std::max(share.top, height + 0.5 * thickness);
                share.mass += partMass;
            }
    auto& own = sharesOf_.emplace_back();
    for (const auto& [cell, share] : shares)
    {
        columns_[cell].push_back(share);
        own.emplace_back(cell, share.mass);
    }
    height_.push_back(sign_ * p.x[std::size_t(up_)][i]);
}

double Overburden::massAbove(const std::vector<Share>& column, double height) const
{
    double mass = 0;
    for (const auto& share : column) // from the highest top down
    {
        if (share.top <= height)
            break;
        const double thickness = share.top - share.bottom;
        mass += thickness > 0 ? share.mass * std::min(1.0, (share.top - height) / thickness) : share.mass;
    }
    return mass;
}

double Overburden::stress(double massAbove) const
{
    return -g_ * massAbove / area_;
}

double Overburden::atParticle(Index p) const
{
    double sum = 0, mass = 0;
    for (const auto& [cell, share] : sharesOf_[std::size_t(p)])
    {
        sum += share * massAbove(columns_.at(cell), height_[std::size_t(p)]);
        mass += share;
    }
    return stress(sum / mass);
}

double Overburden::atPoint(const Vector3& x) const
{
    // On an edge both neighbours count; the slack absorbs the rounding of node positions.
    std::array<std::array<Index, 2>, 2> range{{{0, 0}, {0, 0}}};
    for (int axis = 0, j = 0; axis < dim_; ++axis)
    {
        if (axis == up_)
            continue;
        const double s = (x[std::size_t(axis)] - origin_[std::size_t(axis)]) / width_;
        range[std::size_t(j++)] = {Index(std::floor(s - 1e-9)), Index(std::floor(s + 1e-9))};
    }
    double sum = 0;
    int count = 0;
    for (Index a = range[0][0]; a <= range[0][1]; ++a)
        for (Index b = range[1][0]; b <= range[1][1]; ++b)
        {
            const auto found = columns_.find({a, b});
            if (found == columns_.end())
                continue;
            sum += massAbove(found->second, sign_ * x[std::size_t(up_)]);
            ++count;
        }
    return count > 0 ? stress(sum / count) : 0.0;
}
} // namespace mpm::smoothing
