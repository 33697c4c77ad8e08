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
    const auto n = std::size_t(state.particles.size());
    lastColumn_ = columns_.end();
    height_.reserve(n);
    ownBegin_.reserve(n + 1);
    ownColumn_.reserve(n + n / 4);
    ownMass_.reserve(n + n / 4);
    for (Index p = 0; p < state.particles.size(); ++p)
    {
        makeShares(state, p);
        for (const auto& [cell, share] : made_)
        {
            ownColumn_.push_back(columnOf(cell));
            ownMass_.push_back(share.mass);
        }
        ownBegin_.push_back(ownColumn_.size());
        height_.push_back(sign_ * state.particles.x[std::size_t(up_)][std::size_t(p)]);
    }
    sortShares(state);
}

bool Overburden::defined(const Vector3& gravity, int dim)
{
    const auto isZero = [](double g) { return g == 0; };
    return std::count_if(gravity.begin(), gravity.end(), isZero) == 2 &&
           std::count_if(gravity.begin(), gravity.begin() + dim, isZero) == dim - 1;
}

void Overburden::makeShares(const state::State& state, Index particle)
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
            edge[k][std::size_t(a)] = double(p.F[std::size_t(a * dim_ + k)][i]) * double(p.length0[std::size_t(k)][i]);
            if (a != up_)
                reach += std::abs(edge[k][std::size_t(a)]);
        }
        parts[k] = std::clamp(int(std::ceil(8 * reach / width_ - 1e-9)), 1, 64);
        thickness += std::abs(edge[k][std::size_t(up_)]) / parts[k];
    }
    const double partMass = p.mass[i] / (parts[0] * parts[1] * parts[2]);

    made_.clear();
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
                addPart(cell, sign_ * x[std::size_t(up_)], thickness, partMass);
            }
    std::sort(made_.begin(), made_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

void Overburden::addPart(const Cell& cell, double height, double thickness, double mass)
{
    auto found = std::find_if(made_.rbegin(), made_.rend(), [&](const auto& made) { return made.first == cell; });
    if (found == made_.rend())
    {
        made_.emplace_back(cell, Share{height, height, 0});
        found = made_.rbegin();
    }
    Share& share = found->second;
    share.bottom = std::min(share.bottom, height - 0.5 * thickness);
    share.top = std::max(share.top, height + 0.5 * thickness);
    share.mass += mass;
}

/// Neighbours in memory are mostly in the same column.
std::int32_t Overburden::columnOf(const Cell& cell)
{
    if (lastColumn_ == columns_.end() || lastColumn_->first != cell)
        lastColumn_ = columns_.try_emplace(cell, std::int32_t(columns_.size())).first;
    return lastColumn_->second;
}

/// Makes the shares again instead of keeping them twice.
void Overburden::sortShares(const state::State& state)
{
    columnBegin_.assign(columns_.size() + 1, 0);
    for (const auto column : ownColumn_)
        ++columnBegin_[std::size_t(column) + 1];
    for (std::size_t c = 0; c < columns_.size(); ++c)
        columnBegin_[c + 1] += columnBegin_[c];
    shares_.resize(ownColumn_.size());
    massBefore_.resize(ownColumn_.size());
    thickest_.assign(columns_.size(), 0);
    auto next = columnBegin_;
    auto column = ownColumn_.begin();
    for (Index p = 0; p < state.particles.size(); ++p)
    {
        makeShares(state, p);
        for (const auto& [cell, share] : made_)
            shares_[next[std::size_t(*column++)]++] = share;
    }
    for (std::size_t c = 0; c < columns_.size(); ++c)
    {
        const auto from = std::ptrdiff_t(columnBegin_[c]), to = std::ptrdiff_t(columnBegin_[c + 1]);
        std::sort(shares_.begin() + from, shares_.begin() + to,
                  [](const Share& a, const Share& b) { return a.top > b.top; });
        double mass = 0;
        for (std::size_t s = columnBegin_[c]; s < columnBegin_[c + 1]; ++s)
        {
            massBefore_[s] = mass;
            mass += shares_[s].mass;
            thickest_[c] = std::max(thickest_[c], shares_[s].top - shares_[s].bottom);
        }
    }
}

double Overburden::massAbove(std::int32_t column, double height) const
{
    const auto c = std::size_t(column);
    const auto begin = shares_.begin() + std::ptrdiff_t(columnBegin_[c]);
    const auto end = shares_.begin() + std::ptrdiff_t(columnBegin_[c + 1]);
    // All with a top beyond `whole` lie above the height as a whole.
    const double whole = height + (1 + 1e-9) * thickest_[c];
    auto at = std::partition_point(begin, end, [&](const Share& share) { return share.top > whole; });
    if (at != begin)
        --at;
    double mass = massBefore_[std::size_t(at - shares_.begin())];
    for (; at != end && at->top > height; ++at)
    {
        const Share& share = *at;
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
    for (std::size_t s = ownBegin_[std::size_t(p)]; s < ownBegin_[std::size_t(p) + 1]; ++s)
    {
        sum += ownMass_[s] * massAbove(ownColumn_[s], height_[std::size_t(p)]);
        mass += ownMass_[s];
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
