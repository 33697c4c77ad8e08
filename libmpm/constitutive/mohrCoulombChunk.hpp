#pragma once
/// Mohr-Coulomb's return of whole tensors and of whole chunks, over any surface that has returnToSurface() and
/// relativeYield(): with and without tension cut-off, of one material or of its own in every lane.
#include "constitutive/law.hpp"
#include "constitutive/lodeFrame.hpp"
#include "constitutive/mohrCoulombReturn.hpp"

#include <algorithm>
#include <utility>

namespace mpm::constitutive
{
[[gnu::always_inline]] inline Region regionOf(const Returned& r)
{
    Region region = r.plastic ? Region::face : Region::elastic;
    region = r.edge2 ? Region::edge2 : region;
    region = r.edge1 ? Region::edge1 : region;
    region = r.tension ? Region::tension : region;
    return r.apex ? Region::apex : region;
}

/// Plastic work of the mid-step stress, (start + end)/2 : C^-1 (trial - end), split into deviator and mean so that
/// nothing cancels near nu = 0.5.
template <int nc>
[[gnu::always_inline]] inline double plasticWork(const double (&start)[nc], const double (&trial)[nc],
                                                 const double (&end)[nc], double invTwoG, double invK)
{
    double twice[nc], lost[nc]; // twice the mid-step stress
    for (int k = 0; k < nc; ++k)
    {
        twice[k] = start[k] + end[k];
        lost[k] = trial[k] - end[k];
    }
    const double twiceMean = (twice[0] + twice[1] + twice[2]) * (1.0 / 3);
    const double lostMean = (lost[0] + lost[1] + lost[2]) * (1.0 / 3);
    double normal = 0, shear = 0;
    for (int k = 0; k < 3; ++k)
        normal += (twice[k] - twiceMean) * (lost[k] - lostMean);
    for (int k = 3; k < nc; ++k)
        shear += twice[k] * lost[k];
    return (normal + 2 * shear) * (0.5 * invTwoG) + twiceMean * lostMean * (0.5 * invK);
}

/// Plane strain: the in-plane pair from mean and radius, sorted against zz; the way back keeps cos and sin of twice the
/// in-plane angle.
template <class Surface>
[[gnu::always_inline]] inline Returned returnStress(const Surface& c, const double (&trial)[4], double (&end)[4],
                                                    double& yield)
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
template <class Surface>
[[gnu::always_inline]] inline Returned returnStress(const Surface& c, const double (&trial)[6], double (&end)[6],
                                                    double& yield)
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

/// All lanes stay elastic.
template <int dim>
void keepTrial(Chunk<dim>& chunk, const double (&trials)[stressSize<dim>][lanes])
{
    std::copy(&trials[0][0], &trials[0][0] + stressSize<dim> * lanes, &chunk.stress[0][0]);
    reportElastic(chunk);
}

/// A cone inside the pyramid, over all directions of the deviator s: f <= (k - 1) p + sqrt(2/3 (k^2 + k + 1)) |s| - sc,
/// and s1 <= p + sqrt(2/3) |s|. Wholly within it, no lane of a chunk needs a return.
struct ElasticCone
{
    double slope, square, strength, limit; ///< k - 1, 2/3 (k^2 + k + 1), sc, T
    double rounding; ///< share of |p| that covers the rounding of f, so that lanes near the surface take the return

