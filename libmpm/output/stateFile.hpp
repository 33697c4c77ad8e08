#pragma once
/// state.h5: everything a run needs to go on, one file a time folder. The only way utilities talk to each other.
///
/// Layout, version 2 (HDF5, little-endian, uncompressed, texts of fixed length; N particles, dim 2 or 3, s = 4 or 6
/// stress components xx yy zz xy (yz zx); every dataset carries its unit in the attribute "unit", "1" for numbers):
///
///     /                          attributes format "libmpm state", formatVersion 2, dimension, time [s], step,
///                                deltaT [s], largestJacobian, stepFactor, seedSpacing (3) [m], nextId,
///                                materials (texts)
///     /particles/position        (N, dim)      float64 [m]
///     /particles/velocity        (N, dim)      float64 [m/s]
///     /particles/stress          (N, s)        float64 [Pa], Cauchy, tension positive; attribute components
///     /particles/deformationGradient (N, dim, dim) float64 [1], F_ij at (i, j)
///     /particles/length0         (N, dim)      float64 [m], initial edge lengths; edge k is now length0_k F e_k
///     /particles/mass            (N)           float64 [kg]          (2D: per metre of thickness)
///     /particles/volume0, volume (N)           float64 [m^3]         (2D: m^2)
///     /particles/id, sortKey     (N)           int64                 (sortKey, id) is the order in memory
///     /particles/material, generation (N)      int32
///     /particles/referencePosition (N, dim)    float64 [m], positions at the start; only where a case names them
///     /particles/affine          (N, dim, dim) float64 [1/s], affine velocity, only with APIC and TPIC
///     /particles/tensionGap, dilationRate, flowMemory, viscousStress, quietLooks, plasticStrain (N) float64, those an
///                                              effect in use keeps (state/particles.hpp)
///     /grid/origin (3) [m], /grid/cellSize [m], /grid/cells (3) int64, attributes dimension; periodicX, Y, Z if it is
///     /ledger/<name>             energies [J], impulses (3) [N s], volumes and counts since the start of the run
///     /patches/<name>/centre (n, dim), edges (n, dim (dim - 1)) [m]; attribute index (place in the list)
///     /provenance/<name>         texts
///     /derived/<field>           (N, k) float64, attribute components: fields of the particles made by utilities
///     /derivedNodal/<field>      (nodes, k), and /derivedNodal/position (nodes, dim) [m]
///     /visualisation             float32/int32 copies for ParaView (paraviewSeries.hpp); never read back:
///                                points (N, 3), connectivity (N), velocity (N, 3),
///                                corners (4 N or 8 N, 3), cornerConnectivity (N, 4 or 8), sigma_xx ... (N)
///
/// '/' and '%' in the names of patches and provenance entries are stored as %2F and %25.
///
/// Writing goes through a temporary and a rename (replaceFile.hpp). Reading checks everything: format, version, types,
/// shapes, finite numbers, mass, volume0, volume, length0 > 0, det F > 0, ids unique, >= 0 and < nextId, materials in
/// range; each failure is one InputError with the file and, if there is one, the particle's id.
#include "state/state.hpp"

#include <filesystem>

namespace mpm::output
{
inline constexpr const char* stateFileName = "state.h5";

/// A state on its way to <timeFolder>/state.h5, in a temporary beside it. Making one is all the work that needs the
/// state; commit() waits for the disk and may run in another thread while the state moves on. Without it the temporary
/// goes, and the folder too if it was made for it.
class PendingState
{
  public:
    PendingState(const std::filesystem::path& timeFolder, const state::State& state);
    ~PendingState();
    PendingState(const PendingState&) = delete;
    PendingState& operator=(const PendingState&) = delete;

    void commit();

  private:
    void remove() const;

    std::filesystem::path file_;
    bool folderIsOurs_, committed_ = false;
};

/// Writes <timeFolder>/state.h5, making the folder if needed. Derived fields of an older file are gone.
/// A state that could not be read again (see above) is refused and the old file kept.
void writeState(const std::filesystem::path& timeFolder, const state::State& state);

/// The bare file under exactly this name; an old one is lost.
void writeStateAt(const std::filesystem::path& file, const state::State& state);

/// Does all the work of writing a state but for the disk's, into memory that is given back (as much as the file takes),
/// and returns the size of the file [bytes]: what a state will cost.
double rehearseState(const state::State& state);

/// Reads a state, bitwise as written; particles that are not in the order (sortKey, id) are brought into it.
state::State readState(const std::filesystem::path& file);

/// A field below /derived: its name and one name a column.
struct FieldName
{
    std::string name;
    std::vector<std::string> components;
};

/// The few numbers a listing needs, without reading the arrays.
struct StateSummary
{
    int dim = 2;
    double time = 0; ///< [s]
    Index step = 0;
    Index particles = 0;
    std::vector<FieldName> derived;
    std::string outOfTurn; ///< /provenance/outOfTurn (case/writtenTimes.hpp); empty: there is none
};
StateSummary readSummary(const std::filesystem::path& file);

/// What readState checks, for states from elsewhere; `where` opens the message.
void requireValid(const state::State& state, const std::string& where);
} // namespace mpm::output
