#pragma once
/// A case as one participant of a coupled simulation: a master steps it, rolls it back, and exchanges fields with it on
/// coupling surfaces.
///
///     Created -> initialize() -> Initialized -> advance() -> Stepping -> finalize() -> Finalized
///
///     mpm::Participant soil("cases/columnSpringWall");
///     soil.initialize();
///     while (soil.time() < end)
///     {
///         soil.writeField("wall", FieldName::RigidPose, pose, window);   // where it is at the end of the window
///         soil.advance(window);
///         soil.windowAverage("wall", FieldName::Force, force);           // impulse over window
///         soil.acceptWindow();                                           // only now is anything written to disk
///     }
///
/// Implicit coupling: `const auto start = soil.saveState();` before the window, `soil.restoreState(start)` before each
/// repetition; replays are bitwise.
///
/// Windows. advance(window) takes as many explicit steps as the stability limit (adjustTimeStep yes) or deltaT asks for
/// and lands bitwise on time() + window; the last steps are shortened evenly, so that no step is tiny. The end time of
/// controlDict is not looked at: the master owns it. A window in which the calculation cannot go on is discarded: the
/// participant is back at its start, the message says why.
///
/// Samples. writeField(surface, field, values, relativeTime) says what the field is at time() + relativeTime; what was
/// said for later is dropped, what was said before holds. A surface goes on from where it is; a sample for time()
/// itself before the first advance() puts it there at once. Between samples: constant (the last one not after t),
/// linear, or Hermite, for which written velocities (RigidTwist, Velocity) are the slopes of poses and displacements,
/// and finite differences without them. Rotations go along the shortest arc. A surface with velocities only is moved by
/// their integral. A substep moves the surface by the mean velocity that takes it exactly to where it is said to be.
///
/// Contact. Rigid and Deformable surfaces push soil as nodal/bodyContact.hpp says. The impulse of a node goes to the
/// vertices of the element nearest to it by the weights of its foot point, so that sum of Force . velocity over
/// vertices is the power the soil sees, to round-off (interfaceWork).
///
/// Errors: InputError for the case (file:line), CouplingError for calls; nothing is changed by a call that throws.
/// Not safe for two threads at one participant; several participants in one process are.
/// Verified in tests/unit/participant.cpp, tests/verification (coupled*).
#include "coupling/couplingError.hpp"
#include "coupling/field.hpp"
#include "coupling/mapping.hpp"
#include "coupling/surfaceMesh.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mpm::coupling
{
/// A word of a dictionary with another value than the file's: {"constant/materialProperties", "soil.cohesion", "2e3"}.
struct Setting
{
    std::string file, word, value;
};

enum class Lifecycle
{
    Created,
    Initialized,
    Stepping,
    Finalized
};

enum class Status
{
    reached,  ///< the window's end
    discarded ///< back at its start: `message`
};

struct Advance
{
    double time = 0;    ///< where the participant is now [s]
    Index substeps = 0; ///< taken in this window
    Status status = Status::reached;
    std::string message;
};

/// Of the soil on a surface; per metre in 2D.
struct Resultants
{
    Vector3 force{}, torque{};          ///< means of the last window [N, N m], torque about the reference point
    Vector3 impulse{}, momentImpulse{}; ///< of the last window [N s, N m s]
    double contactArea = 0;             ///< at its end [m^2]
};

/// Sums over the whole soil now [J, N s], from the energy budget (stepping/energyBudget.hpp).
struct Balance
{
    double kineticEnergy = 0, strainEnergy = 0, dissipation = 0, gravityWork = 0;
    double interfaceWork = 0; ///< of all surfaces on the soil since initialize()
    double motionWork = 0;    ///< the same by the soil's own books, with walls and bodies whose motion is prescribed
    double residual = 0;      ///< what the budget does not explain
    Vector3 momentum{};
};

/// A state of a participant: kept in memory, or as bytes.
class Snapshot
{
  public:
    Snapshot() = default;
    bool empty() const { return !held_; }

  private:
    friend class Participant;
    std::shared_ptr<const struct HeldState> held_;
};

/// How a surface touches soil, and where its reference point is.
struct SurfaceOptions
{
    double mu = 0;                     ///< Coulomb friction
    bool separation = true;            ///< false: it also holds
    std::array<double, 3> reference{}; ///< X of the point RigidPose speaks of [m]
    bool referenceIsCentroid = true;   ///< then `reference` is not looked at
};

class Participant
{
  public:
    /// Reads and checks a seeded case: everything but the surfaces added later. threads: 0 takes OpenMP's number.
    explicit Participant(const std::filesystem::path& caseFolder, const std::vector<Setting>& settings = {},
                         int threads = 0);
    ~Participant();
    Participant(Participant&&) noexcept;
    Participant& operator=(Participant&&) noexcept;

    // before initialize()

    /// Surfaces of system/couplingDict are there already (coupling/couplingDict.hpp). mesh: of the surface in its
    /// reference configuration, closed unless it is a Monitor.
    void addCouplingSurface(const std::string& name, SurfaceMesh mesh, SurfaceKind kind,
                            const SurfaceOptions& options = {});
    void setInterpolation(const std::string& surface, FieldName field, Interpolation interpolation);
    /// From now on fields at vertices are exchanged on this mesh: intensive ones mapped consistently, extensive ones
    /// conservatively (coupling/mapping.hpp).
    void setPartnerMesh(const std::string& surface, SurfaceMesh mesh, MappingMethod method);
    void initialize();

    // at any time before finalize()

    Lifecycle lifecycle() const;
    int dimension() const;
    std::vector<std::string> surfaces() const;
    SurfaceKind kind(const std::string& surface) const;
    std::vector<Field> fields(const std::string& surface) const;
    /// In its reference configuration; the partner's, where one was set.
    const SurfaceMesh& mesh(const std::string& surface) const;
    /// X of the point that RigidPose places and torques are about [m].
    Vector3 reference(const std::string& surface) const;
    /// Numbers writeField and readField exchange for a field: components, times vertices.
    std::size_t valueCount(const std::string& surface, FieldName field) const;
    double time() const;

    // from initialize() on

    /// The largest step the scheme may take now [s].
    double stableTimeStep() const;

    void writeField(const std::string& surface, FieldName field, std::span<const double> values,
                    double relativeTime = 0);
    Advance advance(double window);
    /// At time(): forces and tractions of the last substep.
    void readField(const std::string& surface, FieldName field, std::span<double> values) const;
    /// Force, Torque, Traction: impulse of the last window over its length.
    void windowAverage(const std::string& surface, FieldName field, std::span<double> values) const;
    Resultants resultants(const std::string& surface) const;
    /// Work of the surface on the soil since initialize() [J].
    double interfaceWork(const std::string& surface) const;
    Balance balance() const;

    /// All there is, hidden state included. A restored participant goes on bitwise as the saved one did.
    Snapshot saveState() const;
    void restoreState(const Snapshot& snapshot);
    /// Bytes for another process of the same program and case, and back. CouplingError (badState).
    std::vector<std::byte> serialise(const Snapshot& snapshot) const;
    Snapshot deserialise(std::span<const std::byte> bytes) const;

    /// The way since the last accepted window stands: its rows and due states go to disk.
    void acceptWindow();
    /// As it is now: .stl (3D), .vtp or .msh (4.1) by the ending.
    void exportSurface(const std::string& surface, const std::filesystem::path& file) const;
    /// Writes the state of the last accepted window, so that the case can go on from it, and ends.
    void finalize();

  private:
    struct Implementation;
    std::unique_ptr<Implementation> own_;
};
} // namespace mpm::coupling

namespace mpm
{
using coupling::Participant;
}
