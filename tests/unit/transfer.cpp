// Transfer between particles and nodes, chunk by chunk, against plain sums over pairs of a particle and a node, whose
// weights are looked up axis by axis; conservation, linear fields, and projection as the adjoint of interpolation.
#include "support/particleCloud.hpp"
#include "transfer/affine.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/particleToGrid.hpp"

#include <cmath>
#include <cstring>
#include <limits>

using namespace mpm;
using test::Cloud, test::component, test::forShapes, test::LatticeNode;

namespace
{
/// (m, p, f) of a node.
template <int dim>
using NodeSums = std::array<double, 1 + 2 * dim>;

/// The sums of METHOD Eqs. 2, 3 and 7 as they stand there.
template <int dim, class Shape>
std::vector<NodeSums<dim>> plainSums(const Cloud<dim, Shape>& c, bool forces)
{
    std::vector<NodeSums<dim>> sums;
    c.forNodes([&](const LatticeNode& node, Index) {
        NodeSums<dim> sum{};
        for (int l = 0; l < c.count; ++l)
        {
            const double N = c.weight(l, node);
            sum[0] += c.mass[l] * N;
            for (int a = 0; a < dim; ++a)
            {
                sum[1 + a] += c.mass[l] * c.v[a][l] * N;
                for (int b = 0; b < dim && forces; ++b)
                    sum[1 + dim + a] -= c.volume[l] * c.stress[component<dim>(a, b)][l] * c.slope(l, node, b);
            }
        }
        sums.push_back(sum);
    });
    return sums;
}

template <int dim, class What, class Shape>
transfer::ParticleRecords<dim, What> recordsOf(const Cloud<dim, Shape>& c)
{
    transfer::ParticleRecords<dim, What> records;
    if constexpr (std::is_same_v<What, transfer::Forces>)
        records.build(c.mass, c.v, c.volume, c.stress);
    else
        records.build(c.mass, c.v);
    return records;
}

/// The window summed by the kernel. Memory before and behind it must stay as it is.
template <class What, int dim, class Shape>
std::vector<typename What::Node> project(const Cloud<dim, Shape>& c,
                                         const transfer::ParticleRecords<dim, What>& records)
{
    using Node = typename What::Node;
    constexpr std::size_t margin = 200;
    const auto size = std::size_t(c.window.size());
    std::vector<Node> memory(size + 2 * margin, Node{});
    for (std::size_t k = 0; k < margin; ++k)
        memory[k] = memory[margin + size + k] = splat<Node>(7);
    int called = 0;
    projectChunk(c.w, records, c.count, memory.data() + margin, c.window, [&] { ++called; });
    CHECK(called == c.runs());
    bool untouched = true;
    for (std::size_t k = 0; k < margin; ++k)
        for (std::size_t lane = 0; lane < sizeof(Node) / sizeof(double); ++lane)
            untouched = untouched && memory[k][lane] == 7 && memory[margin + size + k][lane] == 7;
    CHECK(untouched);
    return {memory.begin() + margin, memory.begin() + margin + Index(size)};
}

template <class What, int dim, class Shape>
std::vector<NodeSums<dim>> projected(const Cloud<dim, Shape>& c)
{
    std::vector<NodeSums<dim>> sums;
    for (const auto& node : project<What>(c, recordsOf<dim, What>(c)))
    {
        const Record r = transfer::finishNode<dim>(node);
        NodeSums<dim> sum;
        for (int k = 0; k < 1 + 2 * dim; ++k)
            sum[k] = r[k];
        for (int k = 1 + 2 * dim; k < 8; ++k)
            CHECK(r[k] == 0);
        sums.push_back(sum);
    }
    return sums;
}

/// Mass, momentum and force, each against the largest of its kind in all nodes.
template <int dim>
void checkSame(const std::vector<NodeSums<dim>>& found, const std::vector<NodeSums<dim>>& expected)
{
    REQUIRE(found.size() == expected.size());
    for (int k = 0; k < 1 + 2 * dim; ++k)
    {
        const int low = k == 0 ? 0 : k <= dim ? 1 : 1 + dim, high = k == 0 ? 1 : low + dim;
        double scale = 0, error = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
        {
            for (int kind = low; kind < high; ++kind)
                scale = std::max(scale, std::abs(expected[i][kind]));
            REQUIRE(std::isfinite(found[i][k]));
            error = std::max(error, std::abs(found[i][k] - expected[i][k]));
        }
        CAPTURE(k, scale);
        CHECK(error <= 1e-13 * scale);
    }
}

template <class What, int dim, class Shape>
void checkProjection(const Cloud<dim, Shape>& c)
{
    constexpr bool forces = std::is_same_v<What, transfer::Forces>;
    const auto found = projected<What>(c);
    checkSame<dim>(found, plainSums(c, forces));

    NodeSums<dim> total{}, size{};
    bool zeroElsewhere = true;
    c.forNodes([&](const LatticeNode& node, Index at) {
        bool reached = false;
        for (int l = 0; l < c.count; ++l)
            reached = reached || c.reaches(l, node);
        for (int k = 0; k < 1 + 2 * dim; ++k)
        {
            zeroElsewhere = zeroElsewhere && (reached || found[std::size_t(at)][k] == 0);
            total[k] += found[std::size_t(at)][k];
            size[k] += std::abs(found[std::size_t(at)][k]);
        }
    });
    CHECK(zeroElsewhere);

    double mass = 0, momentum[dim] = {};
    for (int l = 0; l < c.count; ++l)
    {
        mass += c.mass[l];
        for (int a = 0; a < dim; ++a)
            momentum[a] += c.mass[l] * c.v[a][l];
    }
    CHECK(std::abs(total[0] - mass) <= 1e-13 * mass);
    for (int a = 0; a < dim; ++a)
    {
        CHECK(std::abs(total[1 + a] - momentum[a]) <= 1e-13 * size[1 + a]);
        CHECK((size[1 + dim + a] > 0) == forces);
        CHECK(std::abs(total[1 + dim + a]) <= 1e-13 * size[1 + dim + a]);
    }
}

/// Random records in the nodes of the window.
template <int dim, class Shape>
std::vector<Record> randomNodes(const Cloud<dim, Shape>& c)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-2, 3);
    std::vector<Record> nodes(std::size_t(c.window.size()));
    for (Record& node : nodes)
        for (int lane = 0; lane < 8; ++lane)
            node[lane] = number(random);
    return nodes;
}

