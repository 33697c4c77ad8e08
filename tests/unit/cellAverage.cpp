// Averages over cells and their neighbours, on their own: treatment/volumetricAveraging.hpp, CellAverage.
#include "stepping/sortParticles.hpp"
#include "treatment/volumetricAveraging.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <Eigen/Dense>
#include <map>
#include <omp.h>
#include <random>

using namespace mpm;

namespace
{
using Cell = std::array<Index, 3>;

/// Particles with volumes and values, the cells they lie in, and the average of the blocks around them.
struct Cloud
{
    state::State state{2};
    state::TileGrid grid;
    std::vector<Cell> cells; ///< those with material
    std::vector<double> volume, mean;
    std::vector<double> random;

    Cloud(int dim, std::array<Index, 3> extent, std::array<bool, 3> periodic, unsigned seed, bool hole = true)
        : state(dim)
    {
        state.grid = {dim, {-1, 0.5, 2}, 0.5, extent, periodic};
        auto& p = state.particles;
        std::mt19937_64 engine(seed);
        std::uniform_real_distribution<double> uniform(0, 1);
        Index n = 1;
        for (int a = 0; a < dim; ++a)
            n *= extent[std::size_t(a)];
        p.resize(2 * n);
        Index kept = 0;
        for (Index i = 0; i < 2 * n; ++i)
        {
            Vector3 u{};
            for (int a = 0; a < dim; ++a)
                u[a] = uniform(engine);
            if (hole && std::hypot(u[0] - 0.5, u[1] - 0.4) < 0.2)
                continue;
            for (int a = 0; a < dim; ++a)
                p.x[a][std::size_t(kept)] =
                    state.grid.origin[std::size_t(a)] + 0.5 * double(extent[std::size_t(a)]) * u[a];
            p.volume[std::size_t(kept)] = p.mass[std::size_t(kept)] = 0.01 + uniform(engine);
            p.id[std::size_t(kept)] = kept;
            ++kept;
        }
        p.resize(kept);
        p.padLastChunk();
        const state::TileLayout layout(state.grid);
        stepping::sortByPosition(state, layout, 3); // three nodes an axis, as of uGIMP
        grid.build(p, layout, 0, 2);
        std::map<Cell, std::array<double, 2>> sums;
        for (std::size_t i = 0; i < std::size_t(kept); ++i)
        {
            Cell c{};
            for (int a = 0; a < dim; ++a)
                c[std::size_t(a)] = Index(std::floor((p.x[a][i] - state.grid.origin[std::size_t(a)]) / 0.5));
            auto& sum = sums[c];
            sum[0] += p.volume[i];
            sum[1] += p.volume[i] * (uniform(engine) - 0.3);
        }
        for (const auto& [cell, sum] : sums)
        {
            cells.push_back(cell);
            volume.push_back(sum[0]);
            mean.push_back(sum[1] / sum[0]);
            random.push_back(uniform(engine) - 0.5);
        }
    }

    std::size_t place(std::size_t c) const
    {
        const Index at = grid.place(cells[c][0], cells[c][1], cells[c][2]);
        REQUIRE(at >= 0);
        return std::size_t(at);
    }

    /// What the average makes of one value a cell.
    std::vector<double> apply(const std::vector<double>& values, int hats, std::vector<double>* all = nullptr) const
    {
        treatment::CellAverage average;
        average.build(grid);
        for (std::size_t c = 0; c < cells.size(); ++c)
        {
            average.volume()[place(c)] = volume[c];
            average.content()[place(c)] = volume[c] * values[c];
        }
        average.average(hats);
        std::vector<double> out;
        for (std::size_t c = 0; c < cells.size(); ++c)
            out.push_back(average.content()[place(c)]);
        if (all)
            *all = average.content();
        return out;
    }

    /// How many images of cell c lie at a node: offset 0 or 1 along each axis.
    double at(std::size_t c, const Cell& node) const
    {
        double product = 1;
        for (int a = 0; a < state.particles.dim; ++a)
        {
            const auto axis = std::size_t(a);
            const Index period = state.grid.periodic[axis] ? state.grid.cells[axis] : Index(1) << 40;
            double images = 0;
            for (const Index by : {0, 1})
                images += (cells[c][axis] + by - node[axis]) % period == 0;
            product *= images;
        }
        return product;
    }

    /// The definition, every node against every cell.
    std::vector<double> direct(std::vector<double> b, int hats) const
    {
        const int corners = 1 << state.particles.dim;
        for (int r = 0; r < hats; ++r)
        {
            std::vector<double> next(cells.size(), 0.0);
            for (std::size_t c = 0; c < cells.size(); ++c)
                for (int corner = 0; corner < corners; ++corner)
                {
                    Cell node = cells[c];
                    for (int a = 0; a < 3; ++a)
                        node[std::size_t(a)] += (corner >> a) & 1;
                    double sum = 0, total = 0;
                    for (std::size_t d = 0; d < cells.size(); ++d)
                        if (const double w = at(d, node); w > 0)
                        {
                            sum += w * volume[d] * b[d];
                            total += w * volume[d];
                        }
                    next[c] += sum / total / corners;
                }
            b = next;
        }
        return b;
    }
};

std::vector<Cloud> clouds()
{
    std::vector<Cloud> out;
    out.emplace_back(2, std::array<Index, 3>{37, 21, 1}, std::array<bool, 3>{}, 1);
    out.emplace_back(2, std::array<Index, 3>{19, 35, 1}, std::array<bool, 3>{true, false, false}, 2);
    out.emplace_back(2, std::array<Index, 3>{5, 3, 1}, std::array<bool, 3>{true, true, false}, 3, false);
    out.emplace_back(3, std::array<Index, 3>{10, 11, 9}, std::array<bool, 3>{}, 4);
    out.emplace_back(3, std::array<Index, 3>{10, 9, 6}, std::array<bool, 3>{false, true, true}, 5);
    return out;
}
} // namespace

