#include "smoothing/stressTargets.hpp"

#include "base/error.hpp"
#include "smoothing/linearFit.hpp"

#include <fmt/format.h>

namespace mpm::smoothing
{
namespace
{
/// Eqs. 11 and 12.
class Smoothing
{
  public:
    Smoothing(const state::Particles& p, const WeightTable& table) : p_(p), table_(table)
    {
        inverseMass_ = sumAtNodes<double>(
            table, [&](std::size_t i) { return p.mass[i]; },
            [](double& sum, double mass, std::size_t, double weight) { sum += mass * weight; });
        for (double& mass : inverseMass_)
            mass = mass > 0 ? 1 / mass : 0;
    }

    /// in(p) is what particle p has.
    template <std::size_t width, class Read>
    void apply(Read&& in, const std::array<double*, width>& out) const
    {
        auto nodal = sumAtNodes<Values<width>>(
            table_,
            [&](std::size_t i) {
                Values<width> own = in(i);
                for (double& value : own)
                    value *= p_.mass[i];
                return own;
            },
            [](Values<width>& sum, const Values<width>& own, std::size_t, double weight) {
                for (std::size_t c = 0; c < width; ++c)
                    sum[c] += weight * own[c];
            });
        for (std::size_t node = 0; node < nodal.size(); ++node)
            for (double& value : nodal[node])
                value *= inverseMass_[node];
        setParticles<width>(table_, out, [&](Index i) {
            Values<width> own{};
            table_.visitNodes(i, [&](std::size_t node, double weight) {
                for (std::size_t c = 0; c < width; ++c)
                    own[c] += weight * nodal[node][c];
            });
            return own;
        });
    }

  private:
    const state::Particles& p_;
    const WeightTable& table_;
    std::vector<double> inverseMass_;
};

/// 2 S s - S S s.
template <std::size_t width>
void filter(const Smoothing& smoothing, const Pointers<width>& in, const std::array<double*, width>& out,
            Index particles)
{
    const auto read = [](const auto& columns) {
        return [&columns](std::size_t i) {
            Values<width> own;
            for (std::size_t c = 0; c < width; ++c)
                own[c] = columns[c][i];
            return own;
        };
    };
    std::vector<double> once(std::size_t(particles) * width);
    std::array<double*, width> first;
    for (std::size_t c = 0; c < width; ++c)
        first[c] = once.data() + std::size_t(particles) * c;
    smoothing.apply<width>(read(in), first);
    smoothing.apply<width>(read(first), out);
    for (std::size_t c = 0; c < width; ++c)
        for (Index i = 0; i < particles; ++i)
            out[c][i] = 2 * first[c][i] - out[c][i];
}

/// Calls visit(pointers in, pointers out) for six, four or one column at a time: all of a stress at once.
template <class Visitor>
void inGroups(const std::vector<const double*>& columns, StressColumns& out, Visitor&& visit)
{
    std::size_t done = 0;
    const auto group = [&]<std::size_t width>(std::integral_constant<std::size_t, width>) {
        Pointers<width> in;
        std::array<double*, width> to;
        for (std::size_t c = 0; c < width; ++c, ++done)
        {
            in[c] = columns[done];
            to[c] = out[done].data();
        }
        visit(in, to);
    };
    while (done < columns.size())
    {
        const std::size_t left = columns.size() - done;
        if (left % 4 != 0 && left >= 6)
            group(std::integral_constant<std::size_t, 6>());
        else if (left >= 4)
            group(std::integral_constant<std::size_t, 4>());
        else
            group(std::integral_constant<std::size_t, 1>());
    }
}

template <std::size_t dim>
void fitLinear(const std::vector<const double*>& columns, const state::Particles& p, const WeightTable& table,
               StressColumns& out)
{
    const LinearFit<dim> fit(p, table);
    inGroups(columns, out, [&](const auto& in, const auto& to) { fit.apply(in, to); });
}

} // namespace

const std::vector<std::string>& stressTargetNames()
{
    static const std::vector<std::string> names{"smoothed", "filtered", "leastSquares"};
    return names;
}

void stressTarget(StressTarget target, const std::vector<const double*>& columns, const state::Particles& p,
                  const WeightTable& table, StressColumns& out)
{
    if (table.particles() != p.size())
        throw InputError(fmt::format("weights of {} particles for {} particles", table.particles(), p.size()));
    out.resize(columns.size());
    for (auto& column : out)
        column.resize(std::size_t(p.size()));
    if (p.size() == 0)
        return;
    if (target == StressTarget::leastSquares)
        return p.dim == 2 ? fitLinear<2>(columns, p, table, out) : fitLinear<3>(columns, p, table, out);
    const Smoothing smoothing(p, table);
    inGroups(columns, out, [&]<std::size_t width>(const Pointers<width>& in, const std::array<double*, width>& to) {
        if (target == StressTarget::filtered)
            return filter<width>(smoothing, in, to, p.size());
        smoothing.apply<width>(
            [&](std::size_t i) {
                Values<width> own;
                for (std::size_t c = 0; c < width; ++c)
                    own[c] = in[c][i];
                return own;
            },
            to);
    });
}

void stressTarget(StressTarget target, const state::Particles& p, const WeightTable& table, StressColumns& out)
{
    StressColumns widened;
    stressTarget(target, stressColumns(p, widened), p, table, out);
}
} // namespace mpm::smoothing
