#pragma once
/// Stress relaxation: particle stresses go towards a field the grid can see,
///     d sigma_p/dt = r (T sigma - sigma)_p,
/// so that what no node feels (the null space of the forces) does not add up for ever. T is `smoothed` (Eqs. 11, 12),
/// `filtered` or `leastSquares` (smoothing/stressTargets.hpp). Over n steps sigma_p += (1 - exp(-r n dt)) (T sigma -
/// sigma)_p: the rate is per second, whatever the step.
///
/// It acts on the stress a step starts from, in front of the law, so the stress a step leaves is admissible. The elastic
/// energy it takes is booked as relaxationLoss.
///
/// Waves: S takes (kh)^2 of a wave of wave number k, the other two (kh)^4. What is at rest: smooth stress need not be in
/// equilibrium where the body ends, so a rate for ever is a creep for ever. Noise is made by straining: r <= perStrain
/// |D_p|, |D| the norm of the strain rate, lets it end with the motion.
///
///     stressRelaxation             // in stressTreatment of system/mpmSchemes; absent: none
///     {
///         target     filtered;     // smoothed | filtered | leastSquares
///         rate       500;          // r at most [1/s]; default 0.6 c_p/h
///         perStrain  5000;         // [-]; 0: no such bound
///         interval   5;            // n [steps]
///     }
///
/// Laws whose stress is a function of F (hyperelastic) are left alone.
/// Cost: a step with it takes two rounds over particles and nodes more (smoothed one, leastSquares a slow one) divided by
/// the interval. Verified in tests/unit/stressRelaxation.cpp.
#include "base/types.hpp"
#include "smoothing/stressTargets.hpp"

#include <optional>

namespace mpm::treatment
{
struct StressRelaxation
{
    smoothing::StressTarget target = smoothing::StressTarget::filtered;
    std::optional<double> rate; ///< [1/s]; none: 0.6 c_p/h
    double perStrain = 5000;
    Index interval = 5;
};

/// rate, or 0.6 c_p/h.
inline double relaxationRate(const StressRelaxation& r, double waveSpeed, double cell)
{
    return r.rate ? *r.rate : 0.6 * waveSpeed / cell;
}

/// 1 - exp(-r n dt) at a strain rate |D| [1/s].
inline double relaxedShare(const StressRelaxation& r, double rate, double strainRate, double dt)
{
    const double bound = r.perStrain * strainRate;
    const double x = (r.perStrain > 0 && bound < rate ? bound : rate) * double(r.interval) * dt;
    const double y = (x < 60 ? x : 60) * (1.0 / 64); // exp(-y) to 1e-9, and its 64th power: no branch, no call
    double power = 1 - y * (1 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120 - y * (1.0 / 720))))));
    for (int k = 0; k < 6; ++k)
        power *= power;
    return 1 - power;
}
} // namespace mpm::treatment
