#include "coupling/participant.hpp"

#include "base/error.hpp"
#include "coupling/couplingDict.hpp"
#include "coupling/implementation.hpp"
#include "coupling/threadCount.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::coupling
{
using enum Lifecycle;

namespace
{
constexpr double mostSubsteps = 1e9; ///< in one window
constexpr const char* lifecycleNames[] = {"Created", "Initialized", "Stepping", "Finalized"};

cases::Overrides overridesOf(const std::vector<Setting>& settings)
{
    if (settings.empty())
        return {};
    cases::Overrides out("settings of the participant");
    for (const auto& setting : settings)
        out.set(setting.file, setting.word, setting.value);
    return out;
}

void requireFinite(const std::string& surface, const char* word, std::span<const double> values)
{
    const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    if (bad != values.end())
        throw CouplingError(Fault::notFinite,
                            fmt::format("{}: found {} as value {} of {}", surface, *bad, bad - values.begin(), word));
}
} // namespace

// What calls have in common -------------------------------------------------------------------------------------------

Participant::Implementation::Implementation(const std::filesystem::path& caseFolder,
                                            const std::vector<Setting>& settings, int threadCount)
    : soil(caseFolder, overridesOf(settings)), threads(threadCount)
{
    for (const auto& setting : settings)
        if (!soil.folder().hasFile(setting.file))
            throw InputError(fmt::format("settings: found the file '{}', which the case {} does not have", setting.file,
                                         soil.folder().folder().string()));
    for (auto& one : readCouplingDict(soil.folder(), soil.state().particles.dim))
    {
        add(one.name, std::move(one.mesh), one.kind, one.options);
        for (const auto& field : surfaces.back().fields())
            if (field.direction == Direction::written && field.name != FieldName::RigidTwist)
                surfaces.back().setInterpolation(field, one.interpolation);
    }
}

void Participant::Implementation::require(std::initializer_list<Lifecycle> allowed, const char* call) const
{
    if (std::find(allowed.begin(), allowed.end(), lifecycle) != allowed.end())
        return;
    std::string names;
    for (const auto one : allowed)
        names += (names.empty() ? "" : " or ") + std::string(lifecycleNames[int(one)]);
    throw CouplingError(Fault::callOrder, fmt::format("{}: found a participant that is {}; allowed: {}", call,
                                                      lifecycleNames[int(lifecycle)], names));
}

Surface& Participant::Implementation::find(const std::string& name)
{
    std::vector<std::string> names;
    for (auto& surface : surfaces)
    {
        if (surface.name() == name)
            return surface;
        names.push_back(surface.name());
    }
    throw CouplingError(Fault::unknownSurface,
                        fmt::format("found no coupling surface '{}'; there {}", name,
                                    names.empty() ? "is none" : "are " + joinWords(names, " and ")));
}

void Participant::Implementation::add(const std::string& name, SurfaceMesh mesh, SurfaceKind kind,
                                      const SurfaceOptions& options)
{
    const auto refuse = [&](const std::string& what) {
        throw CouplingError(Fault::badSurface, fmt::format("'{}': {}", name, what));
    };
    const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), plain))
        refuse("found that name; allowed are letters, digits, _ and -, as files bear it");
    for (const auto& other : surfaces)
        if (other.name() == name)
            refuse("found a surface of that name already");
    if (mesh.dim != soil.state().particles.dim)
        refuse(fmt::format("found a mesh of dimension {}, allowed is that of the case, {}", mesh.dim,
                           soil.state().particles.dim));
    surfaces.emplace_back(name, std::move(mesh), kind, options);
}

void Participant::Implementation::checkSize(const Surface& surface, const Field& field, std::size_t count) const
{
    if (const auto wanted = surface.valueCount(field); count != wanted)
        throw CouplingError(Fault::wrongSize, fmt::format("{}: found {} values for {}, allowed are {}", surface.name(),
                                                          count, fieldWord(field.name), wanted));
}

// Before initialize() -------------------------------------------------------------------------------------------------

Participant::Participant(const std::filesystem::path& caseFolder, const std::vector<Setting>& settings, int threads)
    : own_(std::make_unique<Implementation>(caseFolder, settings, threads))
{}

Participant::~Participant() = default;
Participant::Participant(Participant&&) noexcept = default;
Participant& Participant::operator=(Participant&&) noexcept = default;

