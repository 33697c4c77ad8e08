// Coupling surfaces: made, described, exported.
#include "capi/handles.hpp"

#include <cstring>

using namespace mpm;
using namespace mpm::capi;
using coupling::Participant;

namespace
{
using coupling::FieldName, coupling::SurfaceKind, coupling::Interpolation, coupling::MappingMethod;
static_assert(int(SurfaceKind::Rigid) == MPM_RIGID && int(SurfaceKind::Deformable) == MPM_DEFORMABLE &&
              int(SurfaceKind::Monitor) == MPM_MONITOR);
static_assert(int(Interpolation::constant) == MPM_CONSTANT && int(Interpolation::linear) == MPM_LINEAR &&
              int(Interpolation::Hermite) == MPM_HERMITE);
static_assert(int(MappingMethod::nearestNeighbour) == MPM_NEAREST_NEIGHBOUR &&
              int(MappingMethod::nearestProjection) == MPM_NEAREST_PROJECTION);
static_assert(int(coupling::Direction::written) == MPM_WRITTEN && int(coupling::Direction::read) == MPM_READ);
static_assert(int(coupling::Support::surface) == MPM_SURFACE && int(coupling::Support::vertex) == MPM_VERTEX);

struct Flat
{
    const double* vertices;
    std::size_t vertexCount;
    const std::int64_t* elements;
    std::size_t elementCount;
};

coupling::SurfaceMesh meshOf(const Flat& flat, int dim)
{
    array(reinterpret_cast<const Vector3*>(flat.vertices), flat.vertexCount, "vertices");
    array(reinterpret_cast<const Vector3*>(flat.elements), flat.elementCount, "elements");
    coupling::SurfaceMesh mesh;
    mesh.dim = dim;
    mesh.vertices.resize(flat.vertexCount);
    for (std::size_t i = 0; i < flat.vertexCount; ++i)
        mesh.vertices[i] = {flat.vertices[3 * i], flat.vertices[3 * i + 1], flat.vertices[3 * i + 2]};
    mesh.elements.resize(flat.elementCount);
    const auto corners = std::size_t(dim);
    for (std::size_t i = 0; i < flat.elementCount; ++i)
    {
        const std::int64_t* corner = flat.elements + corners * i;
        mesh.elements[i] = {corner[0], corner[1], dim == 3 ? corner[2] : -1};
    }
    return mesh;
}

/// What an older caller's shorter structure does not have keeps its default.
coupling::SurfaceOptions optionsOf(const mpm_surface_options* given)
{
    const coupling::SurfaceOptions defaults;
    if (!given)
        return defaults;
    mpm_surface_options all{sizeof(all), defaults.mu, defaults.separation, defaults.referenceIsCentroid, {}};
    if (given->size < sizeof(given->size) || given->size > 4096)
        throw Refusal{MPM_WRONG_SIZE,
                      "wrongSize: mpm_surface_options.size is " + std::to_string(given->size) +
                          ", it should be sizeof(mpm_surface_options) = " + std::to_string(sizeof(all))};
    std::memcpy(&all, given, std::min(given->size, sizeof(all)));
    return {all.mu,
            all.separation != 0,
            {all.reference[0], all.reference[1], all.reference[2]},
            all.reference_is_centroid != 0};
}

template <std::size_t n>
void copyText(char (&to)[n], const std::string& text)
{
    const std::size_t length = std::min(text.size(), n - 1);
    std::memcpy(to, text.data(), length);
    to[length] = 0;
}

mpm_field described(const coupling::Field& field)
{
    mpm_field made{};
    made.name = int32_t(field.name);
    made.direction = int32_t(field.direction);
    made.support = int32_t(field.support);
    made.rank = field.rank;
    made.components = field.components;
    made.extensive = field.extensive;
    std::copy(field.dimensions.begin(), field.dimensions.end(), made.dimensions);
    copyText(made.word, coupling::fieldWord(field.name));
    copyText(made.unit, coupling::unitText(field));
    return made;
}
} // namespace

