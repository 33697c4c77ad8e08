#include "state/particles.hpp"

#include "state/permutation.hpp"

#include <algorithm>
#include <tuple>
#include <variant>

namespace mpm::state
{
namespace
{
Index padded(Index n)
{
    return (n + lanes - 1) / lanes * lanes;
}
} // namespace

Particles::Particles(int dimension) : dim(dimension) {}

void Particles::resize(Index n)
{
    const Index old = size_, padding = std::min(n, padded(old));
    forEachColumn([&](auto& column) {
        column.resize(std::size_t(padded(n))); // zeros, but for the old padding
        if (old < padding)
            std::fill(column.begin() + old, column.begin() + padding, 0);
    });
    for (int k = 0; k < dim && old < n; ++k)
        std::fill(F[k * dim + k].begin() + old, F[k * dim + k].begin() + n, 1.0);
    size_ = n;
}

void Particles::enableX()
{
    hasX_ = true;
    for (int k = 0; k < dim; ++k)
        X[k] = x[k];
}

void Particles::enableAffine()
{
    hasAffine_ = true;
    for (int k = 0; k < dim * dim; ++k)
        affine[k].assign(mass.size(), 0.0);
}

void Particles::disableAffine()
{
    hasAffine_ = false;
    for (auto& column : affine)
        column = {};
}

const std::array<OptionalColumn, Particles::optionals>& Particles::optionalColumns()
{
    static constexpr std::array<OptionalColumn, optionals> columns{{
        {&Particles::tensionGap, "tensionGap", "1"},
        {&Particles::dilationRate, "dilationRate", "1/s"},
        {&Particles::flowMemory, "flowMemory", "1"},
        {&Particles::viscousStress, "viscousStress", "Pa"},
        {&Particles::quietLooks, "quietLooks", "1"},
        {&Particles::plasticStrain, "plasticStrain", "1"},
        {&Particles::bulkViscousStress, "bulkViscousStress", "Pa"},
        {&Particles::family, "family", "1"},
    }};
    return columns;
}

namespace
{
std::size_t placeOf(Column<double> Particles::*column)
{
    const auto& all = Particles::optionalColumns();
    return std::size_t(std::find_if(all.begin(), all.end(), [&](const auto& o) { return o.column == column; }) -
                       all.begin());
}
} // namespace

bool Particles::has(Column<double> Particles::*column) const
{
    return has_[placeOf(column)];
}

void Particles::keep(Column<double> Particles::*column, bool keep)
{
    bool& has = has_[placeOf(column)];
    if (keep && !has)
        (this->*column).assign(mass.size(), 0.0);
    if (!keep)
        this->*column = {};
    has = keep;
}

void Particles::padLastChunk()
{
    if (size_ == 0)
        return;
    const std::size_t last = std::size_t(size_ - 1);
    forEachColumn([&](auto& column) { std::fill(column.begin() + size_, column.end(), column[last]); });
    for (std::size_t i = std::size_t(size_); i < mass.size(); ++i)
        mass[i] = volume0[i] = volume[i] = 0;
}

void Particles::permute(Order order)
{
    const Permutation permutation(std::move(order));
    std::vector<std::variant<Column<double>*, Column<float>*, Column<std::int64_t>*, Column<std::int32_t>*>> columns;
    forEachColumn([&](auto& column) { columns.emplace_back(&column); });
#pragma omp parallel if (size_ > manyParticles && !permutation.scatters())
    {
        std::tuple<Column<double>, Column<float>, Column<std::int64_t>, Column<std::int32_t>> kept;
#pragma omp for schedule(dynamic, 1)
        for (std::size_t c = 0; c < columns.size(); ++c)
            std::visit([&]<class T>(Column<T>* column) { permutation.move(*column, std::get<Column<T>>(kept)); },
                       columns[c]);
    }
    padLastChunk();
}

void Particles::permute(const std::vector<Index>& order)
{
    permute(Order(order.begin(), order.end()));
}

Index Particles::appendCopy(Index i)
{
    const Index j = size_;
    resize(size_ + 1);
    forEachColumn([&](auto& column) { column[std::size_t(j)] = column[std::size_t(i)]; });
    return j;
}
} // namespace mpm::state
