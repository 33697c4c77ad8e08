// gmsh in a process of its own.
#include "base/childProcess.hpp"
#include "base/error.hpp"
#include "geometry/geometryFile.hpp"
#include "geometry/gmshScript.hpp"
#include "geometry/meshBytes.hpp"

namespace mpm::geometry
{
GmshMesh readGmsh(const std::filesystem::path& file, int dim, double scale, double seconds)
{
    checkScript(file, checkedEnding(file));
    const auto work = [&] {
        try
        {
            return meshBytes(readGmshHere(file, dim, scale));
        }
        catch (const std::bad_alloc&)
        {
            return refusalBytes(InputError({file.string(), 0}, "gmsh: not enough memory for this geometry").what());
        }
        catch (const std::exception& error)
        {
            return refusalBytes(error.what());
        }
    };
    const ChildAnswer answer = runInChild(work, {.seconds = seconds});
    if (!answer.failure.empty())
        throw InputError({file.string(), 0}, "gmsh, which reads it, " + answer.failure +
                                                 (answer.late ? "; meshingTime of seedParticlesDict allows more" : ""));
    return meshFromBytes(answer.bytes, file, dim);
}
} // namespace mpm::geometry
