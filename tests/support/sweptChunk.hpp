#pragma once
/// A chunk of particles on its way around the law, and what that has to leave: the functions of
/// constitutive/kinematics.hpp one after the other, and linear elasticity.
#include "constitutive/motion.hpp"
#include "stepping/strainSweep.hpp"

#include <algorithm>
#include <random>

namespace sweeps
{
using namespace mpm;
using constitutive::TakenOver;
using stepping::StrainStep;

inline constexpr double E = 1e6, nu = 0.3;
inline constexpr int unused = 3; ///< numbers before and behind those of the particles, no multiple of a cache line

struct Numbers
{
    explicit Numbers(unsigned seed) : random(seed) {}
    double operator()(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }
    std::mt19937 random;
};

/// The columns of particles, with others' in front and behind.
struct Column
{
    double values[unused + lanes + unused];
    double* data() { return values + unused; }

    void fill(Numbers& any, double mean, double size)
    {
        for (double& value : values)
            value = mean + any(size);
    }
};

template <int dim>
struct Case
{
    static constexpr int nc = stressSize<dim>, nn = dim * dim;
    double dt = 0.5;
    int count;
    bool large;
    StrainStep step;
    constitutive::TensorLanes<dim> L;
    Column F[nn], stress[nc], volume, volume0;
    alignas(64) constitutive::StressLanes<dim> preparedStress, preparedStrain;
    alignas(64) double preparedWork[lanes];

    Case(int particles, bool isLarge, TakenOver takenOver, bool prepared, bool keeps, bool plastic)
        : count(particles), large(isLarge), step{takenOver, dt, prepared, keeps, plastic}
    {
        Numbers any(7);
        for (auto& row : L)
            for (double& value : row)
                value = any(large ? 0.3 : constitutive::smallMotion<dim> / 1.06 / dt); // sweeps ask for some room
        for (int k = 0; k < nn; ++k)
            F[k].fill(any, k % (dim + 1) == 0 ? 1 : 0, 0.2);
        for (auto& column : stress)
            column.fill(any, 0, 1e4);
        volume.fill(any, 2, 0.5);
        volume0.fill(any, 2, 0.5);
        for (int k = 0; k < nc; ++k)
            for (int l = 0; l < lanes; ++l)
            {
                preparedStress[k][l] = any(1e4);
                preparedStrain[k][l] = dim == 2 && k == 2 ? 0 : any(1e-3); // plane strain
            }
        for (double& value : preparedWork)
            value = any(1e2);
        for (auto& row : L) // lanes beyond the particles are copies
            std::fill(row + count, row + lanes, row[count - 1]);
    }
    bool whole() const { return count == lanes; }
};

/// What the sweeps have to find, one function after the other.
template <int dim>
struct Expected
{
    static constexpr int nc = stressSize<dim>, nn = dim * dim;
    alignas(64) constitutive::TensorLanes<dim> L, F;
    alignas(64) constitutive::StressLanes<dim> start, turned, end, strain, strainOfForces;
    double J[lanes], before[lanes], after[lanes], workBefore[lanes], workAfter[lanes], energyBefore[lanes],
        energyAfter[lanes], missed[lanes];

    explicit Expected(const Case<dim>& of)
    {
        Case<dim> c = of;
        const auto take = [&](Column& column, double(&lane)[lanes]) {
            for (int l = 0; l < lanes; ++l)
                lane[l] = column.data()[std::min(l, c.count - 1)];
        };
        for (int k = 0; k < nn; ++k)
        {
            take(c.F[k], F[k]);
            std::copy_n(c.L[k], lanes, L[k]);
        }
        for (int k = 0; k < nc; ++k)
            take(c.stress[k], start[k]);
        take(c.volume, before);
        take(c.volume0, after);
        constitutive::strainIncrement(L, c.dt, strainOfForces);
        if (c.step.prepared)
        {
            std::copy_n(&c.preparedStress[0][0], nc * lanes, &start[0][0]);
            std::copy_n(&c.preparedStrain[0][0], nc * lanes, &strainOfForces[0][0]);
        }
        work(start, strainOfForces, workBefore);
        if (c.step.prepared)
            std::copy_n(c.preparedWork, lanes, workBefore);
        energy(start, energyBefore);
        constitutive::toMidStep(c.step.takenOver, c.dt, L);
        constitutive::strainIncrement(L, c.dt, strain);
        constitutive::rotateStress(L, 0.5 * c.dt, strain);
        std::copy_n(&start[0][0], nc * lanes, &turned[0][0]);
        constitutive::rotateStress(L, c.dt, turned);
        constitutive::advanceDeformation(L, c.dt, F);
        constitutive::determinant(F, J);
        for (int l = 0; l < lanes; ++l)
        {
            before[l] = l < c.count ? before[l] : 0;
            after[l] = l < c.count ? after[l] * J[l] : 0;
        }
        addElastic();
    }

