#include "geometry/particleDomains.hpp"

namespace mpm::geometry
{
std::vector<ParticleDomain> particleDomains(const state::Particles& p, std::optional<int> material)
{
    std::vector<ParticleDomain> domains;
    const auto dim = std::size_t(p.dim);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        if (material && p.material[i] != *material)
            continue;
        ParticleDomain& domain = domains.emplace_back();
        domain.volume = p.volume[i];
        for (std::size_t row = 0; row < dim; ++row)
        {
            domain.centre[row] = p.x[row][i];
            for (std::size_t k = 0; k < dim; ++k)
                domain.edges[k][row] = double(p.F[row * dim + k][i]) * double(p.length0[k][i]);
        }
    }
    return domains;
}
} // namespace mpm::geometry
