#pragma once
/// From system/mpmSchemes to the scene a stepper works on.
///
///     shape           uGIMP;    // uGIMP | cpGIMP | CPDI | quadraticBSpline | cubicBSpline | linear
///     stressUpdate    MUSL;     // USF | USL | MUSL
///     transfer        FLIP;     // FLIP | XPIC | FMPM | APIC | TPIC (stepping/velocityFilter.ipp, transfer/affine.hpp)
///     picRate         0;        // FLIP: [1/s] share of PIC velocity mixed in per second
///     order           2;        // XPIC, FMPM: terms of the filter; 1 is PIC
///     filterRate      5;        // XPIC, FMPM: [1/s] share of the filter mixed in per second; absent: in full
///     filterInterval  1;        // [steps] between filters, with filterRate
///     particleMotion  gridVelocity; // gridVelocity | strainVelocity
///                               // (MUSL with FLIP: second order in time, one more gather)
///     staggeredStart  off;      // on: the first kick is half a step, velocities live at t - dt/2 (not with USF)
///     timeIntegration symplecticEuler; // symplecticEuler | RK2 | RK4 (stepping/rungeKutta.hpp): with RK2 and RK4 all
///                               // of a step is evaluated at each stage, and neither stressUpdate nor staggeredStart
///                               // has a meaning
///     stressTreatment none;     // none | automatic | { ... } (treatment/stressTreatment.hpp)
///     sortInterval    20;       // steps between sorts of the particles
///     damping         { ... }   // nodal/damping.hpp, nodal/localDamping.hpp; absent: none
///     bulkViscosity   { ... }   // treatment/bulkViscosity.hpp; absent: none
///     splitting       { ... }   // splitting/splitParticles.hpp; absent: none
///     merging         { ... }   // splitting/mergeParticles.hpp; absent: none
/// Combinations that make no sense are refused with the reason.
#include "dictionary/dictionary.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Shape's name; the rest goes into the scene.
std::string readSchemes(const dictionary::Dictionary& mpmSchemes, stepping::Scene& scene);

/// stressTreatment, which depends on the materials. Throws InputError where it is not valid for their laws.
treatment::StressTreatment readStressTreatment(const dictionary::Dictionary& mpmSchemes, const stepping::Scene& scene);

/// The words solver and splitParticles share: threshold, mode, maxParticles, maxGeneration.
splitting::Rule readSplitRule(const dictionary::Dictionary& splitting);
/// The same and interval.
splitting::Rule readSplitting(const dictionary::Dictionary& splitting);

} // namespace mpm::cases
