#pragma once
/// Materials, chunks and random trial stresses the Mohr-Coulomb tests share.
#include "support/principalReturn.hpp"

namespace mpm::test
{
inline const MohrCoulombParameters paper{{20e6, 0.42}, 1e3, 42, 0}, assoc{{20e6, 0.3}, 10e3, 30, 30},
    nonassoc{{20e6, 0.3}, 10e3, 30, 10}, tresca{{20e6, 0.3}, 10e3, 0, 0}, drySand{{10e6, 0.25}, 0, 35, 5},
    nearIncompressible{{20e6, 0.499}, 1e3, 42, 0};
inline const std::vector<MohrCoulombParameters> materials = {paper,  assoc,   nonassoc,
                                                             tresca, drySand, nearIncompressible};

template <int dim>
void fill(Chunk<dim>& chunk, int lane, const SymmetricTensor& stress, const SymmetricTensor& dStrain = {})
{
    for (int k = 0; k < stressSize<dim>; ++k)
    {
        chunk.stress[k][lane] = stress[k];
        chunk.dStrain[k][lane] = dStrain[k];
    }
}

template <int dim>
SymmetricTensor stressOf(const Chunk<dim>& chunk, int lane)
{
    SymmetricTensor s{};
    for (int k = 0; k < stressSize<dim>; ++k)
        s[k] = chunk.stress[k][lane];
    return s;
}

inline double strength(const MohrCoulombParameters& p)
{
    const double sine = std::sin(p.frictionAngle * std::acos(-1.0) / 180);
    return 2 * p.cohesion * std::sqrt((1 + sine) / (1 - sine));
}

/// f over max(|sigma|, sc), by Eigen.
inline double yieldOf(const MohrCoulombParameters& p, const SymmetricTensor& s)
{
    const double sine = std::sin(p.frictionAngle * std::acos(-1.0) / 180), k = (1 + sine) / (1 - sine);
    const Eigen::Vector3d values = matrix(s).selfadjointView<Eigen::Lower>().eigenvalues();
    const double scale = std::max(values.cwiseAbs().maxCoeff(), strength(p));
    return scale > 0 ? (k * values(2) - values(0) - strength(p)) / scale : 0;
}

/// A principal trial stress outside the surface, sizes from far below to far above the strength.
template <class Random>
Eigen::Vector3d randomTrial(const MohrCoulombParameters& p, Random& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double scale = std::max(strength(p), 1e3) * std::pow(10.0, 1 + uniform(random));
    return scale * (Eigen::Vector3d(uniform(random), uniform(random), uniform(random)) -
                    Eigen::Vector3d::Constant(1 + uniform(random)));
}
} // namespace mpm::test