    /// Linear elasticity: its energy changes by the work of the mean stress.
    void addElastic()
    {
        const double lame = E * nu / ((1 + nu) * (1 - 2 * nu)), shear = E / (2 * (1 + nu));
        double workTurned[lanes], workEnd[lanes];
        for (int l = 0; l < lanes; ++l)
            for (int k = 0; k < nc; ++k)
                end[k][l] = turned[k][l] + 2 * shear * strain[k][l] +
                            (k < 3 ? lame * (strain[0][l] + strain[1][l] + strain[2][l]) : 0);
        energy(end, energyAfter);
        work(end, strainOfForces, workAfter);
        work(turned, strain, workTurned);
        work(end, strain, workEnd);
        for (int l = 0; l < lanes; ++l) // energyBudget.hpp
            missed[l] = 0.5 * (energyBefore[l] + energyAfter[l]) * (after[l] - before[l]) +
                        0.25 * (before[l] + after[l]) * (workTurned[l] + workEnd[l]) - 0.5 * before[l] * workBefore[l];
    }

    static void work(const constitutive::StressLanes<dim>& s, const constitutive::StressLanes<dim>& e,
                     double (&density)[lanes])
    {
        for (int l = 0; l < lanes; ++l)
        {
            density[l] = 0;
            for (int k = 0; k < nc; ++k)
                density[l] += (k < 3 ? 1 : 2) * s[k][l] * e[k][l];
        }
    }
    static void energy(const constitutive::StressLanes<dim>& s, double (&density)[lanes])
    {
        for (int l = 0; l < lanes; ++l)
        {
            double sigma[nc];
            for (int k = 0; k < nc; ++k)
                sigma[k] = s[k][l];
            density[l] = constitutive::elasticEnergyDensity<dim>(sigma, E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu)));
        }
    }
};

/// A chunk as the stepper opens it: whole ones work on the columns, others on copies.
template <int dim>
stepping::StrainColumns<dim> open(Case<dim>& c, stepping::StrainLanes<dim>& chunk, double (&volume0)[lanes])
{
    stepping::StrainColumns<dim> columns;
    for (int k = 0; k < dim * dim; ++k)
    {
        columns.F[k] = transfer::lanesInPlace(c.F[k].data(), c.count, chunk.F[k]);
        std::copy_n(c.L[k], lanes, chunk.L[k]);
    }
    for (int k = 0; k < stressSize<dim>; ++k)
        columns.stress[k] = transfer::lanesInPlace(c.stress[k].data(), c.count, chunk.law.stress[k]);
    columns.volume = c.volume.data();
    columns.volume0 = c.volume0.data();
    if (!c.whole())
    {
        transfer::loadLanesOrZero(c.volume.data(), c.count, chunk.volume);
        transfer::loadLanesOrZero(c.volume0.data(), c.count, volume0);
        columns.volume = chunk.volume;
        columns.volume0 = volume0;
    }
    std::fill_n(chunk.halfOverBulk, lanes, 3 * (1 - 2 * nu) / (2 * E));
    std::fill_n(chunk.quarterOverShear, lanes, 2 * (1 + nu) / (4 * E));
    if (c.step.prepared)
    {
        std::copy_n(&c.preparedStress[0][0], stressSize<dim> * lanes, &chunk.law.stress[0][0]);
        std::copy_n(&c.preparedStrain[0][0], stressSize<dim> * lanes, &chunk.strainOfForces[0][0]);
        std::copy_n(c.preparedWork, lanes, chunk.workOfForces);
    }
    return columns;
}
} // namespace sweeps
