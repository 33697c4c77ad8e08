#pragma once
/// A participant run by a coupling library: the loop of preCICE's documentation ("couple your code"), once.
///
///     meshes and initial data, initialize
///     while coupling goes on
///         keep the state where a window starts that may be repeated
///         step = what is left of the window, cut evenly by maxStep
///         read at times within the step; advance the soil; write; advance the library
///         repeat from the kept state, or accept the window: only then is anything written to disk
///
/// What was read at the end of a step stands at the start of the next: surfaces move on from where they are, whatever a
/// converged iteration left between the two sides. At time 0 of the first step the library is asked for initial data.
///
/// Ends: the library says that coupling is over; stop() (a signal); a throw of the library, which is a StepError here
/// (PeerLost: the partner is gone, the configuration is wrong), a discarded window (StepError), values that cannot be
/// (StepError). Whatever ends it, the participant's finalize() has written the last accepted window.
/// Verified in tests/unit/preciceCoupling.cpp.
#include "base/error.hpp"
#include "coupling/participant.hpp"
#include "precice/couplingLibrary.hpp"
#include "precice/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <utility>

namespace mpm::precice
{
/// The library threw: its first line, without the full stop.
class PeerLost : public StepError
{
  public:
    explicit PeerLost(const std::string& what) : StepError("preCICE: " + firstLine(what)) {}

  private:
    static std::string firstLine(std::string text)
    {
        text.resize(std::min(text.size(), text.find('\n')));
        while (!text.empty() && (text.back() == '.' || text.back() == ' '))
            text.pop_back();
        return text;
    }
};

struct AcceptedWindow
{
    double time = 0;      ///< of the participant now [s]
    Index windows = 0;    ///< accepted so far
    Index iterations = 0; ///< of this one
    Index substeps = 0;   ///< of the soil in the last step
};

struct Hooks
{
    std::function<bool()> stop = [] { return false; };
    std::function<void(const AcceptedWindow&)> accepted = [](const AcceptedWindow&) {};
    std::function<void(bool)> waiting = [](bool) {}; ///< true: the library is at work, the soil at rest
};

template <CouplingLibrary Library, class Soil = coupling::Participant>
class CoupledRun
{
  public:
    /// Sets up the meshes; the soil is not initialized yet. InputError where couplingDict and configuration disagree.
    CoupledRun(Soil& soil, Library& library, PreciceCoupling coupling, Hooks hooks = {})
        : soil_(soil), library_(library), coupling_(std::move(coupling)), hooks_(std::move(hooks))
    {
        for (const SurfaceLink& link : coupling_.surfaces)
            setMesh(link);
    }

    /// False: stopped by the hook.
    bool run()
    {
        soil_.initialize();
        try
        {
            const bool whole = couple();
            soil_.finalize();
            return whole;
        }
        catch (const coupling::CouplingError& error)
        {
            soil_.finalize();
            throw StepError(error.what());
        }
        catch (const StepError&)
        {
            soil_.finalize();
            throw;
        }
    }

  private:
    struct Mesh
    {
        std::vector<int> ids;
        Vector3 reference{};
    };

    /// Calls the library: its exceptions, of whichever type, say that coupling is over.
    template <class F>
    auto ask(F&& call)
    {
        hooks_.waiting(true);
        struct Back
        {
            const Hooks& hooks;
            ~Back() { hooks.waiting(false); }
        } back{hooks_};
        try
        {
            return call();
        }
        catch (const std::exception& error)
        {
            throw PeerLost(error.what());
        }
    }

    void requireComponents(const SurfaceLink& link, const DataLink& data, int dim)
    {
        const int there = ask([&] { return library_.getDataDimensions(link.mesh, data.data); });
        const int here = componentsOf(data.quantity, dim);
        if (there != here)
            throw InputError(data.where,
                             fmt::format("{}: found {} data '{}' in preCICE's configuration, allowed {} in {}D",
                                         quantityWord(data.quantity), there == 1 ? "scalar" : "vector", data.data,
                                         here == 1 ? "scalar" : "vector", dim));
    }

    void setMesh(const SurfaceLink& link)
    {
        const int dim = soil_.dimension();
        const int there = ask([&] { return library_.getMeshDimensions(link.mesh); });
        if (there != dim)
            throw InputError(link.where,
                             fmt::format("mesh {}: found {} dimensions in preCICE's configuration, allowed {} as "
                                         "in system/gridDict",
                                         link.mesh, there, dim));
        for (const auto* list : {&link.read, &link.write})
            for (const DataLink& data : *list)
                requireComponents(link, data, dim);
        Mesh mesh;
        const bool rigid = link.kind == coupling::SurfaceKind::Rigid;
        mesh.reference = rigid ? Vector3(soil_.reference(link.surface)) : Vector3{};
        const coupling::SurfaceMesh surface =
            rigid ? coupling::SurfaceMesh{dim, {mesh.reference}, {}} : soil_.mesh(link.surface);
        std::vector<double> places;
        for (const Vector3& x : surface.vertices)
            places.insert(places.end(), x.begin(), x.begin() + dim);
        mesh.ids.resize(surface.vertices.size());
        ask([&] {
            library_.setMeshVertices(link.mesh, places, mesh.ids);
            setElements(link.mesh, surface, mesh.ids);
        });
        meshes_.push_back(std::move(mesh));
    }

