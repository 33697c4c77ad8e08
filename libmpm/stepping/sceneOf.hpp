#pragma once
/// What of a scene the compiler knows when it makes a stepper.
#include "stepping/stepper.hpp"

#include <memory>
#include <vector>

namespace mpm::stepping
{
/// What the stepper of a shape keeps its scene in. A scene says at run time what is absent; tests/effects has one that
/// says so at compile time, to count what absent effects cost.
template <class Shape>
struct SceneOf
{
    using Type = Scene;
    template <class T>
    using List = std::vector<T>;
    template <class T>
    using Pointer = std::unique_ptr<T>;
    /// Is there nothing but the plain step of FLIP with a law that is elastic in rate form?
    static constexpr bool plain = false;
};

/// A bool that is false for the compiler already.
struct Never
{
    constexpr Never(bool = false) {}
    constexpr operator bool() const { return false; }
};
} // namespace mpm::stepping
