#include "case/makeStepper.hpp"

#include "base/error.hpp"
#include "shape/CPDI.hpp"
#include "shape/cpGIMP.hpp"
#include "shape/cubicBSpline.hpp"
#include "shape/linear.hpp"
#include "shape/quadraticBSpline.hpp"
#include "shape/uGIMP.hpp"

namespace mpm::cases
{
const std::vector<dictionary::Choice>& shapeCatalogue()
{
    static const std::vector<dictionary::Choice> catalogue = {
        {"uGIMP", "particle domains that keep their size"},
        {"cpGIMP", "particle domains that follow the stretch"},
        {"CPDI", "particle domains that follow stretch, shear and rotation"},
        {"quadraticBSpline", "points and quadratic splines, smooth across cells"},
        {"cubicBSpline", "points and cubic splines, the smoothest"},
        {"linear", "points and hat functions, the original method"}};
    return catalogue;
}

bool limitIgnoresMass(const std::string& shape)
{
    return shape != "linear";
}

bool widensWithStretch(const std::string& shape)
{
    return shape == "cpGIMP";
}

std::unique_ptr<stepping::Stepper> makeStepper(const std::string& shape, state::State& state,
                                               const stepping::Scene& scene)
{
    using stepping::TimeIntegration;
    if (scene.timeIntegration != TimeIntegration::symplecticEuler)
        return makeRungeKutta(shape,
                              scene.timeIntegration == TimeIntegration::RK4 ? stepping::RungeKuttaOrder::RK4
                                                                            : stepping::RungeKuttaOrder::RK2,
                              state, scene);
    const bool flat = state.particles.dim == 2;
    if (shape == "linear")
        return flat ? stepping::makeExplicitStepper<2, shape::Linear>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::Linear>(state, scene);
    if (shape == "uGIMP")
        return flat ? stepping::makeExplicitStepper<2, shape::UGIMP>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::UGIMP>(state, scene);
    if (shape == "cpGIMP")
        return flat ? stepping::makeExplicitStepper<2, shape::CpGIMP>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::CpGIMP>(state, scene);
    if (shape == "CPDI")
        return flat ? stepping::makeExplicitStepper<2, shape::CPDI>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::CPDI>(state, scene);
    if (shape == "quadraticBSpline")
        return flat ? stepping::makeExplicitStepper<2, shape::QuadraticBSpline>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::QuadraticBSpline>(state, scene);
    if (shape == "cubicBSpline")
        return flat ? stepping::makeExplicitStepper<2, shape::CubicBSpline>(state, scene)
                    : stepping::makeExplicitStepper<3, shape::CubicBSpline>(state, scene);
    throw InputError("there is no shape '" + shape + "'");
}

std::string whyNotSmooth(const std::string& shape, const stepping::Scene& scene)
{
    if (shape == "linear" || shape == "CPDI")
        return "gradients of the shape " + shape + " jump where particles cross cell faces";
    return stepping::whyNotSmooth(scene);
}

std::unique_ptr<semiDiscrete::SemiDiscrete> makeSemiDiscrete(const std::string& shape, const state::State& state,
                                                             const stepping::Scene& scene)
{
    using semiDiscrete::makeSemiDiscrete;
    if (const auto why = whyNotSmooth(shape, scene); !why.empty())
        throw InputError(why);
    const auto model = stepping::semiDiscreteModel(scene);
    const bool flat = state.particles.dim == 2;
    if (shape == "uGIMP")
        return flat ? makeSemiDiscrete<2, shape::UGIMP>(state, model) : makeSemiDiscrete<3, shape::UGIMP>(state, model);
    if (shape == "cpGIMP")
        return flat ? makeSemiDiscrete<2, shape::CpGIMP>(state, model)
                    : makeSemiDiscrete<3, shape::CpGIMP>(state, model);
    if (shape == "quadraticBSpline")
        return flat ? makeSemiDiscrete<2, shape::QuadraticBSpline>(state, model)
                    : makeSemiDiscrete<3, shape::QuadraticBSpline>(state, model);
    if (shape == "cubicBSpline")
        return flat ? makeSemiDiscrete<2, shape::CubicBSpline>(state, model)
                    : makeSemiDiscrete<3, shape::CubicBSpline>(state, model);
    throw InputError("there is no shape '" + shape + "'");
}

std::unique_ptr<stepping::Stepper> makeRungeKutta(const std::string& shape, stepping::RungeKuttaOrder order,
                                                  state::State& state, const stepping::Scene& scene)
{
    return stepping::makeRungeKutta(order, makeSemiDiscrete(shape, state, scene), state, scene);
}
} // namespace mpm::cases