    void setElements(const std::string& name, const coupling::SurfaceMesh& surface, const std::vector<int>& ids)
    {
        if (surface.elements.empty() || !library_.requiresMeshConnectivityFor(name))
            return;
        std::vector<int> corners;
        for (const auto& element : surface.elements)
            for (int k = 0; k < surface.dim; ++k)
                corners.push_back(ids[std::size_t(element[std::size_t(k)])]);
        if (surface.dim == 2)
            library_.setMeshEdges(name, corners);
        else
            library_.setMeshTriangles(name, corners);
    }

    /// What the partner says at a time of the step ahead, told to the soil.
    void read(double relativeTime)
    {
        const int dim = soil_.dimension();
        for (std::size_t k = 0; k < meshes_.size(); ++k)
        {
            const SurfaceLink& link = coupling_.surfaces[k];
            std::map<Quantity, Values> values;
            for (const DataLink& data : link.read)
            {
                Values& into = values[data.quantity];
                into.resize(meshes_[k].ids.size() * std::size_t(componentsOf(data.quantity, dim)));
                ask([&] { library_.readData(link.mesh, data.data, meshes_[k].ids, relativeTime, into); });
            }
            for (const FieldValues& f : toParticipant(link, dim, meshes_[k].reference, values))
                soil_.writeField(link.surface, f.field, f.values, relativeTime);
        }
    }

    void write(bool stepped)
    {
        for (std::size_t k = 0; k < meshes_.size(); ++k)
        {
            const SurfaceLink& link = coupling_.surfaces[k];
            for (const DataLink& data : link.write)
            {
                const auto field = sourceOf(data.quantity);
                Values values(soil_.valueCount(link.surface, field));
                const bool force = data.quantity == Quantity::Force || data.quantity == Quantity::Torque ||
                                   data.quantity == Quantity::Traction;
                if (stepped && force && coupling_.windowAverage)
                    soil_.windowAverage(link.surface, field, values);
                else
                    soil_.readField(link.surface, field, values);
                const Values out = toPrecice(data.quantity, soil_.dimension(), values);
                ask([&] { library_.writeData(link.mesh, data.data, meshes_[k].ids, out); });
            }
        }
    }

    /// What is left of the window, or an even part of it that is no longer than maxStep.
    double nextStep()
    {
        const double left = ask([&] { return library_.getMaxTimeStepSize(); });
        if (!coupling_.maxStep || left <= *coupling_.maxStep)
            return left;
        return left / std::ceil(left / *coupling_.maxStep * (1 - 1e-12));
    }

    void advanceSoil(double step)
    {
        const coupling::Advance advance = soil_.advance(step);
        if (advance.status == coupling::Status::discarded)
            throw StepError(advance.message);
        accepted_.substeps = advance.substeps;
    }

    bool couple()
    {
        if (ask([&] { return library_.requiresInitialData(); }))
            write(false);
        ask([&] { library_.initialize(); });
        if (ask([&] { return library_.isCouplingOngoing(); }))
            read(0);
        while (ask([&] { return library_.isCouplingOngoing(); }))
        {
            if (hooks_.stop())
                return false;
            if (ask([&] { return library_.requiresWritingCheckpoint(); }))
                windowStart_ = soil_.saveState();
            const double step = nextStep();
            for (Index k = 1; k <= coupling_.samples; ++k)
                read(k == coupling_.samples ? step : step * double(k) / double(coupling_.samples));
            advanceSoil(step);
            write(true);
            ask([&] { library_.advance(step); });
            endStep();
        }
        ask([&] { library_.finalize(); });
        return true;
    }

    void endStep()
    {
        if (ask([&] { return library_.requiresReadingCheckpoint(); }))
        {
            soil_.restoreState(*windowStart_);
            ++accepted_.iterations;
        }
        else if (ask([&] { return library_.isTimeWindowComplete(); }))
        {
            soil_.acceptWindow();
            accepted_.time = soil_.time();
            ++accepted_.windows;
            ++accepted_.iterations;
            hooks_.accepted(accepted_);
            accepted_.iterations = 0;
        }
    }

    Soil& soil_;
    Library& library_;
    PreciceCoupling coupling_;
    Hooks hooks_;
    std::vector<Mesh> meshes_;
    std::optional<decltype(std::declval<Soil&>().saveState())> windowStart_;
    AcceptedWindow accepted_;
};
} // namespace mpm::precice
