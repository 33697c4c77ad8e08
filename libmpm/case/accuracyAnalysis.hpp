#pragma once
/// What can be said of errors at several resolutions and prices.
#include <optional>
#include <vector>

namespace mpm::cases
{
/// Least-squares slope of log(error) over log(size); nothing with fewer than two pairs of positive numbers.
std::optional<double> fitOrder(const std::vector<double>& sizes, const std::vector<double>& errors);

/// Which points no other one beats: none is at most as dear and at most as wrong, and better in one of the two. Points
/// with a price or error that is negative or no number are not on the front.
std::vector<bool> paretoFront(const std::vector<double>& prices, const std::vector<double>& errors);

/// Error of the finest of runs with h1 < h2 < h3, from the distances of the others to it, if the error is C h^p
/// (Richardson): d12 = C (h2^p - h1^p), d13 = C (h3^p - h1^p); p is kept in [1/2, 4]. Without the third run p = 1.
struct Richardson
{
    double order = 1, error = 0;
};
std::optional<Richardson> richardson(double h1, double h2, double d12, std::optional<double> h3 = std::nullopt,
                                     std::optional<double> d13 = std::nullopt);

/// Index of the cheapest point with an error of at most `bound`; nothing if there is none.
std::optional<std::size_t> cheapestWithin(const std::vector<double>& prices, const std::vector<double>& errors,
                                          double bound);
} // namespace mpm::cases
