#include "output/derivedFields.hpp"

#include "base/error.hpp"
#include "output/hdf5File.hpp"
#include "output/replaceFile.hpp"
#include "output/visualisation.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::output
{
namespace
{
namespace fs = std::filesystem;

/// row[i]: the file's row of the state's particle i.
std::vector<Index> rowsInFile(const Hdf5File& file, const state::Particles& p)
{
    const auto ids = file.read<std::int64_t>("/particles/id", {-1});
    std::vector<std::pair<std::int64_t, Index>> table;
    for (std::size_t i = 0; i < ids.size(); ++i)
        table.emplace_back(ids[i], Index(i));
    std::sort(table.begin(), table.end());
    std::vector<Index> rows;
    for (Index i = 0; i < p.size() && p.size() == Index(ids.size()); ++i)
    {
        const auto id = p.id[std::size_t(i)];
        const auto found = std::lower_bound(table.begin(), table.end(), std::make_pair(id, Index(0)));
        if (found != table.end() && found->first == id)
            rows.push_back(found->second);
    }
    if (rows.size() != ids.size() || p.size() != Index(ids.size()))
        file.fail("/particles/id", "the file holds other particles than the state its derived fields belong to");
    return rows;
}

void writeField(Hdf5File& file, const std::string& group, const DerivedField& field, const std::vector<Index>* rows,
                Index n)
{
    const std::string name = group + "/" + field.name;
    const Index width = Index(field.columns.size());
    if (field.name.empty() || field.name.find('/') != std::string::npos || width == 0 ||
        width != Index(field.components.size()))
        file.fail(name, "a derived field needs a plain name and one component name a column");
    std::vector<double> values(std::size_t(n * width));
    for (Index k = 0; k < width; ++k)
    {
        const auto& column = field.columns[std::size_t(k)];
        if (Index(column.size()) != n)
            file.fail(name, fmt::format("column {} has {} rows, {} expected", k, column.size(), n));
        for (Index i = 0; i < n; ++i)
            values[std::size_t((rows ? (*rows)[std::size_t(i)] : i) * width + k)] = column[std::size_t(i)];
    }
    file.remove(name);
    file.write<double>(name, values, {n, width}, field.unit);
    file.setAttribute(name, "components", field.components);
    if (rows)
        writeDerivedVisualisation(file, field.name, field.components, values, field.unit);
}

DerivedField readField(const Hdf5File& file, const std::string& group, const std::string& plainName,
                       const std::vector<Index>* rows, Index n)
{
    const std::string name = group + "/" + plainName;
    DerivedField field{plainName, file.textAttribute(name, "unit"), file.textsAttribute(name, "components"), {}};
    const Index width = Index(field.components.size());
    const auto values = file.read<double>(name, {n, width});
    for (Index k = 0; k < width; ++k)
    {
        std::vector<double> column(static_cast<std::size_t>(n));
        for (Index i = 0; i < n; ++i)
            column[std::size_t(i)] = values[std::size_t((rows ? (*rows)[std::size_t(i)] : i) * width + k)];
        field.columns.push_back(std::move(column));
    }
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
        writeField(file, "/derivedNodal", field, nullptr, n);
}

void rewrite(const fs::path& name, const state::State& state, const std::vector<DerivedField>& fields,
             const NodalFields* nodal)
{
    const fs::path temporary = temporaryName(name);
    std::error_code error;
    fs::copy_file(name, temporary, fs::copy_options::overwrite_existing, error);
    if (error)
        throw InputError({name.string()},
                         fmt::format("cannot be copied to {}: {}", temporary.string(), error.message()));
    try
    {
        Hdf5File file = Hdf5File::edit(temporary);
        const auto rows = rowsInFile(file, state.particles);
        for (const auto& field : fields)
            writeField(file, "/derived", field, &rows, state.particles.size());
        if (nodal)
            writeNodal(file, *nodal, state.particles.dim);
        file.close();
        commitTemporary(name);
    }
    catch (const InputError&)
    {
        fs::remove(temporary, error);
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
    const auto rows = rowsInFile(file, state.particles);
    std::vector<DerivedField> fields;
    for (const auto& member : file.members("/derived"))
        fields.push_back(readField(file, "/derived", member, &rows, state.particles.size()));
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
            nodal.fields.push_back(readField(file, "/derivedNodal", member, nullptr, shape[0]));
    return nodal;
}
} // namespace mpm::output
