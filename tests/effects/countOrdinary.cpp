// Steps of the elastic scene with everything there is: the stepper of mpmSolve, all laws linked.
#include "effects/elasticScene.hpp"
#include "shape/uGIMP.hpp"

int main(int argc, char** argv)
{
    using namespace mpm;
    return counted::steps(argc, argv, [](state::State& state, const stepping::Scene& scene) {
        return stepping::makeExplicitStepper<2, shape::UGIMP>(state, scene);
    });
}
