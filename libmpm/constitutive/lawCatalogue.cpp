#include "constitutive/druckerPrager.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/neoHookean.hpp"
#include "constitutive/rigid.hpp"
#include "constitutive/smallStrain.hpp"
#include "constitutive/tresca.hpp"
#include "constitutive/vonMises.hpp"

namespace mpm::constitutive
{
const char* regionName(Region region)
{
    constexpr const char* names[] = {"elastic", "face", "edge s1=s2 (l1)", "edge s2=s3 (l2)", "apex", "tension limit"};
    return names[static_cast<Index>(region)];
}

const std::vector<dictionary::Choice>& lawCatalogue()
{
    static const std::vector<dictionary::Choice> laws = {
        {"linearElastic", "isotropic linear elasticity in rate form"},
        {"mohrCoulomb", "elastic, plastic Mohr-Coulomb with its own dilation angle; tension cut-off, softening"},
        {"druckerPrager", "elastic, perfectly plastic Drucker-Prager, a cone matched to Mohr-Coulomb; tension cut-off"},
        {"tresca", "elastic, plastic Tresca, Mohr-Coulomb without friction; tension cut-off, softening"},
        {"neoHookean", "hyperelastic, W = mu/2 (tr F F^T - 3) - mu ln J + lambda/2 ln^2 J"},
        {"hencky", "hyperelastic, Kirchhoff stress linear in the logarithmic strain"},
        {"smallStrain", "hyperelastic, nominal stress linear in the stretch (in the displacement gradient)"},
        {"vonMises", "elastic, perfectly plastic von Mises"},
        {"rigid", "moves as prescribed and pushes others by contact"},
    };
    return laws;
}

std::unique_ptr<Law> makeLaw(const dictionary::Dictionary& material)
{
    const std::string law = material.choose("law", "material law", lawCatalogue());
    if (law == "mohrCoulomb")
        return std::make_unique<MohrCoulomb>(MohrCoulomb::read(material));
    if (law == "druckerPrager")
        return std::make_unique<DruckerPrager>(DruckerPrager::read(material));
    if (law == "tresca")
        return std::make_unique<Tresca>(Tresca::read(material));
    if (law == "neoHookean")
        return std::make_unique<NeoHookean>(NeoHookean::read(material));
    if (law == "hencky")
        return std::make_unique<Hencky>(Hencky::read(material));
    if (law == "smallStrain")
        return std::make_unique<SmallStrain>(SmallStrain::read(material));
    if (law == "vonMises")
        return std::make_unique<VonMises>(VonMises::read(material));
    if (law == "rigid")
        return std::make_unique<Rigid>(Rigid::read(material));
    return std::make_unique<LinearElastic>(LinearElastic::read(material));
}
} // namespace mpm::constitutive
