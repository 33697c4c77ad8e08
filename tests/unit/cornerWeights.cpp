// CPDI against what defines it: sums over pairs of particles and nodes, made from the corners of each domain; and what
// the definition must give: partition of unity, linear fields and their gradients, no change under rigid turns.
#include "transfer/cornerWeights.hpp"
#include "support/particleCloud.hpp"
#include "transfer/affine.hpp"

#include <Eigen/Dense>

using namespace mpm;

namespace
{
template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;
template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;

/// A chunk of parallelograms or parallelepipeds.
template <int dim>
struct Domains
{
    state::GridBox grid{dim, {-0.7, 0.4, 1.1}, 0.3, {12, 12, dim == 3 ? 12 : 1}, {}};
    state::NodeBox window{{1, 1, dim == 3 ? 1 : 0}, {10, 10, dim == 3 ? 10 : 1}};
    int count = 37;
    alignas(64) double x[dim][lanes], v[dim][lanes], mass[lanes], volume[lanes], stress[stressSize<dim>][lanes];
    alignas(64) double half[dim * dim][lanes]; ///< in cells
    transfer::ChunkWeights<dim, shape::CPDI> w;

    explicit Domains(double size)
    {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> place(4, 6), any(-1, 1);
        for (int l = 0; l < lanes; ++l)
        {
            for (int a = 0; a < dim; ++a)
            {
                x[a][l] = grid.origin[a] + grid.h * place(random);
                v[a][l] = any(random);
                for (int k = 0; k < dim; ++k)
                    half[a * dim + k][l] = size * ((a == k ? 1 : 0) + 0.4 * any(random));
            }
            for (auto& column : stress)
                column[l] = 1e4 * any(random);
            mass[l] = l < count ? 20 + any(random) : 0;
            volume[l] = l < count ? 0.02 + 0.01 * any(random) : 0;
        }
        w.evaluate(x, half, grid);
        REQUIRE(w.locate(window));
    }

    Vector<dim> centre(int l) const
    {
        Vector<dim> out;
        for (int a = 0; a < dim; ++a)
            out[a] = x[a][l];
        return out;
    }
    /// Columns e_k/2 [m].
    Matrix<dim> halfEdges(int l) const
    {
        Matrix<dim> out;
        for (int a = 0; a < dim; ++a)
            for (int k = 0; k < dim; ++k)
                out(a, k) = half[a * dim + k][l] * grid.h;
        return out;
    }
    Vector<dim> signs(int c) const
    {
        Vector<dim> s;
        for (int k = 0; k < dim; ++k)
            s[k] = (c >> k & 1) ? 1 : -1;
        return s;
    }
    Vector<dim> node(const test::LatticeNode& at) const
    {
        Vector<dim> out;
        for (int a = 0; a < dim; ++a)
            out[a] = grid.origin[a] + grid.h * double(at[a]);
        return out;
    }
    /// Hat function of a node.
    double hat(const test::LatticeNode& at, const Vector<dim>& p) const
    {
        double N = 1;
        for (int a = 0; a < dim; ++a)
            N *= std::max(0.0, 1 - std::abs(p[a] - node(at)[a]) / grid.h);
        return N;
    }
    double N(int l, const test::LatticeNode& at) const
    {
        double sum = 0;
        for (int c = 0; c < 1 << dim; ++c)
            sum += hat(at, centre(l) + halfEdges(l) * signs(c)) / (1 << dim);
        return sum;
    }
    /// Mean over the domain of the gradient of the field that is linear along its edges and has the hat's values at
    /// the corners: differences of opposite faces' means along each edge.
    Vector<dim> gradient(int l, const test::LatticeNode& at) const
    {
        Vector<dim> along = Vector<dim>::Zero(); // change of the field along each whole edge
        for (int c = 0; c < 1 << dim; ++c)
            for (int k = 0; k < dim; ++k)
                along[k] += signs(c)[k] * hat(at, centre(l) + halfEdges(l) * signs(c)) / (1 << (dim - 1));
        return (2 * halfEdges(l)).transpose().inverse() * along; // grad . e_k = along_k
    }
    template <class Body>
    void forNodes(Body&& body) const
    {
        Index at = 0;
        for (Index k = window.lo[2]; k < window.lo[2] + window.n[2]; ++k)
            for (Index j = window.lo[1]; j < window.lo[1] + window.n[1]; ++j)
                for (Index i = window.lo[0]; i < window.lo[0] + window.n[0]; ++i)
                    body(test::LatticeNode{i, j, k}, at++);
    }
};

const auto nothing = [] {};

template <int dim>
void checkProjection(const Domains<dim>& d)
{
    transfer::ParticleRecords<dim, transfer::Forces> records;
    records.build(d.mass, d.v, d.volume, d.stress);
    std::vector<Record> window(std::size_t(d.window.size()), Record{});
    projectChunk(d.w, records, d.count, window.data(), d.window, nothing);
    transfer::ParticleRecords<dim, transfer::Momentum> momenta;
    momenta.build(d.mass, d.v);
    std::vector<HalfRecord> half(window.size(), HalfRecord{});
    projectChunk(d.w, momenta, d.count, half.data(), d.window, nothing);
    double error = 0;
    d.forNodes([&](const test::LatticeNode& at, Index n) {
        double mass = 0;
        Vector<dim> p = Vector<dim>::Zero(), f = Vector<dim>::Zero();
        for (int l = 0; l < d.count; ++l)
        {
            const double N = d.N(l, at);
            const Vector<dim> G = d.gradient(l, at);
            mass += N * d.mass[l];
            for (int a = 0; a < dim; ++a)
            {
                p[a] += N * d.mass[l] * d.v[a][l];
                for (int b = 0; b < dim; ++b)
                    f[a] -= d.volume[l] * d.stress[test::component<dim>(a, b)][l] * G[b];
            }
        }
        const Record r = transfer::finishNode<dim>(window[std::size_t(n)]);
        error = std::max(error, std::abs(r[0] - mass) / 20);
        for (int a = 0; a < dim; ++a)
        {
            error = std::max(error, std::abs(r[1 + a] - p[a]) / 20);
            error = std::max(error, std::abs(half[std::size_t(n)][1 + a] - p[a]) / 20);
            error = std::max(error, std::abs(r[1 + dim + a] - f[a]) / 1e3);
        }
    });
    CHECK(error < 1e-13);
}

/// Gathers of a linear velocity field and of its acceleration are exact, and so is its gradient.
template <int dim>
void checkGathers(const Domains<dim>& d)
{
    Matrix<dim> A;
    Vector<dim> shift;
    for (int a = 0; a < dim; ++a)
    {
        shift[a] = 0.3 * a - 1;
        for (int b = 0; b < dim; ++b)
            A(a, b) = std::sin(1 + a + 3 * b);
    }
    AlignedVector<typename transfer::ValueNode<dim>::Type> values;
    values.resize(std::size_t(d.window.size()));
    AlignedVector<HalfRecord> gradients;
    gradients.resize(values.size());
    d.forNodes([&](const test::LatticeNode& at, Index n) {
        const Vector<dim> u = shift + A * d.node(at);
        Record r{};
        for (int a = 0; a < dim; ++a)
        {
            r[1 + a] = u[a];
            r[1 + dim + a] = -2 * u[a];
        }
        values[std::size_t(n)] = transfer::ValueNode<dim>::pack(r);
        gradients[std::size_t(n)] = transfer::GradientNode<dim, 1>::pack(r);
    });
    transfer::Values<dim> out;
    alignas(64) double L[dim * dim][lanes], C[dim * dim][lanes];
    gatherValues(d.w, values.data(), d.window, out, nothing);
    gatherGradient(d.w, gradients.data(), d.window, L, nothing);
    transfer::gatherAffine<dim>(d.w, gradients.data(), d.x, d.grid, d.count, d.window, C);
    for (int l = 0; l < d.count; ++l)
    {
        const Vector<dim> u = shift + A * d.centre(l);
        for (int a = 0; a < dim; ++a)
        {
            CHECK(out.v[a][l] == Approx(u[a]).margin(1e-13));
            CHECK(out.a[a][l] == Approx(-2 * u[a]).margin(1e-13));
            for (int b = 0; b < dim; ++b)
            {
                CHECK(L[a * dim + b][l] == Approx(A(a, b)).margin(1e-12));
                CHECK(C[a * dim + b][l] == Approx(A(a, b)).margin(1e-11)); // APIC's field is exact too
            }
        }
    }
}
} // namespace

