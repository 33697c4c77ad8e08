#include "case/smoothingInput.hpp"

#include "dictionary/dictionary.hpp"
#include "smoothing/weightTable.hpp"

namespace mpm::cases
{
std::string readSmoothingShape(const CaseDirectory& folder)
{
    std::vector<dictionary::Choice> shapes;
    for (const auto& name : smoothing::shapeNames())
        shapes.push_back({name, ""});
    return dictionary::Dictionary::readFile(folder.dictionaryPath("system/mpmSchemes"))
        .choose("shape", "shape functions", shapes, "uGIMP");
}

Vector3 readSmoothingGravity(const CaseDirectory& folder)
{
    if (!folder.hasFile("constant/g"))
        return {0, 0, 0};
    return dictionary::Dictionary::readFile(folder.dictionaryPath("constant/g"))
        .get<Vector3>({"value", "gravity", dictionary::unit::acceleration});
}
} // namespace mpm::cases
