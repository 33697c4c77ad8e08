#pragma once
/// A second case folder beside a first: constant, system and geometry, no times.
#include "case/caseDirectory.hpp"

namespace mpm::cases
{
/// Makes `target` (a relative path starts at the case folder) and returns its path. A folder that is there already is
/// an InputError, or with `overwrite`, if it is a case, is emptied of its dictionaries, times and postProcessing first.
std::filesystem::path copyCase(const CaseDirectory& from, const std::filesystem::path& target, bool overwrite);
} // namespace mpm::cases