void Participant::addCouplingSurface(const std::string& name, SurfaceMesh mesh, SurfaceKind kind,
                                     const SurfaceOptions& options)
{
    own_->require({Created}, "addCouplingSurface");
    own_->add(name, std::move(mesh), kind, options);
}

void Participant::setInterpolation(const std::string& surface, FieldName field, Interpolation interpolation)
{
    own_->require({Created}, "setInterpolation");
    auto& found = own_->find(surface);
    found.setInterpolation(found.field(field, Direction::written), interpolation);
}

void Participant::setPartnerMesh(const std::string& surface, SurfaceMesh mesh, MappingMethod method)
{
    own_->require({Created}, "setPartnerMesh");
    own_->find(surface).setPartner(std::move(mesh), method);
}

void Participant::initialize()
{
    own_->require({Created}, "initialize");
    auto& soil = own_->soil;
    const auto bodies = soil.scene().bodies;
    const auto carried = soil.scene().carried;
    try
    {
        for (auto& surface : own_->surfaces)
            surface.enter(soil.state(), soil.scene());
        own_->recallSurfaces();
        soil.begin();
    }
    catch (...)
    {
        soil.scene().bodies = bodies;
        soil.scene().carried = carried;
        throw;
    }
    own_->lifecycle = Initialized;
}

// Questions -----------------------------------------------------------------------------------------------------------

Lifecycle Participant::lifecycle() const
{
    return own_->lifecycle;
}

int Participant::dimension() const
{
    return own_->soil.state().particles.dim;
}

std::vector<std::string> Participant::surfaces() const
{
    std::vector<std::string> out;
    for (const auto& surface : own_->surfaces)
        out.push_back(surface.name());
    return out;
}

SurfaceKind Participant::kind(const std::string& surface) const
{
    return own_->find(surface).kind();
}

std::vector<Field> Participant::fields(const std::string& surface) const
{
    return own_->find(surface).fields();
}

const SurfaceMesh& Participant::mesh(const std::string& surface) const
{
    return own_->find(surface).exchanged();
}

Vector3 Participant::reference(const std::string& surface) const
{
    return own_->find(surface).reference();
}

std::size_t Participant::valueCount(const std::string& surface, FieldName field) const
{
    const auto& found = own_->find(surface);
    return found.valueCount(found.field(field));
}

double Participant::time() const
{
    return own_->soil.state().time;
}

double Participant::stableTimeStep() const
{
    own_->require({Initialized, Stepping}, "stableTimeStep");
    return own_->soil.largestStep();
}

// Windows -------------------------------------------------------------------------------------------------------------

void Participant::writeField(const std::string& surface, FieldName field, std::span<const double> values,
                             double relativeTime)
{
    own_->require({Initialized, Stepping}, "writeField");
    auto& found = own_->find(surface);
    const auto what = found.field(field, Direction::written);
    own_->checkSize(found, what, values.size());
    requireFinite(surface, fieldWord(field), values);
    if (!(relativeTime >= 0) || !std::isfinite(relativeTime))
        throw CouplingError(Fault::badValue,
                            fmt::format("{}: found relative time {} s; allowed: 0 and later, from {} s", surface,
                                        relativeTime, time()));
    found.write(what, values, time() + relativeTime);
}

void Participant::Implementation::substep(double dt)
{
    const double time = soil.state().time, h = soil.state().grid.h;
    for (auto& surface : surfaces)
        surface.place(time, dt, h);
    soil.step(dt);
    for (auto& surface : surfaces)
        surface.collect(time, dt, h);
}

/// Steps of the size allowed; what is left at the end in two equal ones, then one, so that none is tiny.
void Participant::Implementation::substeps(double end, Index& count)
{
    for (;; ++count)
    {
        const double left = end - soil.state().time, allowed = soil.largestStep();
        if (left <= allowed * (1 + 1e-9))
            break;
        substep(left < 2 * allowed ? 0.5 * left : allowed);
    }
    substep(end - soil.state().time);
    ++count;
    soil.state().time = end;
}

