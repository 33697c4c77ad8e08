#include "constitutive/neoHookean.hpp"

#include "constitutive/leftStretch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
template <int dim>
void stressOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&stress)[stressSize<dim>][lanes])
{
    alignas(64) double logJ[lanes], volume[lanes];
    for (int l = 0; l < lanes; ++l)
        volume[l] = leftStretch(F, l).volume;
    for (int l = 0; l < lanes; ++l)
        logJ[l] = std::log1p(volume[l]);
    const double lame = moduli.lame(), mu = moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        const auto b = leftStretch(F, l);
        const double inverse = 1 / (1 + volume[l]), pressure = lame * logJ[l];
        for (int k = 0; k < stressSize<dim>; ++k)
            stress[k][l] = (mu * b.x[k] + (k < 3 ? pressure : 0)) * inverse;
    }
}

/// j - ln(1 + j), also where j is small: ln(1 + j) = 2 (z + z^3/3 + z^5/5 ...), z = j/(2 + j), and j - 2 z = j z.
double beyondLogarithm(double j)
{
    const double z = j / (2 + j), square = z * z;
    if (square > 0.03)
        return j - std::log1p(j);
    double sum = 0;
    for (int k = 23; k >= 3; k -= 2)
        sum = 1.0 / k + square * sum;
    return j * z - 2 * z * square * sum;
}

/// tr b - 3 - 2 ln J = (tr(b - I) - 2 (J - 1)) + 2 (J - 1 - ln J); the first is H : H - 2 II(H) - 2 det H.
template <int dim>
double shapeChange(const TensorLanes<dim>& F, int l, double volume)
{
    double h[3][3] = {}, squares = 0;
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
        {
            h[i][j] = i == j ? F[i * dim + j][l] - 1 : F[i * dim + j][l];
            squares += h[i][j] * h[i][j];
        }
    const double xy = h[0][0] * h[1][1] - h[0][1] * h[1][0], yz = h[1][1] * h[2][2] - h[1][2] * h[2][1],
                 zx = h[0][0] * h[2][2] - h[0][2] * h[2][0];
    const double det = h[0][0] * yz - h[0][1] * (h[1][0] * h[2][2] - h[1][2] * h[2][0]) +
                       h[0][2] * (h[1][0] * h[2][1] - h[1][1] * h[2][0]);
    return squares - 2 * (xy + yz + zx + det) + 2 * beyondLogarithm(volume);
}

template <int dim>
void energyOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&energy)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        const double volume = leftStretch(F, l).volume, logJ = std::log1p(volume);
        energy[l] = 0.5 * (moduli.shear() * shapeChange<dim>(F, l, volume) + moduli.lame() * logJ * logJ);
    }
}

template <int dim>
void waveFactorOf(const TensorLanes<dim>& F, const ElasticModuli& moduli, double (&factor)[lanes])
{
    const double lame = moduli.lame(), mu = moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        const auto b = leftStretch(F, l);
        const auto p = principal(b);
        const double along = lame * (1 - std::log1p(b.volume)) + mu;
        factor[l] = ((along > 0 ? along : 0) + mu * (1 + std::max(p.x[0], p.x[2]))) / (lame + 2 * mu);
    }
}
} // namespace

NeoHookean::NeoHookean(const ElasticModuli& moduli) : moduli_(moduli)
{
    requireModuli(moduli);
}

NeoHookean NeoHookean::read(const dictionary::Dictionary& material)
{
    return NeoHookean(readModuli(material));
}

std::string NeoHookean::describe() const
{
    return fmt::format("neoHookean: E {:g} Pa, nu {:g}", moduli_.young, moduli_.poisson);
}

void NeoHookean::update(Chunk<2>& chunk) const
{
    stressOf<2>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void NeoHookean::update(Chunk<3>& chunk) const
{
    stressOf<3>(*chunk.F, moduli_, chunk.stress);
    reportElastic(chunk);
}

void NeoHookean::strainEnergy(const TensorLanes<2>& F, double (&energy)[lanes]) const
{
    energyOf<2>(F, moduli_, energy);
}

void NeoHookean::strainEnergy(const TensorLanes<3>& F, double (&energy)[lanes]) const
{
    energyOf<3>(F, moduli_, energy);
}

void NeoHookean::waveFactor(const TensorLanes<2>& F, double (&factor)[lanes]) const
{
    waveFactorOf<2>(F, moduli_, factor);
}

void NeoHookean::waveFactor(const TensorLanes<3>& F, double (&factor)[lanes]) const
{
    waveFactorOf<3>(F, moduli_, factor);
}
} // namespace mpm::constitutive
