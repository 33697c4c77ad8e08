#pragma once
/// Integrals of a closed surface over the boxes of one row, piece by piece (equation in region.hpp).
///
/// Pieces are parts of the surface inside the row's y and z range, of any x: a segment in 2D (the region to its left),
/// a convex polygon in 3D (counter-clockwise seen from outside). A piece gives its box the integral of (x - x0) dA, and
/// every box at smaller x in the row the full length of that box times dA; the latter is summed once, from the far end.
#include "geometry/region.hpp"

namespace mpm::geometry
{
/// y and z range of a row; in 2D z0 = 0, z1 = 1.
struct RowRange
{
    double y0 = 0, y1 = 0, z0 = 0, z1 = 1;
};

class RowIntegral
{
  public:
    explicit RowIntegral(int dim) : dim_(dim) {}

    void start(const std::vector<double>& xPlanes, const RowRange& range);
    bool empty() const { return first_ > last_; }

    void addSegment(const Vector3& a, const Vector3& b);
    void addPolygon(const std::vector<Vector3>& polygon);

    /// The parts that are not empty. inside(p) decides exactly where p lies; it is asked once for every run of boxes
    /// the surface does not touch. False if the integral contradicts it or is not 0 or 1 there: bad(p) is then the
    /// place.
    bool finish(const std::function<bool(const Vector3&)>& inside, std::vector<BoxPart>& parts, Vector3& bad);

  private:
    struct Sums
    {
        bool touched = false;
        double volume = 0;               ///< integral of (x - x0) dA over the box's own pieces
        double mx = 0, my = 0, mz = 0;   ///< first moments, relative to the box's corner
        double area = 0, ay = 0, az = 0; ///< dA and its moments, relative to (y0, z0)
        std::array<double, 4> contact{}; ///< at y0, y1, z0, z1: own pieces
        std::array<double, 4> beyond{};  ///< what pieces at larger x add per length
        Vector3 lower{}, upper{};

        void addBeyond(const Sums& own); ///< what boxes at smaller x see of it
    };

    Index boxOf(double x) const;
    Sums& touch(Index box);
    void addToBox(Index box, const Vector3& a, const Vector3& b);
    void addToBox(Index box, const std::vector<Vector3>& polygon);
    void addFan(Sums& sums, const Vector3& a, const Vector3& b, const Vector3& c) const;
    BoxPart wholePart(Index box) const;
    BoxPart cutPart(Index box, const Sums& own, const Sums& above) const;

    int dim_;
    RowRange range_;
    const std::vector<double>* planes_ = nullptr;
    std::vector<Sums> sums_;
    Index first_ = 0, last_ = -1;
    std::vector<Vector3> rest_, piece_, next_;
};

/// The part of a convex polygon at coordinate[axis] <= plane (keepBelow) or >= plane; cut points lie on it exactly.
void clipPolygon(const std::vector<Vector3>& polygon, int axis, double plane, bool keepBelow,
                 std::vector<Vector3>& out);
} // namespace mpm::geometry
