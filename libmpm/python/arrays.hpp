#pragma once
/// numpy arrays in and out, without copies where their memory can be used as it is.
#include "coupling/participant.hpp"

#include <pybind11/numpy.h>

namespace mpm::python
{
namespace py = pybind11;

/// Values as they are handed in: any shape, copied only if they are no contiguous doubles.
using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<Index, py::array::c_style | py::array::forcecast>;

inline std::span<const double> view(const Values& values)
{
    return {values.data(), std::size_t(values.size())};
}

/// Shape of a field's values: (components) for a whole surface, (vertices, components) at vertices, (vertices) of
/// scalars.
std::vector<py::ssize_t> shapeOf(const coupling::Participant& participant, const std::string& surface,
                                 coupling::FieldName field);
/// `out` where it is given and fits (else TypeError, ValueError), or a new array.
py::array_t<double> target(const py::object& out, const std::vector<py::ssize_t>& shape);

/// A vector's memory as an array that keeps it.
py::array_t<double> owned(std::vector<Vector3> vertices);
py::array_t<Index> owned(std::vector<Index> values, py::ssize_t columns);

/// vertices (n, 2 or 3), elements (m, 2) in 2D, (m, 3) in 3D; ValueError for other shapes.
coupling::SurfaceMesh meshOf(const Values& vertices, const Indices& elements, int dim);
} // namespace mpm::python
