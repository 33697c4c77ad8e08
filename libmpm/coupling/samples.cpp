#include "coupling/samples.hpp"

#include "coupling/byteStream.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mpm::coupling
{
namespace
{
/// Times a master reached by different sums are one.
bool sameTime(double a, double b)
{
    return std::abs(a - b) <= 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
}
} // namespace

void Samples::set(double time, std::span<const double> values)
{
    if (values.size() != count_)
        throw CouplingError(Fault::wrongSize, fmt::format("found {} values, allowed are {}", values.size(), count_));
    if (!std::isfinite(time))
        throw CouplingError(Fault::notFinite, "found a time that is not finite");
    auto k = std::size_t(std::lower_bound(times_.begin(), times_.end(), time) - times_.begin());
    if (k > 0 && sameTime(times_[k - 1], time))
        --k;
    const auto row = std::ptrdiff_t(k * count_);
    if (k < times_.size() && sameTime(times_[k], time))
        std::copy(values.begin(), values.end(), values_.begin() + row);
    else
    {
        times_.insert(times_.begin() + std::ptrdiff_t(k), time);
        values_.insert(values_.begin() + row, values.begin(), values.end());
    }
}

void Samples::dropAfter(double time)
{
    while (!times_.empty() && times_.back() > time && !sameTime(times_.back(), time))
        times_.pop_back();
    values_.resize(times_.size() * count_);
}

Index Samples::interval(double t) const
{
    return Index(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()) - 1;
}

/// At sample k: of the other samples, or of the parabola through k and two neighbours (two samples: of the line).
void Samples::slopeAt(std::size_t k, std::span<double> out, const Samples* slopes) const
{
    if (slopes && !slopes->empty())
        return slopes->value(times_[k], out);
    const std::size_t last = times_.size() - 1;
    std::size_t a = k > 0 ? k - 1 : 1, b = k < last ? k + 1 : last - 1;
    if (k == 0)
        b = std::min<std::size_t>(2, last);
    else if (k == last)
        b = last > 1 ? last - 2 : a;
    const double ta = times_[a] - times_[k], tb = times_[b] - times_[k];
    for (std::size_t n = 0; n < count_; ++n)
    {
        const double fa = (sample(a)[n] - sample(k)[n]) / ta;
        out[n] = a == b ? fa : (tb * fa - ta * (sample(b)[n] - sample(k)[n]) / tb) / (tb - ta);
    }
}

void Samples::value(double t, std::span<double> out, const Samples* slopes) const
{
    if (out.size() != count_)
        throw CouplingError(Fault::wrongSize,
                            fmt::format("found room for {} values, there are {}", out.size(), count_));
    if (slopes && slopes->empty())
        slopes = nullptr;
    const Index k = interval(t);
    if (times_.empty() || k < 0)
    {
        for (std::size_t n = 0; n < count_; ++n)
            out[n] = times_.empty() ? 0 : values_[n];
        return;
    }
    const auto here = sample(std::size_t(k));
    if (k + 1 == Index(times_.size()))
    {
        std::fill(out.begin(), out.end(), 0.0);
        if (slopes)
            slopes->integral(times_.back(), t, out);
        for (std::size_t n = 0; n < count_; ++n)
            out[n] += here[n];
        return;
    }
    const auto next = sample(std::size_t(k) + 1);
    const double begin = times_[std::size_t(k)], h = times_[std::size_t(k) + 1] - begin, s = (t - begin) / h;
    if (kind_ == Interpolation::constant)
        return void(std::copy(here.begin(), here.end(), out.begin()));
    if (kind_ == Interpolation::linear)
    {
        for (std::size_t n = 0; n < count_; ++n)
            out[n] = here[n] + s * (next[n] - here[n]);
        return;
    }
    std::vector<double> first(count_), second(count_);
    slopeAt(std::size_t(k), first, slopes);
    slopeAt(std::size_t(k) + 1, second, slopes);
    const double toNext = s * s * (3 - 2 * s), ofFirst = h * s * (1 - s) * (1 - s), ofSecond = h * s * s * (s - 1);
    for (std::size_t n = 0; n < count_; ++n)
        out[n] = here[n] + toNext * (next[n] - here[n]) + ofFirst * first[n] + ofSecond * second[n];
}

void Samples::meanRate(double t0, double t1, std::span<double> out, const Samples* slopes) const
{
    std::vector<double> before(count_);
    value(t0, before, slopes);
    value(t1, out, slopes);
    for (std::size_t n = 0; n < count_; ++n)
        out[n] = (out[n] - before[n]) / (t1 - t0);
}

/// Simpson's rule from sample to sample, exact for cubics; where values are constant, what they begin with.
void Samples::integral(double t0, double t1, std::span<double> out) const
{
    std::fill(out.begin(), out.end(), 0.0);
    std::vector<double> at(count_);
    const auto add = [&](double t, double weight) {
        value(t, at);
        for (std::size_t n = 0; n < count_; ++n)
            out[n] += weight * at[n];
    };
    for (double from = t0; from < t1;)
    {
        const auto next = std::upper_bound(times_.begin(), times_.end(), from);
        const double to = next == times_.end() ? t1 : std::min(*next, t1);
        if (kind_ == Interpolation::constant || next == times_.begin() || next == times_.end())
            add(from, to - from);
        else
        {
            add(from, (to - from) / 6);
            add(0.5 * (from + to), (to - from) / 1.5);
            add(to, (to - from) / 6);
        }
        from = to;
    }
}

void Samples::mean(double t0, double t1, std::span<double> out) const
{
    integral(t0, t1, out);
    for (double& x : out)
        x /= t1 - t0;
}

void Samples::forget(double time, const Samples* slopes)
{
    const Index k = interval(time);
    if (k < 0)
        return;
    if (slopes && !slopes->empty() && k + 1 == Index(times_.size()) && times_.back() < time)
    {
        std::vector<double> moved(count_);
        value(time, moved, slopes);
        times_ = {time};
        values_ = std::move(moved);
        return;
    }
    const Index gone = std::max<Index>(0, k - 1);
    times_.erase(times_.begin(), times_.begin() + gone);
    values_.erase(values_.begin(), values_.begin() + gone * Index(count_));
}

void Samples::serialise(std::vector<std::byte>& out) const
{
    putBytes(out, std::uint64_t(count_));
    putBytes(out, std::int64_t(kind_));
    putBytes(out, times_);
    putBytes(out, values_);
}

Samples Samples::deserialise(std::span<const std::byte>& bytes)
{
    const auto count = takeBytes<std::uint64_t>(bytes);
    const auto kind = takeBytes<std::int64_t>(bytes);
    if (kind < 0 || kind > std::int64_t(Interpolation::Hermite))
        throw CouplingError(Fault::badState, fmt::format("found an interpolation number {}", kind));
    Samples out(count, Interpolation(kind));
    out.times_ = takeDoubles(bytes);
    out.values_ = takeDoubles(bytes);
    const std::size_t times = out.times_.size(), values = out.values_.size();
    const bool fits = times == 0 ? values == 0 : values % times == 0 && values / times == count;
    if (!fits || !std::is_sorted(out.times_.begin(), out.times_.end(), std::less_equal<>{}) ||
        !std::all_of(out.times_.begin(), out.times_.end(), [](double t) { return std::isfinite(t); }))
        throw CouplingError(Fault::badState, "found samples whose times and values do not fit");
    return out;
}
} // namespace mpm::coupling
