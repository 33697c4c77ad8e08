#pragma once
/// The inverse of small symmetric, positive semidefinite matrices, with bounds for those that are nearly singular.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mpm::smoothing
{
template <std::size_t dim>
using Matrix = std::array<std::array<double, dim>, dim>;

/// values <- V^T values V, diagonal at the end, and V: Jacobi's rotations.
template <std::size_t dim>
Matrix<dim> eigenvectors(Matrix<dim>& values)
{
    Matrix<dim> V{};
    for (std::size_t a = 0; a < dim; ++a)
        V[a][a] = 1;
    const auto turn = [](double& x, double& y, double c, double s) {
        const double old = x;
        x = c * old - s * y;
        y = s * old + c * y;
    };
    for (int sweep = 0; sweep < (dim == 2 ? 2 : 8); ++sweep)
        for (std::size_t a = 0; a < dim; ++a)
            for (std::size_t b = a + 1; b < dim; ++b)
            {
                if (values[a][b] == 0)
                    continue;
                const double tau = (values[b][b] - values[a][a]) / (2 * values[a][b]);
                const double t = (tau < 0 ? -1 : 1) / (std::abs(tau) + std::sqrt(1 + tau * tau));
                const double c = 1 / std::sqrt(1 + t * t), s = t * c;
                for (std::size_t k = 0; k < dim; ++k)
                    turn(values[k][a], values[k][b], c, s);
                for (std::size_t k = 0; k < dim; ++k)
                {
                    turn(values[a][k], values[b][k], c, s);
                    turn(V[k][a], V[k][b], c, s);
                }
            }
    return V;
}

/// K with K K^T = 1/C, C symmetric and of good condition: unit vectors made orthonormal in C, one after the other.
/// False if some eigenvalue of C may be below `least`.
template <std::size_t dim>
bool wellConditionedRoot(const Matrix<dim>& C, double least, Matrix<dim>& K)
{
    double trace = 0, determinant = 1, bound = least;
    for (std::size_t j = 0; j < dim; ++j)
    {
        std::array<double, dim> v{};
        v[j] = 1;
        for (std::size_t m = 0; m < j; ++m)
        {
            double dot = 0;
            for (std::size_t b = 0; b < dim; ++b)
                dot += K[b][m] * C[b][j];
            for (std::size_t b = 0; b < dim; ++b)
                v[b] -= dot * K[b][m];
        }
        double square = 0;
        for (std::size_t a = 0; a < dim; ++a)
            for (std::size_t b = 0; b < dim; ++b)
                square += v[a] * C[a][b] * v[b];
        if (!(square > least))
            return false;
        for (std::size_t b = 0; b < dim; ++b)
            K[b][j] = v[b] / std::sqrt(square);
        trace += C[j][j];
        determinant *= square;
    }
    for (std::size_t j = 1; j < dim; ++j)
        bound *= trace;
    return determinant > bound; // the smallest eigenvalue is at least determinant/trace^(dim - 1)
}

/// K with K K^T = 1/C, C symmetric and positive semidefinite; eigenvalues below `least` take the ramp of
/// stressTargets.hpp. (1/C itself would carry the round-off of its largest eigenvalue into all directions.)
template <std::size_t dim>
Matrix<dim> rootOfInverse(Matrix<dim> C, double least)
{
    Matrix<dim> K{};
    if (wellConditionedRoot<dim>(C, 1e8 * least, K))
        return K;
    K = eigenvectors<dim>(C);
    for (std::size_t a = 0; a < dim; ++a)
    {
        const double l = std::max(0.0, C[a][a]);
        const double root = std::sqrt(l >= least ? 1 / l : l * (3 - 2 * l / least) / (least * least));
        for (std::size_t k = 0; k < dim; ++k)
            K[k][a] *= root;
    }
    return K;
}
} // namespace mpm::smoothing
