#include "reference/rateEquations.hpp"

#include "reference/mohrCoulombRates.hpp"
#include "reference/odeSolver.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::reference
{
namespace
{
Matrix3d matrix(const double* s)
{
    Matrix3d m;
    m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    return m;
}

void store(const Matrix3d& m, double* s)
{
    const double values[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
    std::copy(values, values + 6, s);
}

double norm(const SymmetricTensor& s)
{
    double sum = 0;
    for (const double x : s)
        sum += x * x;
    return std::sqrt(sum);
}

/// One integration: the state of the event loop.
class Integration
{
  public:
    Integration(const constitutive::MohrCoulombParameters& parameters, const SymmetricTensor& start,
                const StrainPath& path, const RateTolerances& tolerances)
        : rates_(parameters), path_(path), tolerances_(tolerances), sigma_(matrix(start.data())),
          scale_(stressScale(parameters, start)),
          ode_(6, tolerances.relative, tolerances.absolute * scale_,
               [this](double t, const double* y, double* rate) { rightHandSide(t, y, rate); })
    {
        if (rates_.yield(sigma_) > surfaceTolerance * scale_)
            throw InputError(fmt::format("start stress: found f = {:g} Pa, allowed is inside the yield surface, f <= 0",
                                         rates_.yield(sigma_)));
    }

    RateSolution run()
    {
        solution_.stress.push_back(tensor());
        t_ = path_.begin();
        for (piece_ = 0; piece_ < path_.pieces(); ++piece_)
        {
            runPiece(path_.breaks()[piece_ + 1]);
            solution_.stress.push_back(tensor());
        }
        solution_.evaluations = ode_.evaluations();
        return std::move(solution_);
    }

  private:
    static constexpr double surfaceTolerance =
        1e-10; ///< |f| over the stress scale that counts as zero where pieces begin

    double stressScale(const constitutive::MohrCoulombParameters& parameters, const SymmetricTensor& start) const
    {
        const double scale = std::max(norm(start), rates_.strength());
        if (scale > 0)
            return scale;
        double strain = 0;
        for (std::size_t i = 0; i < path_.pieces(); ++i)
            strain = std::max(strain, norm(path_.increment(i, path_.breaks()[i], path_.breaks()[i + 1])));
        return strain > 0 ? parameters.moduli.young * strain : 1;
    }

    SymmetricTensor tensor() const
    {
        SymmetricTensor out;
        store(sigma_, out.data());
        return out;
    }

    Matrix3d strainRate(double t) const
    {
        const SymmetricTensor e = path_.rate(piece_, t);
        return matrix(e.data());
    }

    void rightHandSide(double t, const double* y, double* out) const
    {
        const Frame frame = followedFrame(matrix(y), axes_);
        store(rates_.rate(region_, frame, strainRate(t)).stress, out);
    }

    /// f in the elastic region (beyond the drift it was entered with); otherwise the margin and the gaps s1 - s2, s2 -
    /// s3 that are open, beyond what counts as closed: the edge tolerance, or less where the region was entered with
    /// less.
    OdeEvents events() const
    {
        if (region_ == Region::elastic)
        {
            // from just below zero, so that a path that dips inside for an instant is seen to come back
            const double drift = std::max(0.0, rates_.yield(sigma_) / scale_ + tolerances_.edge);
            return {[this, drift](double, const double* y, double* values) {
                        values[0] = rates_.yield(matrix(y)) / scale_ - drift;
                    },
                    {1}};
        }
        const bool open12 = region_ == Region::face || region_ == Region::edge2;
        const bool open23 = region_ == Region::face || region_ == Region::edge1;
        const Frame frame = followedFrame(sigma_, axes_);
        const auto closed = [&](int i) {
            const double gap = (frame.values(i) - frame.values(i + 1)) / scale_;
            return gap > tolerances_.edge ? tolerances_.edge : gap - tolerances_.edge;
        };
        return {[this, open12, open23, closed12 = closed(0), closed23 = closed(1)](double t, const double* y,
                                                                                   double* values) {
                    const Frame now = followedFrame(matrix(y), axes_);
                    values[0] = rates_.rate(region_, now, strainRate(t)).margin;
                    values[1] = open12 ? (now.values(0) - now.values(1)) / scale_ - closed12 : 1;
                    values[2] = open23 ? (now.values(1) - now.values(2)) / scale_ - closed23 : 1;
                },
                {-1, -1, -1}};
    }

    /// Decides the region at the present state and starts CVODE there.
    void enter(std::optional<Region> left, double end)
    {
        Frame frame = sortedFrame(sigma_);
        const double near = 2.5 * tolerances_.edge * scale_;
        const bool same12 = frame.values(0) - frame.values(1) <= near;
        const bool same23 = frame.values(1) - frame.values(2) <= near;
        const bool onSurface =
            left == Region::elastic || region_ != Region::elastic || rates_.yield(sigma_) > -surfaceTolerance * scale_;
        Region region = Region::elastic;
        if (onSurface)
        {
            Matrix3d rate = strainRate(t_);
            if (rate.isZero(0) || left == Region::apex) // nothing moves at this instant: what comes next decides
                rate = strainRate(t_ + 1e-6 * (end - t_));
            region = rates_.decide(frame, rate, same12, same23, left);
        }
        if (region == Region::edge1)
            frame.values(0) = frame.values(1) = 0.5 * (frame.values(0) + frame.values(1));
        if (region == Region::edge2)
            frame.values(1) = frame.values(2) = 0.5 * (frame.values(1) + frame.values(2));
        if (region == Region::apex)
            frame.values.setConstant(rates_.apex());
        sigma_ = frame.axes * frame.values.asDiagonal() * frame.axes.transpose();

        if (solution_.events.empty() || region != region_)
            solution_.events.push_back({t_, region});
        if (region != Region::elastic && !solution_.yieldTime)
            solution_.yieldTime = t_;
        region_ = region;
        const bool fromApex = same12 && same23 && region != Region::apex;
        if (region == Region::face ? same12 || same23 : region != Region::elastic && fromApex)
            depart(frame, same12, same23, end);
        axes_ = sortedFrame(sigma_).axes;
        std::vector<double> y(6);
        store(sigma_, y.data());
        ode_.restart(t_, y, events());
    }

    /// One Heun step into the region, just long enough to open the gap of repeated values.
    void depart(const Frame& frame, bool same12, bool same23, double end)
    {
        const auto rateAt = [&](double t, const Frame& at) {
            const Matrix3d e = strainRate(t);
            return rates_.rate(region_, rates_.departure(at, e, same12, same23), e).stress;
        };
        const auto opening = [&](const Matrix3d& rate) {
            const Vector3d values = sortedFrame(frame.axes.transpose() * rate * frame.axes).values;
            if (same12 && same23)
                return values.norm();
            const int i = same12 ? 0 : 1;
            const Matrix3d block = frame.axes.transpose() * rate * frame.axes;
            return std::hypot(block(i, i) - block(i + 1, i + 1), 2 * block(i, i + 1));
        };
        const Matrix3d now = rateAt(t_, frame);
        double step = 1e-12 * (end - t_);
        Matrix3d change;
        for (bool last = false; !last; step *= 2)
        {
            last = step >= end - t_;
            step = last ? end - t_ : step;
            const Frame ahead = followedFrame(sigma_ + step * now, frame.axes);
            const Matrix3d then = rateAt(t_ + step, same12 && same23 ? frame : ahead);
            change = 0.5 * step * (now + then);
            last = last || 0.5 * step * (opening(now) + opening(then)) >= tolerances_.departure * scale_;
            if (last)
                break;
        }
        sigma_ += change;
        t_ += step;
    }

    void runPiece(double end)
    {
        const double instant = 1e-13 * (path_.end() - path_.begin());
        int standing = 0;
        ode_.limitStep((end - t_) / (path_.straight() ? 4 : 200));
        enter({}, end);
        while (end - t_ > instant)
        {
            const double before = t_;
            const OdeSolver::Stop stop = ode_.advance(end);
            t_ = ode_.time();
            sigma_ = matrix(ode_.state().data());
            axes_ = followedFrame(sigma_, axes_).axes;
            if (region_ != Region::elastic)
                solution_.drift =
                    std::max(solution_.drift, std::abs(rates_.yield(sigma_)) / std::max(sigma_.norm(), scale_));
            if (stop != OdeSolver::Stop::event)
                continue;
            standing = t_ - before > instant ? 0 : standing + 1;
            if (standing > 50)
                throw StepError(
                    fmt::format("the reference solution stands still at t = {:g}: {} events", t_, standing));
            const auto happened = ode_.happened();
            enter(happened[0] ? std::optional(region_) : std::nullopt, end);
        }
        t_ = end;
    }

    MohrCoulombRates rates_;
    const StrainPath& path_;
    RateTolerances tolerances_;
    Matrix3d sigma_, axes_;
    double scale_;
    OdeSolver ode_;
    RateSolution solution_;
    Region region_ = Region::elastic;
    std::size_t piece_ = 0;
    double t_ = 0;
};
} // namespace

RateSolution integrateRates(const constitutive::MohrCoulombParameters& parameters, const SymmetricTensor& start,
                            const StrainPath& path, const RateTolerances& tolerances)
{
    constitutive::requireParameters(parameters);
    return Integration(parameters, start, path, tolerances).run();
}

std::vector<ReturnMapError> judgeReturnMap(const constitutive::Law& law, const SymmetricTensor& start,
                                           const StrainPath& path, const RateSolution& exact,
                                           const std::vector<int>& steps)
{
    double size = 0;
    for (const auto& s : exact.stress)
        size = std::max(size, norm(s));
    const auto distance = [](const SymmetricTensor& a, const SymmetricTensor& b) {
        SymmetricTensor d;
        for (int k = 0; k < 6; ++k)
            d[k] = a[k] - b[k];
        return norm(d);
    };

    std::vector<ReturnMapError> out;
    for (const int n : steps)
    {
        constitutive::PointStep point{start, Region::elastic, 0, 0, 0};
        double largest = 0;
        for (std::size_t piece = 0; piece < path.pieces(); ++piece)
        {
            const double from = path.breaks()[piece], length = path.breaks()[piece + 1] - from;
            for (int i = 0; i < n; ++i)
                point = updatePoint(law, point.stress,
                                    path.increment(piece, from + length * i / n, from + length * (i + 1) / n));
            largest = std::max(largest, distance(point.stress, exact.stress[piece + 1]));
        }
        const double last = norm(exact.stress.back());
        ReturnMapError row{n,
                           distance(point.stress, exact.stress.back()) / (last > 0   ? last
                                                                          : size > 0 ? size
                                                                                     : 1),
                           largest / (size > 0 ? size : 1),
                           point.yield,
                           {},
                           point.stress};
        if (!out.empty() && row.final > 0)
            row.order = std::log(out.back().final / row.final) / std::log(double(n) / out.back().steps);
        out.push_back(row);
    }
    return out;
}
} // namespace mpm::reference
