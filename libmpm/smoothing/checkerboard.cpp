#include "smoothing/checkerboard.hpp"

#include "base/error.hpp"

#include <cmath>
#include <Eigen/Dense>
#include <optional>
#include <unordered_map>

namespace mpm::smoothing
{
namespace
{
template <int dim>
class Cells
{
  public:
    Cells(const state::State& state, const std::vector<double>& values) : grid_(state.grid)
    {
        const auto& p = state.particles;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            Place place;
            Local local;
            local[0] = 1;
            for (std::size_t a = 0; a < dim; ++a)
            {
                const double s = (p.x[a][i] - grid_.origin[a]) / grid_.h;
                place[a] = Index(std::floor(s));
                local[Eigen::Index(a) + 1] = s - double(place[a]) - 0.5;
            }
            Sums& own = cells_[key(place)];
            own.place = place;
            own.volume += p.volume[i];
            own.basis += p.mass[i] * local * local.transpose();
            own.value += p.mass[i] * values[i] * local;
        }
    }

    Checkerboard measure() const
    {
        std::vector<double> rest;
        double pattern = 0, square = 0, sum = 0;
        for (const auto& [number, own] : cells_)
            if (const auto found = patternAt(own))
            {
                const auto [q, P] = *found;
                pattern += q * q;
                square += P * P;
                rest.push_back(P - q);
                sum += P - q;
            }
        Checkerboard out;
        out.cells = Index(rest.size());
        if (rest.empty())
        {
            out.share = out.amplitude = std::nan("");
            return out;
        }
        const double mean = sum / double(rest.size());
        double variance = pattern;
        for (const double r : rest)
            variance += (r - mean) * (r - mean);
        constexpr double roundOff = 1e-24;
        out.share = variance > roundOff * square ? pattern / variance : 0;
        out.amplitude = square > 0 ? std::sqrt(pattern / square) : 0;
        return out;
    }

  private:
    using Place = std::array<Index, dim>;
    using Local = Eigen::Matrix<double, dim + 1, 1>; ///< 1 and the place in the cell from its centre, over h
    using Basis = Eigen::Matrix<double, dim + 1, dim + 1>;
    struct Sums
    {
        Place place{};
        double volume = 0;
        Basis basis = Basis::Zero(); ///< sum m (1, d)(1, d)^T
        Local value = Local::Zero(); ///< sum m value (1, d)
    };

    Index key(Place place) const
    {
        Index out = 0;
        for (std::size_t a = 0; a < dim; ++a)
        {
            if (grid_.periodic[a])
                place[a] = (place[a] % grid_.cells[a] + grid_.cells[a]) % grid_.cells[a];
            out = (out << 20) + place[a];
        }
        return out;
    }

    const Sums* full(const Place& place) const
    {
        const auto found = cells_.find(key(place));
        return found != cells_.end() && found->second.volume >= 0.5 * std::pow(grid_.h, dim) ? &found->second : nullptr;
    }

    /// q and P of a cell; nothing if it is not inside.
    std::optional<std::pair<double, double>> patternAt(const Sums& own) const
    {
        for (std::size_t a = 0; a < dim; ++a)
            if (grid_.periodic[a] && grid_.cells[a] < 3)
                return {};
        constexpr int block = dim == 2 ? 9 : 27;
        std::array<const Sums*, block> around;
        std::array<double, block> factor;
        Basis basis = Basis::Zero();
        Local value = Local::Zero();
        for (int n = 0; n < block; ++n)
        {
            const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            Place place = own.place;
            Basis move = Basis::Identity(); // (1, d + step) = move (1, d)
            factor[std::size_t(n)] = 1;
            for (std::size_t a = 0; a < dim; ++a)
            {
                place[a] += step[a];
                move(Eigen::Index(a) + 1, 0) = step[a];
                factor[std::size_t(n)] *= step[a] == 0 ? 0.5 : -0.25;
            }
            const Sums* there = full(place);
            if (!there)
                return {};
            around[std::size_t(n)] = there;
            basis += move * there->basis * move.transpose();
            value += move * there->value;
        }
        const Local fit = basis.ldlt().solve(value);
        // the filter takes g . (place of the cell) away by itself
        const auto centred = [&fit](const Sums& cell) {
            double out = cell.value[0];
            for (int a = 1; a <= dim; ++a)
                out -= fit[a] * cell.basis(0, a);
            return out / cell.basis(0, 0);
        };
        double q = 0;
        for (std::size_t n = 0; n < block; ++n)
            q += factor[n] * centred(*around[n]);
        return std::pair{q, centred(own)};
    }

    const state::GridBox& grid_;
    std::unordered_map<Index, Sums> cells_;
};
} // namespace

Checkerboard checkerboard(const state::State& state, const std::vector<double>& values)
{
    if (!(state.grid.h > 0))
        throw InputError("the state has no grid yet");
    return state.particles.dim == 2 ? Cells<2>(state, values).measure() : Cells<3>(state, values).measure();
}

Checkerboard checkerboard(const state::State& state)
{
    const auto& p = state.particles;
    std::vector<double> pressure(std::size_t(p.size()));
    for (std::size_t i = 0; i < pressure.size(); ++i)
        pressure[i] = -(double(p.stress[0][i]) + double(p.stress[1][i]) + double(p.stress[2][i])) / 3;
    return checkerboard(state, pressure);
}
} // namespace mpm::smoothing
