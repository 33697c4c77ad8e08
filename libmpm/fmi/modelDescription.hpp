#pragma once
/// modelDescription.xml of an FMU (FMI 3.0.2, section 2.4; schema fmi3ModelDescription.xsd).
///
/// Outputs have no dependencies at a communication point: setting an input changes nothing before the next step, so
/// that coupled FMUs make no algebraic loop there.
#include "fmi/fmuVariables.hpp"

#include <string>

namespace mpm::fmi
{
struct ModelFacts
{
    std::string modelName;              ///< of the case
    std::string modelIdentifier;        ///< a C name: of the library
    std::string token;                  ///< instantiationToken
    double startTime = 0, stopTime = 0; ///< [s]; no default stop time if it is not after the start
    double stepSize = 0;                ///< communication step to begin with [s]
};

std::string modelDescription(const ModelFacts& facts, const Variables& variables);

/// The variables as a table of documentation/index.html.
std::string documentationPage(const ModelFacts& facts, const Variables& variables);
/// documentation/externalDependencies.txt
std::string externalDependencies();

/// Text with <, >, &, " and control characters as XML wants them.
std::string xmlText(const std::string& text);
/// A case's name as a C name: letters, digits and '_', not beginning with a digit.
std::string identifierOf(const std::string& name);
} // namespace mpm::fmi
