#include "python/arrays.hpp"

#include <numeric>

namespace mpm::python
{
namespace
{
std::string shapeText(const py::array& array)
{
    std::string text = "(";
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        text += (i ? ", " : "") + std::to_string(array.shape(i));
    return text + (array.ndim() == 1 ? ",)" : ")");
}

/// An array whose memory belongs to a vector on the heap.
template <class T, class Held>
py::array_t<T> adopt(std::vector<Held> values, std::vector<py::ssize_t> shape)
{
    auto* held = new std::vector<Held>(std::move(values));
    const py::capsule owner(held, [](void* pointer) { delete static_cast<std::vector<Held>*>(pointer); });
    return py::array_t<T>(std::move(shape), reinterpret_cast<const T*>(held->data()), owner);
}

const coupling::Field& described(const std::vector<coupling::Field>& fields, coupling::FieldName name)
{
    for (const coupling::Field& field : fields)
        if (field.name == name)
            return field;
    throw coupling::CouplingError(coupling::Fault::unknownField, coupling::fieldWord(name));
}
} // namespace

std::vector<py::ssize_t> shapeOf(const coupling::Participant& participant, const std::string& surface,
                                 coupling::FieldName name)
{
    const auto values = py::ssize_t(participant.valueCount(surface, name));
    const auto fields = participant.fields(surface);
    const coupling::Field& field = described(fields, name);
    if (field.support == coupling::Support::surface || field.components == 1)
        return {values};
    return {values / field.components, field.components};
}

py::array_t<double> target(const py::object& out, const std::vector<py::ssize_t>& shape)
{
    if (out.is_none())
        return py::array_t<double>(shape);
    if (!py::isinstance<py::array_t<double>>(out))
        throw py::type_error("out: allowed is an array of float64");
    const auto array = py::reinterpret_borrow<py::array_t<double>>(out);
    if (!array.writeable() || !(array.flags() & py::array::c_style))
        throw py::value_error("out: allowed is a C-contiguous array that can be written");
    if (array.size() != std::accumulate(shape.begin(), shape.end(), py::ssize_t(1), std::multiplies<>()))
        throw py::value_error("out: found shape " + shapeText(array) + ", allowed " +
                              shapeText(py::array_t<double>(shape)));
    return array;
}

py::array_t<double> owned(std::vector<Vector3> vertices)
{
    const auto n = py::ssize_t(vertices.size());
    return adopt<double>(std::move(vertices), {n, 3});
}

py::array_t<Index> owned(std::vector<Index> values, py::ssize_t columns)
{
    const auto n = py::ssize_t(values.size());
    return adopt<Index>(std::move(values), {n / columns, columns});
}

coupling::SurfaceMesh meshOf(const Values& vertices, const Indices& elements, int dim)
{
    if (vertices.ndim() != 2 || (vertices.shape(1) != 3 && vertices.shape(1) != dim))
        throw py::value_error("vertices: found shape " + shapeText(vertices) + ", allowed (n, 3)" +
                              (dim == 2 ? " or (n, 2)" : ""));
    const bool none = elements.size() == 0;
    if (!none && (elements.ndim() != 2 || elements.shape(1) != dim))
        throw py::value_error("elements: found shape " + shapeText(elements) + ", allowed (m, " + std::to_string(dim) +
                              ")");
    coupling::SurfaceMesh mesh;
    mesh.dim = dim;
    const auto columns = std::size_t(vertices.shape(1));
    mesh.vertices.resize(std::size_t(vertices.shape(0)));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (std::size_t k = 0; k < columns; ++k)
            mesh.vertices[i][k] = vertices.data()[columns * i + k];
    mesh.elements.resize(none ? 0 : std::size_t(elements.shape(0)));
    for (std::size_t i = 0; i < mesh.elements.size(); ++i)
    {
        mesh.elements[i] = {-1, -1, -1};
        for (std::size_t k = 0; k < std::size_t(dim); ++k)
            mesh.elements[i][k] = elements.data()[std::size_t(dim) * i + k];
    }
    return mesh;
}
} // namespace mpm::python
