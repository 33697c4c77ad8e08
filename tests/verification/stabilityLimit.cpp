// The largest stable Courant number c_p dt/h of the step itself: a free elastic bar, two particles per cell, positions
// and domains frozen (the linearised step), spectral radius by power iteration on velocities and stresses. The known
// critical numbers come from an independent 1D calculation (spectral radius of the assembled step matrix): just below
// them the motion must stay bounded, just above it must grow. delta: distance of the first particle from where it sits
// in an aligned cell, in cells.
#include "case/makeStepper.hpp"
#include "stepping/timeStep.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <map>
#include <random>
#include <tuple>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
constexpr double modulus = 1e6, density = 1000, h = 0.5;

/// Growth per step of the free motion of the linearised step, over the last `counted` of many: positions and domains
/// are put back and the motion is scaled to its first size after each.
double growth(stepping::Stepper& stepper, state::Particles& p, double dt, double wave, int steps, int counted)
{
    const auto rest = p;
    const auto size = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            for (int a = 0; a < p.dim; ++a)
                sum += density * p.v[a][i] * p.v[a][i];
            for (int k = 0; k < stressComponents(p.dim); ++k)
                sum += p.stress[k][i] * p.stress[k][i] / wave;
        }
        return std::sqrt(sum);
    };
    const double start = size();
    double grown = 0;
    for (int n = 0; n < steps; ++n)
    {
        stepper.step(dt);
        p.x = rest.x;
        p.F = rest.F;
        p.volume = rest.volume;
        const double now = size();
        for (int a = 0; a < p.dim; ++a)
            for (double& v : p.v[a])
                v *= start / now;
        for (int k = 0; k < stressComponents(p.dim); ++k)
            for (double& s : p.stress[k])
                s *= start / now;
        for (auto& column : p.affine)
            for (double& c : column)
                c *= start / now;
        stepper.particlesChanged();
        grown += n >= steps - counted ? std::log(now / start) : 0;
    }
    return std::exp(grown / counted);
}

/// The same for a bar.
double growth(const std::string& shape, StressUpdate update, double delta, double courant)
{
    const Index N = 8;
    auto s = scenes::seedBlock({.corner = {2 * h + delta * h, 0, 0},
                                .n = {2 * N, 2, 1},
                                .spacing = h / 2,
                                .h = h,
                                .density = density,
                                .cells = {N + 6, 1, 1}});
    stepping::Scene scene;
    scene.materials = {scenes::elastic(modulus, 0, density)};
    scene.stressUpdate = update;
    using nodal::WallType;
    scene.walls = {{"below", WallType::roller, 1, -1, 0, 0, false}, {"above", WallType::roller, 1, 1, 1, 0, false}};
    scene.sortInterval = 1 << 30;
    auto stepper = cases::makeStepper(shape, s, scene);
    auto& p = s.particles;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1e-9, 1e-9);
    std::vector<double> perRow(std::size_t(2 * N));
    for (double& v : perRow)
        v = any(random);
    const double low = 2 * h + delta * h;
    for (Index i = 0; i < p.size(); ++i)
        p.v[0][std::size_t(i)] = perRow[std::size_t(std::lround((p.x[0][std::size_t(i)] - low) / (h / 2) - 0.5))];
    return growth(*stepper, p, courant * h / std::sqrt(modulus / density), modulus, 1500, 500);
}
} // namespace

