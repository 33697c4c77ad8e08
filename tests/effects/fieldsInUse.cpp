// Memory and state.h5 hold the fields of effects in use and no others.
#include "case/effectPrices.hpp"
#include "effects/effectScenes.hpp"
#include "output/hdf5File.hpp"
#include "output/stateFile.hpp"
#include "support/temporaryFolder.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

namespace
{
using namespace effects;

const std::set<std::string> always = {"position", "velocity", "stress",   "deformationGradient",
                                      "length0",  "mass",     "volume0",  "volume",
                                      "id",       "sortKey",  "material", "generation"};

struct Kept
{
    std::set<std::string> datasets;
    double state = 0, all = 0; ///< bytes a particle, of the state; with the stepper's
};

double stateBytes(const state::State& s)
{
    double bytes = 0;
    auto& particles = const_cast<state::Particles&>(s.particles); // the visitor only looks
    particles.forEachColumn([&](const auto& column) { bytes += double(sizeof(column[0])); });
    return bytes;
}

/// After one step.
Kept kept(EffectScene s)
{
    const auto stepper = cases::makeStepper(s.shape, s.state, s.scene);
    stepping::beginLedger(s.state, s.scene.materials);
    stepper->step(deltaT);
    const tests::TemporaryFolder folder;
    output::writeState(folder.path() / "0", s.state);
    const auto names = output::Hdf5File::open(folder.path() / "0" / output::stateFileName).members("/particles");
    return {{names.begin(), names.end()}, stateBytes(s.state), cases::bytesPerParticle(s.state, *stepper)};
}

/// Columns of steppers: velocity gradients wait for the means of all, corrections of stress for theirs.
double scratch(const std::string& effect, int dim)
{
    const std::map<std::string, double> all = {{"volumetricAveraging", 8.0 * dim * dim},
                                               {"stressRelaxation", 8.0 * stressComponents(dim)}};
    const auto found = all.find(effect);
    return found == all.end() ? 0 : found->second;
}

double bytesOf(const std::vector<std::string>& fields, int dim)
{
    double bytes = 0;
    for (const auto& field : fields)
        bytes += field == "affine" ? 8.0 * dim * dim : 8.0;
    return bytes;
}
} // namespace

TEST_CASE("a scene without effects keeps what the step needs")
{
    for (const int dim : {2, 3})
    {
        const auto plain = kept(block(dim, stepping::StressUpdate::MUSL));
        CHECK(plain.datasets == always);
        const double stored = sizeof(state::Stored); // velocity, stress, F, lengths
        CHECK(plain.state == 8.0 * dim + stored * (2 * dim + stressComponents(dim) + dim * dim) + 8 * 5 + 4 * 2);
        CHECK(plain.all == plain.state + 8.0 * dim); // positions at the end of a step
    }
}

TEST_CASE("an effect keeps its own fields, in memory and in state.h5, and no others")
{
    for (const int dim : {2, 3})
        for (const auto& effect : cases::effectCatalogue())
        {
            INFO(effect.name << " in " << dim << " dimensions");
            const auto scene = block(dim, stepping::StressUpdate::MUSL);
            const auto off = kept(cases::withoutEffect(effect, scene));
            const auto on = kept(cases::withNeutral(effect, scene));
            std::set<std::string> expected = off.datasets;
            expected.insert(effect.fields.begin(), effect.fields.end());
            CHECK(on.datasets == expected);
            CHECK(on.state - off.state == bytesOf(effect.fields, dim));
            CHECK(on.all - off.all == bytesOf(effect.fields, dim) + scratch(effect.name, dim));
        }
}

TEST_CASE("fields go with the effect they belong to")
{
    for (const auto& effect : cases::effectCatalogue())
    {
        if (effect.fields.empty())
            continue;
        INFO(effect.name);
        auto scene = cases::withNeutral(effect, block(2, stepping::StressUpdate::MUSL));
        scene.state = run(scene, 2);
        const auto before = kept(scene);
        const auto after = kept(cases::withoutEffect(effect, scene));
        CHECK(before.datasets.count(effect.fields.front()) == 1);
        CHECK(after.datasets.count(effect.fields.front()) == 0);
    }
}
