#pragma once
/// The times a run has written, in turn and out of turn, and what becomes of them.
///
/// A run that is interrupted writes its state out of turn. The continued run must leave what the uninterrupted one
/// would have left, so a time out of turn goes as soon as the next state has reached the disk, does not count for
/// purgeWrite and has no say in the names of later times. It stays if a utility has added fields to it, and where the
/// time in turn before it is missing (a state copied into another case).
///
/// What the continued run has to know stands in the state, below /provenance:
///     outOfTurn     "<time folder> <time>" of the last state in turn; only in states out of turn
///     purgeWrite    time folders written in turn before, which purgeWrite counts; only with purgeWrite > 0
#include "case/caseDirectory.hpp"
#include "state/state.hpp"

#include <string>
#include <vector>

namespace mpm::cases
{
class WrittenTimes
{
  public:
    /// keep: purgeWrite, 0 for all; precision: timePrecision.
    WrittenTimes(const CaseDirectory& folder, Index keep, int precision);

    /// The run starts from this state of the time folder `name`; takes the marks out of it.
    void goOnFrom(state::State& state, const std::string& name);
    /// Removes what a killed run did not come to remove.
    void tidy();
    /// The time folder for a state that is about to be written; puts the marks into it.
    std::string next(state::State& state, bool outOfTurn);
    /// The run goes back to this time: what was written after it is removed. Returns the latest time folder left.
    std::string goBack(double time);
    /// That state has reached the disk: removes what it makes superfluous.
    void committed();

  private:
    struct Time
    {
        std::string name;
        double value = 0; ///< [s], exact
    };
    bool drop(const std::string& outOfTurn) const;

    const CaseDirectory& folder_;
    Index keep_;
    int precision_;
    std::string start_;               ///< the run began from it
    std::string name_;                ///< of the state being written
    bool nameOutOfTurn_ = false;      ///< is that one out of turn?
    std::string inTurn_;              ///< the last in turn
    double inTurnTime_ = 0;           ///< [s]
    std::vector<Time> before_;        ///< those in turn before it, as far as this run knows them
    std::string outOfTurn_;           ///< the one on disk; empty: none
    std::vector<std::string> purged_; ///< those purgeWrite counts, oldest first
};

/// Takes the marks out of a state that becomes another one (splitParticles).
void forgetTurn(state::State& state);
} // namespace mpm::cases
