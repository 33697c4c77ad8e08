#pragma once
/// The outline of many small boxes: what a ball of radius alpha that comes from outside cannot enter.
///
/// The boxes are particle domains, parallelograms (2D) or parallelepipeds (3D). Gaps narrower than about two alpha are
/// closed, so that domains that shear past each other leave no cracks.
///
///     3D   CGAL::alpha_wrap_3 around the sides of the boxes: closed, without self-intersections, around every box.
///          All its points lie `offset` outside the boxes. Cavities that cannot be reached from outside are filled.
///          (C. Portaneri, M. Rouxel-Labbe, M. Hemmer, D. Cohen-Steiner & P. Alliez 2022, Alpha wrapping with an
///          offset, ACM Trans. Graph. 41(4), 127.)
///     2D   the same idea carved out of a Delaunay triangulation of points on the boxes, at most alpha apart: a disc of
///          radius alpha passes an edge longer than two alpha, and hollow places it fits into are holes. The points lie
///          on the boxes: no offset. (H. Edelsbrunner, D. G. Kirkpatrick & R. Seidel 1983, On the shape of a set of
///          points in the plane, IEEE Trans. Inf. Theory 29(4), 551-559.)
///
/// Interface for deformedSurface.hpp, which knows what to make of it. Only alphaWrap[23]D.cpp use CGAL here.
#include "geometry/simplex.hpp"

namespace mpm::geometry
{
/// A deformed particle: all x with x = centre + sum s_k edges[k], |s_k| <= 1/2.
struct ParticleDomain
{
    Vector3 centre{};
    std::array<Vector3, 3> edges{}; ///< two in 2D [m]
    double volume = 0;              ///< that is to be found inside [m^3], m^2 in 2D
};

struct Wrap
{
    std::vector<Vector3> points;
    std::vector<Vector3> outward;  ///< of each point: where it goes when the surface moves out by 1
    std::vector<Simplex> elements; ///< facing outward as in coupling/surfaceMesh.hpp: (e_y, -e_x), cross(e1, e2)
    std::vector<int> piece;        ///< of each element, from 0
    int pieces = 0;                ///< that do not hang together
};

Wrap alphaWrap2D(const std::vector<ParticleDomain>& domains, double alpha);
Wrap alphaWrap3D(const std::vector<ParticleDomain>& domains, double alpha, double offset);
} // namespace mpm::geometry
