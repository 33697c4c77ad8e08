#pragma once
/// Mohr-Coulomb's return where every lane has a surface of its own, that of its history kappa (softening.hpp).
///
/// With x the growth of kappa in the step, the return to the surface of kappa + x makes plastic strain and so a growth
/// g(x); wanted is g(x) = x. g hardly changes with x (its slope is the rate of softening over the elastic stiffness),
/// so two secant steps from x = g(0) end within round-off of it; a slope beyond 0.9, where strength falls faster than
/// stress can be unloaded, counts as 0.9. The stress then lies on the surface of the kappa that is kept, to round-off.
/// Lanes do not know of each other.
#include "constitutive/mohrCoulombChunk.hpp"
#include "constitutive/mohrCoulombCutOff.hpp"

#include <numbers>

namespace mpm::constitutive
{
/// sin x for x in [0, pi/2] by its series, so that lanes stay together; error 1e-16.
[[gnu::always_inline]] inline double sineOf(double x)
{
    double sum = 1, square = x * x;
    for (int n = 23; n > 1; n -= 2)
        sum = 1 - sum * square * (1.0 / (n * (n - 1)));
    return x * sum;
}

[[gnu::always_inline]] inline Slope slopeOf(double radians)
{
    const double sine = sineOf(radians), inverse = 1 / (1 - sine), value = (1 + sine) * inverse;
    return {value, 2 * sine * inverse, std::sqrt(value)};
}

/// Peak and residual parameters, angles in radians.
struct SofteningSurface
{
    ElasticModuli moduli;
    double from, invOver, limit;
    double cohesion[2], friction[2], dilation[2];
    double perPressure; ///< 1/K [1/Pa]
    double growth;      ///< of kappa for one |dev sigma_lost|: h/referenceLength sqrt(2/3)/(2 G) [1/Pa]

    SofteningSurface(const MohrCoulombParameters& p, double scale)
        : moduli(p.moduli), from(p.softening->from), invOver(1 / p.softening->over),
          limit(p.tensionCutOff), cohesion{p.cohesion, p.softening->cohesion},
          friction{p.frictionAngle * std::numbers::pi / 180, p.softening->frictionAngle * std::numbers::pi / 180},
          dilation{p.dilationAngle * std::numbers::pi / 180, p.softening->dilationAngle * std::numbers::pi / 180},
          perPressure(1 / p.moduli.bulk()), growth(scale * std::sqrt(2.0 / 3) / (2 * p.moduli.shear()))
    {}

    [[gnu::always_inline]] CutOffSurface at(double kappa) const
    {
        double w = (kappa - from) * invOver;
        w = w > 0 ? w : 0;
        w = w < 1 ? w : 1;
        const auto between = [w](const double(&ends)[2]) { return (1 - w) * ends[0] + w * ends[1]; };
        const double psi = between(dilation);
        return CutOffSurface(limit, moduli.poisson, moduli, between(cohesion), slopeOf(between(friction)), slopeOf(psi),
                             psi > 0 ? 0 : perPressure);
    }
};

/// Sorted principal values.
[[gnu::always_inline]] inline Principal sortedPrincipals(const double (&s)[4])
{
    const double centre = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]);
    const double radius = std::sqrt(half * half + s[3] * s[3]);
    const double major = centre + radius, minor = centre - radius, zz = s[2];
    const bool first = zz > major, last = zz < minor;
    return {first ? zz : major, first ? major : last ? minor : zz, last ? zz : minor};
}

[[gnu::always_inline]] inline Principal sortedPrincipals(const double (&s)[6])
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    const LodeFrame frame = lodeFrame(s);
    const double x = sqrt2over3 * frame.size * frame.theta.cosine, y = sqrtHalf * frame.size * frame.theta.sine;
    return {frame.mean + x, frame.mean + (y - 0.5 * x), frame.mean - (y + 0.5 * x)};
}

/// g of every lane.
inline void growthOfHistory(const SofteningSurface& c, const double (&s)[3][lanes], const double (&kappa)[lanes],
                            const double (&x)[lanes], double (&g)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        const Principal trial{s[0][l], s[1][l], s[2][l]};
        const Returned r = returnToSurface(c.at(kappa[l] + x[l]), trial);
        const double d1 = trial.s1 - r.s.s1, d2 = trial.s2 - r.s.s2, d3 = trial.s3 - r.s.s3;
        const double mean = (d1 + d2 + d3) * (1.0 / 3);
        g[l] = c.growth * std::sqrt((d1 - mean) * (d1 - mean) + (d2 - mean) * (d2 - mean) + (d3 - mean) * (d3 - mean));
    }
}

/// The growth of history x with g(x) = x; false if no lane yields.
inline bool findGrowth(const SofteningSurface& c, const double (&s)[3][lanes], const double (&kappa)[lanes],
                       double (&x)[lanes])
{
    alignas(64) double g[lanes], former[lanes], formerX[lanes] = {};
    std::fill_n(x, lanes, 0.0);
    growthOfHistory(c, s, kappa, x, g);
    for (int round = 0; round < 3; ++round)
    {
        int open = 0;
        for (int l = 0; l < lanes; ++l)
            open += g[l] != x[l];
        if (open == 0)
            return round > 0;
        for (int l = 0; l < lanes; ++l)
        {
            const double step = x[l] - formerX[l];
            double slope = round > 0 && step != 0 ? (g[l] - former[l]) / step : 0;
            slope = slope > 0 ? slope : 0;
            slope = slope < 0.9 ? slope : 0.9;
            const double next = x[l] + (g[l] - x[l]) / (1 - slope);
            former[l] = g[l];
            formerX[l] = x[l];
            x[l] = next > 0 ? next : 0;
        }
        if (round < 2)
            growthOfHistory(c, s, kappa, x, g);
    }
    return true;
}

template <int dim>
void returnSofteningChunk(Chunk<dim>& chunk, const SofteningSurface& surface, const ElasticCone& atPeak)
{
    constexpr int nc = stressSize<dim>;
    alignas(64) double trials[nc][lanes], principals[3][lanes], growth[lanes];
    elasticTrial<dim>(chunk, surface.moduli, trials);
    int softened = 0;
    for (int l = 0; l < lanes; ++l)
        softened += chunk.plasticStrain[l] > surface.from;
    if (softened == 0 && staysElastic<dim>(trials, atPeak))
        return keepTrial(chunk, trials);
    for (int l = 0; l < lanes; ++l)
    {
        double trial[nc];
        for (int k = 0; k < nc; ++k)
            trial[k] = trials[k][l];
        const Principal s = sortedPrincipals(trial);
        principals[0][l] = s.s1;
        principals[1][l] = s.s2;
        principals[2][l] = s.s3;
    }
    if (!findGrowth(surface, principals, chunk.plasticStrain, growth))
        return keepTrial(chunk, trials);
    for (int l = 0; l < lanes; ++l)
        chunk.plasticStrain[l] += growth[l];
    const SofteningSurface c = surface;
    returnTrials(chunk, trials, surface.moduli, [&](int l) { return c.at(chunk.plasticStrain[l]); });
}
} // namespace mpm::constitutive
