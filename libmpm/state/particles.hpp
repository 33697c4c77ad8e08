#pragma once
/// The particles: a structure of arrays. Arrays of one particle field and component are contiguous ("columns") and
/// padded to a whole number of chunks, so that kernels may touch all 64 lanes of the last chunk.
///
/// The padding lanes hold a copy of the last particle with mass and volume zero; padLastChunk() renews them.
#include "base/alignedVector.hpp"
#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mpm::state
{
template <class T>
using Column = AlignedVector<T>;

/// order[i]: the particle that belongs at place i. 32 bits are enough for a terabyte of particles.
using Order = AlignedVector<std::uint32_t>;

struct Particles;

/// A column of one number a particle that only some scenes need (Particles::optionalColumns).
struct OptionalColumn
{
    Column<double> Particles::*column;
    const char* name; ///< in state.h5: /particles/<name>
    const char* unit;
};

/// What velocity, stress, deformation gradient and initial lengths are stored as: the CMake option MPM_STORAGE, double
/// or float. Floats halve what a pass reads and writes of them. All arithmetic is in doubles; positions, masses and
/// volumes stay doubles, because positions change by far less than they are and mass and volume are conserved. A float
/// has 24 bits: a strain increment below 3e-8 leaves F ~ 1 as it was (stresses follow increments down to 6e-8 of
/// themselves).
#ifdef MPM_STORAGE_FLOAT
using Stored = float;
#else
using Stored = double;
#endif

struct Particles
{
    explicit Particles(int dimension = 2);

    int dim = 2;

    std::array<Column<double>, 3> x;      ///< position of the centre [m]
    std::array<Column<Stored>, 3> v;      ///< velocity [m/s]
    std::array<Column<Stored>, 6> stress; ///< Cauchy stress, stressNames order [Pa]
    std::array<Column<Stored>, 9> F;      ///< deformation gradient, dim x dim row by row [-]
    /// Lengths of the initial edge vectors [m]. The seeding lattice follows the axes, so edge k starts as
    /// l0_k = length0[k] e_k; the deformed edge is F l0_k = length0[k] times column k of F. Splitting halves it.
    std::array<Column<Stored>, 3> length0;
    Column<double> mass;             ///< [kg], per metre in 2D
    Column<double> volume0;          ///< initial volume [m^3], m^2 in 2D
    Column<double> volume;           ///< current volume V = V0 det F
    Column<std::int64_t> id;         ///< immutable; children of a split get new ids, the first child keeps its parent's
    Column<std::int64_t> sortKey;    ///< cell key at the last sort; (sortKey, id) is the order in memory
    Column<std::int32_t> material;   ///< index into State::materials
    Column<std::int32_t> generation; ///< number of splits behind the particle

    // Absent (no memory, no bytes in a file) unless a case asks for them.
    std::array<Column<double>, 3> X; ///< position at the start, the material point a particle follows [m]
    /// Affine part of the velocity near the particle, v(x) = v_p + C (x - x_p): dim x dim row by row [1/s], what the
    /// transfers APIC and TPIC carry.
    std::array<Column<double>, 9> affine;
    Column<double> tensionGap;    ///< volumetric strain a particle is open by (treatment/tensionGap.hpp) [-]
    Column<double> dilationRate;  ///< plastic part of tr D in the last step (treatment/volumetricAveraging.hpp) [1/s]
    Column<double> flowMemory;    ///< 1 where the law yields, fading (treatment/stressRelaxation.hpp) [-]
    Column<double> quietLooks;    ///< looks in a row at which a particle's tile was quiet (stepping/rest.hpp) [-]
    Column<double> viscousStress; ///< normal stress that only forces see (treatment/volumetricAveraging.hpp) [Pa]
    Column<double> plasticStrain; ///< kappa, history of laws that soften (constitutive/softening.hpp) [-]
    Column<double> bulkViscousStress; ///< the same of bulk viscosity (treatment/bulkViscosity.hpp) [Pa]
    /// Of a later child of a split: the id of the first, which is that of the parent, + 1; 0 where there is none
    /// (splitting/mergeParticles.hpp).
    Column<double> family;

    /// All of these, in the order of files. A new one is a member above and a line in particles.cpp: memory, files,
    /// sorting, splitting and predictions of cost follow this list.
    static constexpr std::size_t optionals = 8;
    static const std::array<OptionalColumn, optionals>& optionalColumns();
    /// Is the column in use?
    bool has(Column<double> Particles::*column) const;
    /// Adds the column, zero, or takes it away; does nothing where that is so already.
    void keep(Column<double> Particles::*column, bool keep);

    bool hasX() const { return hasX_; }
    bool hasAffine() const { return hasAffine_; }
    /// Adds the columns of X: the positions as they are.
    void enableX();
    /// Adds the columns of the affine part: zero.
    void enableAffine();
    /// Takes them away again.
    void disableAffine();

    Index size() const { return size_; }
    Index chunks() const { return (size_ + lanes - 1) / lanes; }

    /// New particles are zero, with F = I.
    void resize(Index n);
    void padLastChunk();
    /// Reorders all columns: new[i] = old[order[i]].
    void permute(Order order);
    void permute(const std::vector<Index>& order);
    /// Appends a copy of particle i and returns its index.
    Index appendCopy(Index i);

    /// Calls visit(column) for every column in use (all element types).
    template <class Visitor>
    void forEachColumn(Visitor&& visit)
    {
        for (int k = 0; k < dim; ++k)
        {
            visit(x[k]);
            visit(v[k]);
            visit(length0[k]);
        }
        for (int k = 0; k < stressComponents(dim); ++k)
            visit(stress[k]);
        for (int k = 0; k < dim * dim; ++k)
            visit(F[k]);
        visit(mass);
        visit(volume0);
        visit(volume);
        visit(id);
        visit(sortKey);
        visit(material);
        visit(generation);
        for (int k = 0; k < dim && hasX_; ++k)
            visit(X[k]);
        for (int k = 0; k < dim * dim && hasAffine_; ++k)
            visit(affine[k]);
        for (std::size_t k = 0; k < optionals; ++k)
            if (has_[k])
                visit(this->*optionalColumns()[k].column);
    }

  private:
    bool hasX_ = false, hasAffine_ = false;
    std::array<bool, optionals> has_{};
    Index size_ = 0;
};
} // namespace mpm::state
