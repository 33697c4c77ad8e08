// Laws in sub-steps: what a step must not change, and what it must.
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/vonMises.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>

using namespace mpm;
using namespace mpm::constitutive;

namespace
{
const MohrCoulombParameters paper{{20e6, 0.42}, 1e3, 42, 0};

template <int dim>
struct Step
{
    Chunk<dim> chunk;
    alignas(64) TensorLanes<dim> L;
    double dt = 1;
};

/// Steps of constant velocity gradient, some elastic, some plastic; the stress is turned as the time step does it.
template <int dim>
std::unique_ptr<Step<dim>> randomSteps(double strain, double spin)
{
    auto out = std::make_unique<Step<dim>>();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int l = 0; l < lanes; ++l)
    {
        for (int k = 0; k < stressSize<dim>; ++k)
            out->chunk.stress[k][l] = k < 3 ? -40e3 + 10e3 * any(random) : 5e3 * any(random);
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j <= i; ++j)
            {
                const double d = strain * any(random), w = i == j ? 0 : spin * any(random);
                out->L[i * dim + j][l] = d + w;
                out->L[j * dim + i][l] = d - w;
            }
    }
    strainIncrement(out->L, out->dt, out->chunk.dStrain);
    rotateStress(out->L, out->dt, out->chunk.stress);
    out->chunk.L = &out->L;
    out->chunk.dt = out->dt;
    return out;
}

/// The same motion in `parts` steps of the plain law.
template <int dim, class Law>
void follow(const Law& law, Step<dim>& step, int parts)
{
    rotateStress(step.L, -step.dt, step.chunk.stress);
    alignas(64) StressLanes<dim> dStrain;
    alignas(64) TensorLanes<dim> L;
    for (int l = 0; l < lanes; ++l)
    {
        double square = 0;
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < i; ++j)
                square += std::pow(0.25 * step.dt * (step.L[i * dim + j][l] - step.L[j * dim + i][l]), 2);
        const double q = std::sqrt(square), scale = q > 0 ? std::tan(std::atan(q) / parts) / q : 0;
        for (int k = 0; k < dim * dim; ++k)
            L[k][l] = scale * step.L[k][l];
    }
    strainIncrement(step.L, step.dt / parts, dStrain);
    for (int n = 0; n < parts; ++n)
    {
        rotateStress(L, step.dt, step.chunk.stress);
        std::memcpy(step.chunk.dStrain, dStrain, sizeof dStrain);
        law.update(step.chunk);
    }
}

template <int dim>
double worst(const Chunk<dim>& a, const Chunk<dim>& b, double scale)
{
    double most = 0;
    for (int l = 0; l < lanes; ++l)
    {
        double d = 0, size = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            d += (k < 3 ? 1 : 2) * std::pow(a.stress[k][l] - b.stress[k][l], 2);
            size += (k < 3 ? 1 : 2) * std::pow(b.stress[k][l], 2);
        }
        most = std::max(most, std::sqrt(d) / std::max(std::sqrt(size), scale));
    }
    return most;
}

template <int dim, class Law>
void meetsTolerance(const Law& plain, const Law& law, double tolerance)
{
    auto rough = randomSteps<dim>(5e-3, 0.4), fine = randomSteps<dim>(5e-3, 0.4), sub = randomSteps<dim>(5e-3, 0.4);
    plain.update(rough->chunk);
    law.update(sub->chunk);
    follow(plain, *fine, 1 << 15);
    INFO(dim << "D " << law.describe());
    CHECK(worst(rough->chunk, fine->chunk, 2e3) > 10 * tolerance);
    CHECK(worst(sub->chunk, fine->chunk, 2e3) < 3 * tolerance);
    for (int l = 0; l < lanes; ++l)
        CHECK(sub->chunk.yield[l] <= 1e-13);
    CHECK(sub->chunk.parts > 3);
    CHECK(sub->chunk.parts < 4096);
}
} // namespace

TEST_CASE("sub-steps bring the stress of a turning step under their tolerance and keep it on the surface")
{
    for (const double tolerance : {1e-3, 1e-4})
    {
        meetsTolerance<2>(MohrCoulomb(paper), MohrCoulomb(paper, Substep{tolerance}), tolerance);
        meetsTolerance<3>(MohrCoulomb(paper), MohrCoulomb(paper, Substep{tolerance}), tolerance);
        meetsTolerance<2>(VonMises({20e6, 0.3}, 20e3), VonMises({20e6, 0.3}, 20e3, Substep{tolerance}), tolerance);
        meetsTolerance<3>(VonMises({20e6, 0.3}, 20e3), VonMises({20e6, 0.3}, 20e3, Substep{tolerance}), tolerance);
    }
}

TEST_CASE("elastic steps are those of the plain law, bitwise and at its cost")
{
    auto plain = randomSteps<2>(1e-6, 0.3), sub = randomSteps<2>(1e-6, 0.3);
    MohrCoulomb({{20e6, 0.42}, 1e5, 42, 0}).update(plain->chunk);
    MohrCoulomb({{20e6, 0.42}, 1e5, 42, 0}, Substep{}).update(sub->chunk);
    CHECK(sub->chunk.parts == 1);
    CHECK(std::memcmp(plain->chunk.stress, sub->chunk.stress, sizeof plain->chunk.stress) == 0);
}

TEST_CASE("a lane's stress does not depend on its neighbours in the chunk")
{
    const MohrCoulomb law(paper, Substep{1e-5});
    auto whole = randomSteps<2>(5e-3, 0.4);
    law.update(whole->chunk);
    for (const int lane : {0, 17, 63})
    {
        auto alone = randomSteps<2>(5e-3, 0.4);
        for (int l = 0; l < lanes; ++l)
        {
            for (int k = 0; k < 4; ++k)
            {
                alone->chunk.stress[k][l] = alone->chunk.stress[k][lane];
                alone->chunk.dStrain[k][l] = alone->chunk.dStrain[k][lane];
                alone->L[k][l] = alone->L[k][lane];
            }
        }
        law.update(alone->chunk);
        for (int k = 0; k < 4; ++k)
            CHECK(alone->chunk.stress[k][lane] == whole->chunk.stress[k][lane]);
        CHECK(alone->chunk.plasticWork[lane] == whole->chunk.plasticWork[lane]);
    }
}

TEST_CASE("elastic energy and plastic work add up to the work of the mid-step stress")
{
    const MohrCoulomb law(paper, Substep{});
    auto s = randomSteps<3>(5e-3, 0.4);
    const auto before = std::make_unique<Chunk<3>>(s->chunk);
    law.update(s->chunk);
    for (int l = 0; l < lanes; ++l)
    {
        double start[6], end[6], work = 0;
        for (int k = 0; k < 6; ++k)
        {
            start[k] = before->stress[k][l];
            end[k] = s->chunk.stress[k][l];
            work += (k < 3 ? 1 : 2) * 0.5 * (start[k] + end[k]) * before->dStrain[k][l];
        }
        const double K = law.bulkModulus(), G = law.shearModulus();
        const double change = elasticEnergyDensity<3>(end, K, G) - elasticEnergyDensity<3>(start, K, G);
        CHECK(change + s->chunk.plasticWork[l] == Approx(work).margin(1e-9));
    }
}
