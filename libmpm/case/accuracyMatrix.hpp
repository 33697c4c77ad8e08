#pragma once
/// The rows of accuracyCost: which settings of a case are tried, from system/accuracyCostDict.
///
///     axes                            // every combination is a row; an axis not named is as in the case
///     {
///         cellSize        (0.4 0.2);  // [m] system/gridDict
///         particlesPerCell (2 3);     // along each axis, system/seedParticlesDict
///         shape           (uGIMP cpGIMP linear);  // system/mpmSchemes, as are the next six
///         transfer        (FLIP XPIC);
///         order           (2);        // of XPIC and FMPM
///         picRate         (0 2);      // [1/s] of FLIP
///         stressUpdate    (USL MUSL);
///         staggeredStart  (no yes);
///         timeIntegration (symplecticEuler RK4);
///         splitting       (off on);   // on: the dictionary `splitting` of the case
///         courant         (0.1 0.4);  // c_p deltaT/cellSize [-], or
///         deltaT          (1e-3);     // [s]
///     }
///     methods                         // instead of axes, or crossed with them: one curve each
///     {
///         original    { shape linear; stressUpdate USL; }
///         convected   { shape cpGIMP; cellSize (0.4 0.2 0.1); }   // a method's own values go before those of axes
///     }
///
/// Where neither courant nor deltaT is given, the Courant number is that of the case. With `adjustTimeStep yes` courant
/// sets maxCo.
///
/// Errors: an unknown axis or word, a value out of bounds, a value given twice, courant beside deltaT, two methods that
/// come to the same row, more than 10,000 rows.
#include "dictionary/dictionary.hpp"

#include <map>
#include <string>
#include <vector>

namespace mpm::cases
{
/// Axis -> value, as they would stand in a dictionary.
using Setting = std::map<std::string, std::string>;

struct MatrixRow
{
    std::string name;   ///< of its folder: "cpGIMP_MUSL-cellSize_0.2-courant_0.4"
    std::string method; ///< of its curve: a name of `methods` and what else is swept but cell size and time step
    Setting setting;    ///< what is changed of the case
};

/// Rows in the order of the dictionary, the last axis running fastest.
std::vector<MatrixRow> readMatrix(const dictionary::Dictionary& accuracyCostDict);

/// One setting, each axis with one value.
Setting readSetting(const dictionary::Dictionary& dict);

/// All axes, in the order of the table's columns.
const std::vector<std::string>& accuracyAxes();

/// The same settings but for the time step.
bool sameButTimeStep(const Setting& a, const Setting& b);
/// The same settings but for the cell size.
bool sameButCellSize(const Setting& a, const Setting& b);
} // namespace mpm::cases
