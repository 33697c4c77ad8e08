#pragma once
/// What seeding needs to know of the materials (constant/materialProperties, one dictionary a material):
///
///     soil
///     {
///         law mohrCoulomb; ...            // and its parameters, see constitutive/
///         density 1000;                   // [kg/m^3]
///         initialVelocity (0 0 0);        // [m/s], default; z must be 0 or absent in 2D. Or formulas of the seed's
///                                         // place X Y Z: ("v0*sin(pi*X/25)" 0 0); see dictionary/expression.hpp
///         constants { v0 0.1; }           // names for numbers in them
///         initialStress { type K0; }      // see initialStress.hpp; default none
///     }
#include "dictionary/expression.hpp"
#include "seeding/initialStress.hpp"

#include <string>
#include <vector>

namespace mpm::seeding
{
struct SeedMaterial
{
    std::string name;
    double density = 0;                    ///< [kg/m^3]
    dictionary::VectorExpression velocity; ///< of X, Y (and Z in 3D) [m/s]
    InitialStress initialStress;
    std::string description; ///< of the law, for the banner
    Location where;          ///< of the dictionary
};

/// All materials of the file, in its order. Throws InputError (file:line) for what law, density ... cannot be.
std::vector<SeedMaterial> readMaterials(const dictionary::Dictionary& materialProperties, const Vector3& g, int dim);
} // namespace mpm::seeding
