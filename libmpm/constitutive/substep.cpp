#include "constitutive/substep.hpp"

#include "constitutive/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
constexpr int mostParts = 2048;

template <int dim>
using Stress = StressLanes<dim>;

template <int dim>
double normOf(const Stress<dim>& s, int l)
{
    double sum = 0;
    for (int k = 0; k < stressSize<dim>; ++k)
        sum += (k < 3 ? 1 : 2) * s[k][l] * s[k][l];
    return std::sqrt(sum);
}

template <int dim>
double distanceOf(const Stress<dim>& a, const Stress<dim>& b, int l)
{
    double sum = 0;
    for (int k = 0; k < stressSize<dim>; ++k)
        sum += (k < 3 ? 1 : 2) * (a[k][l] - b[k][l]) * (a[k][l] - b[k][l]);
    return std::sqrt(sum);
}

/// Cayley's rotation over dt (rotateStress) turns by an angle whose half has the tangent dt |omega|/2.
template <int dim>
double tangentOfHalf(const TensorLanes<dim>& L, double dt, int l)
{
    double square = 0;
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < i; ++j)
        {
            const double q = 0.25 * dt * (L[i * dim + j][l] - L[j * dim + i][l]);
            square += q * q;
        }
    return std::sqrt(square);
}

/// L scaled in each lane so that the rotation turns by a part of its angle.
template <int dim>
void partOfRotation(const TensorLanes<dim>& L, double dt, int parts, TensorLanes<dim>& out)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double q = tangentOfHalf<dim>(L, dt, l);
        const double scale = q > 1e-8 ? std::tan(std::atan(q) / parts) / q : 1.0 / parts;
        for (int k = 0; k < dim * dim; ++k)
            out[k][l] = scale * L[k][l];
    }
}

template <int dim>
void copyStress(const Stress<dim>& from, Stress<dim>& to)
{
    std::copy(&from[0][0], &from[0][0] + stressSize<dim> * lanes, &to[0][0]);
}

/// 1/2 (start + end) : C^-1 (trial - end).
template <int dim>
void plasticWork(const Stress<dim>& start, const Stress<dim>& trial, const ElasticModuli& moduli, Chunk<dim>& chunk)
{
    const double invTwoG = 1 / (2 * moduli.shear()), invK = 1 / moduli.bulk();
    for (int l = 0; l < lanes; ++l)
    {
        double middle[stressSize<dim>], lost[stressSize<dim>];
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            middle[k] = 0.5 * (start[k][l] + chunk.stress[k][l]);
            lost[k] = trial[k][l] - chunk.stress[k][l];
        }
        const double middleMean = (middle[0] + middle[1] + middle[2]) * (1.0 / 3);
        const double lostMean = (lost[0] + lost[1] + lost[2]) * (1.0 / 3);
        double shear = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
            shear += k < 3 ? (middle[k] - middleMean) * (lost[k] - lostMean) : 2 * middle[k] * lost[k];
        chunk.plasticWork[l] = shear * invTwoG + middleMean * lostMean * invK;
    }
}

template <int dim>
class Parts
{
  public:
    Parts(Chunk<dim>& chunk, const Substep& substep, double scale, const std::function<void(Chunk<dim>&)>& plain)
        : chunk_(chunk), tolerance_(substep.tolerance), scale_(scale), plain_(plain)
    {
        copyStress<dim>(chunk.stress, start_);
        if (chunk.L)
            rotateStress(*chunk.L, -chunk.dt, start_); // the inverse, exactly: Cayley of -W
    }

    /// The step cut in `parts`, into part_; apex_ sums what returns to the apex dropped.
    void run(int parts)
    {
        part_.count = chunk_.count;
        part_.F = nullptr;
        part_.L = nullptr;
        copyStress<dim>(start_, part_.stress);
        alignas(64) double dStrain[stressSize<dim>][lanes];
        for (int k = 0; k < stressSize<dim>; ++k)
            for (int l = 0; l < lanes; ++l)
                dStrain[k][l] = chunk_.dStrain[k][l] / parts;
        if (chunk_.L)
            partOfRotation<dim>(*chunk_.L, chunk_.dt, parts, turn_);
        std::fill_n(apex_, lanes, 0.0);
        for (int n = 0; n < parts; ++n)
        {
            if (chunk_.L)
                rotateStress(turn_, chunk_.dt, part_.stress);
            copyStress<dim>(dStrain, part_.dStrain);
            plain_(part_);
            for (int l = 0; l < lanes; ++l)
                apex_[l] += part_.apexStrain[l];
        }
        calls_ += parts;
    }

