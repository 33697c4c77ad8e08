#include "geometry/flatten.hpp"

#include "base/error.hpp"
#include "geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::geometry
{
void flatten(GmshMesh& mesh)
{
    if (mesh.dim == 3)
        return;
    constexpr double inf = std::numeric_limits<double>::infinity();
    Vector3 lowest{0, 0, inf}, highest{0, 0, -inf}, low{inf, inf, inf}, high{-inf, -inf, -inf};
    for (const RawRegion& region : mesh.regions)
        for (const auto& part : region.parts)
            for (const Simplex& s : part)
            {
                const Vector3& p = mesh.points[std::size_t(s[0])];
                if (p[2] < lowest[2])
                    lowest = p;
                if (p[2] > highest[2])
                    highest = p;
                for (std::size_t k = 0; k < 2; ++k)
                {
                    low[k] = std::min(low[k], p[k]);
                    high[k] = std::max(high[k], p[k]);
                }
            }
    if (!(highest[2] - lowest[2] <= 1e-9 * std::max(high[0] - low[0], high[1] - low[1])))
        throw InputError(
            {mesh.file.string(), 0},
            fmt::format("the geometry leaves its plane, from {} to {}, but gridDict has dimension 2; draw it "
                        "in a plane z = constant, or set dimension 3",
                        placeText(lowest, 3), placeText(highest, 3)));
    for (Vector3& p : mesh.points)
        p[2] = 0;
}
} // namespace mpm::geometry
