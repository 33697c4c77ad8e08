#include "coupling/exportSurface.hpp"

#include "base/error.hpp"
#include "coupling/couplingError.hpp"
#include "output/replaceFile.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <numeric>

namespace mpm::coupling
{
namespace
{
template <class... Arguments>
void add(std::string& text, fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

std::string stl(const std::string& name, const SurfaceMesh& mesh)
{
    // readers take a file that begins with "solid" for ASCII
    std::string out = fmt::format("surface {}", name).substr(0, 80);
    out.resize(80, ' ');
    const auto put = [&](const auto& value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        out.append(bytes, sizeof value);
    };
    put(std::uint32_t(mesh.elements.size()));
    const auto normals = elementNormals(mesh);
    for (std::size_t n = 0; n < mesh.elements.size(); ++n)
    {
        for (const double x : normals[n])
            put(float(x));
        for (const Index v : mesh.elements[n])
            for (const double x : mesh.vertices[std::size_t(v)])
                put(float(x));
        put(std::uint16_t(0));
    }
    return out;
}

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return out;
}

/// One array, `components` numbers a line.
void dataArray(std::string& out, const std::string& name, std::size_t components, std::span<const double> values)
{
    add(out, "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", escaped(name),
        components);
    for (std::size_t n = 0; n < values.size(); ++n)
        add(out, "{:.17g}{}", values[n], (n + 1) % components == 0 ? '\n' : ' ');
    out += "</DataArray>\n";
}

std::string vtp(const SurfaceMesh& mesh, const std::vector<VertexField>& fields)
{
    const auto corners = std::size_t(mesh.dim);
    const std::size_t count = mesh.elements.size();
    std::string out = "<?xml version=\"1.0\"?>\n"
                      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n";
    add(out,
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n<PointData>\n",
        mesh.vertices.size(), mesh.dim == 2 ? count : 0, mesh.dim == 2 ? 0 : count);
    for (const auto& field : fields)
        dataArray(out, field.name, std::size_t(field.components), field.values);
    out += "</PointData>\n<Points>\n";
    std::vector<double> places;
    for (const auto& x : mesh.vertices)
        places.insert(places.end(), x.begin(), x.end());
    dataArray(out, "Points", 3, places);
    const char* const cells = mesh.dim == 2 ? "Lines" : "Polys";
    add(out, "</Points>\n<{}>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n", cells);
    for (const auto& e : mesh.elements)
        for (std::size_t k = 0; k < corners; ++k)
            add(out, "{}{}", e[k], k + 1 == corners ? '\n' : ' ');
    out += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t n = 0; n < count; ++n)
        add(out, "{}\n", corners * (n + 1));
    add(out, "</DataArray>\n</{}>\n</Piece>\n</PolyData>\n</VTKFile>\n", cells);
    return out;
}

/// Elements by piece: those that hang together by their vertices, pieces in the order of their first elements.
std::vector<std::vector<std::size_t>> pieces(const SurfaceMesh& mesh)
{
    std::vector<Index> root(mesh.vertices.size());
    std::iota(root.begin(), root.end(), Index(0));
    const auto find = [&](Index v) {
        while (root[std::size_t(v)] != v)
            v = root[std::size_t(v)] = root[std::size_t(root[std::size_t(v)])];
        return v;
    };
    for (const auto& e : mesh.elements)
        for (std::size_t k = 1; k < std::size_t(mesh.dim); ++k)
            root[std::size_t(find(e[k]))] = find(e[0]);
    std::vector<std::vector<std::size_t>> found;
    std::vector<std::size_t> number(mesh.vertices.size(), std::size_t(-1));
    for (std::size_t n = 0; n < mesh.elements.size(); ++n)
    {
        std::size_t& piece = number[std::size_t(find(mesh.elements[n][0]))];
        if (piece == std::size_t(-1))
        {
            piece = found.size();
            found.emplace_back();
        }
        found[piece].push_back(n);
    }
    return found;
}

/// Each piece is a curve or surface of its own, tags from 1, so that a .geo file can say what is a hole in what; all
/// vertices stand with the first, in their order.
std::string msh(const std::string& name, const SurfaceMesh& mesh)
{
    const int entity = mesh.dim - 1;
    std::string group;
    for (const char c : name)
        if (c != '"' && c != '\n' && c != '\r')
            group += c;
    std::string out = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    add(out, "$PhysicalNames\n1\n{} 1 \"{}\"\n$EndPhysicalNames\n", entity, group);
    const auto parts = pieces(mesh);
    add(out, "$Entities\n0 {} {} 0\n", entity == 1 ? parts.size() : 0, entity == 2 ? parts.size() : 0);
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        Vector3 low = mesh.vertices[std::size_t(mesh.elements[parts[p][0]][0])], high = low;
        for (const std::size_t n : parts[p])
            for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
                for (std::size_t a = 0; a < 3; ++a)
                {
                    low[a] = std::min(low[a], mesh.vertices[std::size_t(mesh.elements[n][k])][a]);
                    high[a] = std::max(high[a], mesh.vertices[std::size_t(mesh.elements[n][k])][a]);
                }
        add(out, "{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} 1 1 0\n", p + 1, low[0], low[1], low[2], high[0],
            high[1], high[2]);
    }
    const std::size_t count = mesh.vertices.size();
    add(out, "$EndEntities\n$Nodes\n1 {} 1 {}\n{} 1 0 {}\n", count, count, entity, count);
    for (std::size_t n = 1; n <= count; ++n)
        add(out, "{}\n", n);
    for (const auto& x : mesh.vertices)
        add(out, "{:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
    add(out, "$EndNodes\n$Elements\n{} {} 1 {}\n", parts.size(), mesh.elements.size(), mesh.elements.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        add(out, "{} {} {} {}\n", entity, p + 1, entity, parts[p].size());
        for (const std::size_t n : parts[p])
        {
            add(out, "{}", n + 1);
            for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
                add(out, " {}", mesh.elements[n][k] + 1);
            out += '\n';
        }
    }
    out += "$EndElements\n";
    return out;
}
} // namespace

void exportSurface(const std::filesystem::path& file, const std::string& name, const SurfaceMesh& mesh,
                   const std::vector<VertexField>& fields)
{
    const auto fail = [&](const std::string& what) {
        throw CouplingError(Fault::files, fmt::format("{}: {}", file.string(), what));
    };
    for (const auto& field : fields)
        if (field.components < 1 || field.values.size() != mesh.vertices.size() * std::size_t(field.components))
            throw CouplingError(Fault::wrongSize,
                                fmt::format("found {} values of the field {}, allowed are {} vertices of {}",
                                            field.values.size(), field.name, mesh.vertices.size(), field.components));
    if (mesh.vertices.empty())
        fail("found a surface without vertices");
    std::string ending = file.extension().string(), text;
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (ending == ".stl" && mesh.dim == 3)
        text = stl(name, mesh);
    else if (ending == ".vtp")
        text = vtp(mesh, fields);
    else if (ending == ".msh")
        text = msh(name, mesh);
    else
        fail(fmt::format("found the ending '{}', allowed are {}", ending,
                         mesh.dim == 3 ? ".stl, .vtp and .msh" : ".vtp and .msh in 2D"));
    try
    {
        output::replaceText(file, text);
    }
    catch (const InputError& e)
    {
        throw CouplingError(Fault::files, e.what());
    }
}
} // namespace mpm::coupling
