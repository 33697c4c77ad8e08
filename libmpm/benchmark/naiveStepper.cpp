#include "benchmark/naiveStepper.hpp"

#include "base/error.hpp"
#include "benchmark/naiveNodes.hpp"
#include "benchmark/naiveWeights.hpp"
#include "constitutive/kinematics.hpp"

#include <unordered_map>

namespace mpm::benchmark
{
namespace
{
using stepping::StressUpdate;

constexpr int stressAt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; ///< component sigma_ab

template <int dim>
struct Particle
{
    double x[dim], v[dim], F[dim * dim], sigma[stressSize<dim>], length0[dim];
    double halfLength[dim]; ///< of the domain, in cells
    double mass, volume0, volume;
    std::int64_t id;
};

/// What one sweep from nodes to particles does.
struct Sweep
{
    bool velocity = false, strain = false, position = false;
};

template <int dim, Kind kind>
class Naive : public NaiveStepper
{
  public:
    Naive(const state::State& state, const stepping::Scene& scene)
        : scene_(scene), grid_(state.grid), nodes_(state.grid)
    {
        particles_.resize(std::size_t(state.particles.size()));
        for (std::size_t i = 0; i < particles_.size(); ++i)
            copy(state.particles, i, particles_[i]);
        alignas(64) constitutive::TensorLanes<dim> F;
        for (std::size_t first = 0; first < particles_.size(); first += lanes)
        {
            for (int l = 0; l < lanes; ++l)
                for (int k = 0; k < dim * dim; ++k)
                    F[k][l] = particles_[std::min(first + std::size_t(l), particles_.size() - 1)].F[k];
            setDomains(first, F);
        }
    }

    Index particles() const override { return Index(particles_.size()); }

    void step(double dt) override
    {
        nodes_.cover(particles_);
        switch (scene_.stressUpdate)
        {
        case StressUpdate::USF:
            project(true, true); // which walls hold is foreseen with the stress at hand
            nodes_.solve(dt, scene_);
            nodes_.strainVelocities(scene_.walls);
            toParticles(dt, {.strain = true});
            project(true, true);
            nodes_.solve(dt, scene_);
            toParticles(dt, {.velocity = true, .position = true});
            break;
        case StressUpdate::USL:
            project(true, true);
            nodes_.solve(dt, scene_);
            nodes_.strainVelocitiesAreNew();
            toParticles(dt, {.velocity = true, .strain = true, .position = true});
            break;
        case StressUpdate::MUSL:
            project(true, true);
            nodes_.solve(dt, scene_);
            toParticles(dt, {.velocity = true});
            project(false, false);
            nodes_.strainVelocities(scene_.walls);
            toParticles(dt, {.strain = true, .position = true});
            break;
        }
    }

    void store(state::State& state) const override
    {
        auto& p = state.particles;
        std::unordered_map<std::int64_t, std::size_t> place;
        for (Index i = 0; i < p.size(); ++i)
            place[p.id[std::size_t(i)]] = std::size_t(i);
        for (const auto& from : particles_)
        {
            const std::size_t i = place.at(from.id);
            for (int a = 0; a < dim; ++a)
            {
                p.x[a][i] = from.x[a];
                p.v[a][i] = from.v[a];
            }
            for (int k = 0; k < dim * dim; ++k)
                p.F[k][i] = from.F[k];
            for (int k = 0; k < stressSize<dim>; ++k)
                p.stress[k][i] = from.sigma[k];
            p.volume[i] = from.volume;
        }
        p.padLastChunk();
    }

  private:
    static void copy(const state::Particles& p, std::size_t i, Particle<dim>& to)
    {
        for (int a = 0; a < dim; ++a)
        {
            to.x[a] = p.x[a][i];
            to.v[a] = p.v[a][i];
            to.length0[a] = p.length0[a][i];
        }
        for (int k = 0; k < dim * dim; ++k)
            to.F[k] = p.F[k][i];
        for (int k = 0; k < stressSize<dim>; ++k)
            to.sigma[k] = p.stress[k][i];
        to.mass = p.mass[i];
        to.volume0 = p.volume0[i];
        to.volume = p.volume[i];
        to.id = p.id[i];
    }

