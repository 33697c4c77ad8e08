// Bounds and dimensions, checked and shown.
#include "dictionary/body.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
bool Bound::contains(double value) const
{
    return (lowOpen ? value > low : value >= low) && (highOpen ? value < high : value <= high);
}

std::string Bound::text() const
{
    const bool below = low == -std::numeric_limits<double>::infinity();
    const bool above = high == std::numeric_limits<double>::infinity();
    if (below && above)
        return "";
    if (above)
        return fmt::format("{} {}", lowOpen ? ">" : ">=", low);
    if (below)
        return fmt::format("{} {}", highOpen ? "<" : "<=", high);
    return fmt::format("in {}{}, {}{}", lowOpen ? '(' : '[', low, high, highOpen ? ')' : ']');
}

std::string exponentsText(const Dimensions& d)
{
    return fmt::format("[{} {} {} {} {} {} {}]", d[0], d[1], d[2], d[3], d[4], d[5], d[6]);
}

std::string unitText(const Dimensions& dimensions)
{
    if (dimensions == unit::pressure)
        return "Pa";
    static constexpr const char* names[] = {"kg", "m", "s", "K", "mol", "A", "cd"};
    std::string out;
    for (std::size_t i = 0; i < dimensions.size(); ++i)
        if (dimensions[i] != 0)
        {
            out.append(out.empty() ? "" : " ").append(names[i]);
            if (dimensions[i] != 1)
                out += fmt::format("^{}", dimensions[i]);
        }
    return out;
}
} // namespace mpm::dictionary
