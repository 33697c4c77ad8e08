#include "dictionary/motion.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
struct Word
{
    const char *word, *help;
    Motion::Given given;
    Dimensions dimensions;
};

Motion readOneOf(const Dictionary& d, const std::array<Word, 3>& words, int dim, int components)
{
    const Word* found = nullptr;
    for (const auto& w : words)
        if (d.found(w.word))
        {
            if (found)
                d.fail(w.word, fmt::format("{} besides {}", w.word, found->word), "one of them");
            found = &w;
        }
    if (!found)
        throw InputError(d.where(), fmt::format("found no motion, allowed is {}, {} or {}", words[0].word,
                                                words[1].word, words[2].word));
    const auto beyond =
        found->given == Motion::Given::acceleration ? TimeFunction::Beyond::zero : TimeFunction::Beyond::holds;
    return Motion(found->given,
                  TimeFunction::read(d, found->word, found->help, found->dimensions, dim, beyond, components));
}

Vector3 combined(const Vector3& a, double factor, const Vector3& b)
{
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
} // namespace

Motion::Motion(Given given, TimeFunction f) : given_(given), f_(std::move(f))
{
    if (given_ == Given::displacement)
        start_ = f_.value(0);
}

Motion Motion::read(const Dictionary& d, int dim)
{
    return readOneOf(d,
                     {{{"displacement", "displacement since t = 0", Given::displacement, unit::length},
                       {"velocity", "velocity", Given::velocity, unit::velocity},
                       {"acceleration", "acceleration from rest at t = 0", Given::acceleration, unit::acceleration}}},
                     dim, 3);
}

Motion readAngle(const Dictionary& d)
{
    using Given = Motion::Given;
    return readOneOf(d,
                     {{{"angle", "angle in rad since t = 0", Given::displacement, unit::none},
                       {"angularVelocity", "angular velocity in rad/s", Given::velocity, unit::rate},
                       {"angularAcceleration", "angular acceleration in rad/s^2, from rest at t = 0",
                        Given::acceleration, Dimensions{0, 0, -2}}}},
                     2, 1);
}

Vector3 Motion::displacement(double t) const
{
    switch (given_)
    {
    case Given::displacement:
        return combined(f_.value(t), -1, start_);
    case Given::velocity:
        return f_.integrals(t).once;
    case Given::acceleration:
        return f_.integrals(t).twice;
    }
    return {};
}

Vector3 Motion::velocity(double t) const
{
    switch (given_)
    {
    case Given::displacement:
        return f_.derivative(t);
    case Given::velocity:
        return f_.value(t);
    case Given::acceleration:
        return f_.integrals(t).once;
    }
    return {};
}

/// Differences of displacements lose digits as t grows, so velocities are taken over the step itself.
Vector3 Motion::meanVelocity(double t, double dt) const
{
    if (const Vector3* v = f_.constant(); v && given_ == Given::velocity)
        return *v;
    switch (given_)
    {
    case Given::displacement:
        return combined({}, 1 / dt, combined(f_.value(t + dt), -1, f_.value(t)));
    case Given::velocity:
        return combined({}, 1 / dt, f_.integrals(t, dt).once);
    case Given::acceleration:
        return combined(velocity(t), 1 / dt, f_.integrals(t, dt).twice);
    }
    return {};
}

bool Motion::stillAlong(std::size_t axis) const
{
    const auto number = f_.number(axis);
    return number && (given_ == Given::displacement || *number == 0);
}

std::string Motion::describe() const
{
    static const char* const names[] = {"displacement", "velocity", "acceleration"};
    static const char* const units[] = {"m", "m/s", "m/s^2"};
    return fmt::format("{} {} {}", names[int(given_)], f_.describe(), units[int(given_)]);
}
} // namespace mpm::dictionary
