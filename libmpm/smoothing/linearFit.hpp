#pragma once
/// The linear fields that fit particle values best at each node: the operator `leastSquares` of stressTargets.hpp.
#include "smoothing/nodeSums.hpp"
#include "state/particles.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mpm::smoothing
{
template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;

/// 1/C on symmetric positive semidefinite matrices; eigenvalues below `least` take the ramp of stressTargets.hpp.
template <int dim>
Matrix<dim> boundedInverse(const Matrix<dim>& C, double least)
{
    // The smallest eigenvalue is at least det/trace^(dim - 1): far above the ramp, and of good condition?
    const double trace = C.trace();
    if (C.determinant() > 1e4 * least * (dim == 3 ? trace * trace : trace))
        return C.inverse();
    Matrix<dim> values = C, vectors = Matrix<dim>::Identity();
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b)
            {
                Eigen::JacobiRotation<double> turn;
                turn.makeJacobi(values, a, b);
                values.applyOnTheRight(a, b, turn);
                values.applyOnTheLeft(a, b, turn.adjoint());
                vectors.applyOnTheRight(a, b, turn);
            }
    Matrix<dim> inverse = Matrix<dim>::Zero();
    for (int a = 0; a < dim; ++a)
    {
        const double l = std::max(0.0, values(a, a));
        inverse += (l >= least ? 1 / l : l * (3 - 2 * l / least) / (least * least)) * vectors.col(a) *
                   vectors.col(a).transpose();
    }
    return inverse;
}

/// Best linear fields at nodes.
template <int dim>
class LinearFit
{
  public:
    LinearFit(const state::Particles& p, const WeightTable& table) : p_(p), table_(table)
    {
        constexpr std::size_t moments = 1 + dim + dim * (dim + 1) / 2;
        const auto sums = sumAtNodes<Values<moments>>(
            table, [&](std::size_t i) { return i; },
            [&](Values<moments>& sum, std::size_t i, std::size_t node, double weight) {
                const double share = weight * p.mass[i];
                const auto d = offset(i, node);
                sum[0] += share;
                std::size_t k = 1 + dim;
                for (std::size_t a = 0; a < dim; ++a)
                {
                    sum[1 + a] += share * d[a];
                    for (std::size_t b = a; b < dim; ++b)
                        sum[k++] += share * d[a] * d[b];
                }
            });
        const auto row = std::size_t(table.rows.front());
        const double h = table.position[row + 1][0] - table.position[row][0];
        fits_.resize(sums.size());
#pragma omp parallel for schedule(static) if (p.size() >= manyParticles)
        for (Index node = 0; node < table.nodes(); ++node)
            if (sums[std::size_t(node)][0] > 0)
                fits_[std::size_t(node)] = fit(sums[std::size_t(node)].data(), h);
    }

    template <std::size_t width>
    void apply(const Pointers<width>& in, const std::array<double*, width>& out) const
    {
        using Field = Values<(1 + dim) * width>; ///< sums of m N s, m N d s; then values at the node, slopes
        auto fields = sumAtNodes<Field>(
            table_, [](std::size_t i) { return i; },
            [&](Field& sum, std::size_t i, std::size_t node, double weight) {
                const double share = weight * p_.mass[i];
                const auto d = offset(i, node);
                for (std::size_t c = 0; c < width; ++c)
                {
                    const double part = share * in[c][i];
                    sum[c] += part;
                    for (std::size_t a = 0; a < dim; ++a)
                        sum[(1 + a) * width + c] += part * d[a];
                }
            });
#pragma omp parallel for schedule(static) if (p_.size() >= manyParticles)
        for (Index node = 0; node < table_.nodes(); ++node)
            solve<width>(fits_[std::size_t(node)], fields[std::size_t(node)].data());
        setParticles<width>(table_, out, [&](Index i) {
            Values<width> own{};
            table_.visitNodes(i, [&](std::size_t node, double weight) {
                const auto& field = fields[node];
                const auto d = offset(std::size_t(i), node);
                for (std::size_t c = 0; c < width; ++c)
                {
                    double value = field[c];
                    for (std::size_t a = 0; a < dim; ++a)
                        value += field[(1 + a) * width + c] * d[a];
                    own[c] += weight * value;
                }
            });
            return own;
        });
    }

  private:
    using Vector = Eigen::Matrix<double, dim, 1>;
    struct Fit
    {
        double inverseMass = 0;
        std::array<double, dim> centre{};          ///< of mass, from the node
        std::array<double, dim * dim> perMoment{}; ///< inverse of the second moments about it
    };

    std::array<double, dim> offset(std::size_t i, std::size_t node) const
    {
        std::array<double, dim> d;
        for (std::size_t a = 0; a < dim; ++a)
            d[a] = p_.x[a][i] - table_.position[node][a];
        return d;
    }

    static Fit fit(const double* sum, double h)
    {
        Fit out;
        out.inverseMass = 1 / sum[0];
        Matrix<dim> C;
        const double* second = sum + 1 + dim;
        for (int a = 0; a < dim; ++a)
            out.centre[std::size_t(a)] = sum[1 + a] / sum[0];
        for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b)
                C(a, b) = C(b, a) =
                    *second++ / sum[0] - out.centre[std::size_t(a)] * out.centre[std::size_t(b)]; // per mass
        const Matrix<dim> inverse = boundedInverse<dim>(C, 1e-8 * h * h) * out.inverseMass;
        std::copy_n(inverse.data(), dim * dim, out.perMoment.begin());
        return out;
    }

    template <std::size_t width>
    static void solve(const Fit& fit, double* field)
    {
        for (std::size_t c = 0; c < width; ++c)
        {
            const double sum = field[c];
            Vector moment, slope;
            for (std::size_t a = 0; a < dim; ++a)
                moment[Index(a)] = field[(1 + a) * width + c] - fit.centre[a] * sum;
            slope = Eigen::Map<const Matrix<dim>>(fit.perMoment.data()) * moment;
            field[c] = fit.inverseMass * sum;
            for (std::size_t a = 0; a < dim; ++a)
            {
                field[(1 + a) * width + c] = slope[Index(a)];
                field[c] -= slope[Index(a)] * fit.centre[a];
            }
        }
    }

    const state::Particles& p_;
    const WeightTable& table_;
    std::vector<Fit> fits_;
};
} // namespace mpm::smoothing
