#include "output/visualisation.hpp"

#include <limits>
#include <numeric>

namespace mpm::output
{
Vector3 domainCorner(const state::Particles& p, Index particle, int c)
{
    const auto i = std::size_t(particle);
    Vector3 corner{};
    for (int a = 0; a < p.dim; ++a)
    {
        double value = p.x[std::size_t(a)][i];
        for (int k = 0; k < p.dim; ++k)
            value += 0.5 * cornerSigns[std::size_t(c)][std::size_t(k)] * p.F[std::size_t(a * p.dim + k)][i] *
                     p.length0[std::size_t(k)][i];
        corner[std::size_t(a)] = value;
    }
    return corner;
}

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

void writeDerivedVisualisation(Hdf5File& file, const std::string& field, const std::vector<std::string>& components,
                               const std::vector<double>& rows, const std::string& unit)
{
    const auto names = derivedComponentNames(field, components);
    const std::size_t width = names.size();
    for (std::size_t k = 0; k < width; ++k)
    {
        std::vector<float> column;
        for (std::size_t i = k; i < rows.size(); i += width)
            column.push_back(float(rows[i]));
        file.remove("/visualisation/derived/" + names[k]);
        file.write<float>("/visualisation/derived/" + names[k], column, {Index(column.size())}, unit);
    }
}

void writeVisualisation(Hdf5File& file, const state::Particles& p)
{
    const Index n = p.size();
    const int corners = p.dim == 2 ? 4 : 8;
    if (n * corners > std::numeric_limits<std::int32_t>::max())
        file.fail("/visualisation", "more corners than 32-bit numbers count");
    std::vector<float> points, velocity, corner;
    for (Index i = 0; i < n; ++i)
    {
        for (int a = 0; a < 3; ++a)
        {
            points.push_back(a < p.dim ? float(p.x[std::size_t(a)][std::size_t(i)]) : 0.0f);
            velocity.push_back(a < p.dim ? float(p.v[std::size_t(a)][std::size_t(i)]) : 0.0f);
        }
        for (int c = 0; c < corners; ++c)
            for (double value : domainCorner(p, i, c))
                corner.push_back(float(value));
    }
    std::vector<std::int32_t> numbers(std::size_t(n * corners));
    std::iota(numbers.begin(), numbers.end(), 0);
    file.write<float>("/visualisation/points", points, {n, 3}, "m");
    file.write<float>("/visualisation/velocity", velocity, {n, 3}, "m/s");
    file.write<float>("/visualisation/corners", corner, {n * corners, 3}, "m");
    file.write<std::int32_t>("/visualisation/connectivity", std::span(numbers).first(std::size_t(n)), {n}, "1");
    file.write<std::int32_t>("/visualisation/cornerConnectivity", numbers, {n, corners}, "1");
    for (int k = 0; k < stressComponents(p.dim); ++k)
    {
        const std::vector<float> column(p.stress[std::size_t(k)].begin(), p.stress[std::size_t(k)].begin() + n);
        file.write<float>("/visualisation/" + stressComponentName(k), column, {n}, "Pa");
    }
}
} // namespace mpm::output
