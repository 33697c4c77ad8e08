// Measures of a stress field against closed forms: noise, checkerboards, yield and tension, volume.
#include "base/error.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/neoHookean.hpp"
#include "constitutive/vonMises.hpp"
#include "smoothing/admissibility.hpp"
#include "smoothing/checkerboard.hpp"
#include "smoothing/componentNoise.hpp"
#include "smoothing/filteredNoise.hpp"
#include "smoothing/volumeBudget.hpp"
#include "support/particleLattice.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::smoothing;
using namespace mpm::test;

namespace
{
const constitutive::MohrCoulombParameters soil{{20e6, 0.42}, 1e3, 42, 0};

constitutive::Material material(std::shared_ptr<const constitutive::Law> law)
{
    return {"m", 1000, std::move(law)};
}
} // namespace

TEST_CASE("noise of known size: N of every component, shear over its own size and over the mean stress")
{
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, 6, 0.5, true);
        auto& p = state.particles;
        // hat functions take what alternates from particle to particle away: N is amplitude over base
        const double base[6] = {-3e4, -6e4, -3e4, 10, 2e4, 0}, amplitude[6] = {3e3, 3e3, 3e3, 1e3, 1e3, 2e3};
        for (std::size_t c = 0; c < std::size_t(stressComponents(dim)); ++c)
            for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
                p.stress[c][i] = base[c] + amplitude[c] * signOfParticle(state, i);
        const auto noise = componentNoise(p, smoothStress(p, weightTable(state, "linear")));
        REQUIRE(noise.own.size() == std::size_t(stressComponents(dim)));
        CHECK(noise.own[0] == Approx(0.1));
        CHECK(noise.own[1] == Approx(0.05));
        CHECK(noise.own[3] == Approx(100)); // a shear stress next to nothing
        CHECK(noise.scale == Approx(4e4));
        CHECK(noise.ofMean[3] == Approx(1e3 / 4e4));
        CHECK(noise.mean == Approx(3e3 / 4e4));
        if (dim == 3)
        {
            CHECK(noise.own[4] == Approx(0.05));
            CHECK(noise.ofMean[5] == Approx(2e3 / 4e4));
        }
    }
}

TEST_CASE("noise beyond the filter is that of particles, the floor that of the field")
{
    for (const int dim : {2, 3})
        for (const double shift : {0.0, 0.5})
        {
            auto state = lattice(dim, 12, 0.5, true);
            auto& p = state.particles;
            const auto n = std::size_t(p.size());
            // on this lattice hats keep lambda = 1 - 3 t^2/16 of a wave of k h = t << 1, and S f = lambda f
            const double t = 2 * M_PI / 12, k = t / 0.5, lost = 3. / 16 * t * t, rms = 2e4 / std::sqrt(2);
            double wave = 0;
            for (const double amplitude : {0.0, 3e3})
            {
                for (std::size_t i = 0; i < n; ++i)
                    p.stress[1][i] =
                        -5e4 + 2e4 * std::sin(k * p.x[0][i] + shift) + amplitude * signOfParticle(state, i);
                const auto table = weightTable(state, "linear");
                const auto smoothed = smoothStress(p, table);
                const auto noise = filteredNoise(p, table, smoothed);
                double size = 0;
                for (const double value : smoothed.smoothed[1])
                    size += value * value / double(n);
                if (amplitude == 0)
                {
                    // (1 - lambda)^2, and of the wave t^3/64 from particle to particle, which no node sees
                    wave = noise.beyondFilter;
                    CHECK(wave ==
                          Approx(std::hypot(lost * lost, t * t * t / 64) * rms / std::sqrt(size)).epsilon(0.05));
                }
                else
                    CHECK(noise.beyondFilter == Approx(std::hypot(wave, amplitude / std::sqrt(size))));
                CHECK(noise.floorOfField == Approx(lost * rms / std::sqrt(size)).epsilon(0.05));
            }
        }
}

