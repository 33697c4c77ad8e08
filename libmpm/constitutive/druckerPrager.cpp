#include "constitutive/druckerPrager.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace mpm::constitutive
{
namespace
{
/// The part of A and B a match makes of sin phi and c cos phi.
double factorOf(ConeMatch match, double sinPhi, double sinPsi)
{
    if (match == ConeMatch::compression)
        return 6 / (3 - sinPhi);
    if (match == ConeMatch::extension)
        return 6 / (3 + sinPhi);
    const double a = sinPsi / std::sqrt(9 + 3 * sinPsi * sinPsi);
    return std::numbers::sqrt3 / (std::sqrt(1 - 3 * a * a) + a * sinPhi);
}

const DruckerPragerParameters& checked(const DruckerPragerParameters& p)
{
    requireModuli(p.moduli);
    requireStrength(p.cohesion, p.frictionAngle, p.dilationAngle, p.tensionCutOff);
    return p;
}

/// p and q of a trial, returned; selects, no branches.
struct Point
{
    double p, q;
    bool plastic, apex, tension;
};

struct Constants
{
    DruckerPragerCone cone;
    double invStiffness;    ///< 1/(3 G + K A A')
    double volume, highest; ///< K A', the smaller of apex and limit
    double ring;            ///< q on the cone at the limit [Pa]
    double dropsVolume;     ///< 1/K at psi = 0 without a limit, else 0

    Constants(const DruckerPragerCone& c, const ElasticModuli& m)
        : cone(c), invStiffness(1 / (3 * m.shear() + m.bulk() * c.slope * c.flow)), volume(m.bulk() * c.flow),
          highest(std::min(c.apex, c.limit)), ring(c.strength - (c.slope > 0 ? c.slope * highest : 0)),
          dropsVolume(c.flow > 0 || c.limit < c.apex ? 0 : 1 / m.bulk())
    {}
};

[[gnu::always_inline]] inline Point returned(const Constants& c, double p, double q)
{
    const double f = q + c.cone.slope * p - c.cone.strength;
    const double lam = f > 0 ? f * c.invStiffness : 0;
    const double coneP = p - c.volume * lam; // where q on the cone is negative, p is beyond the apex
    const bool beyondApex = coneP > c.cone.apex, beyond = coneP > c.cone.limit;
    const bool plastic = (f > 0) | beyond;

    // q follows from p, so that f is round-off of the stress however far out the trial was
    double coneQ = c.cone.strength - c.cone.slope * coneP;
    coneQ = beyondApex ? 0 : coneQ;
    coneQ = coneQ > 0 ? coneQ : 0;
    const double limitQ = q < c.ring ? q : c.ring;
    const double onP = coneP < c.highest ? coneP : c.highest, onQ = beyond ? limitQ : coneQ;

    Point out;
    out.p = plastic ? onP : p;
    out.q = plastic ? onQ : q;
    out.plastic = plastic;
    out.tension = plastic & beyond;
    out.apex = plastic & beyondApex & !beyond;
    return out;
}

/// max(f, p - T) over the largest of |p|, q and B.
[[gnu::always_inline]] inline double relativeYield(const DruckerPragerCone& c, double p, double q)
{
    const double size = std::abs(p) > q ? std::abs(p) : q;
    const double scale = size > c.strength ? size : c.strength;
    const double f = q + c.slope * p - c.strength, over = p - c.limit;
    const double largest = f > over ? f : over;
    return scale > 0 ? largest / scale : 0;
}

template <int dim>
void updateChunk(Chunk<dim>& chunk, const ElasticModuli& moduli, const DruckerPragerCone& cone)
{
    constexpr int nc = stressSize<dim>;
    alignas(64) double trials[nc][lanes];
    elasticTrial<dim>(chunk, moduli, trials);
    const Constants c(cone, moduli);
    const double quarterOverG = 0.25 / moduli.shear(), invK = 1 / moduli.bulk();
    for (int l = 0; l < lanes; ++l)
    {
        const double mean = (trials[0][l] + trials[1][l] + trials[2][l]) * (1.0 / 3);
        const double meanStart = (chunk.stress[0][l] + chunk.stress[1][l] + chunk.stress[2][l]) * (1.0 / 3);
        double trial[nc], s[nc], start[nc], square = 0, work = 0;
        for (int k = 0; k < nc; ++k)
        {
            trial[k] = trials[k][l];
            s[k] = trial[k] - (k < 3 ? mean : 0);
            start[k] = chunk.stress[k][l] - (k < 3 ? meanStart : 0);
            square += (k < 3 ? 1 : 2) * s[k] * s[k];
        }
        const double q = std::sqrt(1.5 * square);
        const Point r = returned(c, mean, q);
        const double share = r.q / q, kept = q > 0 ? share : 0;
        for (int k = 0; k < nc; ++k)
        {
            const double end = kept * s[k], back = end + (k < 3 ? r.p : 0);
            work += (k < 3 ? 1 : 2) * (start[k] + end) * (s[k] - end);
            chunk.stress[k][l] = r.plastic ? back : trial[k];
        }
        const double lost = mean - r.p;
        work = work * quarterOverG + 0.5 * (meanStart + r.p) * lost * invK;
        chunk.plasticWork[l] = r.plastic ? work : 0;
        chunk.apexStrain[l] = (r.apex ? lost : 0) * c.dropsVolume;
        chunk.yield[l] = relativeYield(c.cone, r.p, r.q);
        Region region = r.plastic ? Region::face : Region::elastic;
        region = r.tension ? Region::tension : region;
        chunk.region[l] = r.apex ? Region::apex : region;
    }
    chunk.apexReturns = 0;
    for (int l = 0; l < chunk.count; ++l)
        chunk.apexReturns += chunk.region[l] == Region::apex;
}

template <int dim>
void yieldOfChunk(Chunk<dim>& chunk, const DruckerPragerCone& cone)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double mean = (chunk.stress[0][l] + chunk.stress[1][l] + chunk.stress[2][l]) * (1.0 / 3);
        double square = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            const double s = k < 3 ? chunk.stress[k][l] - mean : chunk.stress[k][l];
            square += (k < 3 ? 1 : 2) * s * s;
        }
        chunk.yield[l] = relativeYield(cone, mean, std::sqrt(1.5 * square));
    }
}

