#include "base/error.hpp"
#include "precice/preciceLink.hpp"

namespace mpm::precice
{
std::string preciceVersion()
{
    return {};
}

int runWithPrecice(CoupledCase&)
{
    throw InputError("built without preCICE: install preCICE 3 (precice.org, package libprecice3), then configure and "
                     "build libmpm again (-Dprecice_DIR=... where CMake does not find it by itself)");
}
} // namespace mpm::precice
