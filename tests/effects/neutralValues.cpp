// Every effect at its neutral value gives what its absence gives: the same bits, or the same to round-off for the
// reason the catalogue tells. Effects without a neutral value say why, and do change something.
#include "effects/effectScenes.hpp"

#include <catch2/catch.hpp>
#include <cstring>

namespace
{
using namespace effects;

/// Largest difference of a motion, over sizes of its own: positions in cells, velocities in m/s, stresses in 1e6 Pa.
double difference(const state::Particles& a, const state::Particles& b)
{
    const auto inA = treated::byId(a), inB = treated::byId(b);
    double most = 0;
    for (std::size_t n = 0; n < inA.size(); ++n)
    {
        const std::size_t i = inA[n], j = inB[n];
        const auto look = [&](const auto& one, const auto& other, double scale) {
            const double change = double(one[i]) - double(other[j]);
            most = std::max(most, std::isnan(change) ? INFINITY : std::abs(change) / scale);
        };
        for (int k = 0; k < a.dim; ++k)
        {
            look(a.x[k], b.x[k], 1);
            look(a.v[k], b.v[k], 1);
        }
        for (int k = 0; k < stressComponents(a.dim); ++k)
            look(a.stress[k], b.stress[k], 1e6);
        for (int k = 0; k < a.dim * a.dim; ++k)
            look(a.F[k], b.F[k], 1);
        look(a.volume, b.volume, 1);
        look(a.mass, b.mass, 1);
    }
    return most;
}

void compare(const Effect& effect, const EffectScene& scene)
{
    INFO(effect.name << " in " << scene.state.particles.dim << " dimensions, " << stepping::methodText(scene.scene));
    const auto absent = run(cases::withoutEffect(effect, scene), 45);
    const auto neutral = run(cases::withNeutral(effect, scene), 45);
    REQUIRE(absent.particles.size() == neutral.particles.size());
    const double found = difference(absent.particles, neutral.particles);
    if (effect.neutralText.empty())
        CHECK(found > 1e-9); // else it has a neutral value
    else if (effect.differs.empty())
        CHECK(found == 0);
    else
        CHECK(found < 1e-10);
}
} // namespace

TEST_CASE("every effect has a neutral value, or says why not")
{
    for (const auto& effect : cases::effectCatalogue())
    {
        INFO(effect.name);
        CHECK((!effect.neutralText.empty() || !effect.differs.empty()));
        CHECK(bool(effect.uses));
        CHECK(bool(effect.without));
        CHECK(bool(effect.neutral));
        CHECK(bool(effect.did));
        CHECK_FALSE(effect.word.empty());
        CHECK_FALSE(effect.help.empty());
    }
}

TEST_CASE("every law of the catalogue of laws is an effect")
{
    for (const auto& law : constitutive::lawCatalogue())
        CHECK(cases::effectNamed(law.name).word == "law " + law.name);
}

TEST_CASE("an effect that is put in is found, and gone when it is taken out")
{
    const auto scene = block(2, stepping::StressUpdate::MUSL);
    for (const auto& effect : cases::effectCatalogue())
    {
        INFO(effect.name);
        const auto with = cases::withNeutral(effect, scene);
        CHECK(effect.uses(with));
        CHECK(effect.uses(cases::withoutEffect(effect, with)) == (effect.name == "linearElastic"));
    }
}

TEST_CASE("the neutral value of an effect is its absence")
{
    for (const auto& effect : cases::effectCatalogue())
        for (const auto update : treated::updates)
            compare(effect, block(2, update));
}

TEST_CASE("the neutral value of an effect is its absence in 3D")
{
    for (const auto& effect : cases::effectCatalogue())
        compare(effect, block(3, stepping::StressUpdate::MUSL));
}

TEST_CASE("values that are not neutral are no absence")
{
    // the comparison would see the least of them
    auto scene = block(2, stepping::StressUpdate::MUSL);
    const auto plain = run(scene, 45);
    scene.scene.gravity = Vector3{0, -1e-6, 0};
    CHECK(difference(plain.particles, run(scene, 45).particles) > 0);
}