    /// Half lengths of up to 64 particles from their F: uGIMP l0, cpGIMP l0 U_kk.
    void setDomains(std::size_t first, const constitutive::TensorLanes<dim>& F)
    {
        alignas(64) double U[dim][lanes];
        if (kind == Kind::cpGIMP)
            constitutive::stretchDiagonal(F, U);
        for (std::size_t l = 0; l < std::min<std::size_t>(lanes, particles_.size() - first); ++l)
            for (int a = 0; a < dim; ++a)
            {
                Particle<dim>& p = particles_[first + l];
                const double half = 0.5 * p.length0[a] / grid_.h;
                p.halfLength[a] = kind == Kind::cpGIMP ? std::min(1.0, half * U[a][l]) : std::min(0.5, half);
            }
    }

    /// Calls visit(node, N, gradN) for every node of the particle's support.
    template <class Visit>
    [[gnu::always_inline]] void forEachNode(const Particle<dim>& p, const Visit& visit)
    {
        constexpr int n = naiveNodesOf(kind);
        double s[dim];
        Index first[3] = {0, 0, 0};
        for (int a = 0; a < dim; ++a)
        {
            s[a] = (p.x[a] - grid_.origin[a]) * (1 / grid_.h);
            first[a] = Index(std::floor(s[a] - 0.5 * (n - 2)));
        }
        for (Index k = first[2]; k < first[2] + (dim == 3 ? n : 1); ++k)
            for (Index j = first[1]; j < first[1] + n; ++j)
                for (Index i = first[0]; i < first[0] + n; ++i)
                {
                    const Index at[3] = {i, j, k};
                    double N = 1, G[dim];
                    std::fill_n(G, dim, 1.0);
                    for (int a = 0; a < dim; ++a)
                    {
                        const auto w = naiveWeight<kind>(s[a] - double(at[a]), p.halfLength[a], at[a] == first[a]);
                        N *= w.N;
                        for (int b = 0; b < dim; ++b)
                            G[b] *= a == b ? w.G / grid_.h : w.N;
                    }
                    visit(nodes_.at(i, j, k), N, G);
                }
    }

    void project(bool mass, bool forces)
    {
        nodes_.clear(mass, forces);
        for (const auto& p : particles_)
            forEachNode(p, [&](Node<dim>& node, double N, const double(&G)[dim]) {
                if (mass)
                    node.mass += p.mass * N;
                for (int a = 0; a < dim; ++a)
                {
                    node.momentum[a] += p.mass * p.v[a] * N;
                    if (forces)
                        for (int b = 0; b < dim; ++b)
                            node.force[a] -= p.volume * p.sigma[stressAt[a][b]] * G[b];
                }
            });
    }

    void toParticles(double dt, const Sweep& sweep)
    {
        constitutive::Chunk<dim> chunk;
        alignas(64) constitutive::TensorLanes<dim> L, F;
        for (std::size_t first = 0; first < particles_.size(); first += lanes)
        {
            chunk.count = int(std::min<std::size_t>(lanes, particles_.size() - first));
            for (int l = 0; l < chunk.count; ++l)
                move(particles_[first + std::size_t(l)], dt, sweep, l, L);
            if (sweep.strain)
                updateStress(first, dt, L, F, chunk);
        }
    }

