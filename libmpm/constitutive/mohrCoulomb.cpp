#include "constitutive/mohrCoulomb.hpp"

#include "constitutive/lodeFrame.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <utility>

namespace mpm::constitutive
{
namespace
{
struct Slope
{
    double value, minusOne, root; ///< (1 + sin a)/(1 - sin a), the same minus one, its square root
};

/// 1 - sin a without cancellation near 90 degrees, exactly 1 at 0.
Slope slope(double degrees)
{
    const double a = degrees * std::numbers::pi / 180;
    const double half = std::sin(std::numbers::pi / 4 - a / 2);
    const double oneMinusSine = a < 0.5 ? 1 - std::sin(a) : 2 * half * half;
    return {(1 + std::sin(a)) / oneMinusSine, 2 * std::sin(a) / oneMinusSine, std::cos(a) / oneMinusSine};
}

const MohrCoulombParameters& checked(const MohrCoulombParameters& parameters)
{
    requireParameters(parameters);
    return parameters;
}

[[gnu::always_inline]] inline Region regionOf(const Returned& r)
{
    Region region = r.plastic ? Region::face : Region::elastic;
    region = r.edge2 ? Region::edge2 : region;
    region = r.edge1 ? Region::edge1 : region;
    return r.apex ? Region::apex : region;
}

/// Plastic work of the mid-step stress, (start + end)/2 : C^-1 (trial - end), split into deviator and mean so that
/// nothing cancels near nu = 0.5.
template <int nc>
[[gnu::always_inline]] inline double plasticWork(const double (&start)[nc], const double (&trial)[nc],
                                                 const double (&end)[nc], double invTwoG, double invK)
{
    double middle[nc], lost[nc];
    for (int k = 0; k < nc; ++k)
    {
        middle[k] = 0.5 * (start[k] + end[k]);
        lost[k] = trial[k] - end[k];
    }
    const double middleMean = (middle[0] + middle[1] + middle[2]) * (1.0 / 3);
    const double lostMean = (lost[0] + lost[1] + lost[2]) * (1.0 / 3);
    double shear = 0;
    for (int k = 0; k < 3; ++k)
        shear += (middle[k] - middleMean) * (lost[k] - lostMean);
    for (int k = 3; k < nc; ++k)
        shear += 2 * middle[k] * lost[k];
    return shear * invTwoG + middleMean * lostMean * invK;
}

/// Plane strain: the in-plane pair from mean and radius, sorted against zz; the way back keeps cos and sin of twice the
/// in-plane angle.
[[gnu::always_inline]] inline Returned returnStress(const MohrCoulombSurface& c, const double (&trial)[4],
                                                    double (&end)[4], double& yield)
{
    const double centre = 0.5 * (trial[0] + trial[1]), half = 0.5 * (trial[0] - trial[1]);
    const double radius2 = half * half + trial[3] * trial[3];
    const double radius = std::sqrt(radius2);
    const double inverse = radius2 > 0 ? 1 / radius : 0;
    const double major = centre + radius, minor = centre - radius, zz = trial[2];

    const bool zzFirst = zz > major, zzLast = zz < minor;
    Principal s;
    s.s1 = zzFirst ? zz : major;
    s.s2 = zzFirst ? major : zzLast ? minor : zz;
    s.s3 = zzLast ? zz : minor;
    const Returned r = returnToSurface(c, s);

    const double newMajor = zzFirst ? r.s.s2 : r.s.s1;
    const double newMinor = zzLast ? r.s.s2 : r.s.s3;
    const double newZz = zzFirst ? r.s.s1 : zzLast ? r.s.s3 : r.s.s2;
    const double newCentre = 0.5 * (newMajor + newMinor), newRadius = 0.5 * (newMajor - newMinor) * inverse;
    end[0] = r.plastic ? newCentre + newRadius * half : trial[0];
    end[1] = r.plastic ? newCentre - newRadius * half : trial[1];
    end[2] = r.plastic ? newZz : trial[2];
    end[3] = r.plastic ? newRadius * trial[3] : trial[3];
    yield = relativeYield(c, r.s.s1, r.s.s3);
    return r;
}

/// 3D: principal values and the way back in the Lode frame; a and b are the returned deviator turned by theta.
[[gnu::always_inline]] inline Returned returnStress(const MohrCoulombSurface& c, const double (&trial)[6],
                                                    double (&end)[6], double& yield)
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    const LodeFrame frame = lodeFrame(trial);

