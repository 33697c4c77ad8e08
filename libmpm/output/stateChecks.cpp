#include "base/error.hpp"
#include "output/stateFile.hpp"

#include "output/ledgerEntries.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace mpm::output
{
namespace
{
template <int dim>
double determinant(const state::Particles& p, std::size_t i)
{
    const auto F = [&](int row, int column) -> double { return p.F[std::size_t(row * dim + column)][i]; };
    if constexpr (dim == 2)
        return F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
    return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) - F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
           F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
}

class Checker
{
  public:
    Checker(const state::State& state, const std::string& where) : state_(state), p_(state.particles), where_(where) {}

    void scalars() const
    {
        const auto finite = [&](const std::string& what, double value) {
            if (!std::isfinite(value))
                fail(fmt::format("{} is {}, a finite number expected", what, value));
        };
        const auto count = [&](const std::string& what, Index value) {
            if (value < 0)
                fail(fmt::format("{} is {}, allowed >= 0", what, value));
        };
        finite("time", state_.time);
        finite("deltaT", state_.deltaT);
        if (!(state_.largestJacobian >= 1 && std::isfinite(state_.largestJacobian)))
            fail(fmt::format("largestJacobian is {}, allowed >= 1", state_.largestJacobian));
        if (!(state_.stepFactor > 0 && state_.stepFactor <= 1))
            fail(fmt::format("stepFactor is {}, allowed > 0 to 1", state_.stepFactor));
        count("step", state_.step);
        count("nextId", state_.nextId);
        for (double length : state_.seedSpacing)
            finite("seedSpacing", length);
        forEachLedgerEntry(state_.ledger, [&](const std::string& name, const auto& value, const std::string&) {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, Vector3>)
                for (double component : value)
                    finite("ledger " + name, component);
            else if constexpr (std::is_same_v<Value, double>)
                finite("ledger " + name, value);
        });
        for (const auto& patch : state_.patches)
        {
            for (const auto& column : patch.centre)
                for (double value : column)
                    finite("patch " + patch.name, value);
            for (const auto& column : patch.edges)
                for (double value : column)
                    finite("patch " + patch.name, value);
        }
    }

    /// A grid is there with h > 0 and cells >= 1, or not yet chosen (all zero).
    void grid() const
    {
        const auto& grid = state_.grid;
        if (grid.dim != p_.dim)
            fail(fmt::format("the grid has dimension {}, the particles have {}", grid.dim, p_.dim));
        if (grid.h == 0 && grid.cells == std::array<Index, 3>{})
            return;
        if (!(grid.h > 0) || !std::isfinite(grid.h))
            fail(fmt::format("the grid's cellSize is {}, allowed > 0", grid.h));
        double nodes = 1;
        for (int a = 0; a < 3; ++a)
        {
            const auto k = std::size_t(a);
            if (!std::isfinite(grid.origin[k]) || grid.cells[k] < (a < grid.dim ? 1 : 0))
                fail(fmt::format("the grid's origin or number of cells along {} is not valid", axisNames[k]));
            nodes *= double(std::max<Index>(grid.cells[k], 1)) + 1;
        }
        if (nodes > 1e12)
            fail("the grid has more than 1e12 nodes");
    }

    /// Whole chunks are looked at without branches; a bad one is looked at again for the message.
    void particles() const
    {
        bool good = true;
#pragma omp parallel for schedule(static) reduction(&& : good) if (p_.size() > 100000)
        for (Index first = 0; first < p_.size(); first += lanes)
            good = good && (p_.dim == 2 ? chunkIsGood<2>(first) : chunkIsGood<3>(first));
        if (!good)
            findBadParticle();
    }

    /// Each id once. With ids far beyond the number of particles a table of all would be large: then they are sorted.
    void ids() const
    {
        const auto id = p_.id.begin();
        if (std::adjacent_find(id, id + p_.size(), std::greater_equal<>()) == id + p_.size())
            return;
        if (state_.nextId <= 64 * p_.size())
        {
            std::vector<bool> seen(std::size_t(state_.nextId), false);
            bool twice = false;
            for (Index i = 0; i < p_.size(); ++i)
            {
                twice = twice || seen[std::size_t(id[i])];
                seen[std::size_t(id[i])] = true;
            }
            if (!twice)
                return;
        }
        std::vector<std::int64_t> ids(id, id + p_.size());
        std::sort(ids.begin(), ids.end());
        const auto twice = std::adjacent_find(ids.begin(), ids.end());
        if (twice != ids.end())
            fail(fmt::format("particle id {} is there twice", *twice));
    }

  private:
    template <int dim>
    bool chunkIsGood(Index first) const
    {
        const Index n = std::min<Index>(lanes, p_.size() - first);
        int bad = 0;
        const auto finite = [&](const auto& columns, int used) {
            for (int k = 0; k < used; ++k)
                for (Index l = 0; l < n; ++l)
                    bad |= !std::isfinite(columns[std::size_t(k)][std::size_t(first + l)]);
        };
        const auto positive = [&](const auto& column) {
            for (Index l = 0; l < n; ++l)
            {
                const double value = column[std::size_t(first + l)];
                bad |= !(value > 0) | !std::isfinite(value);
            }
        };
        finite(p_.x, dim);
        finite(p_.v, dim);
        finite(p_.stress, stressSize<dim>);
        finite(p_.F, dim * dim);
        finite(p_.X, p_.hasX() ? dim : 0);
        finite(p_.affine, p_.hasAffine() ? dim * dim : 0);
        for (const auto& optional : state::Particles::optionalColumns())
            finite(&(p_.*optional.column), p_.has(optional.column));
        for (int k = 0; k < dim; ++k)
            positive(p_.length0[std::size_t(k)]);
        positive(p_.mass);
        positive(p_.volume0);
        positive(p_.volume);
        const auto materials = std::int32_t(state_.materials.size());
        for (Index l = 0; l < n; ++l)
        {
            const auto i = std::size_t(first + l);
            const double J = determinant<dim>(p_, i);
            bad |= !(J > 0) | !std::isfinite(J);
            bad |= int(p_.material[i] < 0) | int(p_.material[i] >= materials) | int(p_.generation[i] < 0);
            bad |= int(p_.id[i] < 0) | int(p_.id[i] >= state_.nextId);
        }
        return bad == 0;
    }

    void findBadParticle() const
    {
        const auto materials = std::int32_t(state_.materials.size());
        for (std::size_t i = 0; i < std::size_t(p_.size()); ++i)
        {
            finiteAll("position", p_.x, p_.dim, i);
            finiteAll("velocity", p_.v, p_.dim, i);
            finiteAll("stress", p_.stress, stressComponents(p_.dim), i);
            finiteAll("deformationGradient", p_.F, p_.dim * p_.dim, i);
            finiteAll("referencePosition", p_.X, p_.hasX() ? p_.dim : 0, i);
            finiteAll("affine", p_.affine, p_.hasAffine() ? p_.dim * p_.dim : 0, i);
            for (const auto& optional : state::Particles::optionalColumns())
                finiteAll(optional.name, &(p_.*optional.column), p_.has(optional.column), i);
            for (int k = 0; k < p_.dim; ++k)
                positive("length0", p_.length0[std::size_t(k)][i], i);
            positive("mass", p_.mass[i], i);
            positive("volume0", p_.volume0[i], i);
            positive("volume", p_.volume[i], i);
            positive("det F", p_.dim == 2 ? determinant<2>(p_, i) : determinant<3>(p_, i), i);
            if (p_.material[i] < 0 || p_.material[i] >= materials)
                fail(i, fmt::format("material index {} is not one of the {} materials", p_.material[i], materials));
            if (p_.id[i] < 0 || p_.id[i] >= state_.nextId)
                fail(i, fmt::format("its id is not below nextId {}", state_.nextId));
            if (p_.generation[i] < 0)
                fail(i, fmt::format("generation is {}, allowed >= 0", p_.generation[i]));
        }
    }

    [[noreturn]] void fail(const std::string& message) const
    {
        throw InputError({where_}, message);
    }
    [[noreturn]] void fail(std::size_t i, const std::string& message) const
    {
        fail(fmt::format("particle with id {} (row {}): {}", p_.id[i], i, message));
    }
    void positive(const char* what, double value, std::size_t i) const
    {
        if (!(value > 0) || !std::isfinite(value))
            fail(i, fmt::format("{} is {}, allowed > 0", what, value));
    }
    template <class Columns>
    void finiteAll(const char* what, const Columns& columns, int used, std::size_t i) const
    {
        for (int k = 0; k < used; ++k)
            if (!std::isfinite(columns[std::size_t(k)][i]))
                fail(i, fmt::format("{} is {}, a finite number expected", what, columns[std::size_t(k)][i]));
    }

    const state::State& state_;
    const state::Particles& p_;
    std::string where_;
};
} // namespace

void requireValid(const state::State& state, const std::string& where)
{
    const Checker check(state, where);
    check.scalars();
    check.grid();
    check.particles();
    check.ids();
}
} // namespace mpm::output
