#include "reference/mohrCoulombRates.hpp"

#include <numbers>

namespace mpm::reference
{
namespace
{
double slopeOf(double degrees)
{
    const double sine = std::sin(degrees * std::numbers::pi / 180);
    return (1 + sine) / (1 - sine);
}

Matrix3d dyad(const Vector3d& n)
{
    return n * n.transpose();
}

/// A symmetric tensor seen in the plane of two axes: its mean there and its deviator as a 3 x 3 tensor.
struct Plane
{
    double mean;
    Matrix3d deviator;
    double half; ///< half the difference of its principal values
    Vector3d major, minor;
};

Plane inPlane(const Matrix3d& T, const Vector3d& u, const Vector3d& v)
{
    Plane out;
    const double uu = u.dot(T * u), vv = v.dot(T * v), uv = u.dot(T * v), d = 0.5 * (uu - vv);
    out.mean = 0.5 * (uu + vv);
    out.deviator = d * (dyad(u) - dyad(v)) + uv * (u * v.transpose() + v * u.transpose());
    out.half = std::hypot(d, uv);
    const double angle = 0.5 * std::atan2(uv, d);
    out.major = std::cos(angle) * u + std::sin(angle) * v;
    out.minor = std::cos(angle) * v - std::sin(angle) * u;
    return out;
}
} // namespace

Frame sortedFrame(const Matrix3d& sigma)
{
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(sigma);
    return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

Frame followedFrame(const Matrix3d& sigma, const Matrix3d& former)
{
    static constexpr int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    const Frame sorted = sortedFrame(sigma);
    const Matrix3d overlap = (former.transpose() * sorted.axes).cwiseAbs2();
    const int* best = orders[0];
    double most = -1;
    for (const auto& order : orders)
    {
        const double sum = overlap(0, order[0]) + overlap(1, order[1]) + overlap(2, order[2]);
        if (sum > most)
        {
            most = sum;
            best = order;
        }
    }
    Frame out;
    for (int i = 0; i < 3; ++i)
    {
        out.values(i) = sorted.values(best[i]);
        out.axes.col(i) = sorted.axes.col(best[i]);
    }
    return out;
}

MohrCoulombRates::MohrCoulombRates(const constitutive::MohrCoulombParameters& p)
    : k_(slopeOf(p.frictionAngle)), m_(slopeOf(p.dilationAngle)), strength_(2 * p.cohesion * std::sqrt(k_)),
      apex_(p.frictionAngle > 0 ? strength_ / (k_ - 1) : 0), lame_(p.moduli.lame()), shear_(p.moduli.shear())
{
    if (p.frictionAngle == 0)
        k_ = 1;
}

double MohrCoulombRates::yield(const Matrix3d& sigma) const
{
    const Vector3d values = sigma.selfadjointView<Eigen::Lower>().eigenvalues();
    return k_ * values(2) - values(0) - strength_;
}

Matrix3d MohrCoulombRates::elastic(const Matrix3d& e) const
{
    return lame_ * e.trace() * Matrix3d::Identity() + 2 * shear_ * e;
}

MohrCoulombRates::Rate MohrCoulombRates::rate(Region region, const Frame& frame, const Matrix3d& strainRate) const
{
    const Matrix3d T = elastic(strainRate);
    const Vector3d n1 = frame.axes.col(0), n2 = frame.axes.col(1), n3 = frame.axes.col(2);
    const double coupling = (k_ - 1) * (m_ - 1) * lame_;
    switch (region)
    {
    case Region::elastic:
    case Region::tension: // of laws that are not judged here
        break;
    case Region::face: {
        const double lambda = (k_ * n1.dot(T * n1) - n3.dot(T * n3)) / (coupling + 2 * shear_ * (k_ * m_ + 1));
        return {T - lambda * elastic(m_ * dyad(n1) - dyad(n3)), lambda};
    }
    case Region::edge1: {
        const Plane t = inPlane(T, n1, n2);
        const double sum = (k_ * t.mean - n3.dot(T * n3)) / (coupling + shear_ * (k_ * m_ + 2));
        const Matrix3d P = t.deviator / (2 * shear_ * m_) + 0.5 * sum * (dyad(n1) + dyad(n2));
        return {T - elastic(m_ * P - sum * dyad(n3)), 0.5 * sum - t.half / (2 * shear_ * m_)};
    }
    case Region::edge2: {
        const Plane t = inPlane(T, n2, n3);
        const double sum = (k_ * n1.dot(T * n1) - t.mean) / (coupling + shear_ * (2 * k_ * m_ + 1));
        const Matrix3d Q = -t.deviator / (2 * shear_) + 0.5 * sum * (dyad(n2) + dyad(n3));
        return {T - elastic(m_ * sum * dyad(n1) - Q), 0.5 * sum - t.half / (2 * shear_)};
    }
    case Region::apex: {
        const Vector3d e = sortedFrame(strainRate).values;
        return {Matrix3d::Zero(), std::min(e(0) + e(1) + m_ * e(2), e(0) + m_ * (e(1) + e(2)))};
    }
    }
    return {T, 1};
}

Region MohrCoulombRates::decideAtApex(const Matrix3d& strainRate, std::optional<Region> left) const
{
    // The tangent cone of the apex is the whole pyramid: the rate is the return of T to the pyramid of c = 0.
    const Frame frame = sortedFrame(elastic(strainRate));
    if (left != Region::apex && rate(Region::apex, frame, strainRate).margin >= 0)
        return Region::apex;
    if (left != Region::elastic && k_ * frame.values(0) - frame.values(2) <= 0)
        return Region::elastic;
    const Matrix3d onFace = frame.axes.transpose() * rate(Region::face, frame, strainRate).stress * frame.axes;
    return onFace(0, 0) < onFace(1, 1) ? Region::edge1 : onFace(1, 1) < onFace(2, 2) ? Region::edge2 : Region::face;
}

Frame MohrCoulombRates::departure(const Frame& frame, const Matrix3d& strainRate, bool same12, bool same23) const
{
    const Matrix3d T = elastic(strainRate);
    if (same12 && same23)
        return {frame.values, sortedFrame(T).axes};
    Frame out = frame;
    const int first = same12 ? 0 : 1;
    if (same12 || same23)
    {
        const Plane t = inPlane(T, frame.axes.col(first), frame.axes.col(first + 1));
        out.axes.col(first) = t.major;
        out.axes.col(first + 1) = t.minor;
    }
    return out;
}

Region MohrCoulombRates::decide(const Frame& frame, const Matrix3d& strainRate, bool same12, bool same23,
                                std::optional<Region> left) const
{
    if (same12 && same23 && hasApex())
        return decideAtApex(strainRate, left);
    if (same12 && left != Region::edge1 && rate(Region::edge1, frame, strainRate).margin >= 0)
        return Region::edge1;
    if (same23 && left != Region::edge2 && rate(Region::edge2, frame, strainRate).margin >= 0)
        return Region::edge2;
    if (left == Region::elastic)
        return Region::face;
    const Frame face = departure(frame, strainRate, same12, same23);
    return left != Region::face && rate(Region::face, face, strainRate).margin > 0 ? Region::face : Region::elastic;
}
} // namespace mpm::reference
