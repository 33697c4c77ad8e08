#pragma once
/// The closed surface of a rigid body: a polygon of segments in 2D, triangles in 3D, outward normals (e_y, -e_x) and
/// cross(e1, e2), and how far a point is from it.
///
/// The distance is negative inside; its sign is that of the product with the normal of the nearest segment, triangle,
/// edge or corner, those of edges and corners weighted by angle, which makes it exact for any closed surface
/// (J. A. Baerentzen & H. Aanaes 2005, IEEE Trans. Vis. Comput. Graph. 11, 243-253). The nearest point of a triangle
/// as in C. Ericson, Real-Time Collision Detection (2005), 5.1.5, found through a tree of boxes.
///
/// Errors (InputError at `where`, what and where in space): fewer than three points, an element of no size, a surface
/// that is open, an edge of more than two triangles, triangles that face the other way than their neighbours, elements
/// that cut each other. A surface that is inside out as a whole is turned. Verified in tests/unit/rigidSurface.cpp.
#include "base/error.hpp"
#include "base/types.hpp"

#include <vector>

namespace mpm::nodal
{
class RigidSurface
{
  public:
    using Element = std::array<Index, 3>; ///< points of a triangle; in 2D of a segment, the third unused
    struct Nearest
    {
        double distance = 0; ///< negative inside
        Vector3 point{};
        Vector3 normal{};                ///< unit, outward: where the way out is shortest
        Index element = 0;               ///< the point lies on it
        std::array<double, 3> weights{}; ///< of the element's points there; they add up to 1
    };

    /// Points closer than 1e-9 of the size are one (triangles of an STL file name theirs one by one).
    RigidSurface(int dim, std::vector<Vector3> points, std::vector<Element> elements, const Location& where);
    /// A polygon; its last point is joined to its first.
    static RigidSurface polygon(const std::vector<Vector3>& corners, const Location& where);
    /// The 12 triangles of a box, outward: corner n lies high along axis a where bit a of n is set, low elsewhere.
    static const std::vector<Element>& boxTriangles();

    Nearest nearest(const Vector3& x) const;
    /// The same elements with their points elsewhere. False if they hold no volume any more, or are not finite.
    bool deform(const std::vector<Vector3>& points);

    /// How deep points half of h below its elements lie, at most: less than that where the body is thin.
    double depth(double h) const;

    int dim() const { return dim_; }
    const std::vector<Vector3>& points() const { return points_; }
    const std::vector<Element>& elements() const { return elements_; }
    const Vector3& low() const { return low_; }
    const Vector3& high() const { return high_; }
    double volume() const { return volume_; } ///< area in 2D
    const Vector3& centroid() const { return centroid_; }

  private:
    struct Box
    {
        Vector3 low, high;
        Index first = 0, count = 0; ///< elements of a leaf, in the order of `order_`
        Index left = -1, right = -1;
    };
    struct Foot
    {
        Vector3 point{};
        int feature = 0; ///< 0: inside the element; 1..3: edge from corner k - 1; 4..6: corner k - 4
        std::array<double, 3> weights{};
    };
    void weld();
    void orient(const Location& where);
    void closed2D(const Location& where) const;
    void closed3D(const Location& where) const;
    void measure();
    void makeNormals();
    Index makeBox(Index first, Index count);
    void fitLeaf(Box& box) const;
    void refuseCuts(const Location& where) const;
    bool cut(Index e, Index f) const;
    Foot foot(Index e, const Vector3& x) const;
    Vector3 centre(Index e) const;

    int dim_;
    std::vector<Vector3> points_;
    std::vector<Element> elements_;
    std::vector<Vector3> normals_;                    ///< of elements, unit
    std::vector<std::array<Vector3, 3>> edgeNormals_; ///< 3D: of the edge from corner k
    std::vector<Vector3> cornerNormals_;
    std::vector<Box> boxes_;
    std::vector<Index> order_;
    Vector3 low_{}, high_{}, centroid_{};
    double volume_ = 0;
};
} // namespace mpm::nodal
