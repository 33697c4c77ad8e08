#include "output/derivedFields.hpp"

#include "base/error.hpp"
#include "output/hdf5File.hpp"
#include "output/hdf5Probe.hpp"
#include "output/replaceFile.hpp"
#include "output/visualisation.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::output
{
namespace
{
namespace fs = std::filesystem;

std::size_t rowIn(const std::vector<Index>& order, Index row)
{
    return std::size_t(order.empty() ? row : order[std::size_t(row)]);
}

/// The file's particles against the state's: order[row] is the state's particle in a row of the file. Empty if both
/// stand in the same order, as in a file just read.
std::vector<Index> orderInFile(const Hdf5File& file, const state::Particles& p)
{
    const auto ids = file.read<std::int64_t>("/particles/id", {-1});
    const auto own = p.id.begin();
    if (std::equal(ids.begin(), ids.end(), own, own + p.size()))
        return {};
    std::vector<std::pair<std::int64_t, Index>> inFile, inState;
    for (std::size_t row = 0; row < ids.size(); ++row)
        inFile.emplace_back(ids[row], Index(row));
    for (Index i = 0; i < p.size(); ++i)
        inState.emplace_back(own[i], i);
    std::sort(inFile.begin(), inFile.end());
    std::sort(inState.begin(), inState.end());
    const auto sameId = [](const auto& a, const auto& b) { return a.first == b.first; };
    if (!std::equal(inFile.begin(), inFile.end(), inState.begin(), inState.end(), sameId))
        file.fail("/particles/id", "the file holds other particles than the state its derived fields belong to");
    std::vector<Index> order(ids.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        order[std::size_t(inFile[k].second)] = inState[k].second;
    return order;
}

/// Row r of the file holds row order[r] of the columns; an empty order means r itself.
void writeField(Hdf5File& file, const std::string& group, const DerivedField& field, const std::vector<Index>& order,
                Index n)
{
    const std::string name = group + "/" + field.name;
    const Index width = Index(field.columns.size());
    if (field.name.empty() || field.name.find('/') != std::string::npos || width == 0 ||
        width != Index(field.components.size()))
        file.fail(name, "a derived field needs a plain name and one component name a column");
    for (Index k = 0; k < width; ++k)
        if (const auto rows = Index(field.columns[std::size_t(k)].size()); rows != n)
            file.fail(name, fmt::format("column {} has {} rows, {} expected", k, rows, n));
    file.remove(name);
    file.writeRows<double>(name, {n, width}, field.unit, [&](Index first, Index rows, double* out) {
        for (Index k = 0; k < width; ++k)
            for (Index i = 0; i < rows; ++i)
                out[i * width + k] = field.columns[std::size_t(k)][rowIn(order, first + i)];
    });
    file.setAttribute(name, "components", field.components);
}

/// The columns again one by one, as float32.
void writePicture(Hdf5File& file, const DerivedField& field, const std::vector<Index>& order, Index n)
{
    const auto names = derivedComponentNames(field.name, field.components);
    for (std::size_t k = 0; k < names.size(); ++k)
    {
        const std::string name = "/visualisation/derived/" + names[k];
        file.remove(name);
        file.writeRows<float>(name, {n}, field.unit, [&](Index first, Index rows, float* out) {
            for (Index i = 0; i < rows; ++i)
                out[i] = float(field.columns[k][rowIn(order, first + i)]);
        });
    }
}

DerivedField readField(const Hdf5File& file, const std::string& group, const std::string& plainName,
                       const std::vector<Index>& order, Index n)
{
    const std::string name = group + "/" + plainName;
    DerivedField field{plainName, file.textAttribute(name, "unit"), file.textsAttribute(name, "components"), {}};
    const Index width = Index(field.components.size());
    field.columns.assign(std::size_t(width), std::vector<double>(std::size_t(n)));
    file.readRows<double>(name, {n, width}, [&](Index first, Index rows, const double* in) {
        for (Index k = 0; k < width; ++k)
            for (Index i = 0; i < rows; ++i)
                field.columns[std::size_t(k)][rowIn(order, first + i)] = in[i * width + k];
    });
    return field;
}

void writeNodal(Hdf5File& file, const NodalFields& nodal, int dim)
{
    const Index n = Index(nodal.position.size());
    std::vector<double> position;
    for (const auto& x : nodal.position)
        position.insert(position.end(), x.begin(), x.begin() + dim);
    file.remove("/derivedNodal");
    file.write<double>("/derivedNodal/position", position, {n, dim}, "m");
    for (const auto& field : nodal.fields)
        writeField(file, "/derivedNodal", field, {}, n);
}

void rewrite(const fs::path& name, const state::State& state, const std::vector<DerivedField>& fields,
             const NodalFields* nodal)
{
    copyToTemporary(name);
    rememberHarmless(temporaryName(name)); // a copy of what was read
    try
    {
        Hdf5File file = Hdf5File::edit(temporaryName(name));
        const auto order = orderInFile(file, state.particles);
        const Index n = state.particles.size();
        for (const auto& field : fields)
        {
            writeField(file, "/derived", field, order, n);
            writePicture(file, field, order, n);
        }
        if (nodal)
            writeNodal(file, *nodal, state.particles.dim);
        file.close();
        commitTemporary(name);
        rememberHarmless(name);
    }
    catch (const InputError&)
    {
        std::error_code ignored;
        fs::remove(temporaryName(name), ignored);
        throw;
    }
}
} // namespace

void writeDerived(const fs::path& file, const state::State& state, const std::vector<DerivedField>& fields)
{
    rewrite(file, state, fields, nullptr);
}

void writeDerived(const fs::path& file, const state::State& state, const std::vector<DerivedField>& fields,
                  const NodalFields& nodal)
{
    rewrite(file, state, fields, &nodal);
}

std::vector<DerivedField> readDerived(const fs::path& name, const state::State& state)
{
    const Hdf5File file = Hdf5File::open(name);
    const auto order = orderInFile(file, state.particles);
    std::vector<DerivedField> fields;
    for (const auto& member : file.members("/derived"))
        fields.push_back(readField(file, "/derived", member, order, state.particles.size()));
    return fields;
}

NodalFields readDerivedNodal(const fs::path& name)
{
    const Hdf5File file = Hdf5File::open(name);
    NodalFields nodal;
    if (!file.exists("/derivedNodal"))
        return nodal;
    const Shape shape = file.shape("/derivedNodal/position");
    if (shape.size() != 2 || shape[1] < 2 || shape[1] > 3)
        file.fail("/derivedNodal/position", "one row of 2 or 3 coordinates a node expected");
    const auto position = file.read<double>("/derivedNodal/position", shape);
    for (std::size_t i = 0; i < position.size(); i += std::size_t(shape[1]))
        nodal.position.push_back({position[i], position[i + 1], shape[1] == 3 ? position[i + 2] : 0.0});
    for (const auto& member : file.members("/derivedNodal"))
        if (member != "position")
            nodal.fields.push_back(readField(file, "/derivedNodal", member, {}, shape[0]));
    return nodal;
}
} // namespace mpm::output
