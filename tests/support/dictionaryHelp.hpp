#pragma once
/// A dictionary with everything in it, and short ways to ask and to catch messages.
#include "dictionary/dictionary.hpp"

#include <functional>
#include <string>

namespace mpm::tests
{
inline const char* const soilText = R"(FoamFile
{
    version     2.0;
    format      ascii;
    class       dictionary;
    object      materialProperties;
}
/* a comment
   over lines */
stiffness       20e6;           // used by a macro
soil
{
    law             mohrCoulomb;
    density         [1 -3 0 0 0 0 0] 1000;
    E               [1 -1 -2 0 0] $stiffness;
    nu              0.42;
    frictionAngle   42;
    active          on;
    steps           12;
    initialVelocity (0 -1.5e-3 .5);
    title           "a \"soft\" soil";
    layers          (0 2 4.5);
    names           (soil "other soil" div(phi,U));
    points          2((0 0 0) (1 0 0));
    initialStress
    {
        type        K0;
        K0          $..nu;
        again       $..E;
    }
}
clay
{
    $soil;
    E               5e6;
    initialStress
    {
        K0          0.8;
    }
}
copy    $clay;
)";

inline double number(const dictionary::Dictionary& dict, const std::string& word)
{
    return dict.get<double>({word, ""});
}

/// What the InputError of an action says, or "no error".
inline std::string messageOf(const std::function<void()>& action)
{
    try
    {
        action();
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "no error";
}

/// The same of reading a text called "t".
inline std::string messageOf(const std::string& text)
{
    return messageOf([&] { dictionary::Dictionary::fromText(text, "t"); });
}
} // namespace mpm::tests
