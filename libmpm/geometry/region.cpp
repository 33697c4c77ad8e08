#include "geometry/region.hpp"

#include <fmt/format.h>

namespace mpm::geometry
{
namespace
{
class OneBox : public BoxTiling
{
  public:
    OneBox(const Vector3& lower, const Vector3& upper) : lower_(lower), upper_(upper) {}
    std::vector<double> zPlanes() const override { return {lower_[2], upper_[2]}; }
    std::vector<double> yPlanes(Index) const override { return {lower_[1], upper_[1]}; }
    void xPlanes(Index, Index, std::vector<double>& planes) const override { planes = {lower_[0], upper_[0]}; }

  private:
    Vector3 lower_, upper_;
};
} // namespace

BoxPart boxPart(const Region& region, const Vector3& lower, const Vector3& upper)
{
    BoxPart found;
    region.forEachRow(OneBox(lower, upper), [&](Index, Index, const std::vector<BoxPart>& parts) {
        for (const BoxPart& part : parts)
            found = part;
    });
    return found;
}

std::string placeText(const Vector3& p, int dim)
{
    return dim == 2 ? fmt::format("({:.9g} {:.9g})", p[0], p[1])
                    : fmt::format("({:.9g} {:.9g} {:.9g})", p[0], p[1], p[2]);
}
} // namespace mpm::geometry