template <class Packer>
std::vector<typename Packer::Type> packed(const std::vector<Record>& nodes)
{
    std::vector<typename Packer::Type> window;
    for (const Record& node : nodes)
        window.push_back(Packer::pack(node));
    return window;
}

/// v and a, and the gradients of both, from the kernels.
template <int dim>
struct Gathered
{
    transfer::Values<dim> value;
    alignas(64) double gradient[2][dim * dim][lanes];
};

template <int dim, class Shape>
Gathered<dim> gather(const Cloud<dim, Shape>& c, const std::vector<Record>& nodes)
{
    Gathered<dim> out;
    int called = 0;
    const auto count = [&] { ++called; };
    gatherValues(c.w, packed<transfer::ValueNode<dim>>(nodes).data(), c.window, out.value, count);
    gatherGradient(c.w, packed<transfer::GradientNode<dim, 1>>(nodes).data(), c.window, out.gradient[0], count);
    gatherGradient(c.w, packed<transfer::GradientNode<dim, 1 + dim>>(nodes).data(), c.window, out.gradient[1], count);
    CHECK(called == 3 * lanes / 8);
    return out;
}

/// In all lanes: those beyond the count repeat the last particle.
template <int dim, class Shape>
void checkGathers(const Cloud<dim, Shape>& c)
{
    const auto nodes = randomNodes(c);
    const auto found = gather(c, nodes);
    double valueError = 0, slopeError = 0;
    for (int l = 0; l < lanes; ++l)
        for (int a = 0; a < 2 * dim; ++a) // velocities, then accelerations
        {
            double value = 0, slope[dim] = {};
            c.forNodes([&](const LatticeNode& node, Index at) {
                const double of = nodes[std::size_t(at)][1 + a];
                value += c.weight(l, node) * of;
                for (int b = 0; b < dim; ++b)
                    slope[b] += c.slope(l, node, b) * of;
            });
            const bool second = a >= dim;
            const double interpolated = second ? found.value.a[a - dim][l] : found.value.v[a][l];
            REQUIRE(std::isfinite(interpolated));
            valueError = std::max(valueError, std::abs(interpolated - value));
            for (int b = 0; b < dim; ++b)
            {
                const double gradient = found.gradient[second][a % dim * dim + b][l];
                REQUIRE(std::isfinite(gradient));
                slopeError = std::max(slopeError, std::abs(gradient - slope[b]));
            }
        }
    CHECK(valueError <= 1e-13 * 3);
    CHECK(slopeError <= 1e-13 * 3 / c.grid.h);
}

