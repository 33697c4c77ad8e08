#include "constitutive/smallStrain.hpp"

#include "constitutive/leftStretch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
/// Principal stretches less one, lambda - 1 = x/(1 + sqrt(1 + x)).
template <int dim>
PrincipalStretch<dim> extensions(const LeftStretch<dim>& b, double (&e)[3])
{
    const auto p = principal(b);
    for (int k = 0; k < 3; ++k)
        e[k] = p.x[k] / (1 + std::sqrt(1 + p.x[k]));
    return p;
}

template <int dim>
void stressOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&stress)[stressSize<dim>][lanes])
{
    const double lame = moduli.lame(), twoMu = 2 * moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        const auto b = leftStretch(F, l);
        double e[3], out[stressSize<dim>];
        const auto p = extensions<dim>(b, e);
        const double inverse = 1 / (1 + b.volume), mean = lame * (e[0] + e[1] + e[2]);
        for (int k = 0; k < 3; ++k)
            e[k] = (1 + e[k]) * (mean + twoMu * e[k]) * inverse;
        turnBack(p, e, out);
        for (int k = 0; k < stressSize<dim>; ++k)
            stress[k][l] = out[k];
    }
}

template <int dim>
void energyOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&energy)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        double e[3];
        extensions<dim>(leftStretch(F, l), e);
        const double sum = e[0] + e[1] + e[2];
        energy[l] = 0.5 * moduli.lame() * sum * sum + moduli.shear() * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    }
}

/// With a spatial motion v and a direction n, e = sym(v n), s = tr(V - I) and Kirchhoff stresses tau:
///     v . Q . v = lambda (v . V . n)^2 + (2 mu - lambda s) (sum lambda_i e_ii^2
///                 + sum 4 lambda_i lambda_j/(lambda_i + lambda_j) e_ij^2) + n . tau . n,  e : e <= 1.
template <int dim>
void waveFactorOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&factor)[lanes])
{
    const double lame = moduli.lame(), mu = moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        double e[3];
        extensions<dim>(leftStretch(F, l), e);
        const double sum = lame * (e[0] + e[1] + e[2]), most = 1 + std::max({e[0], e[1], e[2]});
        double highest = (1 + e[0]) * (sum + 2 * mu * e[0]);
        for (int k = 1; k < 3; ++k)
            highest = std::max(highest, (1 + e[k]) * (sum + 2 * mu * e[k]));
        const double shear = most * std::max(2 * mu - sum, 0.0);
        factor[l] = (std::max(lame, 0.0) * most * most + shear + highest) / (lame + 2 * mu);
    }
}
} // namespace

SmallStrain::SmallStrain(const ElasticModuli& moduli) : moduli_(moduli)
{
    requireModuli(moduli);
}

SmallStrain SmallStrain::read(const dictionary::Dictionary& material)
{
    return SmallStrain(readModuli(material));
}

std::string SmallStrain::describe() const
{
    return fmt::format("smallStrain: E {:g} Pa, nu {:g}", moduli_.young, moduli_.poisson);
}

void SmallStrain::update(Chunk<2>& chunk) const
{
    stressOf<2>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void SmallStrain::update(Chunk<3>& chunk) const
{
    stressOf<3>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void SmallStrain::strainEnergy(const TensorLanes<2>& F, double (&energy)[lanes]) const
{
    energyOf<2>(F, moduli_, energy);
}

void SmallStrain::strainEnergy(const TensorLanes<3>& F, double (&energy)[lanes]) const
{
    energyOf<3>(F, moduli_, energy);
}

void SmallStrain::waveFactor(const TensorLanes<2>& F, double (&factor)[lanes]) const
{
    waveFactorOf<2>(F, moduli_, factor);
}

void SmallStrain::waveFactor(const TensorLanes<3>& F, double (&factor)[lanes]) const
{
    waveFactorOf<3>(F, moduli_, factor);
}
} // namespace mpm::constitutive
