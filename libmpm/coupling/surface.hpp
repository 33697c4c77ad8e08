#pragma once
/// One coupling surface of a participant while it runs: where a master says it is (samples), what moves in the soil's
/// steps (a rigid body, a deformable body, a carried surface), and what came of it (impulses at vertices, sums).
///
/// A step of dt: place() before it, collect() after it. A body goes from where it is to where the samples say it is at
/// the end of the step, at the one velocity that takes it there; impulses J of nodes go to the vertices of the nearest
/// element by the weights of the foot point: J_v = sum w_v J. Force = - sum J_v/dt, traction its share of the vertex'
/// area.
///
/// Contact area: elements are cut into pieces no shorter than a cell; a piece that a pressed node's foot lies on
/// counts. Stress of a Monitor at x: sum_p w V sigma/sum_p w V, w the hat of width h around x.
#include "coupling/mapping.hpp"
#include "coupling/participant.hpp"
#include "coupling/poseSamples.hpp"
#include "nodal/carriedSurface.hpp"
#include "stepping/stepper.hpp"

#include <optional>

namespace mpm::coupling
{
class Surface
{
  public:
    /// CouplingError (badSurface).
    Surface(std::string name, SurfaceMesh mesh, SurfaceKind kind, const SurfaceOptions& options);

    const std::string& name() const { return name_; }
    SurfaceKind kind() const { return kind_; }
    const SurfaceMesh& mesh() const { return mesh_; }
    /// The mesh fields are exchanged on.
    const SurfaceMesh& exchanged() const { return partner_ ? partner_->mesh : mesh_; }
    const Vector3& reference() const { return reference_; }
    std::vector<Field> fields() const { return fieldsOf(kind_, mesh_.dim); }
    /// CouplingError (unknownField) unless the surface has it in that direction.
    Field field(FieldName name, std::optional<Direction> direction = {}) const;
    std::size_t valueCount(const Field& field) const;

    void setInterpolation(const Field& field, Interpolation interpolation);
    void setPartner(SurfaceMesh mesh, MappingMethod method);
    /// Adds itself to a scene. CouplingError (badSurface): outside the grid, thinner than a cell, periodic grid.
    void enter(const state::State& state, stepping::Scene& scene);
    /// Before the first step: where a sample of this time says. CouplingError (badSurface) inside the soil.
    void startAt(const state::State& state);

    void write(const Field& field, std::span<const double> values, double time);
    /// CouplingError (jump), (badSurface) for a deformed surface that holds no volume.
    void place(double time, double dt, double h);
    void collect(double time, double dt, double h);
    void beginWindow();
    /// The window is over: samples before `time` are forgotten.
    void endWindow(double time);

    void read(const Field& field, const state::State& state, std::span<double> out) const;
    void average(const Field& field, std::span<double> out) const;
    Resultants resultants() const;
    double work() const { return now_.work; }
    /// As it is now (coupling/exportSurface.hpp); with its fields where there is a state.
    void exportTo(const std::filesystem::path& file, const state::State* state) const;
    /// Where the vertices are now.
    std::vector<Vector3> points() const;

    std::vector<std::byte> save() const;
    /// CouplingError (badState) for bytes that are none of this surface's; then nothing is changed.
    void load(std::span<const std::byte> bytes);
    void requireOwn(std::span<const std::byte> bytes) const { parse(bytes); }
    /// Force of the last exchange, summed before and after the mapping.
    const std::array<Vector3, 2>& mappedSums() const { return sums_; }

  private:
    struct Partner
    {
        SurfaceMesh mesh;
        Mapping toOwn, fromOwn;
    };
    /// All that changes, and goes into a snapshot.
    struct Now
    {
        PoseSamples pose;
        Samples displacement, velocity, force, traction;
        nodal::Pose place;                          ///< rigid
        nodal::Twist twist;                         ///< of the last step
        std::vector<double> points, velocities;     ///< of vertices, where it is not rigid
        std::vector<double> impulse, windowImpulse; ///< on the soil, at vertices [N s]: last step, window
        std::vector<double> area;                   ///< in contact, at vertices
        Vector3 onSurface{}, torque{};              ///< force and torque of the last step
        Vector3 sumImpulse{}, sumMoment{};          ///< on the surface in the window
        double step = 0, window = 0, work = 0;      ///< [s], [s], [J]
    };
    Now parse(std::span<const std::byte>& bytes) const;
    bool rigid() const { return kind_ == SurfaceKind::Rigid; }
    void moveBody(double dt);
    void findArea(const std::vector<nodal::SurfaceImpulse>& impulses, double h);
    void refuseInsideSoil(const state::State& state) const;
    std::vector<double> own(const Field& field, const state::State& state) const;
    std::vector<double> tractions(const std::vector<double>& impulse, double time) const;
    void stressAt(const state::State& state, std::vector<double>& out) const;
    void give(const Field& field, const std::vector<double>& own, std::span<double> out) const;
    SurfaceMesh meshNow() const;

    std::string name_;
    SurfaceMesh mesh_;
    SurfaceKind kind_;
    SurfaceOptions options_;
    Vector3 reference_{};
    std::optional<Partner> partner_;
    std::shared_ptr<nodal::RigidBody> rigid_;
    std::shared_ptr<nodal::DeformableBody> deformable_;
    std::shared_ptr<nodal::CarriedSurface> carried_;
    Now now_;
    mutable std::array<Vector3, 2> sums_{};
};
} // namespace mpm::coupling
