#include "splitting/mergeParticles.hpp"

#include "constitutive/particleEnergy.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mpm::splitting
{
namespace
{
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix gradient(const state::Particles& p, std::size_t i)
{
    Matrix F{};
    for (int a = 0; a < p.dim; ++a)
        for (int k = 0; k < p.dim; ++k)
            F[a][k] = p.F[a * p.dim + k][i];
    if (p.dim == 2)
        F[2][2] = 1;
    return F;
}

double determinant(const Matrix& F)
{
    return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
           F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

/// det F times F^-1 d.
Vector3 adjugateTimes(const Matrix& F, const Vector3& d)
{
    Vector3 out{};
    for (int k = 0; k < 3; ++k)
    {
        Matrix column = F; // Cramer's rule
        for (int a = 0; a < 3; ++a)
            column[a][k] = d[std::size_t(a)];
        out[std::size_t(k)] = determinant(column);
    }
    return out;
}

double edge(const state::Particles& p, std::size_t i, int k)
{
    double square = 0;
    for (int a = 0; a < p.dim; ++a)
        square += double(p.F[a * p.dim + k][i]) * double(p.F[a * p.dim + k][i]);
    return double(p.length0[k][i]) * std::sqrt(square);
}

struct Candidate
{
    std::int64_t cell, id;
    std::size_t i;
    bool along[3]; ///< may it merge along edge k?
};

bool mayMerge(const state::State& s, const MergeRule& rule, std::size_t i, bool (&along)[3])
{
    const auto& p = s.particles;
    double most = 1; // halved edge over the spacing
    for (int k = 0; k < p.dim; ++k)
        most = std::min(most, double(p.length0[k][i]) / s.seedSpacing[k]);
    bool any = false;
    for (int k = 0; k < p.dim; ++k)
    {
        const double length = edge(p, i, k), spacing = s.seedSpacing[k];
        if (length > 2 * rule.threshold * spacing)
            return false;
        along[k] = length < rule.threshold * spacing && double(p.length0[k][i]) < std::min(0.75, 1.5 * most) * spacing;
        any = any || along[k];
    }
    return any;
}

std::int64_t cellOf(const state::State& s, std::size_t i)
{
    std::int64_t cell = 0;
    for (int a = s.particles.dim - 1; a >= 0; --a)
    {
        const double at = std::floor((s.particles.x[a][i] - s.grid.origin[a]) / s.grid.h);
        cell = cell * (s.grid.cells[a] + 2) + std::int64_t(std::clamp(at, -1.0, double(s.grid.cells[a]))) + 1;
    }
    return cell;
}

std::vector<Candidate> candidates(const state::State& s, const MergeRule& rule)
{
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
    {
        Candidate c{0, s.particles.id[i], i, {}};
        if (s.particles.generation[i] == 0 || !mayMerge(s, rule, i, c.along))
            continue;
        c.cell = cellOf(s, i);
        found.push_back(c);
    }
    std::sort(found.begin(), found.end(),
              [](const Candidate& a, const Candidate& b) { return std::tie(a.cell, a.id) < std::tie(b.cell, b.id); });
    return found;
}

/// Later children bear the first one's id, the parent's, in `family`.
bool siblings(const state::Particles& p, std::size_t first, std::size_t second)
{
    if (!p.has(&state::Particles::family))
        return false;
    const double of = p.family[second];
    return of != 0 && (of == p.family[first] || of == double(p.id[first] + 1));
}

struct Pair
{
    bool strangers;
    int axis; ///< along which siblings merge first; all of one family choose alike
    double misfit;
    std::int64_t firstId, secondId;
    std::size_t first, second;
    int k;
    bool operator<(const Pair& o) const
    {
        return std::tie(strangers, axis, misfit, firstId, secondId, k) <
               std::tie(o.strangers, o.axis, o.misfit, o.firstId, o.secondId, o.k);
    }
};

/// Largest distance from an exact fit along edge k, in edges; infinite if the two do not belong together.
double misfit(const state::Particles& p, std::size_t i, std::size_t j, int k, double closeness)
{
    const Matrix A = gradient(p, i), B = gradient(p, j);
    Matrix mean{};
    double difference = 0, size = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
        {
            mean[a][b] = 0.5 * (A[a][b] + B[a][b]);
            difference += (A[a][b] - B[a][b]) * (A[a][b] - B[a][b]);
            size += mean[a][b] * mean[a][b];
        }
    const double J = determinant(mean);
    if (!(J > 0) || difference > closeness * closeness * size)
        return INFINITY;
    Vector3 d{};
    for (int a = 0; a < p.dim; ++a)
        d[std::size_t(a)] = p.x[a][j] - p.x[a][i];
    const Vector3 apart = adjugateTimes(mean, d);
    double worst = 0;
    for (int a = 0; a < p.dim; ++a)
    {
        const double edges = std::abs(apart[std::size_t(a)]) / (J * double(p.length0[a][i]));
        worst = std::max(worst, std::abs(edges - (a == k ? 1 : 0)));
    }
    return worst;
}

/// Pairs of one cell's candidates [begin, end).
std::vector<Pair> pairsOf(const state::State& s, const MergeRule& rule, const Candidate* begin, const Candidate* end)
{
    const auto& p = s.particles;
    std::vector<Pair> pairs;
    for (const Candidate* a = begin; a != end; ++a)
        for (const Candidate* b = a + 1; b != end; ++b)
        {
            bool alike = p.material[a->i] == p.material[b->i];
            for (int k = 0; k < p.dim && alike; ++k)
                alike = std::abs(p.length0[k][a->i] - p.length0[k][b->i]) <= 1e-6 * p.length0[k][a->i];
            if (!alike)
                continue;
            const bool strangers = !siblings(p, a->i, b->i);
            for (int k = 0; k < p.dim; ++k)
                if (a->along[k] && b->along[k])
                    if (const double off = misfit(p, a->i, b->i, k, rule.closeness); off < rule.closeness)
                        pairs.push_back({strangers, strangers ? 0 : k, off, a->id, b->id, a->i, b->i, k});
        }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Moment of momentum m x v about a point (the z component in 2D).
Vector3 angularMomentum(const state::Particles& p, std::size_t i, const Vector3& about)
{
    Vector3 x{}, v{};
    for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
    {
        x[a] = p.x[a][i] - about[a];
        v[a] = p.v[a][i];
    }
    const double m = p.mass[i];
    return {m * (x[1] * v[2] - x[2] * v[1]), m * (x[2] * v[0] - x[0] * v[2]), m * (x[0] * v[1] - x[1] * v[0])};
}

double kineticEnergy(const state::Particles& p, std::size_t i)
{
    double vv = 0;
    for (int a = 0; a < p.dim; ++a)
        vv += double(p.v[a][i]) * double(p.v[a][i]);
    return 0.5 * p.mass[i] * vv;
}

/// F of the two together: the mean by V0, scaled to the determinant (V + V')/(V0 + V0').
void meanGradient(state::Particles& p, std::size_t i, std::size_t j)
{
    const double share = p.volume0[j] / (p.volume0[i] + p.volume0[j]);
    const Matrix A = gradient(p, i), B = gradient(p, j);
    Matrix mean{};
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            mean[a][b] = A[a][b] + share * (B[a][b] - A[a][b]);
    const double J = (p.volume[i] + p.volume[j]) / (p.volume0[i] + p.volume0[j]);
    const double ratio = J / determinant(mean);
    const double scale = ratio == 1 ? 1 : p.dim == 2 ? std::sqrt(ratio) : std::cbrt(ratio);
    for (int a = 0; a < p.dim; ++a)
        for (int k = 0; k < p.dim; ++k)
            p.F[a * p.dim + k][i] = scale * mean[a][k];
}

/// Particle i takes j in.
void merge(state::State& s, std::size_t i, std::size_t j, int k, const constitutive::Law& law)
{
    auto& p = s.particles;
    auto& ledger = s.ledger;
    Vector3 about{}; // near both, so that round-off is of their distance
    for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
        about[a] = p.x[a][i];
    const double kinetic = kineticEnergy(p, i) + kineticEnergy(p, j);
    const double elastic = constitutive::particleEnergy(p, i, law) + constitutive::particleEnergy(p, j, law);
    const Vector3 spinI = angularMomentum(p, i, about), spinJ = angularMomentum(p, j, about);

    const double byMass = p.mass[j] / (p.mass[i] + p.mass[j]), byVolume = p.volume[j] / (p.volume[i] + p.volume[j]);
    const double byVolume0 = p.volume0[j] / (p.volume0[i] + p.volume0[j]);
    const auto take = [&](auto& column, double share) { column[i] += share * (column[j] - column[i]); };
    meanGradient(p, i, j);
    for (int a = 0; a < p.dim; ++a)
    {
        take(p.x[a], byMass);
        take(p.v[a], byMass);
        if (p.hasX())
            take(p.X[a], byVolume0);
    }
    for (int c = 0; c < stressComponents(p.dim); ++c)
        take(p.stress[c], byVolume);
    for (int c = 0; c < p.dim * p.dim && p.hasAffine(); ++c)
        take(p.affine[c], byMass);
    for (const auto& optional : state::Particles::optionalColumns())
        if (p.has(optional.column) && optional.column != &state::Particles::family)
            take(p.*optional.column, byVolume);
    p.mass[i] += p.mass[j];
    p.volume[i] += p.volume[j];
    p.volume0[i] += p.volume0[j];
    p.length0[k][i] *= 2;
    int halvings = 0; // the most that are left of an edge
    for (int a = 0; a < p.dim; ++a)
        halvings = std::max(halvings, int(std::lround(std::log2(s.seedSpacing[a] / double(p.length0[a][i])))));
    p.generation[i] = halvings;

    const double lost = kinetic - kineticEnergy(p, i);
    const Vector3 spin = angularMomentum(p, i, about);
    double change = 0;
    for (std::size_t a = 0; a < 3; ++a)
        change += std::pow(spin[a] - spinI[a] - spinJ[a], 2);
    ledger.kineticEnergy -= lost;
    ledger.splitMergeLoss += lost + elastic - constitutive::particleEnergy(p, i, law);
    ledger.splitAngularMomentum += std::sqrt(change);
    ledger.merges += 1;
}

/// Takes away particles marked as gone; the others keep their order.
void compact(state::Particles& p, const std::vector<char>& gone)
{
    std::vector<Index> order;
    order.reserve(gone.size());
    for (const char out : {0, 1})
        for (std::size_t i = 0; i < gone.size(); ++i)
            if (gone[i] == out)
                order.push_back(Index(i));
    const Index left = Index(std::count(gone.begin(), gone.end(), 0));
    p.permute(order);
    p.resize(left);
    p.padLastChunk();
}
} // namespace

Index mergeParticles(state::State& state, const MergeRule& rule, const std::vector<constitutive::Material>& materials)
{
    const auto found = candidates(state, rule);
    std::vector<char> gone(std::size_t(state.particles.size()), 0), used = gone;
    Index merges = 0;
    for (std::size_t begin = 0, end = 0; begin < found.size(); begin = end)
    {
        while (end < found.size() && found[end].cell == found[begin].cell)
            ++end;
        for (const Pair& pair : pairsOf(state, rule, found.data() + begin, found.data() + end))
        {
            if (used[pair.first] || used[pair.second])
                continue;
            used[pair.first] = used[pair.second] = gone[pair.second] = 1;
            merge(state, pair.first, pair.second, pair.k,
                  *materials[std::size_t(state.particles.material[pair.first])].law);
            ++merges;
        }
    }
    if (merges > 0)
        compact(state.particles, gone);
    return merges;
}
} // namespace mpm::splitting
