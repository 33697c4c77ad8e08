#pragma once
/// Runs one of the project's scripts (etc/plotLaw ...) and waits for it.
#include <filesystem>
#include <string>
#include <vector>

namespace mpm::output
{
/// The script sees the arguments word for word (no shell). Throws InputError if it cannot be started or fails.
void runScript(const std::filesystem::path& script, const std::vector<std::string>& arguments);
} // namespace mpm::output