    const double x = sqrt2over3 * frame.size * frame.theta.cosine;
    const double y = sqrtHalf * frame.size * frame.theta.sine;
    Principal s;
    s.s1 = frame.mean + x;
    s.s2 = frame.mean + (y - 0.5 * x);
    s.s3 = frame.mean - (y + 0.5 * x);
    const Returned r = returnToSurface(c, s);

    const double mean = (r.s.s1 + r.s.s2 + r.s.s3) * (1.0 / 3);
    const double newX = sqrt2over3 * (r.s.s1 - 0.5 * (r.s.s2 + r.s.s3));
    const double newY = sqrtHalf * (r.s.s2 - r.s.s3);
    const double a = newX * frame.theta.cosine + newY * frame.theta.sine;
    const double b = newX * frame.theta.sine - newY * frame.theta.cosine;
    for (int k = 0; k < 6; ++k)
    {
        const double deviator = a * frame.n[k] + b * frame.second[k];
        end[k] = r.plastic ? (k < 3 ? mean + deviator : deviator) : trial[k];
    }
    yield = relativeYield(c, r.s.s1, r.s.s3);
    return r;
}

template <int dim>
void updateChunk(Chunk<dim>& chunk, const ElasticModuli& moduli, const MohrCoulombSurface& surface)
{
    constexpr int nc = stressSize<dim>;
    alignas(64) double trials[nc][lanes];
    elasticTrial<dim>(chunk, moduli, trials);

    const MohrCoulombSurface c = surface;
    const double invTwoG = 1 / (2 * moduli.shear()), invK = 1 / moduli.bulk();
    for (int i = 0; i < lanes; ++i)
    {
        double start[nc], trial[nc], end[nc];
        for (int k = 0; k < nc; ++k)
        {
            start[k] = chunk.stress[k][i];
            trial[k] = trials[k][i];
        }
        const Returned r = returnStress(c, trial, end, chunk.yield[i]);
        for (int k = 0; k < nc; ++k)
            chunk.stress[k][i] = end[k];
        const double mean = (trial[0] + trial[1] + trial[2]) * (1.0 / 3);
        chunk.plasticWork[i] = plasticWork<nc>(start, trial, end, invTwoG, invK);
        chunk.apexStrain[i] = r.apex ? (mean - c.apex) * c.dropsVolume : 0;
        chunk.region[i] = regionOf(r);
    }
    chunk.apexReturns = 0;
    for (int i = 0; i < chunk.count; ++i)
        chunk.apexReturns += chunk.region[i] == Region::apex;
}

/// Largest and smallest principal stress.
std::pair<double, double> extremePrincipals(const double (&s)[4])
{
    const double centre = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[3]);
    return {std::max(s[2], centre + radius), std::min(s[2], centre - radius)};
}

std::pair<double, double> extremePrincipals(const double (&s)[6])
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    const LodeFrame frame = lodeFrame(s);
    const double x = sqrt2over3 * frame.size * frame.theta.cosine, y = sqrtHalf * frame.size * frame.theta.sine;
    return {frame.mean + x, frame.mean - (y + 0.5 * x)};
}

template <int dim>
void yieldOfChunk(Chunk<dim>& chunk, const MohrCoulombSurface& surface)
{
    for (int i = 0; i < lanes; ++i)
    {
        double s[stressSize<dim>];
        for (int k = 0; k < stressSize<dim>; ++k)
            s[k] = chunk.stress[k][i];
        const auto [s1, s3] = extremePrincipals(s);
        chunk.yield[i] = relativeYield(surface, s1, s3);
    }
}
} // namespace

void requireParameters(const MohrCoulombParameters& p)
{
    requireModuli(p.moduli);
    if (!std::isfinite(p.cohesion) || p.cohesion < 0)
        throw InputError(fmt::format("cohesion: found {}, allowed is >= 0", p.cohesion));
    if (!(p.frictionAngle >= 0 && p.frictionAngle < 90))
        throw InputError(fmt::format("frictionAngle: found {}, allowed is in [0, 90)", p.frictionAngle));
    if (!(p.dilationAngle >= 0 && p.dilationAngle <= p.frictionAngle))
        throw InputError(fmt::format("dilationAngle: found {}, allowed is in [0, frictionAngle = {}]", p.dilationAngle,
                                     p.frictionAngle));
}

