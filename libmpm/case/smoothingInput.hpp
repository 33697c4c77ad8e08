#pragma once
/// What utilities that judge stored stresses read from a case's dictionaries: smoothStress and stressQuality. Other
/// entries of these dictionaries are the solver's, which checks them.
#include "case/caseDirectory.hpp"

#include <string>

namespace mpm::cases
{
/// The word `shape` of system/mpmSchemes, default uGIMP: whose weights Eqs. 11 and 12 take.
std::string readSmoothingShape(const CaseDirectory& folder);

/// constant/g; zero without that file.
Vector3 readSmoothingGravity(const CaseDirectory& folder);
} // namespace mpm::cases
