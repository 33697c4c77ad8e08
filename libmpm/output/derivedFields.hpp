#pragma once
/// Fields that utilities compute from a stored state and keep beside it in state.h5: /derived/<name> with one row a
/// particle, /derivedNodal/<name> with one row a node of positions /derivedNodal/position (layout: stateFile.hpp).
///
/// Rows follow the particles by id, so a state sorted differently gets its rows back in its own order. Fields belong to
/// the particles they were made from: other ids in the file are an InputError, and writeState writes none.
///
///     writeDerived("0.5/state.h5", state, {{"smoothedStress", "Pa", {"xx", "yy", "zz", "xy"}, columns}});
#include "state/state.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mpm::output
{
struct DerivedField
{
    std::string name;
    std::string unit;
    std::vector<std::string> components;      ///< one a column
    std::vector<std::vector<double>> columns; ///< all of one length
};

struct NodalFields
{
    std::vector<Vector3> position;    ///< [m]
    std::vector<DerivedField> fields; ///< columns of position.size()
};

/// Adds (or replaces) particle fields, through a temporary copy and a rename.
void writeDerived(const std::filesystem::path& file, const state::State& state,
                  const std::vector<DerivedField>& fields);
/// The same, and all nodal fields anew.
void writeDerived(const std::filesystem::path& file, const state::State& state, const std::vector<DerivedField>& fields,
                  const NodalFields& nodal);

/// All particle fields of a file, rows in the order of the state's particles.
std::vector<DerivedField> readDerived(const std::filesystem::path& file, const state::State& state);
NodalFields readDerivedNodal(const std::filesystem::path& file);
} // namespace mpm::output
