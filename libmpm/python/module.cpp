// import libmpm
#include "base/version.hpp"
#include "python/session.hpp"

PYBIND11_MODULE(libmpm, module)
{
    module.doc() =
        "Material point method for large-deformation soil mechanics, as a participant of coupled simulations.";
    module.attr("__version__") = mpm::projectVersion();
    mpm::python::defineErrors(module);
    mpm::python::defineRecords(module);
    mpm::python::defineParticipant(module);
}
