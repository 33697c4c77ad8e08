#include "case/accuracyFit.hpp"

#include "base/error.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mpm::cases
{
namespace
{
constexpr double reach = 1.6; ///< [spacings] how far particles have a say

using Cell = std::array<long, 3>;

/// Particles by the box of one spacing they are in.
class Neighbours
{
  public:
    explicit Neighbours(const Sample& from) : from_(from)
    {
        for (std::size_t i = 0; i < from.X.size(); ++i)
            boxes_[cellOf(from.X[i])].push_back(i);
    }

    /// Indices within `radius` spacings.
    std::vector<std::size_t> near(const Vector3& x, long radius) const
    {
        std::vector<std::size_t> out;
        const Cell middle = cellOf(x);
        const long deep = from_.dim == 3 ? radius : 0;
        for (long k = -deep; k <= deep; ++k)
            for (long j = -radius; j <= radius; ++j)
                for (long i = -radius; i <= radius; ++i)
                    if (const auto box = boxes_.find({middle[0] + i, middle[1] + j, middle[2] + k});
                        box != boxes_.end())
                        out.insert(out.end(), box->second.begin(), box->second.end());
        return out;
    }

  private:
    Cell cellOf(const Vector3& x) const
    {
        Cell out{};
        for (std::size_t a = 0; a < std::size_t(from_.dim); ++a)
            out[a] = std::lround(std::floor(x[a] / from_.spacing));
        return out;
    }

    const Sample& from_;
    std::map<Cell, std::vector<std::size_t>> boxes_;
};

double squaredDistance(const Vector3& a, const Vector3& b)
{
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// The weighted normal equations of a linear function, one right-hand side a component.
class LinearFit
{
  public:
    LinearFit(int dim, int components) : unknowns_(std::size_t(dim) + 1), right_(std::size_t(components)) {}

    void add(const std::array<double, 4>& basis, const double* values, double weight)
    {
        for (std::size_t r = 0; r < unknowns_; ++r)
        {
            for (std::size_t c = 0; c < unknowns_; ++c)
                matrix_[r][c] += weight * basis[r] * basis[c];
            for (std::size_t k = 0; k < right_.size(); ++k)
                right_[k][r] += weight * basis[r] * values[k];
        }
    }

    /// The function's value at the middle, for each component. Where particles stand on a line, or there are too few,
    /// the slope nobody knows is zero: that is what the small number on the diagonal does.
    std::vector<double> value()
    {
        constexpr double small = 1e-12;
        const double first = matrix_[0][0];
        for (std::size_t r = 1; r < unknowns_; ++r)
            matrix_[r][r] += small * first;
        for (std::size_t p = unknowns_; p-- > 1;) // eliminates all but the first unknown; the matrix is positive
            for (std::size_t r = 0; r < p; ++r)
            {
                const double factor = matrix_[r][p] / matrix_[p][p];
                for (std::size_t c = 0; c < p; ++c)
                    matrix_[r][c] -= factor * matrix_[p][c];
                for (auto& right : right_)
                    right[r] -= factor * right[p];
            }
        std::vector<double> out;
        for (const auto& right : right_)
            out.push_back(right[0] / matrix_[0][0]);
        return out;
    }

  private:
    std::size_t unknowns_;
    std::array<std::array<double, 4>, 4> matrix_{};
    std::vector<std::array<double, 4>> right_;
};
} // namespace

std::vector<double> fitAt(const Sample& from, const std::vector<Vector3>& positions)
{
    const Neighbours neighbours(from);
    std::vector<double> out;
    out.reserve(positions.size() * std::size_t(from.components));
    for (const Vector3& x : positions)
    {
        LinearFit fit(from.dim, from.components);
        bool any = false;
        for (const std::size_t i : neighbours.near(x, 2))
        {
            const double root = 1 - std::sqrt(squaredDistance(from.X[i], x)) / (reach * from.spacing);
            if (root <= 0)
                continue;
            std::array<double, 4> basis{1};
            for (std::size_t a = 0; a < std::size_t(from.dim); ++a)
                basis[1 + a] = (from.X[i][a] - x[a]) / from.spacing;
            fit.add(basis, &from.values[i * std::size_t(from.components)], root * root);
            any = true;
        }
        if (!any)
            throw InputError(fmt::format("found no particle of the finest run near the material position ({:g} {:g} "
                                         "{:g})",
                                         x[0], x[1], x[2]));
        for (const double value : fit.value())
            out.push_back(value);
    }
    return out;
}
} // namespace mpm::cases