template <int dim, class Shape>
void checkLinearField(const Cloud<dim, Shape>& c)
{
    const double v0[3] = {0.3, -1.7, 2.9}, A[3][3] = {{1.1, -2.3, 0.7}, {0.4, 3.1, -1.9}, {-0.6, 2.2, -4.3}};
    auto nodes = randomNodes(c);
    const auto field = [&](int a, const auto& x) {
        double value = v0[a];
        for (int b = 0; b < dim; ++b)
            value += A[a][b] * x(b);
        return value;
    };
    c.forNodes([&](const LatticeNode& node, Index at) {
        for (int a = 0; a < dim; ++a)
            nodes[std::size_t(at)][1 + a] =
                field(a, [&](int b) { return c.grid.origin[b] + c.grid.h * double(node[b]); });
    });
    const auto found = gather(c, nodes);
    for (int l = 0; l < lanes; ++l)
        for (int a = 0; a < dim; ++a)
        {
            CHECK(found.value.v[a][l] == Approx(field(a, [&](int b) { return c.x[b][l]; })).epsilon(0).margin(3e-14));
            for (int b = 0; b < dim; ++b)
                CHECK(found.gradient[0][a * dim + b][l] == Approx(A[a][b]).epsilon(0).margin(3e-13));
        }
}

/// sum_i f_i . w_i = - sum_p V sigma : L(w) and sum_i p_i . w_i = sum_p m v . w(x_p), for any field w on the nodes.
template <int dim, class Shape>
void checkAdjoint(const Cloud<dim, Shape>& c)
{
    const auto nodes = randomNodes(c);
    const auto sums = projected<transfer::Forces>(c);
    const auto found = gather(c, nodes);
    double power = 0, momentum = 0, powerSize = 0, momentumSize = 0;
    c.forNodes([&](const LatticeNode&, Index at) {
        for (int a = 0; a < dim; ++a)
        {
            const double w = nodes[std::size_t(at)][1 + a];
            power += sums[std::size_t(at)][1 + dim + a] * w;
            powerSize += std::abs(sums[std::size_t(at)][1 + dim + a] * w);
            momentum += sums[std::size_t(at)][1 + a] * w;
            momentumSize += std::abs(sums[std::size_t(at)][1 + a] * w);
        }
    });
    for (int l = 0; l < c.count; ++l)
        for (int a = 0; a < dim; ++a)
        {
            momentum -= c.mass[l] * c.v[a][l] * found.value.v[a][l];
            for (int b = 0; b < dim; ++b)
                power += c.volume[l] * c.stress[component<dim>(a, b)][l] * found.gradient[0][a * dim + b][l];
        }
    CHECK(std::abs(power) <= 1e-12 * powerSize);
    CHECK(std::abs(momentum) <= 1e-12 * momentumSize);
}

