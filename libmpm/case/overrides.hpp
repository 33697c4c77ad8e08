#pragma once
/// Words of the dictionaries that a run takes other values for than its files say, and why: what -withinTime and
/// -withinError have picked (pickSetting.hpp). The files stay as they are. The words stand in each state the run
/// writes, /provenance/overrides, so that a run that goes on from it goes on with them:
///
///     -withinTime 60
///     system/mpmSchemes shape cpGIMP
///     system/mpmSchemes splitting -           // taken away
///     system/controlDict deltaT 0.0005
///
/// A dictionary that is taken away or a word that is set counts as read.
#include "dictionary/dictionary.hpp"
#include "state/state.hpp"

#include <string>
#include <vector>

namespace mpm::cases
{
struct Override
{
    std::string file, word, value; ///< an empty value takes the word away
};

class Overrides
{
  public:
    Overrides() = default;
    explicit Overrides(std::string reason) : reason_(std::move(reason)) {}

    void set(const std::string& file, const std::string& word, const std::string& value);
    bool empty() const { return words_.empty(); }
    const std::string& reason() const { return reason_; }

    /// Changes a dictionary that was read from `file` ("system/mpmSchemes").
    void apply(const std::string& file, dictionary::Dictionary& dictionary) const;
    /// "shape cpGIMP, no splitting, deltaT 0.0005".
    std::string describe() const;

    /// Puts them into a state that is about to be written, in place of what is there.
    void remember(state::State& state) const;
    /// Those of a state that was read; InputError if the text is none of ours.
    static Overrides recall(const state::State& state);

  private:
    std::string reason_;
    std::vector<Override> words_;
};
} // namespace mpm::cases
