#pragma once
/// The interface of a material law: stress update of one chunk of particles in the co-rotated frame.
///
/// The stepper has rotated the stress by dR (METHOD: dR = (I - dt W/2)^-1 (I + dt W/2)); the law adds C : dStrain and
/// returns to its yield surface. One virtual call per chunk, a vector loop over lanes inside: no branch per particle.
/// A hyperelastic law makes the stress anew from the deformation gradient instead.
///
/// To add a law: one header with its equation and a dictionary example, one source, one line in lawCatalogue.cpp, one
/// unit test.
#include "constitutive/kinematics.hpp"
#include "dictionary/dictionary.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mpm::constitutive
{
/// What the return map did to a lane. Edges by sorted principal stresses s1 >= s2 >= s3.
enum class Region : Index
{
    elastic, ///< inside the surface: the trial stress, bitwise
    face,    ///< one plane
    edge1,   ///< s1 = s2 (l1, triaxial compression)
    edge2,   ///< s2 = s3 (l2, triaxial extension)
    apex,
    tension ///< the limit of tension, alone or with others
};

/// "elastic", "face", "edge s1=s2 (l1)", "edge s2=s3 (l2)", "apex", "tension limit".
const char* regionName(Region region);

/// One chunk of particles. All 64 lanes hold finite numbers; lanes from `count` on are copies that nobody reads back.
template <int dim>
struct Chunk
{
    static constexpr int nc = stressSize<dim>;
    int count = lanes;
    alignas(64) double stress[nc][lanes];  ///< in: rotated stress at the start; out: stress at the end of the step [Pa]
    alignas(64) double dStrain[nc][lanes]; ///< strain increment dt D, tensor components (zz = 0 in plane strain) [-]
    /// in and out: the history of a law that usesHistory() [-]; else not looked at
    alignas(64) double plasticStrain[lanes] = {};
    const TensorLanes<dim>* F = nullptr; ///< in: deformation gradient at the end of the step; hyperelastic laws need it
    /// in: velocity gradient and length of the step `stress` has been turned over; laws in sub-steps (substep.hpp) look
    /// at it. Null: the stress has not been turned.
    const TensorLanes<dim>* L = nullptr;
    double dt = 0;
    /// out: plastic work (sigma_start + sigma_end)/2 : dEps_p per current volume [J/m^3], so that elastic + plastic
    /// adds up to the work of the mid-step stress
    alignas(64) double plasticWork[lanes];
    /// out: volumetric plastic strain the return to the apex drops beyond what the flow rule allows [-]; 0 elsewhere.
    /// At psi = 0 that is all of it; for psi > 0 every apex return has multipliers >= 0, so nothing is dropped.
    alignas(64) double apexStrain[lanes];
    /// out: f/max(|sigma|, strength scale) of the returned principal stresses [-]; <= 0 inside (0 where the whole chunk
    /// is too far inside for a return), round-off on the surface
    alignas(64) double yield[lanes];
    alignas(64) Region region[lanes]; ///< out: where each lane ended
    int apexReturns = 0;              ///< out: lanes below `count` that ended at the apex
    int parts = 1;                    ///< out: how often the law was evaluated (laws in sub-steps)
};

class Hyperelastic;

class Law
{
  public:
    virtual ~Law() = default;

    virtual std::string name() const = 0;
    /// One line for the banner: parameters with units.
    virtual std::string describe() const = 0;

    virtual void update(Chunk<2>& chunk) const = 0;
    virtual void update(Chunk<3>& chunk) const = 0;

    /// Elastic moduli at rest [Pa], for wave speeds and elastic energy.
    virtual double bulkModulus() const = 0;
    virtual double shearModulus() const = 0;
    /// P-wave modulus K + 4/3 G [Pa].
    double waveModulus() const { return bulkModulus() + 4.0 / 3.0 * shearModulus(); }
    /// nu = (3K - 2G)/(2(3K + G)).
    double poissonRatio() const
    {
        return (3 * bulkModulus() - 2 * shearModulus()) / (2 * (3 * bulkModulus() + shearModulus()));
    }
    /// Can the law yield at all? (The monitor asks.)
    virtual bool plastic() const { return false; }
    /// Does the law read and write Chunk::plasticStrain? Then particles carry it (Particles::plasticStrain).
    virtual bool usesHistory() const { return false; }
    /// The cell size [m] of the grid the law works on, told once before the first step to laws whose history depends on
    /// it (softening.hpp).
    virtual void regularise(double) {}
    /// Into chunk.yield: what update() reports of the stress it leaves, of chunk.stress as it stands. Nothing else
    /// changes. For judging stored stresses; no step asks.
    virtual void reportYield(Chunk<2>& chunk) const { std::fill_n(chunk.yield, lanes, 0.0); }
    virtual void reportYield(Chunk<3>& chunk) const { std::fill_n(chunk.yield, lanes, 0.0); }
    /// The largest mean stress the law can carry, that of its apex [Pa]; infinity without one.
    virtual double tensionLimit() const { return std::numeric_limits<double>::infinity(); }
    /// Does the flow rule make volume?
    virtual bool dilates() const { return false; }
    /// Does a return to the apex drop volume (Chunk::apexStrain), of which one may ask where it is?
    virtual bool dropsApexVolume() const { return false; }
    /// Does it move as prescribed (rigid.hpp)?
    virtual bool rigid() const { return false; }
    /// The law if its stress is a function of the deformation gradient, else null.
    virtual const Hyperelastic* hyperelastic() const { return nullptr; }
};

/// A law whose stress follows from a strain energy W(F) per initial volume: sigma = dW/dF F^T/det F. Reads Chunk::F,
/// and neither the stress at the start nor the strain increment; nothing drifts, and no stress is left where F = I.
class Hyperelastic : public Law
{
  public:
    const Hyperelastic* hyperelastic() const final { return this; }

    /// W(F) [J/m^3] in every lane.
    virtual void strainEnergy(const TensorLanes<2>& F, double (&energy)[lanes]) const = 0;
    virtual void strainEnergy(const TensorLanes<3>& F, double (&energy)[lanes]) const = 0;
    /// A bound of the fastest wave in the deformed body: its speed in space squared over waveModulus()/rho_0, that is
    /// the largest eigenvalue of Q_ac = d^2W/(dF_aB dF_cD) m_B m_D, m = F^T n, over unit vectors n, over waveModulus().
    virtual void waveFactor(const TensorLanes<2>& F, double (&factor)[lanes]) const = 0;
    virtual void waveFactor(const TensorLanes<3>& F, double (&factor)[lanes]) const = 0;
};

/// What elastic laws report of plasticity: nothing.
template <int dim>
void reportElastic(Chunk<dim>& chunk)
{
    std::fill_n(chunk.plasticWork, lanes, 0.0);
    std::fill_n(chunk.apexStrain, lanes, 0.0);
    std::fill_n(chunk.yield, lanes, 0.0);
    std::fill_n(chunk.region, lanes, Region::elastic);
    chunk.apexReturns = 0;
}

/// 1/2 sigma : C^-1 : sigma of an isotropic elastic solid [J/m^3]; components in storage order (4 or 6).
template <int dim>
double elasticEnergyDensity(const double (&sigma)[stressSize<dim>], double bulk, double shear)
{
    const double p = (sigma[0] + sigma[1] + sigma[2]) / 3;
    double ss = 0;
    for (int k = 0; k < 3; ++k)
        ss += (sigma[k] - p) * (sigma[k] - p);
    for (int k = 3; k < stressSize<dim>; ++k)
        ss += 2 * sigma[k] * sigma[k];
    return p * p / (2 * bulk) + ss / (4 * shear);
}

/// The laws there are: name and one line of help.
const std::vector<dictionary::Choice>& lawCatalogue();

/// Makes the law a material dictionary names (`law mohrCoulomb; E ...;`) and reads its parameters.
/// Throws InputError for unknown names, missing or impossible values.
std::unique_ptr<Law> makeLaw(const dictionary::Dictionary& material);
} // namespace mpm::constitutive
