#include "seeding/seedMaterials.hpp"

#include "constitutive/law.hpp"

#include <fmt/format.h>

namespace mpm::seeding
{
std::vector<SeedMaterial> readMaterials(const dictionary::Dictionary& materialProperties, const Vector3& g, int dim)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    const std::vector<std::string> place =
        dim == 2 ? std::vector<std::string>{"X", "Y"} : std::vector<std::string>{"X", "Y", "Z"};
    std::vector<SeedMaterial> materials;
    for (const std::string& name : materialProperties.dictNames())
    {
        const auto& dict = materialProperties.subDict(name, "a material");
        const auto law = constitutive::makeLaw(dict);
        SeedMaterial material;
        material.name = name;
        material.where = dict.where();
        material.description = law->describe();
        material.density = dict.get<double>({"density", "mass per initial volume", unit::density, Bound::positive()});
        material.velocity =
            dictionary::readVectorExpression(dict, "initialVelocity", "velocity at the start", unit::velocity, dim,
                                             place, dictionary::readConstants(dict, place), false);
        material.initialStress = readInitialStress(dict, law->poissonRatio(), g, dim, law->hyperelastic());
        materials.push_back(std::move(material));
    }
    if (materials.empty())
        throw InputError(materialProperties.where(),
                         "no material here; one dictionary a material: soil { law ...; density ...; }");
    return materials;
}
} // namespace mpm::seeding
