#pragma once
/// A region: the inside of closed polygons (2D) or closed triangle surfaces (3D), and its share of the boxes of a
/// tiling.
///
/// The share of a box is found by the divergence theorem in the form
///     V = sum over surface pieces of the integral of (clamp(x, x0, x1) - x0) n_x dA,   y and z inside the box,
/// (clamping the surface to the box keeps the enclosed part of the box), likewise for first moments. In real arithmetic
/// this is exact for any closed surface, so that only round-off remains, and no new surface has to be built.
/// CGAL's exact predicates decide whether a run of uncut boxes is inside; the integral must agree with it.
#include "geometry/boxTiling.hpp"

#include <functional>
#include <string>
#include <vector>

namespace mpm::geometry
{
/// The part of one box inside a region. Volumes are areas in 2D.
struct BoxPart
{
    Index box = 0;        ///< index of the box in its row
    double volume = 0;    ///< [m^3], m^2 in 2D
    double boxVolume = 0; ///< of the whole box
    Vector3 centroid{};   ///< of the part [m]
    Vector3 extent{};     ///< lengths of the part's bounding box [m]
    bool whole = false;   ///< the box is inside
    /// Area the part has in common with the faces x0, x1, y0, y1, z0, z1 of its box.
    std::array<double, 6> contact{};
};

class Region
{
  public:
    explicit Region(std::string name, int dim) : name_(std::move(name)), dim_(dim) {}
    virtual ~Region() = default;
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;

    const std::string& name() const { return name_; }
    int dim() const { return dim_; }
    double volume() const { return volume_; } ///< [m^3], m^2 in 2D
    const Vector3& centroid() const { return centroid_; }
    const Vector3& lower() const { return lower_; } ///< corners of the bounding box [m]
    const Vector3& upper() const { return upper_; }

    /// Is the point inside or on the surface? Decided exactly.
    virtual bool contains(const Vector3& p) const = 0;

    /// All vertices of the surface [m].
    virtual const std::vector<Vector3>& vertices() const = 0;

    using Row = std::function<void(Index row, Index layer, const std::vector<BoxPart>& parts)>;
    /// Calls visit for every row that touches the region, in ascending order of (layer, row), with the boxes' parts
    /// that are not empty, in ascending order. What lies outside the tiling is not seen. Linear in surface + boxes.
    virtual void forEachRow(const BoxTiling& tiling, const Row& visit) const = 0;

  protected:
    std::string name_;
    int dim_;
    double volume_ = 0;
    Vector3 centroid_{}, lower_{}, upper_{};
};

/// The part of one box; its volume is 0 if there is none.
BoxPart boxPart(const Region& region, const Vector3& lower, const Vector3& upper);

/// "(x y)" or "(x y z)" for messages.
std::string placeText(const Vector3& p, int dim);
} // namespace mpm::geometry
