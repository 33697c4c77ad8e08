// filterRate of XPIC and FMPM: as much of the filter a second, whatever the step; and stress treatments that are off.
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace treated;
using stepping::Transfer;

namespace
{
stepping::Scene filtered(Transfer transfer, int order, std::optional<double> rate, Index interval = 1,
                         StressUpdate update = StressUpdate::MUSL)
{
    auto sc = scene(scenes::elastic(1e6, 0.3), {}, update);
    sc.transfer = transfer;
    sc.transferOrder = order;
    sc.filterRate = rate;
    sc.filterInterval = interval;
    return sc;
}

bool sameBits(state::Particles a, state::Particles b)
{
    std::vector<std::vector<double>> left, right;
    const auto collect = [](state::Particles& p, auto& out) {
        p.permute([&] {
            std::vector<Index> order;
            for (const std::size_t i : byId(p))
                order.push_back(Index(i));
            return order;
        }());
        p.forEachColumn([&](const auto& column) { out.emplace_back(column.begin(), column.begin() + p.size()); });
    };
    collect(a, left);
    collect(b, right);
    return left == right;
}
} // namespace

TEST_CASE("what no node sees of the velocities decays by exp(-filterRate t), whatever step and interval")
{
    for (const auto transfer : {Transfer::XPIC, Transfer::FMPM})
        for (const int order : {1, 2, 4})
            for (const Index interval : {1, 4})
                for (const int steps : {20, 40, 80})
                {
                    CAPTURE(int(transfer), order, interval, steps);
                    // pairs of opposite velocities about the middle of the cells of a periodic box: no node moves
                    auto s = scenes::seedBlock({.n = {8, 8, 1}, .spacing = 0.5, .h = 1, .cells = {4, 4, 1}});
                    s.grid.periodic = {true, true, false};
                    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
                        s.particles.v[0][i] = (s.particles.id[i] % 8 + s.particles.id[i] / 8) % 2 == 0 ? 1 : -1;
                    s.particles.padLastChunk();
                    const double time = 0.2, rate = 6;
                    const auto after = run(s, "uGIMP", filtered(transfer, order, rate, interval), steps, time / steps);
                    for (std::size_t i = 0; i < std::size_t(after.particles.size()); ++i)
                    {
                        const double sign = (after.particles.id[i] % 8 + after.particles.id[i] / 8) % 2 == 0 ? 1 : -1;
                        CHECK(double(after.particles.v[0][i]) == Approx(sign * std::exp(-rate * time)).epsilon(1e-12));
                    }
                }
}

TEST_CASE("rate 0 is FLIP bit by bit")
{
    for (const auto& shape : shapes)
        for (const auto update : updates)
            for (const auto transfer : {Transfer::XPIC, Transfer::FMPM})
            {
                CAPTURE(shape, int(update), int(transfer));
                auto s = block();
                stir(s, 1);
                const auto flip = run(s, shape, scene(scenes::elastic(1e6, 0.3), {}, update), 20, 4e-3);
                const auto zero = run(s, shape, filtered(transfer, 3, 0.0, 2, update), 20, 4e-3);
                CHECK(sameBits(flip.particles, zero.particles));
            }
}

TEST_CASE("a filter at a rate keeps momentum, beside walls too, and the budget closes")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapes)
            for (const auto update : updates)
                for (const auto transfer : {Transfer::XPIC, Transfer::FMPM})
                {
                    CAPTURE(dim, shape, int(update), int(transfer));
                    auto s = block(dim);
                    stir(s, 1);
                    auto sc = filtered(transfer, 2, 50, 2, update);
                    sc.gravity = Vector3{0.3, -9.8, 0};
                    sc.walls = {nodal::Wall{"base", nodal::WallType::friction, 1, -1, 3, 0.4, true},
                                nodal::Wall{"side", nodal::WallType::roller, 0, -1, 3}};
                    s = run(s, shape, sc, 40, 4e-3);
                    const auto t = stepping::totals(s, sc.materials);
                    double wall = 0;
                    for (int a = 0; a < dim; ++a)
                    {
                        CHECK(std::abs(t.momentum[a] - s.ledger.initialMomentum[a] - s.ledger.gravityImpulse[a] -
                                       s.ledger.wallImpulse[a]) < 1e-11 * t.mass);
                        wall = std::max(wall, std::abs(s.ledger.wallImpulse[a]));
                    }
                    CHECK(wall > 1e-2 * t.mass); // there was something to book
                    CHECK(residual(s, sc) < 1e-10 * t.mass);
                }
}

TEST_CASE("half the step takes the same share of a block's noise")
{
    const auto noise = [](int steps) {
        auto s = block();
        stir(s, 1e-3);
        const auto sc = filtered(Transfer::XPIC, 2, 8);
        s = run(s, "uGIMP", sc, steps, 0.4 / steps);
        return s.ledger.transferLoss / s.ledger.initialKineticEnergy;
    };
    const double coarse = noise(200), fine = noise(400), finer = noise(800);
    CHECK(finer > 0.02);
    CHECK(std::abs(fine - finer) < 0.02 * finer);
    CHECK(std::abs(coarse - fine) < 0.04 * finer);
}

TEST_CASE("treatments that are off leave no trace: the same bits, no columns")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapes)
            for (const auto update : updates)
            {
                CAPTURE(dim, shape, int(update));
                const auto material = soil(1e6, 0.3, 1e3, 30);
                stepping::Scene without;
                without.materials = {material};
                without.stressUpdate = update;
                auto s = block(dim);
                stir(s, 1);
                auto other = s;
                other.particles.keep(&state::Particles::tensionGap, true); // left by another run
                other.particles.keep(&state::Particles::dilationRate, true);
                const auto a = run(s, shape, without, 10, 4e-3),
                           b = run(other, shape, scene(material, {}, update), 10, 4e-3);
                CHECK(sameBits(a.particles, b.particles));
                CHECK_FALSE(b.particles.has(&state::Particles::tensionGap));
                CHECK_FALSE(b.particles.has(&state::Particles::dilationRate));
                CHECK_FALSE(b.particles.has(&state::Particles::viscousStress));
                for (const double entry : {b.ledger.relaxationLoss, b.ledger.averagingLoss, b.ledger.gapWork})
                    CHECK(entry == 0);
            }
}