TEST_CASE("projections and gathers of corners are sums over pairs of particles and nodes")
{
    for (const double size : {0.05, 0.25, 0.45})
    {
        CAPTURE(size);
        checkProjection(Domains<2>(size));
        checkProjection(Domains<3>(size));
        checkGathers(Domains<2>(size));
        checkGathers(Domains<3>(size));
    }
}

TEST_CASE("a rigid quarter turn of body and domain turns weights and gradients with them")
{
    // a square domain off the lattice, turned by 90 degrees about a node: the lattice looks the same from there
    Domains<2> a(0.2), b(0.2);
    const double cx = a.grid.origin[0] + 5 * a.grid.h, cy = a.grid.origin[1] + 5 * a.grid.h;
    for (int l = 0; l < lanes; ++l)
    {
        b.x[0][l] = cx - (a.x[1][l] - cy);
        b.x[1][l] = cy + (a.x[0][l] - cx);
        for (int k = 0; k < 2; ++k)
        {
            b.half[k][l] = -a.half[2 + k][l];
            b.half[2 + k][l] = a.half[k][l];
        }
    }
    a.w.evaluate(a.x, a.half, a.grid);
    b.w.evaluate(b.x, b.half, b.grid);
    for (int l = 0; l < a.count; ++l)
        for (int c = 0; c < 4; ++c)
        {
            CHECK(b.w.at.g[0][c][l] == Approx(-a.w.at.g[1][c][l]).margin(1e-11));
            CHECK(b.w.at.g[1][c][l] == Approx(a.w.at.g[0][c][l]).margin(1e-11));
        }
}

TEST_CASE("domains whose corners would leave the support are scaled about their centre and counted")
{
    Domains<2> d(0.25);
    for (int k = 0; k < 4; ++k)
        d.half[k][3] *= 20;
    const double ratio = d.half[0][3] / d.half[1][3];
    CHECK(shape::CPDI::holdWithin<2>(d.half, d.count) == 1);
    CHECK(d.half[0][3] / d.half[1][3] == Approx(ratio));
    const double reach =
        std::max(std::abs(d.half[0][3]) + std::abs(d.half[1][3]), std::abs(d.half[2][3]) + std::abs(d.half[3][3]));
    CHECK(reach <= 1);
    CHECK(reach == Approx(1).epsilon(1e-11));
    d.w.evaluate(d.x, d.half, d.grid);
    CHECK(d.w.locate(d.window));
}