    /// chunk_ holds the whole step, `turned` and `trial` the stresses before and after its strain. Which lanes need
    /// parts?
    bool look(const Stress<dim>& turned, const Stress<dim>& trial)
    {
        bool any = false;
        for (int l = 0; l < lanes; ++l)
        {
            const double turn = chunk_.L ? 2 * tangentOfHalf<dim>(*chunk_.L, chunk_.dt, l) : 0;
            const bool straight = 0.5 * turn * distanceOf<dim>(turned, trial, l) <=
                                  tolerance_ * std::max(normOf<dim>(chunk_.stress, l), scale_);
            open_[l] = chunk_.region[l] != Region::elastic || !straight;
            any = any || (open_[l] && l < chunk_.count);
        }
        return any;
    }

    /// Doubles the parts until all lanes are done.
    void refine()
    {
        bool done[lanes];
        for (int l = 0; l < lanes; ++l)
            done[l] = !open_[l];
        alignas(64) Stress<dim> last, estimate, next;
        copyStress<dim>(chunk_.stress, last);
        bool first = true;
        for (int parts = 2; parts <= mostParts && !std::all_of(done, done + chunk_.count, [](bool d) { return d; });
             parts *= 2)
        {
            run(parts);
            for (int k = 0; k < stressSize<dim>; ++k)
                for (int l = 0; l < lanes; ++l)
                    next[k][l] = 2 * part_.stress[k][l] - last[k][l];
            copyStress<dim>(part_.stress, last);
            for (int l = 0; l < lanes; ++l)
            {
                if (done[l])
                    continue;
                for (int k = 0; k < stressSize<dim>; ++k)
                    chunk_.stress[k][l] = next[k][l];
                chunk_.apexStrain[l] = apex_[l];
                chunk_.region[l] = part_.region[l];
                done[l] =
                    !first && distanceOf<dim>(next, estimate, l) <= tolerance_ * std::max(normOf<dim>(next, l), scale_);
            }
            copyStress<dim>(next, estimate);
            first = false;
        }
    }

    int calls() const { return calls_; }

    /// Extrapolated stresses go back to the surface.
    void close()
    {
        copyStress<dim>(chunk_.stress, part_.stress);
        for (int k = 0; k < stressSize<dim>; ++k)
            std::fill_n(part_.dStrain[k], lanes, 0.0);
        plain_(part_);
        ++calls_;
        for (int l = 0; l < lanes; ++l)
            if (open_[l])
            {
                for (int k = 0; k < stressSize<dim>; ++k)
                    chunk_.stress[k][l] = part_.stress[k][l];
                chunk_.yield[l] = part_.yield[l];
            }
    }

  private:
    Chunk<dim>& chunk_;
    const double tolerance_, scale_;
    const std::function<void(Chunk<dim>&)>& plain_;
    Chunk<dim> part_;
    alignas(64) Stress<dim> start_; ///< before the step's rotation
    alignas(64) TensorLanes<dim> turn_;
    alignas(64) double apex_[lanes];
    bool open_[lanes]; ///< lanes that need parts
    int calls_ = 1;
};
} // namespace

std::optional<Substep> readSubstep(const dictionary::Dictionary& material)
{
    const auto* d = material.findDict("substep", "parts of a step, as many as the error asks for; absent: none");
    if (!d)
        return std::nullopt;
    return Substep{d->get<double>({"tolerance", "relative error of the stress at the end of a step",
                                   dictionary::unit::none, dictionary::Bound::between(1e-10, 0.1), 1e-4})};
}

std::string describeSubstep(const std::optional<Substep>& substep)
{
    return substep ? fmt::format(", substep tolerance {:g}", substep->tolerance) : std::string();
}

template <int dim>
void updateInParts(Chunk<dim>& chunk, const Substep& substep, const ElasticModuli& moduli, double scale,
                   const std::function<void(Chunk<dim>&)>& plain)
{
    alignas(64) Stress<dim> turned, trial;
    copyStress<dim>(chunk.stress, turned);
    elasticTrial<dim>(chunk, moduli, trial);
    Parts<dim> parts(chunk, substep, scale, plain);
    plain(chunk);
    chunk.parts = 1;
    if (!parts.look(turned, trial))
        return;
    parts.refine();
    parts.close();
    plasticWork<dim>(turned, trial, moduli, chunk);
    chunk.parts = parts.calls();
    chunk.apexReturns = int(std::count(chunk.region, chunk.region + chunk.count, Region::apex));
}

template void updateInParts<2>(Chunk<2>&, const Substep&, const ElasticModuli&, double,
                               const std::function<void(Chunk<2>&)>&);
template void updateInParts<3>(Chunk<3>&, const Substep&, const ElasticModuli&, double,
                               const std::function<void(Chunk<3>&)>&);
} // namespace mpm::constitutive
