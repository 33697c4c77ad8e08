#pragma once
/// Numbers in the dictionaries of a case as parameters of an FMU: what a master may set before the calculation begins.
///
///     constant/materialProperties    soil { cohesion 1e3; }        materialProperties.soil.cohesion   one number
///     constant/g                     value (0 -9.8 0);             g.value                            three numbers
///
/// Looked into are constant/{g,materialProperties,boundaryConditions,rigidBodies,contactProperties,bodyForce} and
/// system/mpmSchemes as a whole, and deltaT and maxCo of system/controlDict. Left out is what acted when the particles
/// were seeded and is in their state by now: density, initialStress, initialVelocity. Lists of other lengths, words and
/// formulas are no parameters.
///
/// A value that was not changed leaves the dictionary as it is written, to the last bit.
#include "coupling/participant.hpp"

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mpm::fmi
{
/// A unit by its SI exponents (kg m s K mol A cd, as in dictionaries) and that of rad; without a name: a pure number.
struct Unit
{
    std::string name;
    std::array<int, 7> exponents{};
    int rad = 0;
    double factor = 1; ///< of the value in SI units
};

struct Parameter
{
    std::string file, word; ///< "constant/materialProperties", "soil.cohesion"
    std::vector<double> values;
    Unit unit;

    std::string name() const; ///< "materialProperties.soil.cohesion", in FMI's structured naming
};

std::vector<Parameter> numbersOfCase(const std::filesystem::path& caseFolder);

/// What takes the place of a parameter's value in its dictionary: "2000", "(0 -1.6 0)".
coupling::Setting settingOf(const Parameter& parameter, std::span<const double> values);

/// A name's part as FMI's structured naming wants it: wall, but 'left wall' and '2nd' in apostrophes.
std::string namePart(const std::string& text);
} // namespace mpm::fmi
