#pragma once
// A scene in which no effect can be: what is optional in stepping::Scene is empty for the compiler already, so that a
// stepper made for it holds the code of the plain step and nothing else. A new member of Scene that is read in the step
// gets its line here; without one it stays a run-time question of both programs.
#include "shape/uGIMP.hpp"
#include "stepping/explicitStepper.hpp"

namespace counted
{
using namespace mpm;

/// A pointer to nothing.
template <class T>
struct Nothing
{
    Nothing() = default;
    template <class Other>
    Nothing& operator=(const Other&)
    {
        return *this;
    }
    constexpr explicit operator bool() const { return false; }
    T* operator->() const { std::abort(); }
    T& operator*() const { std::abort(); }
};

struct BareTreatment
{
    static constexpr std::optional<treatment::VolumetricAveraging> averaging{};
    static constexpr std::optional<treatment::StressRelaxation> relaxation{};
    static constexpr bool tensionGap = false;
    static constexpr bool any() { return false; }
    static constexpr bool followsFlow() { return false; }
    static constexpr bool hasViscosity() { return false; }
    static constexpr bool averagesElasticPart() { return false; }
};

struct BareScene : stepping::Scene
{
    explicit BareScene(const stepping::Scene& scene) : stepping::Scene(scene) {}

    static constexpr std::optional<Vector3> gravity{};
    static constexpr std::optional<double> relaxationTime{}, localDamping{}, filterRate{};
    static constexpr std::optional<nodal::GravityRamp> gravityRamp{};
    static constexpr std::optional<splitting::Rule> splitting{};
    static constexpr std::optional<splitting::MergeRule> merging{};
    static constexpr std::optional<treatment::BulkViscosity> bulkViscosity{};
    static constexpr Nothing<const stepping::BodyForce> bodyForce{};
    static constexpr stepping::StressUpdate stressUpdate = stepping::StressUpdate::MUSL;
    static constexpr stepping::Transfer transfer = stepping::Transfer::FLIP;
    static constexpr int transferOrder = 2;
    static constexpr bool moveByStrainVelocity = false, staggeredStart = false;
    static constexpr Index filterInterval = 1;
    static constexpr BareTreatment treatment{};
    static constexpr double picRate = 0;
    static constexpr std::optional<stepping::Rest> rest{};
};

/// A list nothing is ever put in.
template <class T>
struct NoList
{
    template <class... A>
    void push_back(A&&...)
    {}
    template <class... A>
    void emplace_back(A&&...)
    {}
    static constexpr T* begin() { return nullptr; }
    static constexpr T* end() { return nullptr; }
    static constexpr std::size_t size() { return 0; }
    static constexpr bool empty() { return true; }
    T& operator[](std::size_t) const { return *begin(); }
};

struct OnlyElastic : shape::UGIMP
{
    using Narrow = OnlyElastic;
};
} // namespace counted

namespace mpm::stepping
{
template <>
struct SceneOf<counted::OnlyElastic>
{
    using Type = counted::BareScene;
    template <class T>
    using List = counted::NoList<T>;
    template <class T>
    using Pointer = counted::Nothing<T>;
    static constexpr bool plain = true;
};
} // namespace mpm::stepping
