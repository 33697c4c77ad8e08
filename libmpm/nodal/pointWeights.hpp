#pragma once
/// Nodes around a point of a surface that moves with the soil, and what they count there: for tractions on patches
/// (nodal/traction.hpp) and for surfaces that are carried (nodal/carriedSurface.hpp).
#include "state/gridBox.hpp"
#include "state/tileGrid.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
/// What a node carries of a load, or tells of a patch's motion. A surface that lies delta beyond a line of nodes, in
/// cells, gives these nodes a mass of delta^2/2, a hat of delta and so velocities of 1/delta: particles do not feel
/// them (their weights are delta^2), but a patch that followed them would be torn apart. So light nodes do not move it,
/// and take no more of the load than the delta that their mass stands for.
enum class Use
{
    load,
    motion
};

/// Hat functions of the 2^dim nodes around a point, renormalised over nodes with mass.
template <int dim>
struct PointWeights
{
    static constexpr int count = 1 << dim;
    const Record* node[count]; ///< null where no mass is
    double N[count];
    double G[count][dim];

    bool found; ///< is there a node with mass?

    PointWeights(const Vector3& x, const state::GridBox& grid, const state::TileGrid& nodes, int body,
                 double smallestMass, Use use)
    {
        Index base[3] = {0, 0, 0};
        double t[3] = {0, 0, 0};
        for (int a = 0; a < dim; ++a)
        {
            const double s = (x[std::size_t(a)] - grid.origin[a]) / grid.h;
            base[a] = Index(std::floor(s));
            t[a] = s - std::floor(s);
        }
        double total = 0, slope[dim] = {}, heaviest = 0;
        for (int c = 0; c < count; ++c)
        {
            Index index[3] = {base[0], base[1], base[2]};
            N[c] = 1;
            for (int a = 0; a < dim; ++a)
            {
                const bool up = c >> a & 1;
                index[a] += up;
                N[c] *= up ? t[a] : 1 - t[a];
                G[c][a] = (up ? 1 : -1) / grid.h;
                for (int b = 0; b < dim; ++b)
                    if (b != a)
                        G[c][a] *= (c >> b & 1) ? t[b] : 1 - t[b];
            }
            node[c] = nodes.find(index[0], index[1], index[2], body);
            if (!node[c] || !((*node[c])[0] > smallestMass))
            {
                node[c] = nullptr;
                continue;
            }
            heaviest = std::max(heaviest, (*node[c])[0]);
        }
        for (int c = 0; c < count; ++c)
        {
            if (!node[c])
                continue;
            const double mass = (*node[c])[0];
            if (use == Use::motion && mass < 0.01 * heaviest)
            {
                node[c] = nullptr;
                continue;
            }
            if (use == Use::load)
                N[c] = std::min(N[c], 2 * std::sqrt(mass / heaviest));
            total += N[c];
            for (int a = 0; a < dim; ++a)
                slope[a] += G[c][a];
        }
        found = total > 0;
        if (!found)
            return;
        for (int c = 0; c < count; ++c)
        {
            for (int a = 0; a < dim; ++a)
                G[c][a] = (G[c][a] - N[c] * slope[a] / total) / total;
            N[c] /= total;
        }
    }
};
} // namespace mpm::nodal
