// The participant's verbs.
#include "python/arrays.hpp"
#include "python/session.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace mpm::python
{
namespace
{
using namespace coupling;
using py::arg;

template <class Enum, std::size_t n>
Enum chosen(const std::string& word, const std::array<const char*, n>& words, const char* what)
{
    std::string allowed;
    for (std::size_t i = 0; i < n; ++i)
    {
        if (word == words[i])
            return Enum(i);
        allowed += (i ? ", " : "") + std::string(words[i]);
    }
    throw CouplingError(Fault::badValue, std::string(what) + ": found '" + word + "', allowed " + allowed);
}

constexpr std::array<const char*, 4> lifecycles = {"Created", "Initialized", "Stepping", "Finalized"};
constexpr std::array<const char*, 3> interpolations = {"constant", "linear", "Hermite"};
constexpr std::array<const char*, 2> methods = {"nearestNeighbour", "nearestProjection"};

void addSurface(Session& own, const std::string& surface, const Values& vertices, const Indices& elements,
                const std::string& kind, double mu, bool separation,
                const std::optional<std::array<double, 3>>& reference)
{
    own.quick([&](Participant& p) {
        SurfaceOptions options{mu, separation, {}, !reference};
        if (reference)
            options.reference = *reference;
        p.addCouplingSurface(surface, meshOf(vertices, elements, p.dimension()), surfaceKind(kind), options);
    });
}

void setPartner(Session& own, const std::string& surface, const Values& vertices, const Indices& elements,
                const std::string& method)
{
    own.quick([&](Participant& p) {
        p.setPartnerMesh(surface, meshOf(vertices, elements, p.dimension()),
                         chosen<MappingMethod>(method, methods, "method"));
    });
}

/// readField or windowAverage into `out`, or into a new array.
template <void (Participant::*read)(const std::string&, FieldName, std::span<double>) const>
py::array_t<double> values(Session& own, const std::string& surface, const std::string& field, const py::object& out)
{
    return own.quick([&](Participant& p) {
        const FieldName name = fieldName(field);
        py::array_t<double> array = target(out, shapeOf(p, surface, name));
        (p.*read)(surface, name, {array.mutable_data(), std::size_t(array.size())});
        return array;
    });
}

py::array_t<Index> elements(Session& own, const std::string& surface)
{
    return own.quick([&](Participant& p) {
        const SurfaceMesh& mesh = p.mesh(surface);
        std::vector<Index> flat;
        for (const auto& element : mesh.elements)
            flat.insert(flat.end(), element.begin(), element.begin() + mesh.dim);
        return owned(std::move(flat), mesh.dim);
    });
}

void restore(Session& own, const Saved& saved)
{
    own.slow([&](Participant& p) { p.restoreState(saved.of ? saved.snapshot : p.deserialise(saved.bytes)); });
}

using Class = py::class_<Session, std::shared_ptr<Session>>;

void defineSurfaces(Class& type)
{
    type.def("add_coupling_surface", &addSurface, arg("surface"), arg("vertices"), arg("elements"),
             arg("kind") = "Rigid", arg("mu") = 0.0, arg("separation") = true, arg("reference") = py::none(),
             "Before initialize(). vertices: (n, 3) [m], in 2D also (n, 2); elements: from 0, segments (m, 2) with "
             "outward\n"
             "normal (e_y, -e_x) in 2D, triangles (m, 3) in 3D. kind: Rigid (moved as a whole), Deformable (vertex by\n"
             "vertex), Monitor (moves with the soil). mu: Coulomb friction; separation=False: it also holds;\n"
             "reference: (3,) [m], the point RigidPose speaks of, default the centroid.")
        .def(
            "set_interpolation",
            [](Session& own, const std::string& surface, const std::string& field, const std::string& word) {
                own.quick([&](Participant& p) {
                    p.setInterpolation(surface, fieldName(field),
                                       chosen<Interpolation>(word, interpolations, "interpolation"));
                });
            },
            arg("surface"), arg("field"), arg("interpolation"),
            "Before initialize(). Between written samples: constant, linear (default), Hermite.")
        .def("set_partner_mesh", &setPartner, arg("surface"), arg("vertices"), arg("elements"),
             arg("method") = "nearestProjection",
             "Before initialize(). Fields at vertices are exchanged on this mesh: intensive ones mapped consistently,\n"
             "extensive ones conservatively. method: nearestNeighbour, nearestProjection.")
        .def_property_readonly(
            "surfaces", [](Session& own) { return own.quick([](Participant& p) { return p.surfaces(); }); },
            "Names, in the order they were added.")
        .def(
            "kind",
            [](Session& own, const std::string& surface) {
                return own.quick([&](Participant& p) { return kindWord(p.kind(surface)); });
            },
            arg("surface"))
        .def(
            "fields",
            [](Session& own, const std::string& surface) {
                return own.quick([&](Participant& p) { return p.fields(surface); });
            },
            arg("surface"), "List of Field: name, direction, support, rank, components, dimensions, extensive, unit.")
        .def(
            "vertices",
            [](Session& own, const std::string& surface) {
                return own.quick([&](Participant& p) { return owned(p.mesh(surface).vertices); });
            },
            arg("surface"), "(n, 3) [m] in the reference configuration; the partner's, where one was set.")
        .def(
            "reference",
            [](Session& own, const std::string& surface) {
                const Vector3 point = own.quick([&](Participant& p) { return p.reference(surface); });
                return py::array_t<double>(3, point.data());
            },
            arg("surface"), "(3,) [m]: the point that RigidPose places and torques are about.")
        .def("elements", &elements, arg("surface"), "(m, 2) in 2D, (m, 3) in 3D, from 0.")
        .def(
            "value_count",
            [](Session& own, const std::string& surface, const std::string& field) {
                return own.quick([&](Participant& p) { return p.valueCount(surface, fieldName(field)); });
            },
            arg("surface"), arg("field"), "Numbers of a field: components, times vertices.")
        .def(
            "export_surface",
            [](Session& own, const std::string& surface, const std::filesystem::path& file) {
                own.slow([&](Participant& p) { p.exportSurface(surface, file); });
            },
            arg("surface"), arg("file"), "As it is now: .stl (3D), .vtp or .msh by the ending.");
}

void defineExchange(Class& type)
{
    type.def(
            "write_field",
            [](Session& own, const std::string& surface, const std::string& field, const Values& given, double time) {
                own.quick([&](Participant& p) { p.writeField(surface, fieldName(field), view(given), time); });
            },
            arg("surface"), arg("field"), arg("values"), arg("relative_time") = 0.0,
            "What a field is at time + relative_time [s]. RigidPose (7,): x y z [m] qw qx qy qz; RigidTwist (6,):\n"
            "vx vy vz [m/s] wx wy wz [rad/s]; Displacement [m], Velocity [m/s], Force [N], Traction [Pa]: (n, 3).\n"
            "Contiguous float64 is taken as it lies.")
        .def(
            "advance",
            [](Session& own, double window) { return own.slow([&](Participant& p) { return p.advance(window); }); },
            arg("window"),
            "Steps to time + window [s] and lands on it bitwise. Returns an Advance, which is false if the window was\n"
            "discarded. Other threads of Python run meanwhile.")
        .def("read_field", &values<&Participant::readField>, arg("surface"), arg("field"), arg("out") = py::none(),
             "A field at `time`, into `out` (C-contiguous float64) where it is given. Force, Torque of a Rigid surface "
             "(3,),\n"
             "ContactArea (1,); at vertices Force [N], Traction [Pa], Displacement [m], Velocity [m/s] (n, 3),\n"
             "ContactArea [m^2] (n,), Stress [Pa] (n, 6): xx yy zz xy yz zx.")
        .def("window_average", &values<&Participant::windowAverage>, arg("surface"), arg("field"),
             arg("out") = py::none(), "Force, Torque, Traction: impulse of the last window over its length.")
        .def(
            "resultants",
            [](Session& own, const std::string& surface) {
                return own.quick([&](Participant& p) { return p.resultants(surface); });
            },
            arg("surface"), "Force and torque of the last window and their impulses, contact area at its end.")
        .def(
            "interface_work",
            [](Session& own, const std::string& surface) {
                return own.quick([&](Participant& p) { return p.interfaceWork(surface); });
            },
            arg("surface"), "Work of the surface on the soil since initialize() [J]; per metre in 2D.")
        .def(
            "balance", [](Session& own) { return own.quick([](Participant& p) { return p.balance(); }); },
            "Energies, works and momentum of the whole soil.");
}

void defineStates(Class& type)
{
    type.def(
            "save_state",
            [](const std::shared_ptr<Session>& own) {
                auto snapshot = own->slow([](Participant& p) { return p.saveState(); });
                return std::make_shared<Saved>(Saved{std::move(snapshot), own, {}});
            },
            "All there is, hidden state included. Can be pickled.")
        .def("restore_state", &restore, arg("state"), "The participant goes on bitwise as the saved one did.")
        .def(
            "accept_window", [](Session& own) { own.slow([](Participant& p) { p.acceptWindow(); }); },
            "The way since the last accepted window stands: only now its rows and due states go to disk.")
        .def(
            "finalize", [](Session& own) { own.slow([](Participant& p) { p.finalize(); }); },
            "Writes the state of the last accepted window, so that the case can go on from it, and ends.");
}
} // namespace

void defineParticipant(py::module_& module)
{
    Class type(
        module, "Participant",
        "A seeded case as one participant of a coupled simulation. SI units, tension positive; vectors have three\n"
        "components in 2D too; in 2D what is extensive is per metre of thickness.\n\n"
        "    soil = libmpm.Participant(\"columnSpringWall\")\n"
        "    soil.initialize()\n"
        "    while soil.time < end:\n"
        "        soil.write_field(\"wall\", \"RigidPose\", pose, window)\n"
        "        soil.advance(window)\n"
        "        force = soil.window_average(\"wall\", \"Force\")\n"
        "        soil.accept_window()\n"
        "    soil.finalize()");
    type.def(py::init([](const std::filesystem::path& folder, const py::object& settings, int threads) {
                 const auto words = settingsOf(settings);
                 const py::gil_scoped_release others;
                 return std::make_shared<Session>(folder.string(), words, threads);
             }),
             arg("case"), arg("settings") = py::none(), arg("threads") = 0,
             "case: folder, seeded. settings: {\"constant/materialProperties\": {\"soil.cohesion\": 2e3}}, words with "
             "other\n"
             "values than the files'. threads: 0 takes OpenMP's number. All mistakes of the case are an InputError "
             "here.")
        .def(
            "initialize", [](Session& own) { own.slow([](Participant& p) { p.initialize(); }); },
            "Ends the time in which surfaces can be added.")
        .def_property_readonly(
            "lifecycle",
            [](Session& own) {
                return own.quick([](Participant& p) { return lifecycles[std::size_t(p.lifecycle())]; });
            },
            "Created, Initialized, Stepping or Finalized.")
        .def_property_readonly("dimension",
                               [](Session& own) { return own.quick([](Participant& p) { return p.dimension(); }); })
        .def_property_readonly(
            "time", [](Session& own) { return own.quick([](Participant& p) { return p.time(); }); }, "[s]")
        .def_property_readonly(
            "stable_time_step",
            [](Session& own) { return own.quick([](Participant& p) { return p.stableTimeStep(); }); },
            "From initialize() on: the largest step the scheme may take now [s]; deltaT where it is fixed.");
    defineSurfaces(type);
    defineExchange(type);
    defineStates(type);
}
} // namespace mpm::python
