#include "coupling/readSurfaceMesh.hpp"

#include "case/readSurface.hpp"
#include "coupling/couplingError.hpp"

namespace mpm::coupling
{
SurfaceMesh readSurfaceMesh(const std::filesystem::path& file, int dim, bool closed, double scale)
{
    auto found = cases::readSurfaceElements(file, dim, scale);
    SurfaceMesh mesh{dim, std::move(found.points), std::move(found.elements)};
    if (dim == 2)
        for (auto& e : mesh.elements)
            e[2] = -1;
    mesh = merged(mesh);
    if (closed && enclosedVolume(mesh) < 0)
        for (auto& e : mesh.elements)
            std::swap(e[0], e[1]);
    try
    {
        check(mesh, closed, file.stem().string());
    }
    catch (const CouplingError& e)
    {
        throw InputError({file.string()}, e.what());
    }
    return mesh;
}
} // namespace mpm::coupling
