#include "output/stateBytes.hpp"

#include "base/error.hpp"
#include "output/hdf5Probe.hpp"
#include "output/stateFile.hpp"

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace mpm::output
{
namespace fs = std::filesystem;

namespace
{
/// HDF5 wants a name it can find: files in memory have none.
class TemporaryFile
{
  public:
    TemporaryFile()
    {
        std::string name = (fs::temp_directory_path() / "libmpm-XXXXXX").string();
        const int descriptor = ::mkstemp(name.data());
        if (descriptor < 0)
            throw InputError({name}, "cannot be made: a snapshot becomes bytes by way of a temporary file");
        ::close(descriptor);
        path_ = name;
    }
    ~TemporaryFile()
    {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};
} // namespace

std::vector<std::byte> stateBytes(const state::State& state)
{
    requireValid(state, "the state");
    const TemporaryFile file;
    writeStateAt(file.path(), state);
    std::vector<std::byte> out(fs::file_size(file.path()));
    std::ifstream stream(file.path(), std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size())))
        throw InputError({file.path().string()}, "cannot be read back");
    return out;
}

state::State stateFromBytes(std::span<const std::byte> bytes)
{
    const TemporaryFile file;
    std::ofstream stream(file.path(), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (!stream.flush())
        throw InputError({file.path().string()}, "cannot be written (disk full?)");
    rememberHarmless(file.path()); // no look from another process: who hands bytes on vouches for them
    return readState(file.path());
}
} // namespace mpm::output
