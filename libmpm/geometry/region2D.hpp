#pragma once
/// A 2D region: closed polygons, any number of islands and holes. The only place where CGAL's 2D algorithms are used.
///
/// Loops may run either way: a loop inside an odd number of others is a hole (even-odd rule); afterwards islands run
/// counter-clockwise and holes clockwise, so that the region lies to the left of every edge.
/// Errors (InputError, with the region's name and the place): fewer than three corners, an edge of no length, edges
/// that cross, overlap or touch inside an edge, loops that cross at a common corner. Loops may share single corners.
#include "geometry/region.hpp"

#include <algorithm>

namespace mpm::geometry
{
class Region2D : public Region
{
  public:
    using Loop = std::vector<Vector3>; ///< corners in order, z ignored; the last is joined to the first

    Region2D(std::string name, std::vector<Loop> loops);

    bool contains(const Vector3& p) const override;
    const std::vector<Vector3>& vertices() const override { return vertices_; }
    void forEachRow(const BoxTiling& tiling, const Row& visit) const override;

    std::size_t loops() const { return loops_.size(); }
    const Loop& loop(std::size_t i) const { return loops_[i]; }
    bool reversed(std::size_t i) const { return reversed_[i]; } ///< against the loop as given
    bool island(std::size_t i) const { return island_[i]; }     ///< else a hole
    std::size_t islands() const { return std::size_t(std::count(island_.begin(), island_.end(), true)); }
    std::size_t largest() const { return largest_; } ///< the loop around the largest area

  private:
    struct Edge
    {
        Vector3 from, to;
        double low() const { return std::min(from[1], to[1]); }
        double high() const { return std::max(from[1], to[1]); }
    };

    void checkLoops() const;
    std::vector<std::pair<std::size_t, std::size_t>> checkCrossings() const;
    void orient();
    void measure();
    std::size_t depthOf(const Vector3& p, std::size_t loop, bool& onOther) const;
    static bool inside(const Vector3& p, const std::vector<const Edge*>& edges);

    std::vector<Loop> loops_;
    std::vector<bool> reversed_;
    std::vector<bool> island_;
    std::size_t largest_ = 0;
    std::vector<Vector3> vertices_;
    std::vector<Edge> edges_; ///< by ascending lower end
};

/// Area common to two regions, exactly constructed and then rounded; `place` is a corner of it.
double overlap(const Region2D& a, const Region2D& b, Vector3& place);
} // namespace mpm::geometry