TEST_CASE("no checkerboard in linear fields, whatever the particles, and nothing else in a checkerboard")
{
    for (const int dim : {2, 3})
    {
        INFO(dim);
        const auto regular = lattice(dim, 7, 0.4);
        auto irregular = regular;
        scatter(irregular);
        for (const state::State* state : {&std::as_const(regular), &std::as_const(irregular)})
        {
            const auto& p = state->particles;
            const auto linear = checkerboard(*state, valuesOf(*state, [&](std::size_t i) {
                return 5e4 - 1e4 * p.x[0][i] + 3e4 * p.x[1][i] - (dim == 3 ? 2e4 * p.x[2][i] : 0);
            }));
            CHECK(linear.cells >= (dim == 2 ? 16 : 64));
            CHECK(linear.share < 1e-20);
            CHECK(linear.amplitude < 1e-12);
            CHECK(checkerboard(*state, std::vector<double>(std::size_t(p.size()), -7e4)).share == 0);
            CHECK(checkerboard(*state, std::vector<double>(std::size_t(p.size()), 0.0)).amplitude == 0);
        }
        // 5^dim of the 7^dim cells have all their neighbours: an odd number, so the mean of the pattern is not zero
        const auto pure =
            checkerboard(regular, valuesOf(regular, [&](std::size_t i) { return 4e4 + 3e3 * signOfCell(regular, i); }));
        CHECK(pure.cells == Index(std::pow(5, dim)));
        CHECK(pure.share == Approx(1).epsilon(1e-12));
        CHECK(pure.amplitude == Approx(3e3 / 4e4).epsilon(0.01)); // RMS of 4e4 +- 3e3
        const auto scattered = checkerboard(
            irregular, valuesOf(irregular, [&](std::size_t i) { return 4e4 + 3e3 * signOfCell(irregular, i); }));
        CHECK(scattered.share > 0.9);
        CHECK(scattered.amplitude == Approx(3e3 / 4e4).epsilon(0.1));
        // on top of a linear field the amplitude stays what it is
        const auto both = checkerboard(regular, valuesOf(regular, [&](std::size_t i) {
                                           return 1e6 + 1e5 * regular.particles.x[0][i] + 1e3 * signOfCell(regular, i);
                                       }));
        CHECK(both.amplitude == Approx(1e3 / 1.14e6).epsilon(0.02));
    }
}

TEST_CASE("of a wave over twelve cells the checkerboard's filter leaves what its header says")
{
    const auto state = lattice(2, 12, 1, true);
    const auto& p = state.particles;
    const double k = 2 * M_PI / 12, gain = std::pow(std::sin(k / 2), 4);
    const auto wave = checkerboard(
        state, valuesOf(state, [&](std::size_t i) { return std::sin(k * p.x[0][i]) * std::sin(k * p.x[1][i]); }));
    CHECK(wave.cells == 144);
    CHECK(wave.share == Approx(gain * gain / (gain * gain + (1 - gain) * (1 - gain))).epsilon(1e-9));
    CHECK(wave.share < 3e-5);
    CHECK(wave.amplitude == Approx(gain).epsilon(1e-9));
}

TEST_CASE("the checkerboard is one of the pressure, inside the material only")
{
    auto state = lattice(2, 6, 0.5);
    auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        for (std::size_t c = 0; c < 3; ++c)
            p.stress[c][i] = -1e4;
        p.stress[0][i] += 9e3 * signOfCell(state, i);
        p.stress[3][i] = 5e5 * signOfCell(state, i); // shear is no pressure
    }
    CHECK(checkerboard(state).share == Approx(1));
    CHECK(checkerboard(state).amplitude == Approx(3e3 / std::hypot(1e4, 3e3)));
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.stress[0][i] = -2e4; // two deviators may hide a pressure's pattern from no one
    CHECK(checkerboard(state).share == 0);
    // a cell emptied in the middle leaves none of the 4 x 4 inner cells with all neighbours but those out of its reach
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        if (cellOf(state, i, 0) == 5 && cellOf(state, i, 1) == 5)
            p.x[0][i] += 0.5;
    CHECK(checkerboard(state).cells == 16 - 9);
    const auto thin = checkerboard(lattice(2, 2, 0.5));
    CHECK(thin.cells == 0);
    CHECK(std::isnan(thin.share));
    state::State noGrid(2);
    CHECK_THROWS_AS(checkerboard(noGrid), InputError);
}

TEST_CASE("a law reports the yield function of a stress as it stands: what update says of the stress it leaves")
{
    std::mt19937_64 engine(3);
    std::normal_distribution<double> stress(-2e4, 3e4);
    std::vector<std::shared_ptr<const constitutive::Law>> laws{
        std::make_shared<constitutive::MohrCoulomb>(soil),
        std::make_shared<constitutive::VonMises>(constitutive::ElasticModuli{1e6, 0.3}, 2e4),
        std::make_shared<constitutive::LinearElastic>(constitutive::ElasticModuli{1e6, 0.3})};
    for (const auto& law : laws)
        for (int round = 0; round < 20; ++round)
        {
            const auto check = [&]<int dim>(std::integral_constant<int, dim>) {
                auto chunk = std::make_unique<constitutive::Chunk<dim>>();
                for (int k = 0; k < stressComponents(dim); ++k)
                    for (int l = 0; l < lanes; ++l)
                    {
                        chunk->stress[k][l] = stress(engine);
                        chunk->dStrain[k][l] = 0;
                    }
                auto before = std::make_unique<constitutive::Chunk<dim>>(*chunk);
                law->reportYield(*before);
                law->update(*chunk);
                auto after = std::make_unique<constitutive::Chunk<dim>>(*chunk);
                law->reportYield(*after);
                int beyond = 0;
                for (int l = 0; l < lanes; ++l)
                {
                    const bool elastic = chunk->region[l] == constitutive::Region::elastic;
                    CHECK(after->yield[l] == Approx(chunk->yield[l]).margin(1e-12));
                    CHECK((before->yield[l] <= 0) == elastic);
                    CHECK(before->stress[1][l] == before->stress[1][l]);
                    beyond += !elastic;
                }
                CHECK((beyond > 0) == law->plastic());
            };
            check(std::integral_constant<int, 2>{});
            check(std::integral_constant<int, 3>{});
        }
    CHECK(laws[0]->tensionLimit() == Approx(1e3 / std::tan(42 * M_PI / 180)));
    CHECK(std::isinf(laws[1]->tensionLimit()));
    CHECK(std::isinf(constitutive::MohrCoulomb({{20e6, 0.42}, 1e3, 0, 0}).tensionLimit())); // Tresca
}

