#include "precice/preciceLink.hpp"

#include "base/error.hpp"

#include <fmt/format.h>
#include <precice/precice.hpp>
#include <precice/Tooling.hpp>

namespace mpm::precice
{
static_assert(CouplingLibrary<::precice::Participant>);

namespace
{
std::unique_ptr<::precice::Participant> join(const PreciceCoupling& coupling)
{
    try
    {
        return std::make_unique<::precice::Participant>(coupling.participant, coupling.config.string(), 0, 1);
    }
    catch (const ::precice::Error& error)
    {
        throw InputError(fmt::format("{}: {}", coupling.config.string(), error.what()));
    }
}
} // namespace

std::string preciceVersion()
{
    const std::string all = ::precice::getVersionInformation(); // version;revision;how it was built
    return "preCICE " + all.substr(0, all.find(';'));
}

int runWithPrecice(CoupledCase& coupled)
{
    auto library = join(coupled.coupling());
    try
    {
        const int code = coupled.run(*library);
        if (code != 0)
            (void)library.release();
        return code;
    }
    catch (...)
    {
        (void)library.release(); // its destructor would speak to a partner that may be gone, and wait for ever
        throw;
    }
}
} // namespace mpm::precice
