#pragma once
/// The values of one field between the times a master said them for.
///
///     constant    the last sample not after t                                            order 1
///     linear                                                                             order 2
///     Hermite     cubic; slopes are other samples (velocities of a displacement)         order 4
///                 without them: those of the parabola through the three samples nearest  order 3
///
/// Before the first sample: the first. After the last sample: the last one; or, where there are slopes, it moves on by
/// their integral - that is how a surface moves of which velocities alone are said. No sample at all: zeros.
/// (C. de Boor 1978, A Practical Guide to Splines, chapter IV.)
///
/// Plain data: copies are independent, and serialise() brings back every bit. CouplingError (badState) for bytes that
/// are none, (wrongSize) for values of another number. Verified in tests/unit/samples.cpp.
#include "coupling/field.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace mpm::coupling
{
class Samples
{
  public:
    explicit Samples(std::size_t valueCount = 0, Interpolation kind = Interpolation::linear)
        : count_(valueCount), kind_(kind)
    {}

    /// What is said for `time`; another word for the same time (to round-off) replaces it. Later samples stay.
    void set(double time, std::span<const double> values);
    /// What was said for later than `time` does not hold any more.
    void dropAfter(double time);
    void setInterpolation(Interpolation kind) { kind_ = kind; }

    std::size_t valueCount() const { return count_; }
    bool empty() const { return times_.empty(); }
    const std::vector<double>& times() const { return times_; }
    std::span<const double> sample(std::size_t k) const { return {values_.data() + k * count_, count_}; }

    void value(double t, std::span<double> out, const Samples* slopes = nullptr) const;
    /// (value(t1) - value(t0))/(t1 - t0): with it, a step goes as far as the samples say.
    void meanRate(double t0, double t1, std::span<double> out, const Samples* slopes = nullptr) const;
    /// At sample k, as Hermite interpolation takes it; two or more samples are needed, or slopes.
    void slopeAt(std::size_t k, std::span<double> out, const Samples* slopes = nullptr) const;
    /// Integral of value over [t0, t1], exact for each interpolation (of these samples alone, without slopes).
    void integral(double t0, double t1, std::span<double> out) const;
    /// integral/(t1 - t0).
    void mean(double t0, double t1, std::span<double> out) const;

    /// Nothing before `time` will be asked for any more: what still matters from then on stays - the last sample not
    /// after it and, for slopes by differences, one before; where `slopes` have moved on beyond the last sample, their
    /// result takes its place. The slopes themselves may then forget what is before times().front() and `time`.
    void forget(double time, const Samples* slopes = nullptr);

    void serialise(std::vector<std::byte>& out) const;
    /// Takes what serialise() wrote from the front of `bytes`.
    static Samples deserialise(std::span<const std::byte>& bytes);

    bool operator==(const Samples&) const = default;

  private:
    /// Sample k with k <= t < k + 1; -1 before the first.
    Index interval(double t) const;

    std::size_t count_;
    Interpolation kind_;
    std::vector<double> times_;  ///< ascending [s]
    std::vector<double> values_; ///< sample by sample
};
} // namespace mpm::coupling
