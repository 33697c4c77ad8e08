#pragma once
/// Every effect a scene may name, once: what it is called, how a scene names it, how it is taken out of a scene and put
/// into one, what it keeps, what it did. mpmSolve -effects, the summary of a run, docs/effects.md and the tests of
/// label `effects` read this list and nothing else.
///
///     off      base(scene): the scene without the effect, and without what it takes the place of (other laws, other
///              transfers)
///     neutral  base(scene) with the effect at the value at which it does nothing: mu = 0, cohesion -> infinity, a
///     limit
///              no particle reaches. Results are those of base(scene), bit for bit or to round-off for a reason that is
///              told (tests/effects/neutralValues.cpp); what it costs is what naming it costs before it acts
///
/// A new effect is one entry in the list of its family (lawEffects.cpp, boundaryEffects.cpp, motionEffects.cpp,
/// contactEffects.cpp, processEffects.cpp, transferEffects.cpp, treatmentEffects.cpp): copy a neighbour. Tests and
/// tables follow; renew docs/effects.md by etc/effectsTable.
#include "stepping/stepper.hpp"

#include <functional>
#include <string>
#include <vector>

namespace mpm::cases
{
enum class EffectFamily
{
    law,
    boundary,
    contact,
    process,
    transfer,
    treatment
};

/// "law", "boundary", ...
const char* familyName(EffectFamily family);

/// All that decides what a step does. Effects may need their place in the state, too: a surface for a load.
struct EffectScene
{
    stepping::Scene scene;
    state::State state;
    std::string shape = "uGIMP";
};

/// A run, for effects to say what they did in it.
struct EffectRun
{
    const stepping::Scene& scene;
    const state::State& state;    ///< at its end
    const state::Ledger& atStart; ///< of the run
    Index steps = 0;
    stepping::StepReport report{}; ///< of its last step

    /// Growth of an entry of the ledger in the run.
    template <class T>
    T grown(T state::Ledger::*entry) const
    {
        return state.ledger.*entry - atStart.*entry;
    }
    /// "12.3 kJ", "12.3 kJ/m" in 2D.
    std::string energy(double joule) const;
    /// The same with its share of the work supplied: "12.3 kJ/m (4.1 % of the work supplied)".
    std::string share(double joule) const;
    /// Work of gravity, loads, body forces and motions, and the energy the body had to begin with [J].
    double supplied() const;
};

/// What an effect did. One that was on but never acted says so: "0 contacts".
struct Deed
{
    double value = 0;
    std::string unit = {}; ///< of value
    std::string text = {}; ///< "took 12.3 kJ/m at 31 nodes a step"
    bool acted = true;
};

struct Effect
{
    std::string name = {};
    EffectFamily family = EffectFamily::process;
    std::string word = {}; ///< that names it: "type friction"
    std::string file = {}; ///< and the dictionary it stands in
    std::string help = {}; ///< one line
    /// Columns of /particles in state.h5 it keeps, without the numbers of components.
    std::vector<std::string> fields = {};
    std::function<bool(const EffectScene&)> uses = {};
    /// Takes it out of a scene that uses it.
    std::function<void(EffectScene&)> without = {};
    /// Takes out what it cannot stand beside, before neutral(); empty: nothing.
    std::function<void(EffectScene&)> base = {};
    /// Puts it into a scene that does not use it, at its neutral value. Where it has none (differs says why) at some
    /// harmless value. Throws InputError where a scene cannot have it.
    std::function<void(EffectScene&)> neutral = {};
    std::string neutralText = {}; ///< that value: "mu 0"; empty: there is none
    /// Why results at the neutral value are those of its absence to round-off only; empty: they are so bit for bit.
    std::string differs = {};
    /// The part of the step it acts in: an upper bound of its cost where nothing better is known.
    double stepping::PassTimes::*pass = &stepping::PassTimes::nodal;
    bool ownPass = false; ///< nothing else is done in that part
    std::function<Deed(const EffectRun&)> did = {};
};

/// All effects, family by family.
const std::vector<Effect>& effectCatalogue();
const Effect& effectNamed(const std::string& name);
/// Those a scene uses, in the order of the catalogue.
std::vector<const Effect*> effectsOf(const EffectScene& scene);

/// The same scene with an effect taken out, or, where it is not used, without what it cannot stand beside.
EffectScene withoutEffect(const Effect& effect, EffectScene scene);
/// The same scene with the effect at its neutral value.
EffectScene withNeutral(const Effect& effect, EffectScene scene);

/// The lists of the families.
std::vector<Effect> lawEffects();
std::vector<Effect> boundaryEffects();
std::vector<Effect> motionEffects();
std::vector<Effect> contactEffects();
std::vector<Effect> processEffects();
std::vector<Effect> transferEffects();
std::vector<Effect> treatmentEffects();
} // namespace mpm::cases
