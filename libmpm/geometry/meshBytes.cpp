#include "geometry/meshBytes.hpp"

#include "base/error.hpp"

#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace mpm::geometry
{
namespace
{
/// Coordinates [m]: a sphere of galaxies fits, rounding errors of any body are larger. Exact arithmetic on numbers of
/// all magnitudes between 1e-308 and 1e308 would take minutes on a few hundred triangles.
constexpr double largest = 1e30, smallest = 1e-60;
constexpr char meshMark = 'm', refusalMark = 'r';
constexpr std::size_t longestRefusal = 4000; // characters

class Writer
{
  public:
    explicit Writer(char mark) : bytes_(1, mark) {}

    template <class T>
    void plain(const T& value)
    {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void text(const std::string& value)
    {
        plain(std::uint64_t(value.size()));
        bytes_ += value;
    }
    template <class T>
    void list(const std::vector<T>& values)
    {
        plain(std::uint64_t(values.size()));
        for (const T& value : values)
            plain(value);
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class Reader
{
  public:
    Reader(const std::string& bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError({file_.string(), 0}, fmt::format("gmsh answered with something that is no mesh: {}", what));
    }

    template <class T>
    T plain()
    {
        T value;
        if (bytes_.size() - at_ < sizeof value)
            fail("it ends too early");
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    /// A number of things of at least `size` bytes each, which must be there.
    std::size_t count(std::size_t size)
    {
        const auto n = plain<std::uint64_t>();
        if (n > (bytes_.size() - at_) / size)
            fail("it counts more than it holds");
        return std::size_t(n);
    }
    std::string text()
    {
        const std::size_t n = count(1);
        at_ += n;
        return bytes_.substr(at_ - n, n);
    }
    template <class T>
    std::vector<T> list()
    {
        std::vector<T> values(count(sizeof(T)));
        for (T& value : values)
            value = plain<T>();
        return values;
    }
    bool over() const { return at_ == bytes_.size(); }

  private:
    const std::string& bytes_;
    const std::filesystem::path& file_;
    std::size_t at_ = 0;
};

/// Text of a stranger: as one that can be printed, with the file's name at its beginning.
[[noreturn]] void refuse(std::string text, const std::filesystem::path& file)
{
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127)
            c = ' ';
    if (text.rfind(file.string(), 0) == 0)
        throw InputError(text);
    throw InputError({file.string(), 0},
                     text.find_first_not_of(' ') == std::string::npos ? "gmsh gave no reason" : text);
}

/// Indices of points, all different; the third is -1 in 2D.
void checkElements(const std::vector<Simplex>& elements, const GmshMesh& mesh, const Reader& in)
{
    for (const Simplex& s : elements)
        for (std::size_t k = 0; k < 3; ++k)
            if (mesh.dim == 2 && k == 2 ? s[k] != -1 : s[k] < 0 || std::size_t(s[k]) >= mesh.points.size())
                in.fail("an element has no such point");
}
} // namespace

std::string meshBytes(const GmshMesh& mesh)
{
    Writer out(meshMark);
    out.plain(std::int32_t(mesh.dim));
    out.list(mesh.points);
    out.plain(std::uint64_t(mesh.regions.size()));
    for (const RawRegion& region : mesh.regions)
    {
        out.text(region.name);
        out.plain(char(region.connected));
        out.plain(std::uint64_t(region.parts.size()));
        for (const auto& part : region.parts)
            out.list(part);
    }
    out.plain(std::uint64_t(mesh.boundaries.size()));
    for (const RawBoundary& boundary : mesh.boundaries)
    {
        out.text(boundary.name);
        out.list(boundary.elements);
    }
    out.plain(std::uint64_t(mesh.notes.size()));
    for (const std::string& note : mesh.notes)
        out.text(note);
    return out.take();
}

std::string refusalBytes(const std::string& message)
{
    return refusalMark + message;
}

GmshMesh meshFromBytes(const std::string& bytes, const std::filesystem::path& file, int dim)
{
    if (!bytes.empty() && bytes[0] == refusalMark)
        refuse(bytes.substr(1, longestRefusal), file);
    Reader in(bytes, file);
    if (in.plain<char>() != meshMark || in.plain<std::int32_t>() != dim)
        in.fail("its beginning is wrong");
    GmshMesh mesh;
    mesh.dim = dim;
    mesh.file = file;
    mesh.points = in.list<Vector3>();
    for (Vector3& p : mesh.points)
        for (double& x : p)
        {
            if (!(std::abs(x) <= largest))
                throw InputError(
                    {file.string(), 0},
                    fmt::format("found a point at ({} {} {}), allowed numbers up to {:g}", p[0], p[1], p[2], largest));
            if (std::abs(x) < smallest)
                x = 0;
        }
    mesh.regions.resize(in.count(8 + 1 + 8));
    for (RawRegion& region : mesh.regions)
    {
        region.name = in.text();
        region.connected = in.plain<char>() != 0;
        region.parts.resize(in.count(8));
        for (auto& part : region.parts)
            checkElements(part = in.list<Simplex>(), mesh, in);
    }
    mesh.boundaries.resize(in.count(8 + 8));
    for (RawBoundary& boundary : mesh.boundaries)
    {
        boundary.name = in.text();
        checkElements(boundary.elements = in.list<Simplex>(), mesh, in);
    }
    mesh.notes.resize(in.count(8));
    for (std::string& note : mesh.notes)
        note = in.text();
    if (!in.over())
        in.fail("it goes on after its end");
    return mesh;
}
} // namespace mpm::geometry
