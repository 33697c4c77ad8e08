#include "output/stateFile.hpp"

#include "base/error.hpp"
#include "output/hdf5File.hpp"
#include "output/hdf5Probe.hpp"
#include "output/ledgerEntries.hpp"
#include "output/replaceFile.hpp"
#include "output/visualisation.hpp"
#include "state/particleOrder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace mpm::output
{
namespace
{
constexpr const char* formatName = "libmpm state";
constexpr Index formatVersion = 2;
constexpr const char* periodicAttribute[3] = {"periodicX", "periodicY", "periodicZ"};

/// Columns side by side: row i holds column 0 to used - 1 of particle i.
template <class T, std::size_t n>
RowFiller<double> interleaved(const std::array<state::Column<T>, n>& columns, int used)
{
    return [&columns, used](Index first, Index rows, double* out) {
        for (int k = 0; k < used; ++k)
        {
            const T* column = columns[std::size_t(k)].data() + first;
            for (Index i = 0; i < rows; ++i)
                out[i * used + k] = column[i];
        }
    };
}

/// Columns of floats take the nearest: what was written from them comes back as it was.
template <class T, std::size_t n>
RowTaker<double> dealTo(std::array<state::Column<T>, n>& columns, int used)
{
    return [&columns, used](Index first, Index rows, const double* in) {
        for (int k = 0; k < used; ++k)
        {
            T* column = columns[std::size_t(k)].data() + first;
            for (Index i = 0; i < rows; ++i)
                column[i] = T(in[i * used + k]);
        }
    };
}

/// "/" and "%" would change the meaning of an HDF5 name; "." alone is its own group.
std::string encoded(const std::string& name)
{
    std::string out;
    for (char c : name)
        out +=
            c == '/' || c == '%' || (c == '.' && name.size() == 1) ? fmt::format("%{:02X}", int(c)) : std::string(1, c);
    return out;
}

std::string decoded(const std::string& name)
{
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i)
    {
        const std::string code = name.substr(i, 3);
        const char plain = code == "%2F" ? '/' : code == "%25" ? '%' : code == "%2E" ? '.' : '\0';
        out += plain ? plain : name[i];
        i += plain ? 2 : 0;
    }
    return out;
}

void writeRoot(Hdf5File& file, const state::State& state)
{
    file.setAttribute("/", "format", std::string(formatName));
    file.setAttribute("/", "formatVersion", formatVersion);
    file.setAttribute("/", "dimension", Index(state.particles.dim));
    file.setAttribute("/", "time", state.time);
    file.setAttribute("/", "step", state.step);
    file.setAttribute("/", "deltaT", state.deltaT);
    file.setAttribute("/", "largestJacobian", state.largestJacobian);
    file.setAttribute("/", "stepFactor", state.stepFactor);
    file.setAttribute("/", "seedSpacing", state.seedSpacing);
    file.setAttribute("/", "nextId", state.nextId);
    file.setAttribute("/", "materials", state.materials);
    file.writeScalar("/grid/cellSize", state.grid.h, "m");
    file.write<double>("/grid/origin", state.grid.origin, {3}, "m");
    file.write<Index>("/grid/cells", state.grid.cells, {3}, "1");
    file.setAttribute("/grid", "dimension", Index(state.grid.dim));
    for (int a = 0; a < state.grid.dim; ++a)
        if (state.grid.periodic[std::size_t(a)])
            file.setAttribute("/grid", periodicAttribute[a], Index(1));
}

void readRoot(const Hdf5File& file, state::State& state)
{
    state.time = file.realAttribute("/", "time");
    state.step = file.integerAttribute("/", "step");
    state.deltaT = file.realAttribute("/", "deltaT");
    state.largestJacobian = file.realAttribute("/", "largestJacobian");
    state.stepFactor = file.realAttribute("/", "stepFactor");
    state.seedSpacing = file.vectorAttribute("/", "seedSpacing");
    state.nextId = file.integerAttribute("/", "nextId");
    state.materials = file.textsAttribute("/", "materials");
    state.grid.h = file.readReal("/grid/cellSize");
    const auto origin = file.read<double>("/grid/origin", {3});
    const auto cells = file.read<Index>("/grid/cells", {3});
    std::copy(origin.begin(), origin.end(), state.grid.origin.begin());
    std::copy(cells.begin(), cells.end(), state.grid.cells.begin());
    state.grid.dim = int(file.integerAttribute("/grid", "dimension"));
    for (int a = 0; a < 3; ++a)
        state.grid.periodic[std::size_t(a)] = file.hasAttribute("/grid", periodicAttribute[a]);
}

void writeParticles(Hdf5File& file, const state::Particles& p)
{
    const Index n = p.size();
    const int dim = p.dim;
    const Index s = stressComponents(dim);
    const std::string measure = dim == 2 ? "m^2" : "m^3";
    const auto plain = [&]<class T>(const std::string& name, const state::Column<T>& column, const std::string& unit) {
        file.write<T>("/particles/" + name, std::span<const T>(column.data(), std::size_t(n)), {n}, unit);
    };
    file.writeRows<double>("/particles/position", {n, dim}, "m", interleaved(p.x, dim));
    file.writeRows<double>("/particles/velocity", {n, dim}, "m/s", interleaved(p.v, dim));
    file.writeRows<double>("/particles/stress", {n, s}, "Pa", interleaved(p.stress, int(s)));
    file.setAttribute("/particles/stress", "components",
                      std::vector<std::string>(stressNames.begin(), stressNames.begin() + s));
    file.writeRows<double>("/particles/deformationGradient", {n, dim, dim}, "1", interleaved(p.F, dim * dim));
    file.writeRows<double>("/particles/length0", {n, dim}, "m", interleaved(p.length0, dim));
    plain("mass", p.mass, dim == 2 ? "kg/m" : "kg");
    plain("volume0", p.volume0, measure);
    plain("volume", p.volume, measure);
    plain("id", p.id, "1");
    plain("sortKey", p.sortKey, "1");
    plain("material", p.material, "1");
    plain("generation", p.generation, "1");
    if (p.hasX())
        file.writeRows<double>("/particles/referencePosition", {n, dim}, "m", interleaved(p.X, dim));
    if (p.hasAffine())
        file.writeRows<double>("/particles/affine", {n, dim, dim}, "1/s", interleaved(p.affine, dim * dim));
    for (const auto& optional : state::Particles::optionalColumns())
        if (p.has(optional.column))
            plain(optional.name, p.*optional.column, optional.unit);
}

void readParticles(const Hdf5File& file, state::Particles& p)
{
    const int dim = p.dim;
    const Shape shape = file.shape("/particles/position");
    const Index n = shape.empty() ? 0 : shape.front();
    const int s = stressComponents(dim);
    const auto plain = [&]<class T>(const std::string& name, state::Column<T>& column) {
        file.readRows<T>("/particles/" + name, {n}, [&](Index first, Index rows, const T* in) {
            std::copy(in, in + rows, column.begin() + first);
        });
    };
    // Nothing is allocated before the first array has proved that the file holds n particles.
    file.readRows<double>("/particles/position", {-1, dim}, [&](Index first, Index rows, const double* in) {
        if (p.size() != n)
            p.resize(n);
        dealTo(p.x, dim)(first, rows, in);
    });
    file.readRows<double>("/particles/velocity", {n, dim}, dealTo(p.v, dim));
    file.readRows<double>("/particles/stress", {n, s}, dealTo(p.stress, s));
    file.readRows<double>("/particles/deformationGradient", {n, dim, dim}, dealTo(p.F, dim * dim));
    file.readRows<double>("/particles/length0", {n, dim}, dealTo(p.length0, dim));
    plain("mass", p.mass);
    plain("volume0", p.volume0);
    plain("volume", p.volume);
    plain("id", p.id);
    plain("sortKey", p.sortKey);
    plain("material", p.material);
    plain("generation", p.generation);
    if (file.exists("/particles/referencePosition"))
    {
        p.enableX();
        file.readRows<double>("/particles/referencePosition", {n, dim}, dealTo(p.X, dim));
    }
    if (file.exists("/particles/affine"))
    {
        p.enableAffine();
        file.readRows<double>("/particles/affine", {n, dim, dim}, dealTo(p.affine, dim * dim));
    }
    for (const auto& optional : state::Particles::optionalColumns())
        if (file.exists(std::string("/particles/") + optional.name))
        {
            p.keep(optional.column, true);
            plain(optional.name, p.*optional.column);
        }
    p.padLastChunk();
}

void writeLedger(Hdf5File& file, const state::Ledger& ledger, int dim)
{
    forEachLedgerEntry(ledger, [&](const std::string& name, const auto& value, const std::string& unit) {
        const std::string text = dim == 2 ? unit + "/m" : unit;
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Vector3>)
            file.write<double>("/ledger/" + name, value, {3}, text);
        else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
            file.writeScalar("/ledger/" + name, value, text);
        else
            file.writeScalar("/ledger/" + name, Index(value), unit);
    });
}

