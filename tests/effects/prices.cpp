// What effects cost is measured, what they did is told.
#include "case/effectPrices.hpp"
#include "case/effectTables.hpp"
#include "effects/effectScenes.hpp"

#include <catch2/catch.hpp>
#include <ctime>
#include <limits>

namespace
{
using namespace effects;
using stepping::StressUpdate;

/// A body force that takes its time: so many microseconds of the processor a chunk.
class SlowForce : public stepping::BodyForce
{
  public:
    explicit SlowForce(double microseconds) : seconds_(1e-6 * microseconds) {}
    void acceleration(const state::Particles&, Index, int, double, double (&b)[3][lanes]) const override
    {
        for (auto& axis : b)
            std::fill_n(axis, lanes, 0.0);
        for (const double end = used() + seconds_; used() < end;)
            ;
    }

  private:
    static double used()
    {
        timespec t = {};
        ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    }
    double seconds_;
};

const cases::EffectPrice& priceOf(const cases::EffectPrices& prices, const std::string& name)
{
    for (const auto& price : prices.list)
        if (price.effect->name == name)
            return price;
    throw std::runtime_error(name);
}

const cases::PriceLimits quick{.seconds = 0.2, .rounds = 3, .fewestRounds = 3};
} // namespace

TEST_CASE("a dear effect is seen to be dear, in use and off")
{
    auto s = block(2, StressUpdate::MUSL);
    s.scene.bodyForce = std::make_shared<SlowForce>(200);
    const auto prices = priceEffects(s.scene, s.state, s.shape, deltaT, quick);
    const auto& force = priceOf(prices, "bodyForce");
    CHECK(force.used);
    CHECK(force.fault.empty());
    CHECK(force.share > 0.7);
    CHECK(force.share < 1);
    CHECK(force.nanoseconds > 0.7 * prices.nanoseconds);
    CHECK_FALSE(priceOf(prices, "gravity").used);
    CHECK(priceOf(prices, "APIC").bytes == 32);
    CHECK(priceOf(prices, "tensionGap").bytes == 8);
    CHECK(priceOf(prices, "gravity").bytes == 0);
}

TEST_CASE("all effects have a price in an ordinary scene, but the one others are measured against")
{
    for (const int dim : {2, 3})
    {
        const auto s = block(dim, StressUpdate::MUSL);
        const auto prices = priceEffects(s.scene, s.state, s.shape, deltaT, quick);
        CHECK(prices.list.size() == cases::effectCatalogue().size());
        CHECK(prices.particles == s.state.particles.size());
        for (const auto& price : prices.list)
        {
            INFO(price.effect->name << ": " << price.fault);
            CHECK(price.fault.empty() == (price.effect->name != "linearElastic"));
        }
    }
}

TEST_CASE("of a large state a part is stepped, loads included")
{
    auto s = block(2, StressUpdate::MUSL);
    s.state.patches.push_back({"side", {}, {}});
    s.scene.loads.push_back({"side", true, {}, 1e3});
    cases::effectNamed("pressure").neutral(s); // a second, to have one more than patches
    cases::PriceLimits limits = quick;
    limits.particles = 70;
    const auto prices = priceEffects(s.scene, s.state, s.shape, deltaT, limits);
    CHECK(prices.particles == 70);
    CHECK(prices.all == s.state.particles.size());
    CHECK(priceOf(prices, "pressure").fault.empty());
    CHECK(priceOf(prices, "pressure").used);
}

TEST_CASE("a scene that cannot be stepped has no prices, and no error")
{
    auto s = block(2, StressUpdate::MUSL);
    s.state.particles.v[0][5] = std::numeric_limits<double>::quiet_NaN();
    const auto prices = priceEffects(s.scene, s.state, s.shape, deltaT, quick);
    CHECK(prices.list.size() == cases::effectCatalogue().size());
    for (const auto& price : prices.list)
        CHECK(price.fault.substr(0, 12) == "a step fails");
}

TEST_CASE("what a scene cannot have says why")
{
    auto s = block(2, StressUpdate::MUSL);
    s.scene.timeIntegration = stepping::TimeIntegration::RK2;
    s.scene.walls.clear();
    const auto prices = priceEffects(s.scene, s.state, s.shape, deltaT, quick);
    CHECK(priceOf(prices, "splitting").fault.substr(0, 9) == "not here:");
}

TEST_CASE("pricing at the end of a run fits in, or is left out")
{
    const auto s = block(2, StressUpdate::MUSL);
    CHECK_FALSE(cases::priceEffectsWithin(s.scene, s.state, s.shape, deltaT, 100, 1e-6).has_value());
    const auto prices = cases::priceEffectsWithin(s.scene, s.state, s.shape, deltaT, 100, 1.0);
    REQUIRE(prices.has_value());
    CHECK(prices->list.size() == cases::effectsOf(s).size());
}

TEST_CASE("effects that never acted are named")
{
    auto s = block(2, StressUpdate::MUSL);
    s.scene.walls[0] = {"far", nodal::WallType::friction, 0, 1, 16, 0.5, true};
    s.scene.splitting = splitting::Rule{};
    s.scene.gravity = Vector3{0, -9.8, 0};
    const state::Ledger start = s.state.ledger;
    const auto end = run(s, 25);
    const cases::EffectRun run{s.scene, end, start, 25};
    const auto idle = idleEffects(run, cases::effectsOf(s));
    CHECK(idle ==
          std::vector<std::string>{"friction: 0 contacts in 25 steps", "splitting: 0 particles split in 25 steps"});
}

TEST_CASE("effects tell how much they did")
{
    auto s = block(2, StressUpdate::MUSL);
    s.scene.walls[0].type = nodal::WallType::friction;
    s.scene.walls[0].mu = 0.5;
    s.scene.gravity = Vector3{0, -9.8, 0};
    s.scene.relaxationTime = 0.5;
    s.scene.materials[0] = treated::soil(1e6, 0.3, 500, 30);
    const state::Ledger start = s.state.ledger;
    const auto end = run(s, 60);
    const cases::EffectRun run{s.scene, end, start, 60};
    CHECK(idleEffects(run, cases::effectsOf(s)).empty());
    const auto deed = [&](const char* name) { return cases::effectNamed(name).did(run); };
    CHECK(deed("friction").value == end.ledger.frictionDissipation);
    CHECK(deed("friction").value > 0);
    CHECK(deed("viscousDamping").value == end.ledger.dampingDissipation);
    CHECK(deed("mohrCoulomb").value == end.ledger.plasticDissipation);
    CHECK(deed("gravity").value == end.ledger.gravityWork);
    const auto text = deedsText(run, cases::effectsOf(s), std::nullopt, {}, 1);
    for (const char* name : {"friction", "viscousDamping", "mohrCoulomb", "gravity"})
        CHECK(text.find(std::string("\n  ") + name) != std::string::npos);
}
