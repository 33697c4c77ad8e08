#pragma once
/// Stresses of one case against those of another, usually the same scene at twice the resolution.
///
/// The reference is the other's nodal field, Eq. 11, with the other's shape and grid, at points x of ours:
///     sigma_ref(x) = sum_i N_i(x) sigma_i,   N_i as a particle of the other would have it there as seeded (its seed
///     spacing, F = I)
/// Compared is where the other has material around: x lies in its grid, all nodes with N_i(x) > 0 carry mass, and
/// phi(x) = sum_i N_i(x) phi_i >= 2^-dim, phi_i = sum_q V_q N_iq/h^dim, the share of the space around a node that is
/// full: 1/2 on a level surface, 2^-dim at the corner of a block. The field keeps constants, and linear fields away
/// from boundaries.
/// Verified in tests/unit/stressReport.cpp.
#include "smoothing/smoothStress.hpp"

#include <unordered_map>

namespace mpm::smoothing
{
class ReferenceField
{
  public:
    /// Of one stress component. Throws InputError as weightTable does.
    ReferenceField(const state::State& other, const std::string& shape, std::size_t component);

    /// At the particles of another state, not a number where there is nothing to compare with. Throws InputError for
    /// another dimension.
    std::vector<double> at(const state::Particles& particles) const;

  private:
    struct Node
    {
        double stress, full;
    };
    Index key(const Vector3& position) const;

    int dim_;
    state::GridBox grid_;
    Vector3 spacing_{};
    std::string shape_;
    std::unordered_map<Index, Node> nodes_;
};

struct Comparison
{
    double raw = 0, smoothed = 0; ///< RMS of ours - reference over particles, each counted once [Pa]
    double rawByMass = 0;         ///< the same weighted by mass [Pa]
    double reference = 0;         ///< RMS of the reference at the particles compared [Pa]
    double massShare = 0;         ///< of ours, compared [-]
};

/// Raw and smoothed values, one a particle; errors are not a number if no particle is compared.
Comparison compare(const state::Particles& particles, const std::vector<double>& raw,
                   const std::vector<double>& smoothed, const std::vector<double>& reference);
} // namespace mpm::smoothing