TEST_CASE("yield and tension beyond the law, by particle and its own material")
{
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, 2, 1);
        auto& p = state.particles;
        const std::vector<constitutive::Material> materials{
            material(std::make_shared<constitutive::MohrCoulomb>(soil)),
            material(std::make_shared<constitutive::LinearElastic>(constitutive::ElasticModuli{1e6, 0.3}))};
        for (std::size_t c = 0; c < 3; ++c)
            std::fill(p.stress[c].begin(), p.stress[c].end(), -1e4);
        auto calm = admissibility(state, materials, 1e4);
        CHECK(calm.yieldViolation == 0);
        CHECK(calm.tensionViolation == 0);
        CHECK(calm.massInTension == 0);
        // triaxial compression: f = k s1 - s3 - sc beyond zero by 10 kPa, in a turned frame
        const double k = (1 + std::sin(42 * M_PI / 180)) / (1 - std::sin(42 * M_PI / 180)), sc = 2e3 * std::sqrt(k);
        const double s1 = -1e4, s3 = k * s1 - sc - 1e4, middle = 0.5 * (s1 + s3), radius = 0.5 * (s1 - s3);
        p.stress[0][5] = p.stress[1][5] = middle;
        p.stress[3][5] = radius;
        CHECK(admissibility(state, materials, 1e4).yieldViolation == Approx(1e4 / -s3));
        p.material[5] = 1; // an elastic body may carry it
        CHECK(admissibility(state, materials, 1e4).yieldViolation == 0);

        const double apex = 1e3 / std::tan(42 * M_PI / 180);
        for (std::size_t c = 0; c < 3; ++c)
        {
            p.stress[c][1] = apex + 500;
            p.stress[c][2] = apex - 500;
            p.stress[c][5] = 1e6; // elastic: no limit
        }
        p.stress[3][5] = 0;
        p.mass[2] *= 2;
        const auto torn = admissibility(state, materials, 1e4);
        CHECK(torn.tensionViolation == Approx(0.05));
        CHECK(torn.massInTension == Approx(4.0 / (double(p.size()) + 1)));
    }
}

TEST_CASE("volume: what stresses explain is elastic, the rest is not")
{
    auto state = lattice(2, 4, 0.5);
    auto& p = state.particles;
    const std::vector<constitutive::Material> materials{material(std::make_shared<constitutive::MohrCoulomb>(soil))};
    const double K = materials[0].law->bulkModulus(), start = -3e4, now = -1e5;
    const auto press = [&](double mean) {
        for (std::size_t c = 0; c < 3; ++c)
            std::fill(p.stress[c].begin(), p.stress[c].end(), mean);
    };
    press(start);
    const double atStart = elasticVolume(state, materials);
    CHECK(atStart == Approx(std::expm1(start / K)));
    press(now);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.volume[i] = p.volume0[i] * std::exp((now - start) / K);
    auto elastic = volumeBudget(state, materials, atStart);
    CHECK(elastic.initial == Approx(4));
    CHECK(elastic.change == Approx(std::expm1((now - start) / K)));
    CHECK(std::abs(elastic.inelastic) < 3 * std::abs(start * (now - start)) / (K * K));
    CHECK(elastic.dropped == 0);
    // a tenth of the particles grow by a fifth without a stress to show for it, as booked
    double grown = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); i += 10)
    {
        grown += 0.2 * p.volume[i];
        p.volume[i] *= 1.2;
    }
    state.ledger.apexVolume = grown;
    const auto spurious = volumeBudget(state, materials, atStart);
    CHECK(spurious.inelastic == Approx(spurious.dropped).epsilon(1e-3));
    CHECK(spurious.dropped == Approx(grown / 4));
    CHECK(std::isnan(volumeBudget(state, materials, std::nan("")).inelastic));

    const std::vector<constitutive::Material> rubber{
        material(std::make_shared<constitutive::NeoHookean>(constitutive::ElasticModuli{1e6, 0.3}))};
    const auto all = volumeBudget(state, rubber, 0);
    CHECK(all.elastic == Approx(all.change));
    CHECK(std::abs(all.inelastic) < 1e-14);
}