TEST_CASE("hats are the sums of their definition, over borders of blocks and periodic sides")
{
    for (const auto& cloud : clouds())
    {
        REQUIRE((cloud.grid.blocks().size() > 1 || cloud.cells.size() <= 15));
        for (const int hats : {0, 1, 2, 5})
        {
            CAPTURE(cloud.state.particles.dim, cloud.cells.size(), hats);
            const auto found = cloud.apply(cloud.mean, hats), expected = cloud.direct(cloud.mean, hats);
            double most = 0;
            for (std::size_t c = 0; c < found.size(); ++c)
                most = std::max(most, std::abs(found[c] - expected[c]));
            CHECK(most < 1e-14);
        }
    }
}

TEST_CASE("constants are kept, and cells without material stay zero")
{
    for (const auto& cloud : clouds())
        for (const int hats : {0, 1, 4})
        {
            std::vector<double> all;
            for (const double value : cloud.apply(std::vector<double>(cloud.cells.size(), 3.7), hats, &all))
                CHECK(value == Approx(3.7).epsilon(1e-14));
            std::size_t filled = 0;
            for (const double value : all)
                filled += value != 0;
            CHECK(filled == cloud.cells.size());
            CHECK((all.size() > filled || cloud.cells.size() <= 15));
        }
}

TEST_CASE("hats are their own adjoint in the inner product of volumes, and keep its sums")
{
    for (const auto& cloud : clouds())
        for (const int hats : {0, 1, 2, 4})
        {
            const auto forth = cloud.apply(cloud.mean, hats), back = cloud.apply(cloud.random, hats);
            double left = 0, right = 0, scale = 0, sum = 0, kept = 0;
            for (std::size_t c = 0; c < cloud.cells.size(); ++c)
            {
                left += cloud.volume[c] * cloud.random[c] * forth[c];
                right += cloud.volume[c] * back[c] * cloud.mean[c];
                scale += cloud.volume[c] * std::abs(cloud.mean[c]);
                sum += cloud.volume[c] * cloud.mean[c];
                kept += cloud.volume[c] * forth[c];
            }
            CHECK(std::abs(left - right) < 1e-14 * scale);
            CHECK(std::abs(sum - kept) < 1e-14 * scale);
        }
}

TEST_CASE("inside a body of equal cells hats are (1 2 1)/4 along each axis, and no hat has a negative eigenvalue")
{
    for (const Cloud& cloud :
         {Cloud(2, {13, 9, 1}, {}, 6), Cloud(2, {18, 5, 1}, {true, false, false}, 7), Cloud(3, {5, 4, 9}, {}, 8)})
    {
        auto equal = cloud;
        std::fill(equal.volume.begin(), equal.volume.end(), 1.0);
        const auto n = Eigen::Index(cloud.cells.size());
        Eigen::MatrixXd S(n, n);
        for (Eigen::Index d = 0; d < n; ++d)
        {
            std::vector<double> unit(std::size_t(n), 0.0);
            unit[std::size_t(d)] = 1;
            const auto column = cloud.apply(unit, 1), same = equal.apply(unit, 1);
            for (Eigen::Index c = 0; c < n; ++c)
                S(c, d) =
                    std::sqrt(cloud.volume[std::size_t(c)] / cloud.volume[std::size_t(d)]) * column[std::size_t(c)];
            // a cell all of whose neighbours hold material has 4 or 8 cells at each of its nodes
            Index around = 0;
            for (std::size_t c = 0; c < cloud.cells.size(); ++c)
                around += same[c] > 0;
            if (around == (cloud.state.particles.dim == 2 ? 9 : 27))
                for (std::size_t c = 0; c < cloud.cells.size(); ++c)
                {
                    double w = 1;
                    Index far = 0;
                    for (std::size_t a = 0; a < std::size_t(cloud.state.particles.dim); ++a)
                    {
                        const Index period = cloud.state.grid.periodic[a] ? cloud.state.grid.cells[a] : Index(1) << 40;
                        const Index by = (cloud.cells[c][a] - cloud.cells[std::size_t(d)][a] + period + 1) % period - 1;
                        far = std::max(far, std::abs(by));
                        w *= (2 - std::abs(double(by))) / 4;
                    }
                    CHECK(same[c] == Approx(far > 1 ? 0 : w).margin(1e-14));
                }
        }
        CHECK((S - S.transpose()).cwiseAbs().maxCoeff() < 1e-13);
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S).eigenvalues();
        CHECK(values.minCoeff() > -1e-14);
        CHECK(values.maxCoeff() == Approx(1).epsilon(1e-13));
    }
}

TEST_CASE("averages are bitwise the same for any threads")
{
    const int before = omp_get_max_threads();
    for (const auto& cloud : clouds())
    {
        std::vector<double> first;
        for (const int threads : {1, 2, 3})
        {
            omp_set_num_threads(threads);
            std::vector<double> all;
            cloud.apply(cloud.mean, 3, &all);
            if (first.empty())
                first = all;
            CHECK(all == first);
        }
    }
    omp_set_num_threads(before);
}
