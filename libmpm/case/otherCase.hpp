#pragma once
/// Another case folder whose stored times stand beside ours: option -against.
///
/// A time is the same if the names of its folders differ by no more than 1e-6 of it. Throws InputError if there is no
/// such case, none of the times asked for is in it, or its states are of another dimension.
#include "case/caseDirectory.hpp"

#include <map>

namespace mpm::cases
{
class OtherCase
{
  public:
    /// `folder` as typed: a relative path starts at the case folder. Times are those of `here` that are looked at.
    OtherCase(const CaseDirectory& here, const std::filesystem::path& folder, const std::vector<TimeFolder>& times);

    std::string name() const { return there_.name(); }
    std::string shape() const; ///< of its mpmSchemes
    /// The other's state.h5 of one of our times; empty if it has none.
    std::filesystem::path stateOf(const TimeFolder& time) const;
    std::size_t commonTimes() const { return same_.size(); }

  private:
    CaseDirectory there_;
    std::map<std::string, std::string> same_; ///< names of our times and of its
};
} // namespace mpm::cases
