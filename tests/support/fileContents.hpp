#pragma once
/// Whole files as strings.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace mpm::tests
{
inline std::string contents(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void writeContents(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}
} // namespace mpm::tests
