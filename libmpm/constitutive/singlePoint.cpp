#include "constitutive/singlePoint.hpp"

#include <Eigen/Dense>

namespace mpm::constitutive
{
namespace
{
/// exp of a symmetric tensor.
Eigen::Matrix3d exponential(const SymmetricTensor& a, const SymmetricTensor& b)
{
    SymmetricTensor e;
    for (int k = 0; k < 6; ++k)
        e[k] = a[k] + b[k];
    Eigen::Matrix3d m;
    m << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
    if (m.isDiagonal(0))
        return m.diagonal().array().exp().matrix().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(m);
    return axes.eigenvectors() * axes.eigenvalues().array().exp().matrix().asDiagonal() *
           axes.eigenvectors().transpose();
}
} // namespace

PointStep updatePoint(const Law& law, const SymmetricTensor& stress, const SymmetricTensor& dStrain,
                      const SymmetricTensor& strain, double plasticStrain)
{
    alignas(64) TensorLanes<3> F;
    const Eigen::Matrix3d end = law.hyperelastic() ? exponential(strain, dStrain) : Eigen::Matrix3d::Identity();
    for (int k = 0; k < 9; ++k)
        std::fill_n(F[k], lanes, end(k / 3, k % 3));
    Chunk<3> chunk;
    chunk.count = 1;
    chunk.F = &F;
    for (int k = 0; k < 6; ++k)
        for (int i = 0; i < lanes; ++i)
        {
            chunk.stress[k][i] = stress[k];
            chunk.dStrain[k][i] = dStrain[k];
        }
    std::fill_n(chunk.plasticStrain, lanes, plasticStrain);
    law.update(chunk);

    PointStep out{
        {}, chunk.region[0], chunk.plasticWork[0], chunk.apexStrain[0], chunk.yield[0], chunk.plasticStrain[0]};
    for (int k = 0; k < 6; ++k)
        out.stress[k] = chunk.stress[k][0];
    return out;
}

PointStep returnMap(const Law& law, const SymmetricTensor& trial)
{
    return updatePoint(law, trial, {});
}
} // namespace mpm::constitutive
