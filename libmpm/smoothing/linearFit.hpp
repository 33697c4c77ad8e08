#pragma once
/// The linear fields that fit particle values best at each node: the operator `leastSquares` of stressTargets.hpp.
#include "smoothing/nodeSums.hpp"
#include "smoothing/rootOfInverse.hpp"
#include "state/particles.hpp"

namespace mpm::smoothing
{
/// Best linear fields at nodes.
template <std::size_t dim>
class LinearFit
{
  public:
    LinearFit(const state::Particles& p, const WeightTable& table) : p_(p), table_(table)
    {
        // about the centres of mass nothing cancels, however close the particles of a node are
        constexpr std::size_t moments = 1 + dim + dim * (dim + 1) / 2;
        origin_ = table.position;
        const auto centres = sumAtNodes<Values<1 + dim>>(
            table, [](std::size_t i) { return i; },
            [&](Values<1 + dim>& sum, std::size_t i, std::size_t node, double weight) {
                const double share = weight * p.mass[i];
                const auto d = offset(i, node);
                sum[0] += share;
                for (std::size_t a = 0; a < dim; ++a)
                    sum[1 + a] += share * d[a];
            });
        for (std::size_t node = 0; node < centres.size(); ++node)
            for (std::size_t a = 0; a < dim && centres[node][0] > 0; ++a)
                origin_[node][a] += centres[node][1 + a] / centres[node][0];
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
        using Field = Values<(1 + dim) * width>; ///< sums of m N s, m N d s; then values at the origin, slopes
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
    struct Fit
    {
        double inverseMass = 0;
        std::array<double, dim> centre{}; ///< of mass, from the origin: of the size of round-off
        Matrix<dim> root{};               ///< K with K K^T = inverse of the second moments about it
    };

    std::array<double, dim> offset(std::size_t i, std::size_t node) const
    {
        std::array<double, dim> d;
        for (std::size_t a = 0; a < dim; ++a)
            d[a] = p_.x[a][i] - origin_[node][a];
        return d;
    }

    static Fit fit(const double* sum, double h)
    {
        Fit out;
        out.inverseMass = 1 / sum[0];
        Matrix<dim> C;
        const double* second = sum + 1 + dim;
        for (std::size_t a = 0; a < dim; ++a)
            out.centre[a] = sum[1 + a] * out.inverseMass;
        for (std::size_t a = 0; a < dim; ++a)
            for (std::size_t b = a; b < dim; ++b)
                C[a][b] = C[b][a] = *second++ * out.inverseMass - out.centre[a] * out.centre[b];
        out.root = rootOfInverse<dim>(C, 1e-12 * h * h);
        return out;
    }

    template <std::size_t width>
    static void solve(const Fit& fit, double* field)
    {
        for (std::size_t c = 0; c < width; ++c)
        {
            const double mean = field[c] *= fit.inverseMass;
            std::array<double, dim> moment, slope{};
            for (std::size_t a = 0; a < dim; ++a)
                moment[a] = field[(1 + a) * width + c] * fit.inverseMass - fit.centre[a] * mean;
            for (std::size_t k = 0; k < dim; ++k)
            {
                double part = 0;
                for (std::size_t a = 0; a < dim; ++a)
                    part += fit.root[a][k] * moment[a];
                for (std::size_t a = 0; a < dim; ++a)
                    slope[a] += fit.root[a][k] * part;
            }
            for (std::size_t a = 0; a < dim; ++a)
            {
                field[(1 + a) * width + c] = slope[a];
                field[c] -= slope[a] * fit.centre[a];
            }
        }
    }

    const state::Particles& p_;
    const WeightTable& table_;
    std::vector<Vector3> origin_; ///< of the fields [m]
    std::vector<Fit> fits_;
};
} // namespace mpm::smoothing
