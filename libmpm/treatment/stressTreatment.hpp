#pragma once
/// What is done against erratic particle stresses, `stressTreatment` of system/mpmSchemes:
///     none;         // default: the plain scheme
///     automatic;    // the best valid combination for the laws of the scene
///     { volumetricAveraging {...} stressRelaxation {...} tensionGap yes; }   // single remedies
/// See volumetricAveraging.hpp, stressRelaxation.hpp, tensionGap.hpp; cases/trustworthyStress measures them.
#include "constitutive/material.hpp"
#include "treatment/stressRelaxation.hpp"
#include "treatment/volumetricAveraging.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mpm::treatment
{
struct StressTreatment
{
    std::optional<VolumetricAveraging> averaging;
    std::optional<StressRelaxation> relaxation;
    bool tensionGap = false;

    bool any() const { return averaging || relaxation || tensionGap; }
    bool followsFlow() const { return relaxation && relaxation->followsFlow(); }
    bool hasViscosity() const { return averaging && averaging->viscosity > 0; }
    /// Are strains other than those of the particle's own velocity gradient?
    bool averagesElasticPart() const { return averaging && averaging->of == AveragedPart::elastic; }
};

/// "patch average of volume change x 4, stress relaxed to filtered ..., tension gap"; "none".
std::string describe(const StressTreatment& treatment);

/// What `automatic` picks, see automatic.cpp for the rules and their reasons.
StressTreatment automatic(const std::vector<constitutive::Material>& materials);

/// Why a treatment is not valid with these laws: what was found and what to do; none if it is, or without materials.
struct Objection
{
    std::string word, found, allowed;
};
std::optional<Objection> objection(const StressTreatment& treatment,
                                   const std::vector<constitutive::Material>& materials);
} // namespace mpm::treatment