/// Entries that files of earlier versions lack: those of effects that were not there yet.
constexpr std::array<std::string_view, 17> lateEntries{
    "relaxationLoss", "averagingLoss",     "viscosityLoss", "gapWork",      "contactFriction", "contactLoss",
    "restLoss",       "bulkViscosityLoss", "motionWork",    "motionSupply", "absorbedEnergy",  "restImpulse",
    "merges",         "restingSteps",      "wakes",         "bodyContacts", "contactNodes"};

void readLedger(const Hdf5File& file, state::Ledger& ledger)
{
    forEachLedgerEntry(ledger, [&](const std::string& name, auto& value, const std::string&) {
        using Value = std::decay_t<decltype(value)>;
        if (std::count(lateEntries.begin(), lateEntries.end(), name) > 0 && !file.exists("/ledger/" + name))
            return; // a file of a version that had none
        if constexpr (std::is_same_v<Value, Vector3>)
        {
            const auto values = file.read<double>("/ledger/" + name, {3});
            std::copy(values.begin(), values.end(), value.begin());
        }
        else if constexpr (std::is_same_v<Value, double>)
            value = file.readReal("/ledger/" + name);
        else
            value = Value(file.read<Index>("/ledger/" + name, {}).front());
    });
}

void writePatches(Hdf5File& file, const std::vector<state::SurfacePatch>& patches, int dim)
{
    file.makeGroup("/patches");
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
        const auto& patch = patches[i];
        const std::string group = "/patches/" + encoded(patch.name);
        if (patch.name.empty() || file.exists(group))
            file.fail(group, "a patch needs a name of its own");
        const Index n = patch.size();
        const int edges = dim * (dim - 1);
        file.writeRows<double>(group + "/centre", {n, dim}, "m", interleaved(patch.centre, dim));
        file.writeRows<double>(group + "/edges", {n, edges}, "m", interleaved(patch.edges, edges));
        file.setAttribute(group, "index", Index(i));
    }
}

