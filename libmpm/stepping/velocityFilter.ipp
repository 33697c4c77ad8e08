// The velocity filter of XPIC and FMPM. What particles do that no grid sees, the null space of the projection, stays in
// the velocities of FLIP for ever. With S the interpolation to particles and S+ the projection, v_i = S+ v_p,
//     v^(k) = sum_{r=1..k} (-1)^(r+1) binomial(k, r) (S+ S)^(r-1) v_i
// and S v^(k) = (1 - (1 - S S+)^k) v_p: k = 1 is PIC, k -> infinity FLIP without the null space.
//     XPIC   v_p = S (v^(k) + dt a)            (Hammerquist & Nairn 2017, doi 10.1016/j.cma.2017.01.035)
//     FMPM   v_p = S v*^(k), v* after forces   (Nairn & Hammerquist 2021, doi 10.1016/j.cma.2021.113667)
// The second is the k-th approximation of the inverse of the full mass matrix, applied to p + dt f. Walls hold the
// filtered velocity where they hold v*. Particles move, and are strained in USL, with the filtered velocity.
//
//     transfer   XPIC;      // mpmSchemes; or FMPM
//     order      2;         // k >= 1
//     filterRate 5;         // [1/s] absent: in full every step. v_p of FLIP, <- (1 - a) v_p + a v_p(filtered),
//     filterInterval 10;    // a = 1 - exp(-rate n dt) every n steps: as strong whatever the step is; particles move
//     with v*
//
// Cost: k - 1 rounds of a gather and a projection a step. Verified in tests/unit/transferSchemes.cpp.
#pragma once
#include "base/clock.hpp"
#include "stepping/explicitStepper.hpp"

namespace mpm::stepping
{
/// Leaves the filtered velocity in lanes 1.. of the nodes' filter layer. Meanwhile lanes 1.. hold (S+ S)^(r-1) v_i and
/// lanes 1 + dim.. the sum.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::filterVelocities()
{
    if (!filters())
        return;
    grid_.openLayer();
    const int order = scene_.transferOrder;
    const bool xpic = scene_.transfer == Transfer::XPIC;
    const double back = xpic ? kick_ : 0; // v_i = v* - dt a
    const double share =
        scene_.filterRate ? -std::expm1(-*scene_.filterRate * double(scene_.filterInterval) * kick_) : 1;
    double factor = order;
    filterRow([&](nodal::NodeRow<dim>& row, const state::Block&, Record* out) {
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
            {
                const double v = row.node[i][1 + a] - back * row.node[i][1 + dim + a];
                out[i][1 + a] = v;
                out[i][1 + dim + a] = factor * v;
            }
    });
    for (int r = 2; r <= order; ++r)
    {
        factor *= -double(order - r + 1) / r;
        particlePass(0, {.filter = true});
        filterRow([&](nodal::NodeRow<dim>& row, const state::Block& block, Record* out) {
            HalfRecord sum[1 << state::TileLayout::bitsOf(dim)] = {};
            sumWindows(row, block, sum);
            for (Index i = row.begin; i < row.end; ++i)
            {
                const double inverse = row.carries(i) ? 1 / row.node[i][0] : 0;
                for (int a = 0; a < dim; ++a)
                {
                    const double v = inverse * sum[i - row.begin][1 + a];
                    out[i][1 + a] = v;
                    out[i][1 + dim + a] += factor * v;
                }
            }
        });
    }
    const auto complete = [&](nodal::NodeRow<dim>& row, const state::Block&, Record* out) {
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
            {
                out[i][1 + dim + a] += back * row.node[i][1 + dim + a];
                out[i][1 + a] = row.node[i][1 + a]; // v*, which says what walls and contact hold
            }
    };
    if (contact_)
    {
        filterRow([&](nodal::NodeRow<dim>& row, const state::Block& block, Record* out) {
            complete(row, block, out);
            for (Index i = row.begin; i < row.end; ++i)
                out[i][0] = row.node[i][0];
            if (!prescribed(row.body))
                return;
            nodal::NodeRow<dim> held = row;
            held.node = out;
            contact_->followDrive(held);
        });
        contact_->follow(grid_, filterLayer);
    }
    filterRow([&](nodal::NodeRow<dim>& row, const state::Block& block, Record* out) {
        if (!contact_)
            complete(row, block, out);
        // What walls take from the filtered velocity is an impulse too, of the share that is mixed in: sum m_p v_p =
        // sum m_i times what is left here.
        const auto book = [&](double sign) {
            sign *= share;
            for (Index i = row.begin; i < row.end; ++i)
                for (int a = 0; a < dim; ++a)
                    row.sums->wallImpulse[a] += sign * row.node[i][0] * out[i][1 + dim + a];
        };
        book(-1);
        nodal::NodeRow<dim> held = row;
        held.node = out;
        for (const auto& wall : walls_)
            if (!prescribed(row.body))
                wall.follow(held);
        for (const auto& body : bodies_)
            if (!prescribed(row.body))
                body.follow(held);
        book(1);
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
                out[i][1 + a] = out[i][1 + dim + a];
    });
    for (const auto& block : blockSums_)
        for (int a = 0; a < dim; ++a)
            state_.ledger.wallImpulse[a] += block.wallImpulse[a];
}

/// change(row, block, filter) for all rows; filter[i] is node i's record in the filter layer.
template <int dim, class Shape>
template <class Change>
void ExplicitStepper<dim, Shape>::filterRow(Change&& change)
{
    Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row, const state::Block& block) {
        change(row, block, grid_.nodes(block, filterLayer) + (row.node - grid_.nodes(block)));
    });
}
} // namespace mpm::stepping