const std::vector<dictionary::Choice>& matches()
{
    static const std::vector<dictionary::Choice> all = {
        {"compression", "strength of Mohr-Coulomb in triaxial compression"},
        {"extension", "strength of Mohr-Coulomb in triaxial extension"},
        {"planeStrain", "strength of Mohr-Coulomb in plane strain"},
    };
    return all;
}
} // namespace

DruckerPragerCone::DruckerPragerCone(const DruckerPragerParameters& p)
{
    const double degree = std::numbers::pi / 180;
    const double sinPhi = std::sin(p.frictionAngle * degree), sinPsi = std::sin(p.dilationAngle * degree);
    const double factor = factorOf(p.match, sinPhi, sinPsi);
    slope = factor * sinPhi;
    strength = factor * (p.cohesion * std::cos(p.frictionAngle * degree));
    flow = factorOf(p.match, sinPsi, sinPsi) * sinPsi;
    apex = slope > 0 ? strength / slope : std::numeric_limits<double>::infinity();
    limit = p.tensionCutOff < apex ? p.tensionCutOff : std::numeric_limits<double>::infinity();
}

DruckerPrager::DruckerPrager(const DruckerPragerParameters& parameters, std::optional<Substep> substep)
    : parameters_(checked(parameters)), cone_(parameters), substep_(substep)
{}

DruckerPrager DruckerPrager::read(const dictionary::Dictionary& material)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    DruckerPragerParameters p;
    p.moduli = readModuli(material);
    p.cohesion = material.get<double>({"cohesion", "cohesion c", unit::pressure, Bound::nonNegative()});
    p.frictionAngle =
        material.get<double>({"frictionAngle", "angle of friction phi [deg]", unit::none, Bound::rightOpen(0, 90)});
    p.dilationAngle = material.get<double>({"dilationAngle", "angle of dilation psi [deg], at most frictionAngle",
                                            unit::none, Bound::between(0, p.frictionAngle), 0.0});
    const std::string match =
        material.choose("match", "where the cone has Mohr-Coulomb's strength", matches(), std::string("planeStrain"));
    p.match = match == "compression" ? ConeMatch::compression
              : match == "extension" ? ConeMatch::extension
                                     : ConeMatch::planeStrain;
    if (material.found("tensionCutOff"))
        p.tensionCutOff = material.get<double>(
            {"tensionCutOff", "largest mean stress; absent: none", unit::pressure, Bound::nonNegative()});
    return DruckerPrager(p, readSubstep(material));
}

std::string DruckerPrager::describe() const
{
    const auto& p = parameters_;
    const std::string cut =
        std::isfinite(p.tensionCutOff) ? fmt::format(", tensionCutOff {:g} Pa", p.tensionCutOff) : std::string();
    return fmt::format("druckerPrager: E {:g} Pa, nu {:g}, cohesion {:g} Pa, frictionAngle {:g} deg, dilationAngle "
                       "{:g} deg, match {} (q + {:g} p <= {:g} Pa){}{}",
                       p.moduli.young, p.moduli.poisson, p.cohesion, p.frictionAngle, p.dilationAngle,
                       matches()[std::size_t(p.match)].name, cone_.slope, cone_.strength, cut,
                       describeSubstep(substep_));
}

void DruckerPrager::update(Chunk<2>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, parameters_.moduli, cone_);
    updateInParts<2>(chunk, *substep_, parameters_.moduli, cone_.strength,
                     [this](Chunk<2>& part) { updateChunk(part, parameters_.moduli, cone_); });
}

void DruckerPrager::update(Chunk<3>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, parameters_.moduli, cone_);
    updateInParts<3>(chunk, *substep_, parameters_.moduli, cone_.strength,
                     [this](Chunk<3>& part) { updateChunk(part, parameters_.moduli, cone_); });
}

void DruckerPrager::reportYield(Chunk<2>& chunk) const
{
    yieldOfChunk(chunk, cone_);
}

void DruckerPrager::reportYield(Chunk<3>& chunk) const
{
    yieldOfChunk(chunk, cone_);
}
} // namespace mpm::constitutive