extern "C" {
mpm_status mpm_participant_add_coupling_surface(mpm_participant* participant, const char* surface, int32_t kind,
                                                const double* vertices, size_t vertex_count, const int64_t* elements,
                                                size_t element_count, const mpm_surface_options* options)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        own.addCouplingSurface(surface, meshOf({vertices, vertex_count, elements, element_count}, own.dimension()),
                               enumerator(kind, SurfaceKind::Monitor, "kind"), optionsOf(options));
    });
}

mpm_status mpm_participant_set_interpolation(mpm_participant* participant, const char* surface, int32_t field,
                                             int32_t interpolation)
{
    return withParticipant(participant, [&](Participant& own) {
        own.setInterpolation(required(surface, "surface"), enumerator(field, FieldName::ContactArea, "field"),
                             enumerator(interpolation, Interpolation::Hermite, "interpolation"));
    });
}

mpm_status mpm_participant_set_partner_mesh(mpm_participant* participant, const char* surface, const double* vertices,
                                            size_t vertex_count, const int64_t* elements, size_t element_count,
                                            int32_t method)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        own.setPartnerMesh(surface, meshOf({vertices, vertex_count, elements, element_count}, own.dimension()),
                           enumerator(method, MappingMethod::nearestProjection, "method"));
    });
}

mpm_status mpm_participant_surface_count(mpm_participant* participant, size_t* count)
{
    return withParticipant(participant, [&](Participant& own) { *required(count, "count") = own.surfaces().size(); });
}

mpm_status mpm_participant_surface_name(mpm_participant* participant, size_t index, char* name, size_t capacity,
                                        size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        const auto names = own.surfaces();
        if (index >= names.size())
            throw Refusal{MPM_UNKNOWN_SURFACE, "unknownSurface: number " + std::to_string(index) + " of " +
                                                   std::to_string(names.size()) + ", counted from 0"};
        deliver(names[index].c_str(), names[index].size() + 1, name, capacity, count);
    });
}

mpm_status mpm_participant_kind(mpm_participant* participant, const char* surface, int32_t* kind)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        *required(kind, "kind") = int32_t(own.kind(surface));
    });
}

mpm_status mpm_participant_fields(mpm_participant* participant, const char* surface, mpm_field* fields, size_t capacity,
                                  size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        std::vector<mpm_field> made;
        for (const coupling::Field& field : own.fields(required(surface, "surface")))
            made.push_back(described(field));
        deliver(made.data(), made.size(), fields, capacity, count);
    });
}

mpm_status mpm_participant_vertices(mpm_participant* participant, const char* surface, double* vertices,
                                    size_t capacity, size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        std::vector<double> flat;
        for (const Vector3& vertex : own.mesh(required(surface, "surface")).vertices)
            flat.insert(flat.end(), vertex.begin(), vertex.end());
        deliver(flat.data(), flat.size(), vertices, capacity, count);
    });
}

mpm_status mpm_participant_elements(mpm_participant* participant, const char* surface, int64_t* elements,
                                    size_t capacity, size_t* count)
{
    return withParticipant(participant, [&](Participant& own) {
        const coupling::SurfaceMesh& mesh = own.mesh(required(surface, "surface"));
        std::vector<std::int64_t> flat;
        for (const auto& element : mesh.elements)
            flat.insert(flat.end(), element.begin(), element.begin() + mesh.dim);
        deliver(flat.data(), flat.size(), elements, capacity, count);
    });
}

mpm_status mpm_participant_reference(mpm_participant* participant, const char* surface, double* point)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        required(point, "point");
        const Vector3 found = own.reference(surface);
        std::copy(found.begin(), found.end(), point);
    });
}

mpm_status mpm_participant_export_surface(mpm_participant* participant, const char* surface, const char* file)
{
    return withParticipant(participant, [&](Participant& own) {
        required(surface, "surface");
        own.exportSurface(surface, required(file, "file"));
    });
}
}
