#include "constitutive/hencky.hpp"

#include "constitutive/leftStretch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
/// Logarithms of the principal stretches from x = lambda^2 - 1.
template <int dim>
PrincipalStretch<dim> logarithms(const LeftStretch<dim>& b, double (&h)[3])
{
    const auto p = principal(b);
    for (int k = 0; k < 3; ++k)
        h[k] = 0.5 * std::log1p(p.x[k]);
    return p;
}

template <int dim>
void stressOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&stress)[stressSize<dim>][lanes])
{
    const double lame = moduli.lame(), twoMu = 2 * moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        const auto b = leftStretch(F, l);
        double h[3], out[stressSize<dim>];
        const auto p = logarithms<dim>(b, h);
        const double inverse = 1 / (1 + b.volume), mean = lame * std::log1p(b.volume) * inverse;
        turnBack(p, h, out);
        for (int k = 0; k < stressSize<dim>; ++k)
            stress[k][l] = twoMu * inverse * out[k] + (k < 3 ? mean : 0);
    }
}

template <int dim>
void energyOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&energy)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        const auto b = leftStretch(F, l);
        double h[3];
        logarithms<dim>(b, h);
        const double volume = std::log1p(b.volume);
        energy[l] = 0.5 * moduli.lame() * volume * volume + moduli.shear() * (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    }
}

/// With a spatial motion v and a direction n, e = sym(v n), Kirchhoff stresses tau and h = ln lambda:
///     v . Q . v = lambda (tr e)^2 + sum (2 mu - 2 tau_i) e_ii^2 + sum 4 G_ij e_ij^2 + n . tau . n,
///     G_ij = mu d coth d - (tau_i + tau_j)/2,  d = h_i - h_j,  d coth d <= 1 + d^2/3,  e : e <= 1.
template <int dim>
void waveFactorOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&factor)[lanes])
{
    const double lame = moduli.lame(), mu = moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        double h[3];
        logarithms<dim>(leftStretch(F, l), h);
        const double most = std::max({h[0], h[1], h[2]}), least = std::min({h[0], h[1], h[2]}), d = most - least;
        const double mean = lame * (h[0] + h[1] + h[2]);
        const double lowest = mean + 2 * mu * least, highest = mean + 2 * mu * most;
        const double shear = 2 * mu * (1 + d * d * (1.0 / 3)) - 2 * lowest;
        factor[l] = (std::max(lame, 0.0) + std::max(shear, 0.0) + highest) / (lame + 2 * mu);
    }
}
} // namespace

Hencky::Hencky(const ElasticModuli& moduli) : moduli_(moduli)
{
    requireModuli(moduli);
}

Hencky Hencky::read(const dictionary::Dictionary& material)
{
    return Hencky(readModuli(material));
}

std::string Hencky::describe() const
{
    return fmt::format("hencky: E {:g} Pa, nu {:g}", moduli_.young, moduli_.poisson);
}

void Hencky::update(Chunk<2>& chunk) const
{
    stressOf<2>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void Hencky::update(Chunk<3>& chunk) const
{
    stressOf<3>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void Hencky::strainEnergy(const TensorLanes<2>& F, double (&energy)[lanes]) const
{
    energyOf<2>(F, moduli_, energy);
}

void Hencky::strainEnergy(const TensorLanes<3>& F, double (&energy)[lanes]) const
{
    energyOf<3>(F, moduli_, energy);
}

void Hencky::waveFactor(const TensorLanes<2>& F, double (&factor)[lanes]) const
{
    waveFactorOf<2>(F, moduli_, factor);
}

void Hencky::waveFactor(const TensorLanes<3>& F, double (&factor)[lanes]) const
{
    waveFactorOf<3>(F, moduli_, factor);
}
} // namespace mpm::constitutive
