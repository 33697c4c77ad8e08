#include "dictionary/timeIntegrals.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <mutex>

namespace mpm::dictionary
{
namespace
{
// Nodes and weights of Kronrod's extension of Gauss' rule with 7 points (A. S. Kronrod 1965; as in QUADPACK's QK15).
constexpr double nodes[8] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                             0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                             0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                             0.207784955007898467600689403773245, 0.0};
constexpr double kronrod[8] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                               0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                               0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                               0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr double gauss[4] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                             0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
constexpr double tolerance = 1e-12;
constexpr int halvings = 12; ///< of a panel, around a jump

class Formulas : public TimeFunction::Source
{
  public:
    Formulas(const VectorExpression& formulas, const std::string& word) : formulas_(formulas), word_(word) {}

    Vector3 value(double t) const override
    {
        Vector3 out{};
        for (std::size_t a = 0; a < 3; ++a)
            sample(a, &t, 1, &out[a]);
        return out;
    }

    /// Differences over +-d and +-2 d, of fourth order.
    Vector3 derivative(double t) const override
    {
        const double d = 1e-4 * std::max(1e-3, std::abs(t) * 1e-2);
        const double at[4] = {t - 2 * d, t - d, t + d, t + 2 * d};
        Vector3 out{};
        for (std::size_t a = 0; a < 3; ++a)
        {
            double f[4];
            sample(a, at, 4, f);
            out[a] = (8 * (f[2] - f[1]) - (f[3] - f[0])) / (12 * d);
        }
        return out;
    }

    Integrals over(double t, double dt) const override
    {
        Integrals out;
        for (std::size_t a = 0; a < 3; ++a)
        {
            const auto both = dt == 0 ? Both{} : adaptive(a, t, dt, halvings);
            out.once[a] = both.once;
            out.twice[a] = both.twice;
        }
        return out;
    }

    /// Panels halve towards t = 0 and are 1/256 of t at most: whatever the scale of time, none is needed as a word.
    Integrals from0(double t) const override
    {
        constexpr int first = -30, count = 128;
        if (!(t > std::ldexp(1.0, first)))
            return over(0, t);
        const int octave = std::ilogb(t);
        const std::lock_guard lock(mutex_);
        if (ends_.empty())
            ends_.push_back({std::ldexp(1.0, first), over(0, std::ldexp(1.0, first))});
        const double width = std::ldexp(1.0, octave) / count;
        const auto panel = std::size_t((t - std::ldexp(1.0, octave)) / width);
        const std::size_t wanted = std::size_t(octave - first) * count + std::min<std::size_t>(panel, count - 1);
        while (ends_.size() <= wanted)
        {
            const std::size_t k = ends_.size() - 1;
            const double base = std::ldexp(1.0, first + int(k / count));
            const double step = base / count, end = base + step * double(k % count + 1);
            ends_.push_back({end, joined(ends_.back().sum, over(ends_.back().t, step), step)});
        }
        const auto& last = ends_[wanted];
        return t > last.t ? joined(last.sum, over(last.t, t - last.t), t - last.t) : last.sum;
    }

    bool fixed(std::size_t a, double& number) const override
    {
        number = formulas_[a].number().value_or(0);
        return formulas_[a].number().has_value();
    }

  private:
    struct Both
    {
        double once = 0, twice = 0;
    };
    struct End
    {
        double t;
        Integrals sum; ///< from 0 to t
    };

    static Integrals joined(const Integrals& before, const Integrals& piece, double dt)
    {
        Integrals out;
        for (std::size_t a = 0; a < 3; ++a)
        {
            out.once[a] = before.once[a] + piece.once[a];
            out.twice[a] = before.twice[a] + before.once[a] * dt + piece.twice[a];
        }
        return out;
    }

    void sample(std::size_t a, const double* t, Index count, double* f) const
    {
        if (const Index bad = formulas_[a].evaluate({t}, count, f); bad >= 0)
            throw StepError(fmt::format("{}: {}: \"{}\" is not finite at t = {:g} s", formulas_[a].where().text(),
                                        word_, formulas_[a].text(), t[bad]));
    }

    Both adaptive(std::size_t a, double t, double dt, int depth) const
    {
        if (const auto number = formulas_[a].number())
            return {*number * dt, 0.5 * *number * dt * dt};
        double at[15], f[15];
        for (int k = 0; k < 15; ++k)
            at[k] = t + 0.5 * dt * (1 + (k < 7 ? -nodes[k] : nodes[14 - k]));
        sample(a, at, 15, f);
        double fine = 0, coarse = 0, moment = 0, size = 0;
        for (int k = 0; k < 15; ++k)
        {
            const int n = k < 7 ? k : 14 - k;
            fine += kronrod[n] * f[k];
            size += kronrod[n] * std::abs(f[k]);
            moment += kronrod[n] * f[k] * (1 - (k < 7 ? -nodes[n] : nodes[n])); // (t + dt - s)/(dt/2)
            if (n % 2 == 1)
                coarse += gauss[n / 2] * f[k];
        }
        if (depth == 0 || std::abs(fine - coarse) <= tolerance * size)
            return {0.5 * dt * fine, 0.25 * dt * dt * moment};
        const Both left = adaptive(a, t, 0.5 * dt, depth - 1);
        const Both right = adaptive(a, t + 0.5 * dt, 0.5 * dt, depth - 1);
        return {left.once + right.once, left.twice + left.once * 0.5 * dt + right.twice};
    }

    VectorExpression formulas_;
    std::string word_;
    mutable std::mutex mutex_;
    mutable std::vector<End> ends_; ///< of the panels so far; each follows from those before it alone
};
} // namespace

std::shared_ptr<const TimeFunction::Source> makeFormulaSource(const VectorExpression& formulas, const std::string& word)
{
    return std::make_shared<Formulas>(formulas, word);
}
} // namespace mpm::dictionary
