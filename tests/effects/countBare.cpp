// The same steps, with nothing but them compiled in.
#include "effects/bareScene.hpp"
#include "effects/elasticScene.hpp"
#include "stepping/explicitStepper.ipp"

int main(int argc, char** argv)
{
    using namespace mpm;
    return counted::steps(argc, argv, [](state::State& state, const stepping::Scene& scene) {
        return stepping::makeExplicitStepper<2, counted::OnlyElastic>(state, scene);
    });
}