Advance Participant::advance(double window)
{
    own_->require({Initialized, Stepping}, "advance");
    const double start = time(), end = start + window, step = own_->soil.largestStep();
    if (!(window >= 1e-9 * step) || !(end > start) || !(window <= mostSubsteps * step))
        throw CouplingError(Fault::badWindow,
                            fmt::format("found a window of {:g} s at {:g} s; allowed: {:.3g} to {:.3g} s, 1e-9 to 1e9 "
                                        "steps of {:.3g} s",
                                        window, start, 1e-9 * step, mostSubsteps * step, step));
    const auto before = own_->hold();
    const ThreadCount threadCount(own_->threads);
    Advance out;
    try
    {
        for (auto& surface : own_->surfaces)
        {
            if (own_->startsNow)
                surface.startAt(own_->soil.state());
            surface.beginWindow();
        }
        own_->substeps(end, out.substeps);
    }
    catch (const StepError& error)
    {
        own_->putBack(*before);
        return {start, out.substeps, Status::discarded, error.what()};
    }
    catch (...)
    {
        own_->putBack(*before);
        throw;
    }
    for (auto& surface : own_->surfaces)
        surface.endWindow(end);
    if (!own_->accepted)
        own_->accepted = before;
    own_->startsNow = false;
    own_->lifecycle = Stepping;
    out.time = end;
    return out;
}

void Participant::readField(const std::string& surface, FieldName field, std::span<double> values) const
{
    own_->require({Initialized, Stepping}, "readField");
    const auto& found = own_->find(surface);
    const auto what = found.field(field, Direction::read);
    own_->checkSize(found, what, values.size());
    found.read(what, own_->soil.state(), values);
}

void Participant::windowAverage(const std::string& surface, FieldName field, std::span<double> values) const
{
    own_->require({Initialized, Stepping}, "windowAverage");
    const auto& found = own_->find(surface);
    const auto what = found.field(field, Direction::read);
    own_->checkSize(found, what, values.size());
    found.average(what, values);
}

Resultants Participant::resultants(const std::string& surface) const
{
    own_->require({Initialized, Stepping}, "resultants");
    return own_->find(surface).resultants();
}

double Participant::interfaceWork(const std::string& surface) const
{
    own_->require({Initialized, Stepping}, "interfaceWork");
    return own_->find(surface).work();
}

Balance Participant::balance() const
{
    own_->require({Initialized, Stepping}, "balance");
    const auto totals = own_->soil.totals();
    const auto& ledger = own_->soil.state().ledger;
    Balance out;
    out.kineticEnergy = totals.kineticEnergy;
    out.strainEnergy = totals.strainEnergy;
    out.dissipation = ledger.plasticDissipation + ledger.frictionDissipation + ledger.wallLoss +
                      ledger.dampingDissipation + ledger.contactFriction + ledger.contactLoss;
    out.gravityWork = ledger.gravityWork;
    out.motionWork = ledger.motionWork;
    out.residual = stepping::residual(ledger, totals.strainEnergy);
    out.momentum = totals.momentum;
    for (const auto& surface : own_->surfaces)
        out.interfaceWork += surface.work();
    return out;
}

// What stands ---------------------------------------------------------------------------------------------------------

void Participant::acceptWindow()
{
    own_->require({Stepping}, "acceptWindow");
    auto& own = *own_;
    const double from = own.accepted ? own.accepted->state.time : time();
    const bool fresh = own.soil.fresh() && !own.windows.wasOpen();
    if (own.soil.due())
        own.soil.state().provenance["coupling"] = own.surfacesAsText(own.savedSurfaces());
    const bool due = own.soil.due();
    own.soil.accept();
    if (due)
        WindowSeries::writeSurfaces(own.soil.folder(), own.soil.storedName(), own.surfaces, own.soil.state());
    if (!own.windows.isOpen())
        own.windows.open(own.soil.folder().postProcessing(), own.surfaces, fresh ? std::nullopt : std::optional(from));
    own.windows.write(time(), time() - from, own.surfaces);
    own.accepted.reset();
}

void Participant::exportSurface(const std::string& surface, const std::filesystem::path& file) const
{
    own_->find(surface).exportTo(file, own_->lifecycle == Created ? nullptr : &own_->soil.state());
}

void Participant::finalize()
{
    own_->require({Initialized, Stepping}, "finalize");
    if (own_->soil.outputBegun())
    {
        const auto last = own_->accepted ? own_->accepted : own_->hold();
        state::State state = last->state;
        state.provenance["coupling"] = own_->surfacesAsText(last->surfaces);
        own_->soil.store(state);
    }
    own_->soil.end();
    own_->lifecycle = Finalized;
}
} // namespace mpm::coupling