    explicit ElasticCone(const MohrCoulombSurface& c, double tensionLimit = std::numeric_limits<double>::infinity())
        : slope(c.kMinus1), square(2.0 / 3 * (c.k * c.k + c.k + 1) * (1 + 1e-12)), strength(c.strength),
          limit(tensionLimit), rounding(1e-13 * (c.k + 1))
    {}
};

/// Do all trials lie within it? A few operations a lane, no roots; where soil flows the first lanes tell.
template <int dim>
bool staysElastic(const double (&trials)[stressSize<dim>][lanes], const ElasticCone& c)
{
    constexpr double twoThirds = 2.0 / 3 * (1 + 1e-12);
    constexpr int together = 16;
    for (int first = 0; first < lanes; first += together)
    {
        int outside = 0;
        for (int l = first; l < first + together; ++l)
        {
            const double p = (trials[0][l] + trials[1][l] + trials[2][l]) * (1.0 / 3), blur = c.rounding * std::abs(p);
            double ss = 0;
            for (int k = 0; k < 3; ++k)
                ss += (trials[k][l] - p) * (trials[k][l] - p);
            for (int k = 3; k < stressSize<dim>; ++k)
                ss += 2 * trials[k][l] * trials[k][l];
            const double room = c.strength - c.slope * p - blur, tension = c.limit - p - blur;
            const bool inside =
                (room > 0) & (c.square * ss < room * room) & (tension > 0) & (twoThirds * ss < tension * tension);
            outside += !inside;
        }
        if (outside > 0)
            return false;
    }
    return true;
}

/// The return of all lanes; surfaceOf(lane) is the lane's surface.
template <int dim, class SurfaceOf>
[[gnu::always_inline]] inline void returnTrials(Chunk<dim>& chunk, const double (&trials)[stressSize<dim>][lanes],
                                                const ElasticModuli& moduli, SurfaceOf&& surfaceOf)
{
    constexpr int nc = stressSize<dim>;
    const double invTwoG = 1 / (2 * moduli.shear()), invK = 1 / moduli.bulk();
    for (int i = 0; i < lanes; ++i)
    {
        double start[nc], trial[nc], end[nc];
        for (int k = 0; k < nc; ++k)
        {
            start[k] = chunk.stress[k][i];
            trial[k] = trials[k][i];
        }
        const auto& c = surfaceOf(i);
        const Returned r = returnStress(c, trial, end, chunk.yield[i]);
        for (int k = 0; k < nc; ++k)
            chunk.stress[k][i] = end[k];
        const double mean = (trial[0] + trial[1] + trial[2]) * (1.0 / 3);
        chunk.plasticWork[i] = plasticWork<nc>(start, trial, end, invTwoG, invK);
        chunk.apexStrain[i] = (r.apex ? mean - c.apex : 0) * c.dropsVolume;
        chunk.region[i] = regionOf(r);
    }
    chunk.apexReturns = 0;
    for (int i = 0; i < chunk.count; ++i)
        chunk.apexReturns += chunk.region[i] == Region::apex;
}

template <int dim, class Surface>
void returnChunk(Chunk<dim>& chunk, const ElasticModuli& moduli, const Surface& surface, const ElasticCone& inside)
{
    alignas(64) double trials[stressSize<dim>][lanes];
    elasticTrial<dim>(chunk, moduli, trials);
    if (staysElastic<dim>(trials, inside))
        return keepTrial(chunk, trials);
    const Surface c = surface;
    returnTrials(chunk, trials, moduli, [&](int) -> const Surface& { return c; });
}

/// Largest and smallest principal stress.
inline std::pair<double, double> extremePrincipals(const double (&s)[4])
{
    const double centre = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[3]);
    return {std::max(s[2], centre + radius), std::min(s[2], centre - radius)};
}

inline std::pair<double, double> extremePrincipals(const double (&s)[6])
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    const LodeFrame frame = lodeFrame(s);
    const double x = sqrt2over3 * frame.size * frame.theta.cosine, y = sqrtHalf * frame.size * frame.theta.sine;
    return {frame.mean + x, frame.mean - (y + 0.5 * x)};
}

template <int dim, class SurfaceOf>
void yieldOfChunk(Chunk<dim>& chunk, SurfaceOf&& surfaceOf)
{
    for (int i = 0; i < lanes; ++i)
    {
        double s[stressSize<dim>];
        for (int k = 0; k < stressSize<dim>; ++k)
            s[k] = chunk.stress[k][i];
        const auto [s1, s3] = extremePrincipals(s);
        chunk.yield[i] = relativeYield(surfaceOf(i), s1, s3);
    }
}
} // namespace mpm::constitutive
