#include "reference/vonMisesRates.hpp"

#include "base/error.hpp"
#include "reference/odeSolver.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::reference
{
namespace
{
using Tensor = SymmetricTensor;

double product(const Tensor& a, const Tensor& b)
{
    double sum = 0;
    for (int k = 0; k < 6; ++k)
        sum += (k < 3 ? 1 : 2) * a[k] * b[k];
    return sum;
}

Tensor deviator(const double* s)
{
    const double mean = (s[0] + s[1] + s[2]) / 3;
    return {s[0] - mean, s[1] - mean, s[2] - mean, s[3], s[4], s[5]};
}

/// f = q + slope p - strength, g = q + flow p.
struct Cone
{
    double slope, flow, strength;
};

class Integration
{
  public:
    Integration(const constitutive::ElasticModuli& moduli, const Cone& cone, const Tensor& start,
                const StrainPath& path, const RateTolerances& t)
        : path_(path), cone_(cone), lame_(moduli.lame()), shear_(moduli.shear()), bulk_(moduli.bulk()),
          scale_(std::max(cone.strength, std::sqrt(product(start, start)))), edge_(t.edge),
          ode_(6, t.relative, t.absolute * scale_,
               [this](double time, const double* y, double* rate) { rightHandSide(time, y, rate); })
    {
        if (yield(start.data()) > 1e-10 * scale_)
            throw InputError(fmt::format("start stress: found f = {:g} Pa, allowed is inside the yield surface, f <= 0",
                                         yield(start.data())));
        y_.assign(start.begin(), start.end());
    }

    RateSolution run()
    {
        keep();
        for (piece_ = 0; piece_ < path_.pieces(); ++piece_)
        {
            runPiece(path_.breaks()[piece_], path_.breaks()[piece_ + 1]);
            keep();
        }
        out_.evaluations = ode_.evaluations();
        return std::move(out_);
    }

  private:
    double yield(const double* s) const
    {
        const Tensor dev = deviator(s);
        return std::sqrt(1.5 * product(dev, dev)) + cone_.slope * (s[0] + s[1] + s[2]) / 3 - cone_.strength;
    }

    /// lam, of either sign.
    double loading(double t, const double* s) const
    {
        const Tensor dev = deviator(s), e = path_.rate(piece_, t);
        const double size = std::sqrt(product(dev, dev));
        const double along = size > 0 ? product(dev, e) / size : 0;
        return (std::sqrt(6.0) * shear_ * along + bulk_ * cone_.slope * (e[0] + e[1] + e[2])) /
               (3 * shear_ + bulk_ * cone_.slope * cone_.flow);
    }

    void rightHandSide(double t, const double* s, double* rate) const
    {
        const Tensor e = path_.rate(piece_, t);
        const double trace = e[0] + e[1] + e[2];
        for (int k = 0; k < 6; ++k)
            rate[k] = 2 * shear_ * e[k] + (k < 3 ? lame_ * trace : 0);
        if (!plastic_)
            return;
        const Tensor dev = deviator(s);
        const double lam = loading(t, s), shear = std::sqrt(6.0) * shear_ / std::sqrt(product(dev, dev));
        for (int k = 0; k < 6; ++k)
            rate[k] -= lam * (shear * dev[k] + (k < 3 ? bulk_ * cone_.flow : 0));
    }

    void keep()
    {
        Tensor s;
        std::copy(y_.begin(), y_.end(), s.begin());
        out_.stress.push_back(s);
    }

    /// The region at (t, y), and the solver started there.
    void enter(double t, bool onSurface)
    {
        const bool before = plastic_;
        plastic_ = onSurface && loading(t, y_.data()) > 0;
        if (plastic_ != before || out_.events.empty())
            out_.events.push_back({t, plastic_ ? Region::face : Region::elastic});
        if (plastic_ && !out_.yieldTime)
            out_.yieldTime = t;
        if (plastic_)
            ode_.restart(t, y_,
                         {[this](double time, const double* s, double* value) { *value = loading(time, s); }, {-1}});
        else // from just below zero, so that a path that dips inside for an instant is seen to come back
            ode_.restart(t, y_,
                         {[this, drift = std::max(0.0, yield(y_.data()) / scale_ + edge_)](
                              double, const double* s, double* value) { *value = yield(s) / scale_ - drift; },
                          {1}});
    }

    void runPiece(double t, double end)
    {
        ode_.limitStep((end - t) / (path_.straight() ? 4 : 200));
        enter(t, yield(y_.data()) > -1e-10 * scale_);
        for (int standing = 0; end - t > 1e-13 * (path_.end() - path_.begin());)
        {
            const double before = t;
            const auto stop = ode_.advance(end);
            t = ode_.time();
            y_ = ode_.state();
            if (const Tensor dev = deviator(y_.data()); plastic_ && product(dev, dev) < 1e-12 * scale_ * scale_)
                throw StepError(
                    fmt::format("the path reaches the apex at t = {:g}, beyond which there are no rates", t));
            if (plastic_)
                out_.drift = std::max(out_.drift, std::abs(yield(y_.data())) / scale_);
            if (stop != OdeSolver::Stop::event)
                continue;
            standing = t - before > 0 ? 0 : standing + 1;
            if (standing > 50)
                throw StepError(fmt::format("the reference solution stands still at t = {:g}", t));
            enter(t, !plastic_);
        }
    }

    const StrainPath& path_;
    Cone cone_;
    double lame_, shear_, bulk_, scale_, edge_;
    OdeSolver ode_;
    std::vector<double> y_;
    RateSolution out_;
    std::size_t piece_ = 0;
    bool plastic_ = false;
};
} // namespace

RateSolution integrateRates(const VonMisesParameters& parameters, const SymmetricTensor& start, const StrainPath& path,
                            const RateTolerances& tolerances)
{
    constitutive::requireModuli(parameters.moduli);
    return Integration(parameters.moduli, {0, 0, parameters.yieldStress}, start, path, tolerances).run();
}

RateSolution integrateRates(const constitutive::DruckerPragerParameters& parameters, const SymmetricTensor& start,
                            const StrainPath& path, const RateTolerances& tolerances)
{
    const constitutive::DruckerPrager law(parameters);
    const auto& cone = law.cone();
    return Integration(parameters.moduli, {cone.slope, cone.flow, cone.strength}, start, path, tolerances).run();
}
} // namespace mpm::reference
