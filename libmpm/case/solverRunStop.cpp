// How a run of the solver ends before its time: by a signal, or because something cannot be written.
#include "base/error.hpp"
#include "case/interruption.hpp"
#include "case/solverRun.hpp"

#include <cstdio>
#include <fmt/format.h>

namespace mpm::cases
{
void SolverRun::failWriting(const InputError& error)
{
    progress_.reset();
    try
    {
        finishWriting();
    }
    catch (const InputError&)
    {
        // the first failure is the one to tell
    }
    throw InputError(fmt::format("{}\n    the last stored time is {}; once this is mended, mpmSolve goes on from there "
                                 "(startFrom latestTime)",
                                 error.what(), lastStored_));
}

int SolverRun::stop(int signal)
{
    try
    {
        if (writtenStep_ != state_.step)
            writeState(true);
        finishWriting();
    }
    catch (const InputError& error)
    {
        failWriting(error);
    }
    progress_.reset();
    const bool latest = runTime_->start() == RunTime::Start::latest;
    std::fflush(stdout);
    std::fputs(fmt::format("--> mpmSolve: stopped by {} at {:g} s, after step {}; the state is in {}/state.h5.\n"
                           "    Run mpmSolve again{}: startFrom latestTime goes on bitwise to endTime {:g} s.\n",
                           signalName(signal), state_.time, state_.step, lastStored_,
                           latest ? "" : " with startFrom latestTime in system/controlDict", runTime_->endTime())
                   .c_str(),
               stderr); // not print, which throws when the terminal is gone
    return Interruption::exitCode(signal);
}
} // namespace mpm::cases
