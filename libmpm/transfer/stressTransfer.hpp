#pragma once
/// Particle stresses to nodes and back (Eqs. 11 and 12): sigma_i = sum m_p sigma_p N_ip / m_i, S sigma_p = sum N_ip
/// sigma_i. A record holds mass and mass times stress, 5 numbers in 2D and 7 in 3D. Verified in
/// tests/unit/stressRelaxation.cpp against smoothing/smoothStress.hpp.
#include "transfer/cornerWeights.hpp"

namespace mpm::transfer
{
struct Stresses ///< mass and mass times stress
{
    using Node = Record;
};

template <int dim>
struct ParticleRecords<dim, Stresses>
{
    Record r[lanes];

    void build(const double (&mass)[lanes], const double (&stress)[stressSize<dim>][lanes])
    {
        for (int g = 0; g < lanes; g += 8)
        {
            const Record m = load(mass + g);
            Record t[8] = {m};
            for (int k = 0; k < stressSize<dim>; ++k)
                t[1 + k] = m * load(stress[k] + g);
            transpose(t);
            for (int l = 0; l < 8; ++l)
                r[g + l] = t[l];
        }
    }
};

/// A summed record -> stress in the first lanes; nothing below `smallestMass`.
inline Record nodalStress(const Record& sum, double smallestMass)
{
    const double inverse = sum[0] > smallestMass ? 1 / sum[0] : 0;
    return splat<Record>(inverse) * shuffle<1, 2, 3, 4, 5, 6, 7, 7>(sum, sum);
}

/// sum N_ip of the first lanes of node records, row after row.
template <int dim, class Shape>
Record gatherRecord(const ChunkWeights<dim, Shape>& w, int l, const Record* window, const state::NodeBox& box)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0], nxy = nx * box.n[1];
    const Record* layer = opaque(window + w.offset[l]);
    Record x[n], sum{};
    MPM_UNROLL
    for (int i = 0; i < n; ++i)
        x[i] = splat<Record>(w.axis[0].N[i][l]);
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    {
        const Record* row = layer;
        Record inLayer{};
        MPM_UNROLL
        for (int j = 0; j < n; ++j)
        {
            Record along{};
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                along += x[i] * row[i];
            inLayer += splat<Record>(w.axis[1].N[j][l]) * along;
            row += nx;
        }
        if constexpr (dim == 3)
            sum += splat<Record>(w.axis[2].N[k][l]) * inLayer;
        else
            sum = inLayer;
        layer = opaque(layer + nxy);
    }
    return sum;
}

template <int dim>
Record shareOfCorner(const ParticleRecords<dim, Stresses>& p, const ChunkWeights<dim, shape::CPDI>&, int, int l)
{
    return splat<Record>(dim == 2 ? 0.25 : 0.125) * p.r[l];
}

template <int dim>
Record gatherRecord(const ChunkWeights<dim, shape::CPDI>& w, int l, const Record* window, const state::NodeBox& box)
{
    Record sum{};
    for (int c = 0; c < 1 << dim; ++c)
        aroundCorner<dim>(w, c, l, box, [&](Index at, double N) { sum += splat<Record>(N) * window[at]; });
    return splat<Record>(dim == 2 ? 0.25 : 0.125) * sum;
}

template <int dim, class Weights, class Meanwhile>
void gatherStress(const Weights& w, const Record* window, const state::NodeBox& box,
                  double (&stress)[stressSize<dim>][lanes], Meanwhile&& meanwhile)
{
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        Record value[8];
        for (int l = 0; l < 8; ++l)
            value[l] = gatherRecord(w, g + l, window, box);
        transpose(value);
        for (int k = 0; k < stressSize<dim>; ++k)
            store(stress[k] + g, value[k]);
    }
}
} // namespace mpm::transfer