    /// One particle: v += dt a (with the scene's rate of PIC), x += dt v*; grad w goes to lane l of L.
    void move(Particle<dim>& p, double dt, const Sweep& sweep, int l, constitutive::TensorLanes<dim>& L)
    {
        double a[dim] = {}, moved[dim] = {}, gradient[dim][dim] = {};
        forEachNode(p, [&](const Node<dim>& node, double N, const double(&G)[dim]) {
            for (int k = 0; k < dim; ++k)
            {
                a[k] += N * node.acceleration[k];
                moved[k] += N * node.velocity[k];
                if (sweep.strain)
                    for (int b = 0; b < dim; ++b)
                        gradient[k][b] += node.strainVelocity[k] * G[b];
            }
        });
        const double alpha = -std::expm1(-scene_.picRate * dt);
        for (int k = 0; k < dim; ++k)
        {
            if (sweep.velocity)
            {
                p.v[k] += dt * a[k];
                p.v[k] += alpha * (moved[k] - p.v[k]);
            }
            if (sweep.position)
                p.x[k] += dt * moved[k];
            for (int b = 0; b < dim; ++b)
                L[k * dim + b][l] = gradient[k][b];
        }
    }

    void updateStress(std::size_t first, double dt, constitutive::TensorLanes<dim>& L,
                      constitutive::TensorLanes<dim>& F, constitutive::Chunk<dim>& chunk)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const int from = std::min(l, chunk.count - 1);
            const auto& p = particles_[first + std::size_t(from)];
            for (int k = 0; k < dim * dim; ++k)
            {
                L[k][l] = L[k][from];
                F[k][l] = p.F[k];
            }
            for (int k = 0; k < stressSize<dim>; ++k)
                chunk.stress[k][l] = p.sigma[k];
        }
        alignas(64) double J[lanes];
        constitutive::toMidStep(scene_.stressUpdate == stepping::StressUpdate::USF ? constitutive::TakenOver::end
                                                                                   : constitutive::TakenOver::start,
                                dt, L);
        constitutive::strainIncrement(L, dt, chunk.dStrain);
        constitutive::advanceDeformation(L, dt, F);
        constitutive::determinant(F, J);
        constitutive::rotateStress(L, dt, chunk.stress);
        constitutive::rotateStress(L, 0.5 * dt, chunk.dStrain);
        chunk.F = &F;
        scene_.materials[0].law->update(chunk);
        for (int l = 0; l < chunk.count; ++l)
        {
            auto& p = particles_[first + std::size_t(l)];
            for (int k = 0; k < dim * dim; ++k)
                p.F[k] = F[k][l];
            for (int k = 0; k < stressSize<dim>; ++k)
                p.sigma[k] = chunk.stress[k][l];
            p.volume = p.volume0 * J[l];
        }
        if (kind == Kind::cpGIMP)
            setDomains(first, F);
    }

    const stepping::Scene scene_;
    const state::GridBox grid_;
    std::vector<Particle<dim>> particles_;
    NaiveNodes<dim> nodes_;
};

template <int dim>
std::unique_ptr<NaiveStepper> make(const std::string& shape, const state::State& state, const stepping::Scene& scene)
{
    if (shape == "linear")
        return std::make_unique<Naive<dim, Kind::linear>>(state, scene);
    if (shape == "uGIMP")
        return std::make_unique<Naive<dim, Kind::uGIMP>>(state, scene);
    if (shape == "cpGIMP")
        return std::make_unique<Naive<dim, Kind::cpGIMP>>(state, scene);
    throw InputError("the naive step has no shape '" + shape + "', allowed linear, uGIMP or cpGIMP");
}
} // namespace

bool naiveKnows(const std::string& shape)
{
    return shape == "linear" || shape == "uGIMP" || shape == "cpGIMP";
}

std::unique_ptr<NaiveStepper> makeNaiveStepper(const std::string& shape, const state::State& state,
                                               const stepping::Scene& scene)
{
    if (scene.splitting || scene.relaxationTime || scene.localDamping || scene.merging || scene.bulkViscosity ||
        scene.bodyForce || !scene.loads.empty() || scene.materials.size() != 1)
        throw InputError(
            "the naive step knows one material, no splitting, damping, tractions or prescribed body forces");
    return state.particles.dim == 2 ? make<2>(shape, state, scene) : make<3>(shape, state, scene);
}
} // namespace mpm::benchmark
