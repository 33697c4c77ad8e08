#include "constitutive/rigid.hpp"

#include "constitutive/elasticTrial.hpp"

#include <algorithm>

namespace mpm::constitutive
{
namespace
{
template <int dim>
void updateRigid(Chunk<dim>& chunk)
{
    std::fill_n(&chunk.stress[0][0], stressSize<dim> * lanes, 0.0);
    reportElastic(chunk);
}
} // namespace

Rigid Rigid::read(const dictionary::Dictionary& material)
{
    material.passOver("motion", "how it moves, read with constant/contactProperties");
    return {};
}

void Rigid::update(Chunk<2>& chunk) const
{
    updateRigid(chunk);
}

void Rigid::update(Chunk<3>& chunk) const
{
    updateRigid(chunk);
}
} // namespace mpm::constitutive
