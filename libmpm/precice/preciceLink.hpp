#pragma once
/// The one door to preCICE: preciceLink.cpp where the library was found when libmpm was configured, preciceAbsent.cpp
/// where it was not.
#include "precice/coupledCase.hpp"

#include <string>

namespace mpm::precice
{
/// "preCICE 3.4.1", or empty.
std::string preciceVersion();
/// Couples the case and runs it to its end; the exit code. InputError where the configuration is wrong, or where there
/// is no preCICE.
int runWithPrecice(CoupledCase& coupled);
} // namespace mpm::precice
