#pragma once
/// Strength that is lost by shearing. With w = (kappa - from)/over held within [0, 1], every parameter goes from its
/// peak to its residual value linearly,
///
///     c = (1 - w) c_peak + w c_residual,   phi and psi likewise,
///     dkappa = h/referenceLength sqrt(2/3) |dev dEps_p|,        kappa: Particles::plasticStrain
///
/// Shear localises in a band about one cell (h) wide, where a slip u makes the plastic strain u/h; kappa is then
/// u/(sqrt 3 referenceLength) on every grid, and so are the strength along u and the energy a slip plane takes per
/// area. referenceLength is the width of the band the strains `from` and `over` are measured in (of a laboratory's
/// shear band: some 10 to 20 grains); a fixed width in place of h: Pietruszczak & Mroz, "Finite element analysis of
/// deformation of strain-softening materials", Int. J. Numer. Meth. Engng 17 (1981) 327-334; scaled by the cell: Bazant
/// & Oh, "Crack band theory for fracture of concrete", Materials and Structures 16 (1983) 155-177. Where strain is
/// uniform the scaling has no business: a body without localisation softens h/referenceLength times as fast.
///
/// The step is implicit: the stress returns to the surface of the kappa it makes itself, by a secant iteration (exact
/// in one round for cohesion alone on one face) in four returns at most, and only where a lane yields. Where strength
/// falls faster than the stress can be unloaded elastically, kappa takes a few steps more.
///
///     softening               // in a material of law mohrCoulomb or tresca; absent: none, at no cost
///     {
///         from             0;        // [-] >= 0, kappa up to which the peak holds; default 0
///         over             0.1;      // [-] > 0, further kappa over which strength falls
///         cohesion         0.2e3;    // [Pa] residual, in [0, cohesion]; default: the peak's
///         frictionAngle    30;       // [deg] residual, in [0, frictionAngle]; default: the peak's (not of tresca)
///         dilationAngle    0;        // [deg] residual, at most the residual frictionAngle; default: the peak's, or
///         that referenceLength  0.1;      // [m] > 0
///     }
///
/// Not with substep { }. driveLaw has no cells: there h = referenceLength.
/// Verified in tests/unit/softening.cpp and tests/verification/softeningBand.
#include "dictionary/dictionary.hpp"

#include <optional>

namespace mpm::constitutive
{
/// Residual values; angles in degrees.
struct Softening
{
    double from = 0, over = 1;
    double cohesion = 0, frictionAngle = 0, dilationAngle = 0;
    double referenceLength = 1; ///< [m]
};

/// The dictionary `softening` of a material with these peaks, if it is there; nothing if it changes nothing. Without
/// friction the material has no words for angles.
std::optional<Softening> readSoftening(const dictionary::Dictionary& material, double cohesion, double frictionAngle,
                                       double dilationAngle, bool friction);
/// ", softening to cohesion ...", or nothing.
std::string describeSoftening(const std::optional<Softening>& softening, double scale);
} // namespace mpm::constitutive
