#include "coupling/couplingError.hpp"

namespace mpm::coupling
{
const char* faultName(Fault fault)
{
    switch (fault)
    {
    case Fault::callOrder:
        return "callOrder";
    case Fault::unknownSurface:
        return "unknownSurface";
    case Fault::unknownField:
        return "unknownField";
    case Fault::wrongSize:
        return "wrongSize";
    case Fault::notFinite:
        return "notFinite";
    case Fault::badValue:
        return "badValue";
    case Fault::badWindow:
        return "badWindow";
    case Fault::badSurface:
        return "badSurface";
    case Fault::jump:
        return "jump";
    case Fault::badState:
        return "badState";
    case Fault::files:
        return "files";
    }
    return "unknown";
}
} // namespace mpm::coupling
