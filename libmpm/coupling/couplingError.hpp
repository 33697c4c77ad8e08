#pragma once
/// What a master did that cannot be done, by name, so that a program can tell the kinds apart. The participant is as it
/// was before the call. Wrong input of the case itself stays an InputError (file:line), a calculation that cannot go on
/// comes back from Participant::advance as a discarded window.
#include <stdexcept>
#include <string>

namespace mpm::coupling
{
enum class Fault
{
    callOrder,      ///< a call that the lifecycle does not allow now
    unknownSurface, ///< no coupling surface of that name
    unknownField,   ///< the surface has no field of that name, or not in this direction
    wrongSize,      ///< more or fewer values than the field has
    notFinite,      ///< a NaN or an infinity among the values
    badValue,       ///< a value no field may have: quaternion of length 0, z component in 2D, time before the window
    badWindow,      ///< a window that is not a positive, finite time a step can be taken in
    badSurface, ///< open, flipped, duplicate, degenerate elements; outside the grid; thinner than a cell; in the soil
    jump,       ///< a surface would move more than half a cell in one substep
    badState,   ///< a saved state that is none, is damaged, or belongs to another case
    files       ///< a file cannot be written or read
};

/// "callOrder", "unknownSurface", ...: the words of messages, the C interface and Python's exceptions.
const char* faultName(Fault fault);

class CouplingError : public std::runtime_error
{
  public:
    CouplingError(Fault fault, const std::string& what)
        : std::runtime_error(std::string(faultName(fault)) + ": " + what), fault_(fault)
    {}
    Fault fault() const { return fault_; }

  private:
    Fault fault_;
};
} // namespace mpm::coupling
