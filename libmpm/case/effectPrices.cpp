#include "case/effectPrices.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "case/costPrediction.hpp"
#include "case/makeStepper.hpp"
#include "stepping/energyBudget.hpp"

#include <algorithm>

namespace mpm::cases
{
namespace
{
constexpr Index fewestParticles = 1000, shortBatch = 5;
constexpr double copies = 1.5; ///< time with what steps do not take: copies of states, steppers that are made

constexpr int weight = 3; ///< rounds for an effect in use, over those for one that is off

/// A scene that can be stepped from the same state as often as one likes.
class Bench
{
  public:
    Bench(EffectScene scene, double dt) : scene_(std::move(scene)), dt_(dt)
    {
        stepper_ = makeStepper(scene_.shape, scene_.state, scene_.scene);
        stepping::beginLedger(scene_.state, scene_.scene.materials);
        start_ = scene_.state;
        bytes_ = 0;
        batch(0); // allocates what it needs
        bytes_ = bytesPerParticle(scene_.state, *stepper_);
    }

    /// Processor seconds a particle-step of n steps after one that sorts and does not count.
    double batch(Index n)
    {
        scene_.state = start_;
        stepper_->particlesChanged();
        stepper_->step(dt_);
        double particleSteps = 0;
        const double begin = processSeconds().cpu;
        for (Index i = 0; i < n; ++i)
        {
            stepper_->step(dt_);
            particleSteps += double(scene_.state.particles.size());
        }
        return n > 0 ? (processSeconds().cpu - begin) / particleSteps : 0;
    }

    double bytes() const { return bytes_; }

  private:
    EffectScene scene_;
    state::State start_;
    double dt_, bytes_;
    std::unique_ptr<stepping::Stepper> stepper_;
};

double quantile(std::vector<double> values, double q)
{
    std::sort(values.begin(), values.end());
    const double at = q * double(values.size() - 1);
    const auto low = std::size_t(at);
    const auto high = std::min(low + 1, values.size() - 1);
    return values[low] + (at - double(low)) * (values[high] - values[low]);
}

/// Rounds of both, in turns, until the time is over.
void measure(EffectPrice& price, Bench& with, Bench& without, const PriceLimits& limits, Index batch, double seconds)
{
    std::vector<double> shares, more;
    const double begin = now();
    for (int r = 0; r < limits.rounds && (r < limits.fewestRounds || now() - begin < seconds); ++r)
    {
        const bool turn = r % 2 == 1; // who comes first finds other things in cache
        const double first = (turn ? with : without).batch(batch), second = (turn ? without : with).batch(batch);
        const double on = turn ? first : second, off = turn ? second : first;
        shares.push_back((on - off) / (price.used ? on : off));
        more.push_back(1e9 * (on - off));
    }
    price.share = quantile(shares, 0.5);
    price.spread = 0.5 * (quantile(shares, 0.75) - quantile(shares, 0.25));
    price.nanoseconds = quantile(more, 0.5);
    price.bytes = with.bytes() - without.bytes();
    price.rounds = int(shares.size());
}

EffectPrice priceOf(const Effect& effect, const EffectScene& scene, double dt, PriceLimits limits, Index batch,
                    double seconds)
{
    EffectPrice price{.effect = &effect, .used = effect.uses(scene)};
    if (price.used)
    {
        limits.rounds *= weight;
        seconds *= weight;
    }
    if (effect.name == "linearElastic")
    {
        price.fault = "laws are measured against it";
        return price;
    }
    try
    {
        Bench without(withoutEffect(effect, scene), dt);
        Bench with(price.used ? scene : withNeutral(effect, scene), dt);
        measure(price, with, without, limits, batch, seconds);
    }
    catch (const InputError& error)
    {
        price.fault = std::string("not here: ") + error.what();
    }
    catch (const StepError& error)
    {
        price.fault = std::string("a step fails: ") + error.what();
    }
    return price;
}

/// A copy of a state, or of its first particles and a surface of their own for each load.
EffectScene partOf(const stepping::Scene& scene, const state::State& state, const std::string& shape, Index count)
{
    if (state.particles.size() <= count)
        return {scene, state, shape};
    EffectScene part{scene, firstParticles(state, count), shape};
    part.scene.loads.clear();
    for (const auto& load : scene.loads)
    {
        effectNamed(load.pressure ? "pressure" : "traction").neutral(part);
        auto& own = part.scene.loads.back();
        own.traction = load.traction;
        own.magnitude = load.magnitude;
    }
    return part;
}
} // namespace

double bytesPerParticle(const state::State& state, const stepping::Stepper& stepper)
{
    double bytes = stepper.scratchBytesPerParticle();
    auto& particles = const_cast<state::Particles&>(state.particles); // the visitor only looks
    particles.forEachColumn([&](const auto& column) { bytes += double(sizeof(column[0])); });
    return bytes;
}

EffectPrices priceEffects(const stepping::Scene& scene, const state::State& state, const std::string& shape, double dt,
                          const PriceLimits& limits)
{
    EffectPrices out;
    const double begin = now();
    out.all = state.particles.size();
    EffectScene part = partOf(scene, state, shape, limits.particles);
    out.particles = part.state.particles.size();
    out.batch = scene.sortInterval;
    std::vector<const Effect*> wanted;
    for (const auto& effect : effectCatalogue())
        if (limits.offToo || effect.uses(part))
            wanted.push_back(&effect);
    try
    {
        Bench asItIs(part, dt);
        const double particleStep = asItIs.batch(std::min(shortBatch, out.batch));
        const auto used = double(effectsOf(part).size()), all = double(wanted.size());
        const double allowed = limits.seconds / std::max(1.0, all + (weight - 1) * used);
        const auto roundsTake = [&] {
            return 2 * (limits.fewestRounds + 1) * double(out.batch + 1) * double(out.particles) * particleStep;
        };
        if (roundsTake() > allowed)
            out.batch = std::min(shortBatch, out.batch);
        if (roundsTake() > allowed && out.particles > fewestParticles)
        {
            const double fits = double(out.particles) * allowed / roundsTake();
            part = partOf(scene, state, shape, std::max(fewestParticles, Index(fits)));
            out.particles = part.state.particles.size();
        }
        out.nanoseconds = 1e9 * particleStep;
        for (const Effect* effect : wanted)
            out.list.push_back(priceOf(*effect, part, dt, limits, out.batch, allowed));
    }
    catch (const StepError& error) // the scene itself cannot be stepped
    {
        for (const Effect* effect : wanted)
            out.list.push_back(
                {.effect = effect, .used = effect->uses(part), .fault = std::string("a step fails: ") + error.what()});
    }
    out.seconds = now() - begin;
    return out;
}

std::optional<EffectPrices> priceEffectsWithin(const stepping::Scene& scene, const state::State& state,
                                               const std::string& shape, double dt, double nsPerParticleStep,
                                               double seconds)
{
    PriceLimits limits{.seconds = seconds / copies, .offToo = false, .rounds = 9, .fewestRounds = 3};
    const EffectScene without{scene, state::State(state.particles.dim), shape};
    const double perParticle = 1e-9 * nsPerParticleStep * double(effectsOf(without).size()) * 2 *
                               (limits.fewestRounds + 1) * double(shortBatch + 1);
    const double fits = limits.seconds / perParticle;
    if (!(fits >= double(std::min(fewestParticles, state.particles.size()))))
        return std::nullopt;
    limits.particles = Index(std::min(fits, double(limits.particles)));
    return priceEffects(scene, state, shape, dt, limits);
}
} // namespace mpm::cases
