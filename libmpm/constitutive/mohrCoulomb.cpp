#include "constitutive/mohrCoulomb.hpp"

#include "constitutive/mohrCoulombSoftening.hpp"

#include <fmt/format.h>
#include <numbers>

namespace mpm::constitutive
{
namespace
{
/// 1 - sin a without cancellation near 90 degrees, exactly 1 at 0.
Slope slope(double degrees)
{
    const double a = degrees * std::numbers::pi / 180;
    const double half = std::sin(std::numbers::pi / 4 - a / 2);
    const double oneMinusSine = a < 0.5 ? 1 - std::sin(a) : 2 * half * half;
    return {(1 + std::sin(a)) / oneMinusSine, 2 * std::sin(a) / oneMinusSine, std::cos(a) / oneMinusSine};
}

const MohrCoulombParameters& checked(const MohrCoulombParameters& parameters)
{
    requireParameters(parameters);
    return parameters;
}

} // namespace

void requireParameters(const MohrCoulombParameters& p)
{
    requireModuli(p.moduli);
    requireStrength(p.cohesion, p.frictionAngle, p.dilationAngle, p.tensionCutOff);
    if (const auto& s = p.softening)
        if (!(s->from >= 0 && s->over > 0 && s->referenceLength > 0 && s->cohesion >= 0 && s->cohesion <= p.cohesion &&
              s->frictionAngle >= 0 && s->frictionAngle <= p.frictionAngle && s->dilationAngle >= 0 &&
              s->dilationAngle <= std::min(p.dilationAngle, s->frictionAngle)))
            throw InputError("softening: found parameters out of their bounds, allowed are residual values at most "
                             "those of the peak, from >= 0, over > 0 and referenceLength > 0");
}

MohrCoulombSurface::MohrCoulombSurface(const MohrCoulombParameters& p)
    : MohrCoulombSurface(p.moduli, p.cohesion, slope(p.frictionAngle), slope(p.dilationAngle),
                         p.dilationAngle > 0 ? 0 : 1 / p.moduli.bulk())
{}

MohrCoulomb::MohrCoulomb(const MohrCoulombParameters& parameters, std::optional<Substep> substep)
    : parameters_(checked(parameters)), surface_(parameters.tensionCutOff, parameters.moduli.poisson, parameters),
      substep_(substep)
{
    if (parameters_.softening && substep_)
        throw InputError("softening: found with substep, allowed is one of them");
}

MohrCoulombParameters MohrCoulomb::readParameters(const dictionary::Dictionary& material, bool friction)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    MohrCoulombParameters p;
    p.moduli = readModuli(material);
    p.cohesion = material.get<double>({"cohesion", "cohesion c", unit::pressure, Bound::nonNegative()});
    if (friction)
    {
        p.frictionAngle =
            material.get<double>({"frictionAngle", "angle of friction phi [deg]", unit::none, Bound::rightOpen(0, 90)});
        p.dilationAngle = material.get<double>({"dilationAngle", "angle of dilation psi [deg], at most frictionAngle",
                                                unit::none, Bound::between(0, p.frictionAngle), 0.0});
    }
    if (material.found("tensionCutOff"))
        p.tensionCutOff = material.get<double>(
            {"tensionCutOff", "largest principal stress; absent: none", unit::pressure, Bound::nonNegative()});
    p.softening = readSoftening(material, p.cohesion, p.frictionAngle, p.dilationAngle, friction);
    if (material.found("softening") && material.found("substep"))
        material.fail("substep", "a material with softening", "softening or substep");
    return p;
}

MohrCoulomb MohrCoulomb::read(const dictionary::Dictionary& material)
{
    const MohrCoulombParameters p = readParameters(material, true);
    return MohrCoulomb(p, readSubstep(material));
}

std::string MohrCoulomb::describeRest() const
{
    const auto& p = parameters_;
    const std::string cut = std::isfinite(p.tensionCutOff)
                                ? fmt::format(", tensionCutOff {:g} Pa{}", p.tensionCutOff,
                                              cutsOff() ? "" : " (not below the apex: never acts)")
                                : std::string();
    return cut + describeSoftening(p.softening, scale_) + describeSubstep(substep_);
}

std::string MohrCoulomb::describe() const
{
    const auto& p = parameters_;
    return fmt::format(
        "mohrCoulomb: E {:g} Pa, nu {:g}, cohesion {:g} Pa, frictionAngle {:g} deg, dilationAngle {:g} deg{}",
        p.moduli.young, p.moduli.poisson, p.cohesion, p.frictionAngle, p.dilationAngle, describeRest());
}

double MohrCoulomb::tensionLimit() const
{
    return std::min(surface_.highest, parameters_.tensionCutOff);
}

bool MohrCoulomb::dropsApexVolume() const
{
    const auto& p = parameters_;
    if (p.frictionAngle == 0 || substep_)
        return false;
    if (p.softening)
        return p.dilationAngle == 0 || (p.softening->dilationAngle == 0 && p.softening->frictionAngle > 0);
    return p.dilationAngle == 0 && !cutsOff();
}

void MohrCoulomb::regularise(double cellSize)
{
    if (parameters_.softening)
        scale_ = cellSize / parameters_.softening->referenceLength;
}

template <int dim>
void MohrCoulomb::updateWhole(Chunk<dim>& chunk) const
{
    if (parameters_.softening)
        returnSofteningChunk(chunk, SofteningSurface(parameters_, scale_), ElasticCone(surface_, surface_.limit));
    else if (cutsOff())
        returnChunk(chunk, parameters_.moduli, surface_, ElasticCone(surface_, surface_.limit));
    else
        returnChunk(chunk, parameters_.moduli, static_cast<const MohrCoulombSurface&>(surface_), ElasticCone(surface_));
}

void MohrCoulomb::update(Chunk<2>& chunk) const
{
    if (!substep_)
        return updateWhole(chunk);
    updateInParts<2>(chunk, *substep_, parameters_.moduli, surface_.strength,
                     [this](Chunk<2>& part) { updateWhole(part); });
}

void MohrCoulomb::update(Chunk<3>& chunk) const
{
    if (!substep_)
        return updateWhole(chunk);
    updateInParts<3>(chunk, *substep_, parameters_.moduli, surface_.strength,
                     [this](Chunk<3>& part) { updateWhole(part); });
}

template <int dim>
void MohrCoulomb::yieldOf(Chunk<dim>& chunk) const
{
    if (!parameters_.softening)
        return yieldOfChunk(chunk, [this](int) -> const CutOffSurface& { return surface_; });
    const SofteningSurface surfaces(parameters_, scale_);
    yieldOfChunk(chunk, [&](int l) { return surfaces.at(chunk.plasticStrain[l]); });
}

void MohrCoulomb::reportYield(Chunk<2>& chunk) const
{
    yieldOf(chunk);
}

void MohrCoulomb::reportYield(Chunk<3>& chunk) const
{
    yieldOf(chunk);
}
} // namespace mpm::constitutive
