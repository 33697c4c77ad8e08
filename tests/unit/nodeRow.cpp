// The equations of a node, and what they book, against loops over components.
#include "nodal/nodeRow.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace mpm;

namespace
{
constexpr double dt = 0.02, smallestMass = 1e-6;
const Vector3 gravity{0.3, -9.8, 1.7};
constexpr Index first = -2, nodes = 11;

/// Masses, momenta and forces; every fourth node is too light to move.
std::vector<Record> projections(int dim, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<Record> out(nodes, Record{});
    for (Index i = 0; i < nodes; ++i)
    {
        auto& r = out[std::size_t(i)];
        r[0] = i % 4 == 3 ? (i == 3 ? 0 : 0.5 * smallestMass) : 1.5 + any(random);
        for (int a = 0; a < 2 * dim; ++a)
            r[1 + a] = r[0] == 0 ? 0 : (r[0] < smallestMass ? 1e-7 : 1) * any(random);
        r[7] = 7;
    }
    return out;
}

template <int dim>
struct Row : nodal::NodeRow<dim>
{
    explicit Row(const std::vector<Record>& from) : records(from)
    {
        this->begin = first;
        this->end = first + nodes;
        this->node = records.data() - first;
        this->dt = ::dt;
        this->smallestMass = ::smallestMass;
        this->sums = &booked;
        this->walls = &touched;
        this->projected = &before;
    }
    Row(const Row&) = delete;

    std::vector<Record> records, before;
    nodal::NodeSums booked;
    typename nodal::NodeRow<dim>::WallScratch touched;
};

template <int dim>
void checkEquations()
{
    CAPTURE(dim);
    const auto given = projections(dim, 5);
    const nodal::NodeEquations<dim> equations(dt, smallestMass, gravity);
    Row<dim> free(std::vector<Record>(nodes, Record{})), row(given);
    nodal::solveFreeRow(free, equations, [&](Index i) { return given[std::size_t(i - first)]; });
    nodal::beginRow(row, equations);
    nodal::NodeSums want;
    for (std::size_t i = 0; i < std::size_t(nodes); ++i)
    {
        const Record &r = given[i], &u = row.records[i];
        const bool carries = r[0] > smallestMass;
        for (int a = 0; a < dim; ++a)
        {
            const double v = carries ? r[1 + a] / r[0] : 0, f = r[1 + dim + a];
            const double trial = carries ? v + dt * (f / r[0] + gravity[std::size_t(a)]) : 0;
            CHECK(u[1 + a] == Approx(v).epsilon(1e-14));
            CHECK(u[1 + dim + a] == Approx(trial).epsilon(1e-14));
            want.kineticBefore += 0.5 * r[0] * v * v;
            want.kineticAfter += 0.5 * r[0] * trial * trial;
            want.forceWorkBefore += dt * f * v;
            want.forceWork += dt * f * trial;
            want.gravityWork += 0.5 * dt * r[0] * gravity[std::size_t(a)] * (v + trial);
            want.gravityImpulse[std::size_t(a)] += carries ? dt * r[0] * gravity[std::size_t(a)] : 0;
        }
        CHECK(u[0] == r[0]);
        CHECK(u[7] == r[7]);
        if (carries)
            want.lightest = std::min(want.lightest, double(r[0]));
    }
    nodal::endRow(row, equations);
    for (std::size_t i = 0; i < std::size_t(nodes); ++i)
    {
        const Record &r = given[i], &end = row.records[i];
        const bool carries = r[0] > smallestMass;
        for (int a = 0; a < dim; ++a)
        {
            const double v = carries ? r[1 + a] / r[0] : 0;
            const double rate = carries ? r[1 + dim + a] / r[0] + gravity[std::size_t(a)] : 0;
            CHECK(end[1 + a] == Approx(v + dt * rate).epsilon(1e-14));
            CHECK(end[1 + dim + a] == Approx(rate).epsilon(1e-12));
        }
        for (int l = 0; l < 8; ++l)
            CHECK(free.records[i][l] == end[l]); // in one go: the same bits
    }
    for (nodal::NodeSums* sums : {&row.booked, &free.booked})
    {
        sums->gather<dim>();
        CHECK(sums->kineticBefore == Approx(want.kineticBefore).epsilon(1e-13));
        CHECK(sums->kineticAfter == Approx(want.kineticAfter).epsilon(1e-13));
        CHECK(sums->forceWorkBefore == Approx(want.forceWorkBefore).epsilon(1e-12));
        CHECK(sums->forceWork == Approx(want.forceWork).epsilon(1e-12));
        CHECK(sums->gravityWork == Approx(want.gravityWork).epsilon(1e-12));
        for (std::size_t a = 0; a < 3; ++a) // but for the mass of nodes that are too light
            CHECK(sums->gravityImpulse[a] == Approx(want.gravityImpulse[a]).epsilon(1e-6));
        CHECK(sums->lightest == want.lightest);
        const nodal::NodeSums once = *sums;
        sums->gather<dim>();
        CHECK(sums->kineticAfter == once.kineticAfter); // nothing is added twice
    }
    for (std::size_t a = 0; a < 3; ++a)
        CHECK(row.booked.gravityImpulse[a] == free.booked.gravityImpulse[a]);
    CHECK(row.booked.kineticAfter == free.booked.kineticAfter);
    CHECK(row.booked.forceWork == free.booked.forceWork);
}

template <int dim>
void checkStrainVelocity()
{
    CAPTURE(dim);
    const auto given = projections(dim, 6);
    Row<dim> row(given);
    for (Index i = row.begin; i < row.end; ++i)
        nodal::setStrainVelocity(row, i, HalfRecord{9, 1, 2, 3});
    for (std::size_t i = 0; i < std::size_t(nodes); ++i)
        for (int l = 0; l < 8; ++l)
        {
            const bool changed = l > dim && l <= 2 * dim;
            const double w = given[i][0] > smallestMass ? (l - dim) / double(given[i][0]) : 0;
            CHECK(row.records[i][l] == Approx(changed ? w : double(given[i][l])).epsilon(1e-14));
        }
    Row<dim> swapped(given);
    nodal::swapTrial(swapped);
    for (std::size_t i = 0; i < std::size_t(nodes); ++i)
        for (int a = 0; a < dim; ++a)
        {
            CHECK(swapped.records[i][1 + a] == given[i][1 + dim + a]);
            CHECK(swapped.records[i][1 + dim + a] == given[i][1 + a]);
        }
}
} // namespace

TEST_CASE("a row is solved and booked node by node, the same whether in one go or in two halves")
{
    checkEquations<2>();
    checkEquations<3>();
}

TEST_CASE("velocities of a second projection stand where accelerations did")
{
    checkStrainVelocity<2>();
    checkStrainVelocity<3>();
}
