// Short texts as .geo and .msh, through gmsh in its process. Slow: some executions a second.
#include "fuzz/fuzzing.hpp"
#include "geometry/bodyGeometry.hpp"

using namespace mpm;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Folder folder;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const bool isMesh = text.rfind("$", 0) == 0;
    const auto file = folder.write(isMesh ? "geometry/body.msh" : "geometry/body.geo", text);
    const std::size_t before = folder.files();
    for (const int dim : {2, 3})
        fuzz::accepted([&] { geometry::readGeometry(file, dim, 1, 2); });
    fuzz::require(folder.files() == before, "reading a geometry writes no file");
    return 0;
}
