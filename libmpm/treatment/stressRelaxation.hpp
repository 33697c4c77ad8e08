#pragma once
/// Stress relaxation: particle stresses go towards a field the grid can see,
///     d sigma_p/dt = r (T sigma - sigma)_p,
/// so that what no node feels (the null space of the forces) does not add up for ever. T is `smoothed` (Eqs. 11, 12),
/// `filtered` or `leastSquares` (smoothing/stressTargets.hpp). Over n steps sigma_p += (1 - exp(-r n dt)) (T sigma -
/// sigma)_p: the rate is per second, whatever the step.
///
/// It acts on the stress a step starts from, in front of the law, so the stress a step leaves is admissible. The
/// elastic energy it takes is booked as relaxationLoss.
///
/// Waves: S takes (kh)^2 of a wave of wave number k, the other two (kh)^4. What is at rest: smooth stress need not be
/// in equilibrium where the body ends, so a rate for ever is a creep for ever. And what varies within a cell is not all
/// noise: strains of hat functions are a staircase, so relaxation takes (kh)^2/48 of a wave's strain energy again and
/// again. But noise is made by flow:
///     r = min(rate, perStrain |D_p| a_p),   a_p <- 1 where the law yields, else a_p exp(-dt/memory),
/// |D| the norm of the strain rate. Material that has not flowed is left alone, bit by bit, and so are its waves; what
/// has flowed is relaxed while it still moves.
///
///     stressRelaxation             // in stressTreatment of system/mpmSchemes; absent: none
///     {
///         target     filtered;     // smoothed | filtered | leastSquares
///         rate       500;          // r at most [1/s]; default 0.6 c_p/h
///         perStrain  5000;         // [-]; 0: r = rate everywhere and for ever
///         memory     0.5;          // [s]; default 400 h/c_p
///         interval   5;            // n [steps]
///     }
///
/// Laws whose stress is a function of F (hyperelastic) are left alone.
/// Cost: a step with it takes two rounds over particles and nodes more (smoothed one, leastSquares a slow one) divided
/// by the interval. Verified in tests/unit/stressRelaxation.cpp.
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
    std::optional<double> memory; ///< [s]; none: 400 h/c_p

    bool followsFlow() const { return perStrain > 0; }
    Index interval = 5;
};

/// rate, or 0.6 c_p/h.
inline double relaxationRate(const StressRelaxation& r, double waveSpeed, double cell)
{
    return r.rate ? *r.rate : 0.6 * waveSpeed / cell;
}

/// memory, or 400 h/c_p.
inline double flowMemory(const StressRelaxation& r, double waveSpeed, double cell)
{
    return r.memory ? *r.memory : 400 * cell / waveSpeed;
}

/// 1 - exp(-r n dt) where |D_p| a_p is `flow` [1/s].
inline double relaxedShare(const StressRelaxation& r, double rate, double flow, double dt)
{
    const double bound = r.perStrain * flow;
    const double x = (r.followsFlow() && bound < rate ? bound : rate) * double(r.interval) * dt;
    const double y = (x < 60 ? x : 60) * (1.0 / 64); // exp(-y) to 1e-9, and its 64th power: no branch, no call
    double power = 1 - y * (1 - y * (0.5 - y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120 - y * (1.0 / 720))))));
    for (int k = 0; k < 6; ++k)
        power *= power;
    return 1 - power;
}
} // namespace mpm::treatment
