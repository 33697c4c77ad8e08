// What callers hand over: mostly what is right, the rest anything.
#include "fuzz/callSequence.hpp"

#include <cmath>
#include <limits>

namespace mpm::fuzz
{
unsigned CallSequence::byte()
{
    if (left_ == 0)
        return 0;
    --left_;
    return *data_++;
}

/// Mostly one that is there.
mpm_participant* CallSequence::participant()
{
    const unsigned b = byte();
    if (b < 160)
        return p_[steady];
    if (b < 240)
        return p_[fresh] ? p_[fresh] : p_[steady];
    if (b < 248)
        return gone_.empty() ? nullptr : gone_[b % gone_.size()];
    return b < 252 ? nullptr : reinterpret_cast<mpm_participant*>(this);
}

/// Place of one in saved_; its size: none of them.
std::size_t CallSequence::savedState()
{
    const unsigned b = byte();
    return saved_.empty() || b > 240 ? saved_.size() : b % saved_.size();
}

const char* CallSequence::name()
{
    static const std::array<const char*, 16> names = {"wall", "wall", "wall",  "wall",  "wall",  "skin",
                                                      "skin", "skin", "skin",  "probe", "probe", "probe",
                                                      "Wall", "",     nullptr, "\xff%s"};
    return names[byte() % names.size()];
}

int32_t CallSequence::enumerator()
{
    const unsigned b = byte();
    return b < 240 ? int32_t(b % 9) : int32_t(b % 16) * 1000 - 3000;
}

double CallSequence::window()
{
    constexpr double inf = std::numeric_limits<double>::infinity(),
                     notANumber = std::numeric_limits<double>::quiet_NaN();
    constexpr std::array<double, 16> windows = {2e-3, 4e-3, 1e-2, 1.7e-3, 1e-3, 5e-3,       1e-5,   3e-3,
                                                2e-3, 1e-2, 0,    -1e-2,  inf,  notANumber, 1e-300, 1e-19};
    return windows[byte() % windows.size()];
}

std::vector<double> CallSequence::values(std::size_t wanted)
{
    const unsigned kind = byte(), b = byte();
    std::vector<double> made(kind % 16 == 1 ? b % 9 : wanted, 0.0);
    const double small = 1e-3 * (double(b) - 128);
    if (wanted == 7 && made.size() == 7)
        made = {-0.5 + 0.25 * small, 0.575, 0, 1, 0, 0, small};
    else
        for (std::size_t i = 0; i < made.size(); i += 3)
            made[i] = (kind & 32 ? 1e3 : 0.1) * small;
    constexpr std::array<double, 6> odd = {std::numeric_limits<double>::quiet_NaN(), 1e308, -HUGE_VAL, 5e-324, 1.9, -1};
    if (kind % 16 == 2 && !made.empty())
        made[b % made.size()] = odd[b % odd.size()];
    if (kind % 16 == 3)
        std::fill(made.begin(), made.end(), 0.0);
    return made;
}
} // namespace mpm::fuzz