void readPatches(const Hdf5File& file, std::vector<state::SurfacePatch>& patches, int dim)
{
    const auto names = file.members("/patches");
    std::vector<state::SurfacePatch> found(names.size());
    for (const auto& name : names)
    {
        const std::string group = "/patches/" + name;
        const Index place = file.integerAttribute(group, "index");
        if (place < 0 || place >= Index(names.size()) || !found[std::size_t(place)].name.empty())
            file.fail(group, "attribute index is not a place of its own in the list");
        auto& patch = found[std::size_t(place)];
        patch.name = decoded(name);
        const auto centre = file.read<double>(group + "/centre", {-1, dim});
        const int edges = dim * (dim - 1);
        const Index n = Index(centre.size()) / dim;
        const auto edge = file.read<double>(group + "/edges", {n, edges});
        for (int k = 0; k < dim; ++k)
            patch.centre[std::size_t(k)].resize(std::size_t(n));
        for (int k = 0; k < edges; ++k)
            patch.edges[std::size_t(k)].resize(std::size_t(n));
        dealTo(patch.centre, dim)(0, n, centre.data());
        dealTo(patch.edges, edges)(0, n, edge.data());
    }
    patches = std::move(found);
}

int readDimension(const Hdf5File& file)
{
    const std::string hint = "is this a state file of libmpm?";
    if (!file.hasAttribute("/", "format") || !file.hasAttribute("/", "formatVersion"))
        file.fail("/", "attribute format is missing; " + hint);
    const std::string format = file.textAttribute("/", "format");
    if (format != formatName)
        file.fail("/", fmt::format("attribute format is \"{}\", \"{}\" expected; {}", format, formatName, hint));
    const Index version = file.integerAttribute("/", "formatVersion");
    if (version != formatVersion)
        file.fail("/", fmt::format("attribute formatVersion is {}, this program reads {}{}", version, formatVersion,
                                   version < formatVersion ? ": made by an older libmpm; seed and run the case again"
                                                           : ": made by a newer libmpm"));
    const Index dim = file.integerAttribute("/", "dimension");
    if (dim != 2 && dim != 3)
        file.fail("/", fmt::format("attribute dimension is {}, allowed 2 or 3", dim));
    return int(dim);
}

