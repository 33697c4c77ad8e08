#pragma once
/// The background grid, from system/gridDict:
///
///     dimension   2;                  // 2: plane strain | 3
///     min         (-12 0 0);          // lower corner [m]; z is 0 for both corners in 2D
///     max         (16 12 0);          // upper corner [m]
///     cellSize    0.2666666666666667; // h [m]
///     periodic    (x);                // axes whose two sides are one: what leaves on one enters on the other; default
///     ()
///
/// The box must be a whole number of cells along every axis, to 1e-6 of a cell; h is then taken as (max - min)/cells of
/// the x axis, so that a rounded cellSize does no harm. Errors (InputError, file:line) name the nearest box that fits.
#include "dictionary/dictionary.hpp"
#include "state/gridBox.hpp"

namespace mpm::cases
{
state::GridBox gridFromDict(const dictionary::Dictionary& gridDict);
} // namespace mpm::cases
