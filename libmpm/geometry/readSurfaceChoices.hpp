#pragma once
/// What a case says of the surface of its deformed material.
///
///     // system/extractSurfaceDict; all of it may be absent
///     material        all;        // all (default: one surface around all of them), or one material
///     alpha           0.5;        // [cells] gaps and hollows narrower than two of it are closed, in [0.05, 100];
///                                 // default: one seeding spacing
///     offset          0.0125;     // [cells], 3D: how closely the domains are wrapped, in [0.001, 1]
///     pieces          one;        // one (default: several are an error) | largest | all
///     matchVolume     yes;        // the surface moves in until it holds the particles' volume
///     volumeTolerance 0.15;       // [-] how far the outline may be off it before
///
/// Errors (InputError, file:line): a word or value that is not among these.
#include "dictionary/dictionary.hpp"
#include "geometry/deformedSurface.hpp"

namespace mpm::geometry
{
struct SurfaceChoices
{
    std::string material;
    Location materialWhere;
    std::optional<double> alpha; ///< [cells]
    double offset = 0;           ///< [cells]
    SurfaceOptions surface;      ///< without lengths

    /// With lengths, for cells and seeding spacings of these sizes [m].
    SurfaceOptions on(double cell, double seedSpacing) const;
};

SurfaceChoices readSurfaceChoices(const dictionary::Dictionary& extractSurfaceDict);
} // namespace mpm::geometry