void writeAll(Hdf5File& file, const state::State& state)
{
    writeRoot(file, state);
    writeParticles(file, state.particles);
    writeLedger(file, state.ledger, state.particles.dim);
    writePatches(file, state.patches, state.particles.dim);
    file.makeGroup("/provenance");
    for (const auto& [key, text] : state.provenance)
        file.writeText("/provenance/" + encoded(key), text);
    writeVisualisation(file, state.particles);
}
} // namespace

void writeStateAt(const std::filesystem::path& name, const state::State& state)
{
    auto file = Hdf5File::create(name);
    writeAll(file, state);
    file.close();
}

PendingState::PendingState(const std::filesystem::path& timeFolder, const state::State& state)
    : file_(timeFolder / stateFileName), folderIsOurs_(!std::filesystem::exists(timeFolder))
{
    requireValid(state, file_.string());
    makeFolder(timeFolder);
    try
    {
        writeStateAt(temporaryName(file_), state);
    }
    catch (const InputError&)
    {
        remove();
        throw;
    }
}

PendingState::~PendingState()
{
    if (!committed_)
        remove();
}

void PendingState::commit()
{
    commitTemporary(file_);
    rememberHarmless(file_);
    committed_ = true;
}

void PendingState::remove() const
{
    std::error_code ignored;
    std::filesystem::remove(temporaryName(file_), ignored);
    if (folderIsOurs_)
        std::filesystem::remove(file_.parent_path(), ignored); // only if empty
}

void writeState(const std::filesystem::path& timeFolder, const state::State& state)
{
    PendingState(timeFolder, state).commit();
}

double rehearseState(const state::State& state)
{
    requireValid(state, "the state");
    auto file = Hdf5File::create("a state in memory", false);
    writeAll(file, state);
    return file.bytes();
}

state::State readState(const std::filesystem::path& name)
{
    const Hdf5File file = Hdf5File::open(name);
    const int dim = readDimension(file);
    state::State state(dim);
    readRoot(file, state);
    readParticles(file, state.particles);
    readLedger(file, state.ledger);
    readPatches(file, state.patches, dim);
    for (const auto& key : file.members("/provenance"))
        state.provenance[decoded(key)] = file.readText("/provenance/" + key);
    requireValid(state, name.string());
    state::sortByKeyAndId(state.particles);
    return state;
}

StateSummary readSummary(const std::filesystem::path& name)
{
    const Hdf5File file = Hdf5File::open(name);
    StateSummary summary;
    summary.dim = readDimension(file);
    summary.time = file.realAttribute("/", "time");
    summary.step = file.integerAttribute("/", "step");
    const Shape shape = file.shape("/particles/mass");
    if (shape.size() != 1)
        file.fail("/particles/mass", "one value a particle expected");
    summary.particles = shape.front();
    for (const auto& field : file.members("/derived"))
        summary.derived.push_back({field, file.textsAttribute("/derived/" + field, "components")});
    if (file.exists("/provenance/outOfTurn"))
        summary.outOfTurn = file.readText("/provenance/outOfTurn");
    return summary;
}
} // namespace mpm::output