TEST_CASE("critical Courant numbers of the step and the solver's bounds", "[long]")
{
    struct Row
    {
        std::string shape;
        double delta, massFraction, usl, musl;
    };
    // basis, shift, smallest nodal mass fraction, critical c_p dt/h for USL and for MUSL and USF (1D, spectral radius)
    const std::vector<Row> rows = {{"linear", 0, 0.5, 0.75, 1.73},
                                   {"linear", 0.24, 0.26, 0.67, 1.44},
                                   {"linear", 0.26, 5e-3, 0.14, 1.43},
                                   {"linear", 0.4, 7.5e-2, 0.52, 1.68},
                                   {"uGIMP", 0, 0.5, 0.75, 1.73},
                                   {"uGIMP", 0.1, 5e-3, 0.65, 1.88},
                                   {"uGIMP", 0.3, 4.5e-2, 0.70, 1.96},
                                   {"uGIMP", 0.49, 0.12, 0.66, 1.75},
                                   {"quadraticBSpline", 0, 1.56e-2, 0.88, 2.30},
                                   {"quadraticBSpline", 0.249, 2.5e-7, 0.69, 2.17},
                                   {"quadraticBSpline", 0.2, 6.25e-4, 0.74, 2.22}};
    for (const auto& row : rows)
        for (const auto update : {StressUpdate::USL, StressUpdate::MUSL, StressUpdate::USF})
        {
            const double known = update == StressUpdate::USL ? row.usl : row.musl;
            const double bound = stepping::criticalCourant(2, row.shape != "linear", update, row.massFraction);
            const double below = growth(row.shape, update, row.delta, known - 0.02);
            const double above = growth(row.shape, update, row.delta, known + 0.02);
            fmt::print(
                "{:>16} {:<5} shift {:<5} critical {:.2f}: growth a step {:.5f} just below, {:.5f} just above; the "
                "solver allows {:.3f}\n",
                row.shape, stepping::stressUpdateName(update), row.delta, known, below, above, bound);
            CHECK(below < 1.002); // modes beat, but do not grow
            CHECK(above > 1.05);
            CHECK(bound <= known + 0.005);
        }
}

namespace
{
/// A free block of the step's own dimension, its particles anywhere in their cells, moved off a lattice by up to
/// `disorder` of their spacing.
struct FreeBlock
{
    int dim = 2;
    std::string shape;
    StressUpdate update = StressUpdate::MUSL;
    double poisson = 0.3;
    Index perCell = 2;
    double disorder = 0;
    unsigned seed = 1;
    stepping::Transfer transfer = stepping::Transfer::FLIP;
    int order = 2;
};

/// Growth per step of the free motion of the linearised step.
double growth(const FreeBlock& block, double courant)
{
    const int dim = block.dim;
    const Index N = dim == 2 ? 4 : 2;
    std::mt19937 random(block.seed);
    std::uniform_real_distribution<double> anywhere(0, 1), speed(-1e-9, 1e-9), moved(-block.disorder, block.disorder);
    const double spacing = h / double(block.perCell);
    const Index n = N * block.perCell, flat = dim == 3 ? n : 1;
    auto s = scenes::seedBlock(
        {.dim = dim,
         .corner = {(2 + anywhere(random)) * h, (2 + anywhere(random)) * h, (2 + anywhere(random)) * h},
         .n = {n, n, flat},
         .spacing = spacing,
         .h = h,
         .density = density,
         .cells = {N + 6, N + 6, dim == 3 ? N + 6 : 1}});
    stepping::Scene scene;
    scene.materials = {scenes::elastic(modulus, block.poisson, density)};
    scene.stressUpdate = block.update;
    scene.transfer = block.transfer;
    scene.transferOrder = block.order;
    scene.sortInterval = 1 << 30;
    auto& p = s.particles;
    for (Index i = 0; i < p.size(); ++i)
        for (int a = 0; a < dim; ++a)
        {
            p.x[a][std::size_t(i)] += moved(random) * spacing;
            p.v[a][std::size_t(i)] = speed(random);
        }
    auto stepper = cases::makeStepper(block.shape, s, scene);
    const double wave = scene.materials[0].law->waveModulus();
    return growth(*stepper, p, courant * h / std::sqrt(wave / density), wave, 500, 200);
}

/// The largest stable c_p dt/h, by bisection.
double critical(const FreeBlock& block)
{
    double low = 0.05, high = 3;
    for (int i = 0; i < 7; ++i)
    {
        const double middle = std::sqrt(low * high);
        (growth(block, middle) < 1.01 ? low : high) = middle;
    }
    return low;
}
} // namespace

