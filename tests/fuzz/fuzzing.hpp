#pragma once
/// What the fuzz targets share. An InputError is the right end of a wrong input; anything else ends the fuzzer.
#include "base/error.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace mpm::fuzz
{
/// A promise that does not hold.
inline void require(bool holds, const char* promise)
{
    if (holds)
        return;
    std::fprintf(stderr, "broken: %s\n", promise);
    std::abort();
}

template <class Action>
bool accepted(Action&& action)
{
    try
    {
        action();
        return true;
    }
    catch (const InputError& error)
    {
        require(error.what()[0] != 0, "a message says something");
        static const bool says = std::getenv("MPM_FUZZ_SAYS") != nullptr; // to look at one input
        if (says)
            std::fprintf(stderr, "%s\n", error.what());
        return false;
    }
}

/// A folder in memory, removed when the program ends.
class Folder
{
  public:
    Folder()
    {
        std::string name = "/dev/shm/mpmFuzz-XXXXXX";
        require(::mkdtemp(name.data()) != nullptr, "a folder in memory");
        path_ = name;
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }
    std::size_t files() const
    {
        std::size_t n = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
            n += entry.is_regular_file();
        return n;
    }

  private:
    std::filesystem::path path_;
};
} // namespace mpm::fuzz
