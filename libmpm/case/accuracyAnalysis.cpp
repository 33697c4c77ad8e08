#include "case/accuracyAnalysis.hpp"

#include <cmath>
#include <cstddef>

namespace mpm::cases
{
namespace
{
constexpr double lowestOrder = 0.5, highestOrder = 4;

bool usable(double value)
{
    return std::isfinite(value) && value >= 0;
}
} // namespace

std::optional<double> fitOrder(const std::vector<double>& sizes, const std::vector<double>& errors)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < sizes.size() && i < errors.size(); ++i)
    {
        if (!(sizes[i] > 0) || !(errors[i] > 0) || !std::isfinite(sizes[i]) || !std::isfinite(errors[i]))
            continue;
        const double a = std::log(sizes[i]), b = std::log(errors[i]);
        n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    const double spread = n * xx - x * x;
    if (n < 2 || !(spread > 1e-12 * n * xx))
        return std::nullopt;
    return (n * xy - x * y) / spread;
}

std::vector<bool> paretoFront(const std::vector<double>& prices, const std::vector<double>& errors)
{
    std::vector<bool> front(prices.size(), false);
    for (std::size_t i = 0; i < prices.size(); ++i)
    {
        front[i] = usable(prices[i]) && usable(errors[i]);
        for (std::size_t j = 0; j < prices.size() && front[i]; ++j)
            if (usable(prices[j]) && usable(errors[j]) && prices[j] <= prices[i] && errors[j] <= errors[i])
                front[i] = !(prices[j] < prices[i] || errors[j] < errors[i]);
    }
    return front;
}

std::optional<Richardson> richardson(double h1, double h2, double d12, std::optional<double> h3,
                                     std::optional<double> d13)
{
    if (!(h2 > h1) || !usable(d12))
        return std::nullopt;
    Richardson out;
    if (h3 && d13 && *h3 > h2 && d12 > 0 && *d13 > 0)
    {
        // (h3^p - h1^p)/(h2^p - h1^p) grows with p
        const auto ratio = [&](double p) {
            return (std::pow(*h3, p) - std::pow(h1, p)) / (std::pow(h2, p) - std::pow(h1, p));
        };
        double low = lowestOrder, high = highestOrder;
        for (int i = 0; i < 60; ++i)
            (ratio(0.5 * (low + high)) < *d13 / d12 ? low : high) = 0.5 * (low + high);
        out.order = 0.5 * (low + high);
    }
    out.error = d12 / (std::pow(h2 / h1, out.order) - 1);
    return out;
}

std::optional<std::size_t> cheapestWithin(const std::vector<double>& prices, const std::vector<double>& errors,
                                          double bound)
{
    std::size_t best = prices.size();
    for (std::size_t i = 0; i < prices.size(); ++i)
        if (usable(prices[i]) && usable(errors[i]) && errors[i] <= bound &&
            (best == prices.size() || prices[i] < prices[best]))
            best = i;
    return best < prices.size() ? std::optional(best) : std::nullopt;
}
} // namespace mpm::cases
