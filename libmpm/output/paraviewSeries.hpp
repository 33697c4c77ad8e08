#pragma once
/// A run as ParaView opens it: two XDMF files in the case folder that point into the state files, one temporal
/// collection each, time from state.h5, particle numbers free to change.
///
///     <case>/<caseName>.xdmf           points: explicit Polyvertex connectivity
///     <case>/<caseName>.domains.xdmf   deformed domains: quadrilaterals or hexahedra, corners x +- F l0 / 2
///
/// Attributes: sigma_xx, sigma_yy ... [Pa], velocity [m/s], mass, id, and every derived field present in all or some
/// times, component by component (smoothedStress_yy). Any of ParaView's XDMF readers opens them.
/// Both files are rewritten whole, through a temporary and a rename.
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::output
{
/// timeNames: the time folders to list, in order. A time whose state cannot be read is an InputError.
void writeParaviewSeries(const std::filesystem::path& caseFolder, const std::string& caseName,
                         const std::vector<std::string>& timeNames);
} // namespace mpm::output
