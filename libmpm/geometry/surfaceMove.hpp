#pragma once
/// Moving a closed surface in until it encloses a volume, without letting it cut itself.
#include "geometry/alphaWrap.hpp"

namespace mpm::geometry
{
/// What elements that face outward enclose [m^3], m^2 in 2D; `origin` does not matter for closed surfaces.
double enclosedVolume(const std::vector<Vector3>& points, const std::vector<Simplex>& elements);
double enclosedVolume(const std::vector<Vector3>& points, const Simplex& element, const Vector3& origin);
/// Its area, or length in 2D.
double surfaceArea(const std::vector<Vector3>& points, const std::vector<Simplex>& elements);

/// The points of a wrap on their way in: all by one length, each by its share of it, which is 1 until it is held back.
class SurfaceMove
{
  public:
    explicit SurfaceMove(const Wrap& wrap) : wrap_(wrap), share_(wrap.points.size(), 1.0) {}

    std::vector<Vector3> by(double way) const;
    /// The way that leaves `volume` enclosed; between -furthest and furthest.
    double wayTo(double volume, double furthest) const;
    /// Points of these elements, or of those next to them too, go less far: half as far, after a few times nowhere.
    void holdBack(const std::vector<std::size_t>& elements, bool neighbours);
    std::size_t heldBack() const;

  private:
    const Wrap& wrap_;
    std::vector<double> share_;
};

/// Elements, by index, that cut others (3D: exactly, region3D.hpp; 2D: in floating point).
std::vector<std::size_t> cuttingElements(const std::vector<Vector3>& points, const std::vector<Simplex>& elements,
                                         int dim);
} // namespace mpm::geometry
