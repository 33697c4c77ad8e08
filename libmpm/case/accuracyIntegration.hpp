#pragma once
/// A row's run without errors in time: its start carried to its end by the semi-discrete equations, to tight tolerance.
/// Who calls brings the solver (reference/semiDiscreteSolution.hpp), so that the library itself needs none.
#include "case/caseDirectory.hpp"
#include "case/timeCheck.hpp"

#include <map>

namespace mpm::cases
{
/// Rows of the same start and shape are integrated once.
class RowIntegration
{
  public:
    explicit RowIntegration(ReferenceSolver solver) : solver_(std::move(solver)) {}

    struct End
    {
        state::State state{2};
        state::State rougher{2}; ///< with a hundred times the tolerance: what the first is wrong by, at most
    };
    /// The particles of a run at its latest time. Throws InputError where the scene has no smooth equations or the run
    /// splits, with the reason.
    const End& end(const CaseDirectory& run);

  private:
    ReferenceSolver solver_;
    std::map<std::string, End> known_;
};
} // namespace mpm::cases