namespace
{
/// visit(block, its bound) for disordered blocks of all shapes, stress updates and Poisson's ratios.
template <class Visit>
void forFreeBlocks(Visit visit)
{
    for (const int dim : {2, 3})
        for (const char* shape : {"linear", "uGIMP", "cpGIMP", "quadraticBSpline", "cubicBSpline", "CPDI"})
            for (const auto update : {StressUpdate::USL, StressUpdate::MUSL, StressUpdate::USF})
            {
                if (std::string(shape) == "linear" && update == StressUpdate::USL)
                    continue; // its bound follows the lightest node: above
                const double bound = stepping::criticalCourant(dim, std::string(shape) != "linear", update, 1);
                for (const double poisson : {0.0, 0.3, 0.499})
                    for (const Index perCell : {1, 2, 3})
                        for (const double disorder : {0.0, 0.5})
                        {
                            if (dim == 3 && (perCell == 3 || (perCell == 2 && poisson == 0)))
                                continue; // time
                            const unsigned seed = unsigned(1 + perCell + 10 * dim + 100 * disorder);
                            visit(FreeBlock{dim, shape, update, poisson, perCell, disorder, seed}, bound);
                        }
            }
}
} // namespace

TEST_CASE("free blocks in two and three dimensions bear the solver's bounds", "[long]")
{
    forFreeBlocks([](const FreeBlock& block, double bound) {
        CAPTURE(block.dim, block.shape, int(block.update), block.poisson, block.perCell, block.disorder);
        CHECK(growth(block, bound) < 1.01);
    });
}

// How far the bounds lie below what blocks bear, printed: stabilityLimit "[margins]"
TEST_CASE("what free blocks bear, two particles a cell", "[.][margins]")
{
    std::map<std::pair<std::string, StressUpdate>, double> least, bounds;
    forFreeBlocks([&](const FreeBlock& block, double bound) {
        if (block.dim == 3 || block.perCell != 2)
            return;
        const auto key = std::pair(block.shape, block.update);
        bounds[key] = bound;
        auto& found = least.try_emplace(key, 9).first->second;
        found = std::min(found, critical(block));
    });
    for (const auto& [key, found] : least)
        fmt::print("2D {:>16} {:<4}: the solver allows {:.2f}; two particles a cell bear {:.2f} and more\n", key.first,
                   stepping::stressUpdateName(key.second), bounds[key], found);
}

TEST_CASE("blocks bear the bounds of all transfers", "[long]")
{
    using stepping::Transfer;
    const std::vector<std::tuple<const char*, Transfer, int>> transfers = {
        {"XPIC 2", Transfer::XPIC, 2}, {"XPIC 5", Transfer::XPIC, 5}, {"FMPM 2", Transfer::FMPM, 2},
        {"FMPM 5", Transfer::FMPM, 5}, {"APIC", Transfer::APIC, 1},   {"TPIC", Transfer::TPIC, 1}};
    for (const auto& [name, transfer, order] : transfers)
        for (const std::string shape : {"linear", "uGIMP", "CPDI", "quadraticBSpline", "cubicBSpline"})
            for (const auto update : {StressUpdate::USL, StressUpdate::MUSL, StressUpdate::USF})
            {
                stepping::Scene scene;
                scene.stressUpdate = update;
                scene.transfer = transfer;
                scene.transferOrder = order;
                if (stepping::limitFollowsMass(scene, shape != "linear"))
                    continue; // with the lightest node: above
                const double bound = stepping::methodCourant(2, shape != "linear", scene, 1);
                for (const Index perCell : {1, 2, 3})
                {
                    CAPTURE(name, shape, int(update), perCell);
                    CHECK(growth({2, shape, update, 0.3, perCell, perCell == 2 ? 0.0 : 0.5, unsigned(1 + perCell),
                                  transfer, order},
                                 bound) < 1.01);
                }
            }
}
