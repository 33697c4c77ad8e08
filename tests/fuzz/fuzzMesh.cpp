// Bytes as the answer of the process that runs gmsh: read, checked, made a body.
#include "fuzz/fuzzing.hpp"
#include "geometry/bodyGeometry.hpp"
#include "geometry/meshBytes.hpp"

using namespace mpm;
using namespace mpm::geometry;

/// The first byte chooses the dimension.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    fuzz::accepted([&] {
        const GmshMesh mesh = meshFromBytes(bytes, "body.geo", data[0] == '3' ? 3 : 2);
        fuzz::require(meshBytes(mesh).size() == bytes.size(), "a mesh is as long as the bytes it came from");
        const BodyGeometry body = makeBody(mesh);
        for (const auto& region : body.regions)
            fuzz::require(region->volume() > 0, "a region that is accepted has a volume");
    });
    return 0;
}
