#include "output/visualisation.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mpm::output
{
namespace
{
/// Vectors of three floats, z = 0 in 2D.
template <class T>
RowFiller<float> vectors(const std::array<state::Column<T>, 3>& columns, int dim)
{
    return [&columns, dim](Index first, Index rows, float* out) {
        for (int a = 0; a < 3; ++a)
            for (Index i = 0; i < rows; ++i)
                out[3 * i + a] = a < dim ? float(columns[std::size_t(a)][std::size_t(first + i)]) : 0.0f;
    };
}

/// Rows are corners, 4 or 8 a particle; blocks begin with a particle (hdf5Values.cpp).
template <int dim>
RowFiller<float> cornersOf(const state::Particles& p)
{
    return [&p](Index first, Index rows, float* out) {
        constexpr Index corners = dim == 2 ? 4 : 8;
        for (int a = 0; a < 3; ++a)
        {
            if (a >= dim)
            {
                for (Index row = 0; row < rows; ++row)
                    out[3 * row + a] = 0;
                continue;
            }
            const double* x = p.x[std::size_t(a)].data() + first / corners;
            const state::Stored *F[dim], *length[dim];
            for (int k = 0; k < dim; ++k)
            {
                F[k] = p.F[std::size_t(a * dim + k)].data() + first / corners;
                length[k] = p.length0[std::size_t(k)].data() + first / corners;
            }
            for (Index i = 0; i < rows / corners; ++i)
                for (Index c = 0; c < corners; ++c)
                {
                    double value = x[i];
                    for (int k = 0; k < dim; ++k)
                        value += 0.5 * cornerSigns[std::size_t(c)][std::size_t(k)] * F[k][i] * length[k][i];
                    out[3 * (corners * i + c) + a] = float(value);
                }
        }
    };
}
} // namespace

std::string stressComponentName(int component)
{
    return std::string("sigma_") + stressNames[std::size_t(component)];
}

std::vector<std::string> derivedComponentNames(const std::string& field, const std::vector<std::string>& components)
{
    if (components.size() == 1)
        return {field};
    std::vector<std::string> names;
    for (const auto& component : components)
        names.push_back(field + "_" + component);
    return names;
}

void writeVisualisation(Hdf5File& file, const state::Particles& p)
{
    const Index n = p.size();
    const int corners = p.dim == 2 ? 4 : 8;
    if (n * corners > std::numeric_limits<std::int32_t>::max())
        file.fail("/visualisation", "more corners than 32-bit numbers count");
    const RowFiller<std::int32_t> count = [](Index first, Index rows, std::int32_t* out) {
        std::iota(out, out + rows, std::int32_t(first));
    };
    file.writeRows<float>("/visualisation/points", {n, 3}, "m", vectors(p.x, p.dim));
    file.writeRows<float>("/visualisation/velocity", {n, 3}, "m/s", vectors(p.v, p.dim));
    file.writeRows<float>("/visualisation/corners", {n * corners, 3}, "m",
                          p.dim == 2 ? cornersOf<2>(p) : cornersOf<3>(p));
    file.writeRows<std::int32_t>("/visualisation/connectivity", {n}, "1", count);
    file.writeRows<std::int32_t>(
        "/visualisation/cornerConnectivity", {n, corners}, "1",
        [&](Index first, Index rows, std::int32_t* out) { count(first * corners, rows * corners, out); });
    for (int k = 0; k < stressComponents(p.dim); ++k)
        file.writeRows<float>("/visualisation/" + stressComponentName(k), {n}, "Pa",
                              [&](Index first, Index rows, float* out) {
                                  std::copy_n(p.stress[std::size_t(k)].data() + first, rows, out);
                              });
}
} // namespace mpm::output
