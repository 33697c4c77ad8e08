#include "benchmark/roofline.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace mpm::benchmark
{
namespace
{
using stepping::StressUpdate;

struct ShapeCount
{
    int nodes;       ///< an axis
    int weightFlops; ///< an axis
    bool domain, follows;
};

ShapeCount countOf(const std::string& shape)
{
    if (shape == "linear")
        return {2, 5, false, false};
    if (shape == "uGIMP")
        return {3, 23, true, false};
    if (shape == "cpGIMP")
        return {3, 23, true, true};
    if (shape == "quadraticBSpline")
        return {3, 17, false, false};
    if (shape == "cubicBSpline")
        return {4, 32, false, false};
    throw InputError("the list of bytes and flops has no shape '" + shape + "'");
}

double lawFlops(const std::string& law, int dim)
{
    if (law == "linearElastic")
        return dim == 2 ? 14 : 18;
    if (law == "mohrCoulomb")
        return dim == 2 ? 104 : 339;
    throw InputError("the list of bytes and flops has no law '" + law + "'");
}

/// Flops between one particle and the nodes of its support.
struct SupportFlops
{
    double d, n, n2, n3; ///< n3: 0 in 2D

    SupportFlops(int dim, int nodes) : d(dim), n(nodes), n2(n * n), n3(dim == 3 ? n2 * n : 0) {}
    bool flat() const { return n3 == 0; }
    double project(double c) const { return flat() ? n * c + 2 * n2 * c : (n + n2) * c + 2 * n3 * c; }
    double projectForces() const { return flat() ? 2 * n * d + 4 * n2 * d : 3 * n * d + 4 * n2 * d + 4 * n3 * d; }
    double interpolate(double c) const { return 2 * (n3 + n2 + n) * c; }
    /// Of a vector whose gradient is formed: all but the outermost sums are there already.
    double interpolateRest() const { return 2 * n * d; }
    double gradient() const { return flat() ? 4 * (n2 + n) * d : 4 * n3 * d + 6 * (n2 + n) * d; }
};

/// r: size of the stored type over that of a double.
double countBytes(int dim, const ShapeCount& shape, StressUpdate update, double r)
{
    const double d = dim, s = stressComponents(dim), l = shape.domain ? d : 0;
    double doubles = shape.follows ? 2 * d * r : 0;
    switch (update)
    {
    case StressUpdate::MUSL:
        doubles += (d + 1 + r * (2 * d + l)) + (2 * d + 3.5 + r * (d + 2 * d * d + 2 * s + l));
        break;
    case StressUpdate::USL:
        doubles += 2 * d + 3.5 + r * (2 * d + 2 * d * d + 2 * s + l);
        break;
    case StressUpdate::USF:
        doubles += (d + 3.5 + r * (d + 2 * d * d + 2 * s + l)) + (2 * d + 1 + r * (2 * d + l));
        break;
    }
    return 8 * doubles;
}

double countFlops(int dim, const ShapeCount& shape, StressUpdate update, double law)
{
    const double d = dim, s = stressComponents(dim);
    const SupportFlops support(dim, shape.nodes);
    const double kinematics = dim == 2 ? 16 + 4 + 63 + 28 + 3 + 1 : 118 + 9 + 220 + 112 + 14 + 1;
    const double domains = shape.follows ? (dim == 2 ? 22 : 1029) : 0;
    double flops = d * shape.weightFlops + kinematics + domains + law;
    flops += d + (dim == 2 ? 3 : 6) + support.project(1 + d) + support.projectForces();
    flops += support.gradient() + support.interpolate(d) + 6 * d + 1;
    switch (update)
    {
    case StressUpdate::MUSL:
        flops += d + support.project(d) + support.interpolate(d) + 2 * s + 2;
        break;
    case StressUpdate::USL:
        flops += support.interpolateRest();
        break;
    case StressUpdate::USF:
        flops += support.interpolate(d) + 2 * s + 2;
        break;
    }
    return flops;
}
} // namespace

const std::vector<std::string>& countedShapes()
{
    static const std::vector<std::string> names{"uGIMP", "cpGIMP", "quadraticBSpline", "cubicBSpline", "linear"};
    return names;
}

const std::vector<std::string>& countedLaws()
{
    static const std::vector<std::string> names{"mohrCoulomb", "linearElastic"};
    return names;
}

Work countedWork(int dim, const std::string& shape, StressUpdate update, const std::string& law,
                 std::size_t storedBytes)
{
    const ShapeCount count = countOf(shape);
    return {countBytes(dim, count, update, double(storedBytes) / sizeof(double)),
            countFlops(dim, count, update, lawFlops(law, dim))};
}

double rooflineSeconds(const Work& work, double triad, double fmaPeak)
{
    return std::max(work.bytes / triad, work.flops / fmaPeak);
}
} // namespace mpm::benchmark
