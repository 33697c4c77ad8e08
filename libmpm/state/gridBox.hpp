#pragma once
/// The background grid: a lattice of square or cubic cells of side h. Node (i, j, k) lies at origin + h (i, j, k),
/// 0 <= i <= cells[0]. The box is where particle centres may be; kernels work on a window of nodes that may reach
/// two cells beyond it (ghost nodes, which obey the walls).
#include "base/types.hpp"

namespace mpm::state
{
struct GridBox
{
    int dim = 2;
    Vector3 origin{};             ///< lower corner [m]
    double h = 0;                 ///< cell size [m]
    std::array<Index, 3> cells{}; ///< number of cells an axis (1 along unused axes)
    /// Are the two sides of an axis one? Node cells[a] is node 0 then, and what leaves on one side enters on the other.
    std::array<bool, 3> periodic{};

    double upper(int axis) const { return origin[axis] + h * double(cells[axis]); }
    bool contains(const Vector3& p) const
    {
        for (int a = 0; a < dim; ++a)
            if (!(p[a] >= origin[a] && p[a] <= upper(a)))
                return false;
        return true;
    }
};
} // namespace mpm::state
