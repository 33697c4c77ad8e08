#pragma once
/// Laboratory tests of a law at a single point: what driveLaw drives.
///
///     oedometer    axial strain along y, lateral strain zero
///     triaxial     drained compression: axial strain along y, the cell pressure stays on x and z
///     simpleShear  shear strain in the x-y plane, normal strains zero
///     FILE         total strains of a table with columns exx, eyy, ezz, exy, eyz, ezx (tensor components)
///
/// Strains in fixed material axes, of large paths logarithmic ones; tension positive, so a compressed specimen shows
/// negative stresses. The law is driven step by step; the triaxial test solves for the lateral strain of each step by a
/// safeguarded secant iteration on the lateral stress, to 1e-12 of the stress. A hyperelastic law gets F = exp(strain)
/// and reaches the stress at the start by a strain from F = I, which its strains include.
///
/// A law file holds one material, as constant/materialProperties does (its density and initial state are left alone),
/// at its top level or in a dictionary of its own, and may add the set-up of the test:
///
///     law mohrCoulomb;  E 20e6;  nu 0.42;  cohesion 1e3;  frictionAngle 42;
///     test                            // all optional
///     {
///         confiningStress 100e3;      // [Pa] >= 0, compression: cell pressure; vertical stress before shear; default
///                                     // 100e3, for the oedometer 0
///         K0              0.7;        // lateral over vertical stress at the start (oedometer, simpleShear);
///                                     // default nu/(1 - nu)
///         maxStrain       0.05;       // [-] > 0: axial compression, or gamma = 2 exy; default 0.05, oedometer 0.01
///         steps           500;        // steps of the test; for FILE between its rows, default 1
///         startStress     (0 0 0 0 0 0);  // [Pa] xx yy zz xy yz zx, for FILE
///     }
///
/// Tests: tests/unit/soilTests.cpp. Errors: InputError with file:line.
#include "base/csvTable.hpp"
#include "constitutive/singlePoint.hpp"

#include <filesystem>

namespace mpm::constitutive
{
/// oedometer, triaxial, simpleShear.
const std::vector<dictionary::Choice>& soilTestCatalogue();

/// What driveLaw -help says of DICT and PATH.
std::string soilTestHelp();

struct SoilTest
{
    std::string path; ///< name of the test, or the table's file
    double confiningStress = 0, K0 = 0, maxStrain = 0;
    Index steps = 1;
    SymmetricTensor startStress{};
};

struct SoilTestPoint
{
    SymmetricTensor strain, stress; ///< totals [-], [Pa]
    Region region;
    double plasticWork;   ///< since the start [J/m^3]
    double plasticStrain; ///< history of a law that has one (softening.hpp) [-]
};

/// `path` if it names a test or a file; InputError otherwise.
std::string requireSoilTest(const std::string& path);

/// The material of a law file: the file itself, or its only nested dictionary with a law, or the one called `material`.
const dictionary::Dictionary& lawDictionary(const dictionary::Dictionary& file, const std::string& material = "");

/// The set-up: the words of test {} with their defaults for this path. `path` is a test's name or a file.
/// startStress is refused where it has no meaning.
SoilTest readSoilTest(const dictionary::Dictionary& law, const std::string& path, double poisson,
                      bool hyperelastic = false);

/// The first point is the start.
std::vector<SoilTestPoint> runSoilTest(const Law& law, const SoilTest& test);

/// Columns step, exx ... ezx, sxx ... szx, meanStress, deviatorStress (q = sqrt(3/2 s:s)), volumetricStrain,
/// plasticWork, region; and plasticStrain of a law with history.
CsvTable soilTestTable(const std::vector<SoilTestPoint>& points, bool history = false);
} // namespace mpm::constitutive
