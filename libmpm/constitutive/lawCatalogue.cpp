#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"

namespace mpm::constitutive
{
const char* regionName(Region region)
{
    constexpr const char* names[] = {"elastic", "face", "edge s1=s2 (l1)", "edge s2=s3 (l2)", "apex"};
    return names[static_cast<Index>(region)];
}

const std::vector<dictionary::Choice>& lawCatalogue()
{
    static const std::vector<dictionary::Choice> laws = {
        {"linearElastic", "isotropic linear elasticity in rate form"},
        {"mohrCoulomb", "elastic, perfectly plastic Mohr-Coulomb with its own dilation angle"},
    };
    return laws;
}

std::unique_ptr<Law> makeLaw(const dictionary::Dictionary& material)
{
    const std::string law = material.choose("law", "material law", lawCatalogue());
    if (law == "mohrCoulomb")
        return std::make_unique<MohrCoulomb>(MohrCoulomb::read(material));
    return std::make_unique<LinearElastic>(LinearElastic::read(material));
}
} // namespace mpm::constitutive
