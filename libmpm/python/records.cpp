// What calls return, as objects with names.
#include "python/arrays.hpp"
#include "python/session.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace mpm::python
{
namespace
{
using namespace coupling;

template <class Record, class... More>
void vectorOf(py::class_<Record, More...>& type, const char* name, Vector3 Record::*member, const char* text)
{
    type.def_property_readonly(
        name, [member](const Record& record) { return py::array_t<double>(3, (record.*member).data()); }, text);
}

std::string fieldText(const Field& field)
{
    return std::string("<Field ") + fieldWord(field.name) + " [" + unitText(field) + "], " +
           (field.direction == Direction::written ? "written" : "read") +
           (field.support == Support::vertex ? " at vertices" : "") + ">";
}
} // namespace

void defineRecords(py::module_& module)
{
    py::class_<Field>(module, "Field", "What a surface exchanges.")
        .def_property_readonly("name", [](const Field& f) { return fieldWord(f.name); })
        .def_property_readonly("direction",
                               [](const Field& f) { return f.direction == Direction::written ? "written" : "read"; })
        .def_property_readonly("support",
                               [](const Field& f) { return f.support == Support::vertex ? "vertex" : "surface"; })
        .def_readonly("rank", &Field::rank, "0 scalar, 1 vector, 2 symmetric tensor; pose and twist count as 1")
        .def_readonly("components", &Field::components, "numbers a value: 1, 3, 6, 7")
        .def_readonly("dimensions", &Field::dimensions, "exponents of kg m s K mol A cd")
        .def_readonly("extensive", &Field::extensive, "does it add up over a surface?")
        .def_property_readonly("unit", [](const Field& f) { return unitText(f); })
        .def("__repr__", &fieldText);

    py::class_<Advance>(module, "Advance", "How far a window went.")
        .def_readonly("time", &Advance::time, "where the participant is now [s]")
        .def_readonly("substeps", &Advance::substeps, "taken in this window")
        .def_property_readonly(
            "discarded", [](const Advance& a) { return a.status == Status::discarded; },
            "True: the calculation could not go on, and is back at the window's start")
        .def_readonly("message", &Advance::message, "why, or \"\"")
        .def("__bool__", [](const Advance& a) { return a.status == Status::reached; })
        .def("__repr__", [](const Advance& a) {
            return "<Advance time " + std::to_string(a.time) + " s, " + std::to_string(a.substeps) + " substeps" +
                   (a.status == Status::discarded ? ", discarded: " + a.message : "") + ">";
        });

    py::class_<Resultants> resultants(module, "Resultants", "Of the soil on a surface; per metre in 2D.");
    vectorOf(resultants, "force", &Resultants::force, "mean of the last window, (3,) [N]");
    vectorOf(resultants, "torque", &Resultants::torque, "the same about the reference point, (3,) [N m]");
    vectorOf(resultants, "impulse", &Resultants::impulse, "of the last window, (3,) [N s]");
    vectorOf(resultants, "moment_impulse", &Resultants::momentImpulse, "of the last window, (3,) [N m s]");
    resultants.def_readonly("contact_area", &Resultants::contactArea, "at its end [m^2]")
        .def("__repr__", [](const Resultants& r) {
            return fmt::format("<Resultants force ({:.6g}, {:.6g}, {:.6g}) N, torque ({:.6g}, {:.6g}, {:.6g}) N m, "
                               "contact {:.6g} m^2>",
                               r.force[0], r.force[1], r.force[2], r.torque[0], r.torque[1], r.torque[2],
                               r.contactArea);
        });

    py::class_<Balance> balance(module, "Balance", "Sums over the whole soil now [J]; per metre in 2D.");
    balance.def_readonly("kinetic_energy", &Balance::kineticEnergy)
        .def_readonly("strain_energy", &Balance::strainEnergy)
        .def_readonly("dissipation", &Balance::dissipation)
        .def_readonly("gravity_work", &Balance::gravityWork)
        .def_readonly("interface_work", &Balance::interfaceWork, "of all surfaces on the soil since initialize()")
        .def_readonly("motion_work", &Balance::motionWork,
                      "the same by the soil's own books, with walls and bodies whose motion is prescribed")
        .def_readonly("residual", &Balance::residual, "what the budget does not explain")
        .def("__repr__", [](const Balance& b) {
            return fmt::format("<Balance kinetic {:.6g} J, strain {:.6g} J, dissipation {:.6g} J, gravity {:.6g} J, "
                               "interface {:.6g} J, residual {:.3g} J>",
                               b.kineticEnergy, b.strainEnergy, b.dissipation, b.gravityWork, b.interfaceWork,
                               b.residual);
        });
    vectorOf(balance, "momentum", &Balance::momentum, "(3,) [N s]");

    py::class_<Saved, std::shared_ptr<Saved>>(module, "State",
                                              "A saved state. It can be pickled, for a process of the same libmpm.")
        .def(py::pickle(
            [](Saved& saved) {
                if (saved.of)
                    saved.bytes = saved.of->slow([&](const Participant& p) { return p.serialise(saved.snapshot); });
                py::bytes copy(reinterpret_cast<const char*>(saved.bytes.data()), saved.bytes.size());
                if (saved.of)
                    saved.bytes = {};
                return py::make_tuple(copy);
            },
            [](const py::tuple& held) {
                if (held.size() != 1)
                    throw CouplingError(Fault::badState, "no state");
                const auto text = held[0].cast<std::string_view>();
                auto saved = std::make_shared<Saved>();
                const auto* first = reinterpret_cast<const std::byte*>(text.data());
                saved->bytes.assign(first, first + text.size());
                return saved;
            }));
}
} // namespace mpm::python
