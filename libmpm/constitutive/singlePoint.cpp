#include "constitutive/singlePoint.hpp"

namespace mpm::constitutive
{
PointStep updatePoint(const Law& law, const SymmetricTensor& stress, const SymmetricTensor& dStrain)
{
    Chunk<3> chunk;
    chunk.count = 1;
    for (int k = 0; k < 6; ++k)
        for (int i = 0; i < lanes; ++i)
        {
            chunk.stress[k][i] = stress[k];
            chunk.dStrain[k][i] = dStrain[k];
        }
    law.update(chunk);

    PointStep out{{}, chunk.region[0], chunk.plasticWork[0], chunk.apexStrain[0], chunk.yield[0]};
    for (int k = 0; k < 6; ++k)
        out.stress[k] = chunk.stress[k][0];
    return out;
}

PointStep returnMap(const Law& law, const SymmetricTensor& trial)
{
    return updatePoint(law, trial, {});
}
} // namespace mpm::constitutive