MohrCoulombSurface::MohrCoulombSurface(const MohrCoulombParameters& p)
{
    const Slope friction = slope(p.frictionAngle), dilation = slope(p.dilationAngle);
    const double nu = p.moduli.poisson, stiff = 1 - 2 * nu, m = dilation.value, mMinus1 = dilation.minusOne;
    k = friction.value;
    kMinus1 = friction.minusOne;
    invK = 1 / k;
    strength = 2 * p.cohesion * friction.root;
    onset = strength / k;

    // D b/(2G) = b + q (1, 1, 1)
    const double q = nu / stiff * mMinus1;
    const double aDb = k * m + 1 + q * kMinus1;
    face2 = q / aDb;
    face3 = (q - 1) / aDb;

    // E g.D^-1: (h1, h1, h3) on l1, (h2, h4, h4) on l2
    const double h1 = stiff - nu * mMinus1, h3 = stiff + mMinus1;
    const double l1 = (2 + k) * stiff + mMinus1 * (k - 2 * nu);
    l1Major = k * h1 / l1;
    l1Minor = k * h3 / l1;
    const double h2 = stiff - 2 * nu * mMinus1, h4 = stiff + mMinus1 * (1 - nu);
    const double l2 = (1 + 2 * k) * stiff + 2 * mMinus1 * (k * (1 - nu) - nu);
    l2Major = k * h2 / l2;
    l2Minor = k * h4 / l2;

    apex = kMinus1 > 0 ? strength / kMinus1 : 0;
    highest = kMinus1 > 0 ? apex : std::numeric_limits<double>::infinity();
    dropsVolume = p.dilationAngle > 0 ? 0 : 1 / p.moduli.bulk();
}

MohrCoulomb::MohrCoulomb(const MohrCoulombParameters& parameters, std::optional<Substep> substep)
    : parameters_(checked(parameters)), surface_(parameters), substep_(substep)
{}

MohrCoulomb MohrCoulomb::read(const dictionary::Dictionary& material)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    MohrCoulombParameters p;
    p.moduli = readModuli(material);
    p.cohesion = material.get<double>({"cohesion", "cohesion c", unit::pressure, Bound::nonNegative()});
    p.frictionAngle =
        material.get<double>({"frictionAngle", "angle of friction phi [deg]", unit::none, Bound::rightOpen(0, 90)});
    p.dilationAngle = material.get<double>({"dilationAngle", "angle of dilation psi [deg], at most frictionAngle",
                                            unit::none, Bound::between(0, p.frictionAngle), 0.0});
    return MohrCoulomb(p, readSubstep(material));
}

std::string MohrCoulomb::describe() const
{
    const auto& p = parameters_;
    return fmt::format(
        "mohrCoulomb: E {:g} Pa, nu {:g}, cohesion {:g} Pa, frictionAngle {:g} deg, dilationAngle {:g} deg{}",
        p.moduli.young, p.moduli.poisson, p.cohesion, p.frictionAngle, p.dilationAngle, describeSubstep(substep_));
}

void MohrCoulomb::update(Chunk<2>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, parameters_.moduli, surface_);
    updateInParts<2>(chunk, *substep_, parameters_.moduli, surface_.strength,
                     [this](Chunk<2>& part) { updateChunk(part, parameters_.moduli, surface_); });
}

void MohrCoulomb::update(Chunk<3>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, parameters_.moduli, surface_);
    updateInParts<3>(chunk, *substep_, parameters_.moduli, surface_.strength,
                     [this](Chunk<3>& part) { updateChunk(part, parameters_.moduli, surface_); });
}

void MohrCoulomb::reportYield(Chunk<2>& chunk) const
{
    yieldOfChunk(chunk, surface_);
}

void MohrCoulomb::reportYield(Chunk<3>& chunk) const
{
    yieldOfChunk(chunk, surface_);
}
} // namespace mpm::constitutive
