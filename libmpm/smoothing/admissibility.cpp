#include "smoothing/admissibility.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::smoothing
{
namespace
{
/// Over the particles of one material in a chunk; a law sees whole chunks.
template <int dim>
double largestYield(const state::Particles& p, const std::vector<constitutive::Material>& materials)
{
    double largest = 0;
    constitutive::Chunk<dim> chunk;
    const bool history = p.has(&state::Particles::plasticStrain);
    for (Index first = 0; first < p.size(); first += lanes)
    {
        chunk.count = int(std::min<Index>(lanes, p.size() - first));
        for (std::size_t k = 0; k < std::size_t(stressComponents(dim)); ++k)
            for (int l = 0; l < lanes; ++l) // lanes beyond the last particle repeat it
                chunk.stress[k][l] = p.stress[k][std::size_t(first + std::min(l, chunk.count - 1))];
        for (int l = 0; l < lanes && history; ++l)
            chunk.plasticStrain[l] = p.plasticStrain[std::size_t(first + std::min(l, chunk.count - 1))];
        for (std::size_t m = 0; m < materials.size(); ++m)
        {
            const auto begin = p.material.begin() + first, end = begin + chunk.count;
            if (std::find(begin, end, std::int32_t(m)) == end)
                continue;
            materials[m].law->reportYield(chunk);
            for (int l = 0; l < chunk.count; ++l)
                if (begin[l] == std::int32_t(m))
                    largest = std::max(largest, chunk.yield[l]);
        }
    }
    return largest;
}
} // namespace

Admissibility admissibility(const state::State& state, const std::vector<constitutive::Material>& materials,
                            double scale)
{
    const auto& p = state.particles;
    Admissibility out;
    out.yieldViolation = p.dim == 2 ? largestYield<2>(p, materials) : largestYield<3>(p, materials);
    double mass = 0, beyond = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        const double mean = (double(p.stress[0][i]) + double(p.stress[1][i]) + double(p.stress[2][i])) / 3;
        beyond = std::max(beyond, mean - materials[std::size_t(p.material[i])].law->tensionLimit());
        mass += p.mass[i];
        out.massInTension += mean > 0 ? p.mass[i] : 0;
    }
    out.tensionViolation = beyond > 0 ? beyond / scale : 0;
    out.massInTension = mass > 0 ? out.massInTension / mass : 0;
    return out;
}
} // namespace mpm::smoothing