template <class What, int dim, class Shape>
void checkLanesBeyondCount(const Cloud<dim, Shape>& c)
{
    auto records = recordsOf<dim, What>(c);
    const auto expected = project<What>(c, records);
    Cloud<dim, Shape> disturbed = c; // the offsets of these lanes stay those of the last particle, as if in its run
    auto* const numbers = reinterpret_cast<double*>(&records);
    constexpr int width = dim == 2 ? sizeof(typename What::Node) / sizeof(double) : 4; // 3D: columns of half records
    for (std::size_t k = 0; k < sizeof(records) / sizeof(double); ++k)
        if (int(k / width) % lanes >= c.count)
            numbers[k] = std::numeric_limits<double>::quiet_NaN();
    for (auto& axis : disturbed.w.axis)
        for (int l = c.count; l < lanes; ++l)
        {
            axis.base[l] = 1 << 20;
            for (int n = 0; n < Shape::nodes; ++n)
                axis.N[n][l] = axis.G[n][l] = std::numeric_limits<double>::quiet_NaN();
        }
    const auto found = project<What>(disturbed, records);
    CHECK(std::memcmp(found.data(), expected.data(), found.size() * sizeof(found[0])) == 0);
}

template <int dim, class Shape>
void checkBodyForce(const Cloud<dim, Shape>& c)
{
    std::vector<Record> window(std::size_t(c.window.size()), Record{});
    transfer::projectBodyForce<dim>(c.w, c.mass, c.b, c.count, window.data(), c.window);
    double error = 0;
    c.forNodes([&](const LatticeNode& node, Index at) {
        const Record r = transfer::finishNode<dim>(window[std::size_t(at)]);
        for (int k = 0; k <= dim; ++k)
            CHECK(r[k] == 0);
        for (int a = 0; a < dim; ++a)
        {
            double expected = 0;
            for (int l = 0; l < c.count; ++l)
                expected += c.mass[l] * c.b[a][l] * c.weight(l, node);
            error = std::max(error, std::abs(r[1 + dim + a] - expected));
        }
    });
    CHECK(error <= 1e-11); // of sums of some 1e2
}
} // namespace

TEST_CASE("chunks hold several runs, of one lane and of many")
{
    const Cloud<2, shape::UGIMP> plane(64, 0.1, 0.5);
    const Cloud<3, shape::UGIMP> solid(37, 0.1, 0.5);
    const Cloud<3, shape::CpGIMP> wide(64, 0.5, 1);
    CHECK((plane.runs() == 9 && solid.runs() > 9 && solid.runs() < 37 && wide.runs() == 4));
}

TEST_CASE("projected mass, momentum and force are the sums over particles and nodes, and conserved")
{
    const auto check = [](const auto& c) {
        checkProjection<transfer::Momentum>(c);
        checkProjection<transfer::Forces>(c);
    };
    forShapes<2>(check);
    forShapes<3>(check);
}

TEST_CASE("values and gradients are the sums over particles and nodes")
{
    forShapes<2>([](const auto& c) { checkGathers(c); });
    forShapes<3>([](const auto& c) { checkGathers(c); });
}

TEST_CASE("a linear velocity field is found exactly, its gradient row by row")
{
    forShapes<2>([](const auto& c) { checkLinearField(c); });
    forShapes<3>([](const auto& c) { checkLinearField(c); });
}

TEST_CASE("projection is the adjoint of interpolation: no power is lost between nodes and particles")
{
    forShapes<2>([](const auto& c) { checkAdjoint(c); });
    forShapes<3>([](const auto& c) { checkAdjoint(c); });
}

TEST_CASE("lanes beyond the count do not reach the nodes")
{
    const auto check = [](const auto& c) {
        checkLanesBeyondCount<transfer::Momentum>(c);
        checkLanesBeyondCount<transfer::Forces>(c);
    };
    forShapes<2>(check);
    forShapes<3>(check);
}

TEST_CASE("a prescribed acceleration adds m b N to the force alone")
{
    forShapes<2>([](const auto& c) { checkBodyForce(c); });
    forShapes<3>([](const auto& c) { checkBodyForce(c); });
}
