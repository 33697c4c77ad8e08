#pragma once
/// Independent references for the Mohr-Coulomb tests: complementarity by brute force in principal space, with Eigen.
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/singlePoint.hpp"

#include <Eigen/Dense>
#include <optional>
#include <random>

namespace mpm::test
{
using constitutive::Chunk;
using constitutive::MohrCoulomb;
using constitutive::MohrCoulombParameters;
using constitutive::Region;
using constitutive::SymmetricTensor;

inline Eigen::Matrix3d matrix(const SymmetricTensor& s)
{
    Eigen::Matrix3d m;
    m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    return m;
}

inline SymmetricTensor tensor(const Eigen::Matrix3d& m)
{
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

inline double largest(const SymmetricTensor& s)
{
    return matrix(s).selfadjointView<Eigen::Lower>().eigenvalues().cwiseAbs().maxCoeff();
}

/// The largest difference of two tensors over all axes.
inline double distance(const SymmetricTensor& a, const SymmetricTensor& b)
{
    return (matrix(a) - matrix(b)).norm();
}

/// Uniformly random axes from a random quaternion.
template <class Random>
Eigen::Matrix3d randomAxes(Random& random)
{
    std::normal_distribution<double> normal;
    Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    return q.normalized().toRotationMatrix();
}

struct Complementary
{
    Eigen::Vector3d stress;
    Region region;
    Eigen::Vector3d plasticStrain;
};

/// All subsets of at most three of the six planes k s_i - s_j = sc (i != j), no ordering assumed: the stress with
/// multipliers >= 0 on the subset and f <= 0 on all planes. Nothing if there is none.
inline std::optional<Complementary> complementarity(const MohrCoulombParameters& p, const Eigen::Vector3d& trial)
{
    const double rad = std::acos(-1.0) / 180;
    const double sinPhi = std::sin(p.frictionAngle * rad), sinPsi = std::sin(p.dilationAngle * rad);
    const double k = (1 + sinPhi) / (1 - sinPhi), m = (1 + sinPsi) / (1 - sinPsi), sc = 2 * p.cohesion * std::sqrt(k);
    const double lame = p.moduli.lame(), shear = p.moduli.shear();
    const Eigen::Matrix3d D = lame * Eigen::Matrix3d::Ones() + 2 * shear * Eigen::Matrix3d::Identity();

    Eigen::Matrix<double, 3, 6> A, B;
    int n = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != j)
            {
                A.col(n) = k * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j);
                B.col(n++) = m * Eigen::Vector3d::Unit(i) - Eigen::Vector3d::Unit(j);
            }
    const double size = std::max(trial.cwiseAbs().maxCoeff(), sc), small = 1e-11 * k * size;
    const Eigen::VectorXd f = A.transpose() * trial - Eigen::VectorXd::Constant(6, sc);
    if (f.maxCoeff() <= 0)
        return Complementary{trial, Region::elastic, Eigen::Vector3d::Zero()};

    for (int subset = 1; subset < 64; ++subset)
    {
        std::vector<int> planes;
        for (int i = 0; i < 6; ++i)
            if (subset >> i & 1)
                planes.push_back(i);
        if (planes.size() > 3)
            continue;
        Eigen::MatrixXd a(3, planes.size()), b(3, planes.size());
        Eigen::VectorXd right(planes.size());
        for (std::size_t i = 0; i < planes.size(); ++i)
        {
            a.col(i) = A.col(planes[i]);
            b.col(i) = B.col(planes[i]);
            right(i) = f(planes[i]);
        }
        Eigen::FullPivLU<Eigen::MatrixXd> lu(a.transpose() * D * b);
        lu.setThreshold(1e-9);
        if (!lu.isInvertible())
            continue;
        const Eigen::VectorXd multipliers = lu.solve(right);
        const Eigen::Vector3d stress = trial - D * b * multipliers;
        if (multipliers.minCoeff() < 0 || (A.transpose() * stress).maxCoeff() - sc > small)
            continue;
        Region region = planes.size() == 1 ? Region::face : Region::apex;
        Eigen::Vector3d sorted = stress;
        std::sort(sorted.data(), sorted.data() + 3);
        if (planes.size() == 2)
            region = sorted(2) - sorted(1) < sorted(1) - sorted(0) ? Region::edge1 : Region::edge2;
        return Complementary{stress, region, b * multipliers};
    }
    return std::nullopt;
}
} // namespace mpm::test
