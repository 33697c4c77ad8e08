#include "geometry/readSurfaceChoices.hpp"

namespace mpm::geometry
{
SurfaceOptions SurfaceChoices::on(double cell, double seedSpacing) const
{
    SurfaceOptions how = surface;
    how.cell = cell;
    how.alpha = alpha ? *alpha * cell : seedSpacing;
    how.offset = offset * cell;
    return how;
}

SurfaceChoices readSurfaceChoices(const dictionary::Dictionary& dict)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    SurfaceChoices made;
    made.material = dict.get<std::string>({"material", "one material, or all", unit::none, {}, "all"});
    made.materialWhere = dict.where("material");
    if (dict.found("alpha"))
        made.alpha = dict.get<double>(
            {"alpha", "gaps and hollows narrower than two of it are closed [cells]; default one seeding spacing",
             unit::none, Bound::between(0.05, 100)});
    made.offset = dict.get<double>({"offset", "how closely a 3D surface is wrapped around the domains [cells]",
                                    unit::none, Bound::between(0.001, 1), 0.0125});
    const std::string pieces =
        dict.choose("pieces", "what is done with material in several pieces",
                    {{"one", "an error"}, {"largest", "it alone"}, {"all", "all of them"}}, "one");
    made.surface.pieces = pieces == "one" ? Pieces::one : pieces == "largest" ? Pieces::largest : Pieces::all;
    made.surface.matchVolume = dict.get<bool>(
        {"matchVolume", "move the surface in until it encloses the particles' volume", unit::none, {}, true});
    made.surface.volumeTolerance = dict.get<double>(
        {"volumeTolerance", "how far the outline may be off the particles' volume before it is matched", unit::none,
         Bound::positive(), made.surface.volumeTolerance});
    return made;
}
} // namespace mpm::geometry
