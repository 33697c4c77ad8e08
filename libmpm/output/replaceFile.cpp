#include "output/replaceFile.hpp"

#include "base/error.hpp"
#include "output/diskPace.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace mpm::output
{
namespace fs = std::filesystem;

namespace
{
/// Brings a file or a folder to the disk.
bool synchronise(const fs::path& name, int flags)
{
    const int descriptor = ::open(name.c_str(), flags);
    if (descriptor < 0)
        return false;
    const bool done = ::fsync(descriptor) == 0;
    return ::close(descriptor) == 0 && done;
}

bool writeAll(int descriptor, const char* bytes, std::size_t count)
{
    while (count > 0)
    {
        const ssize_t n = ::write(descriptor, bytes, count);
        if (n < 0 && errno != EINTR)
            return false;
        bytes += std::max<ssize_t>(n, 0);
        count -= std::size_t(std::max<ssize_t>(n, 0));
    }
    return true;
}

bool copyBytes(int from, int to)
{
    std::vector<char> block(std::size_t(1) << 20);
    DiskPace pace;
    for (;; pace.follow(to))
    {
        const ssize_t n = ::read(from, block.data(), block.size());
        if (n == 0)
            return true;
        if (n < 0 ? errno != EINTR : !writeAll(to, block.data(), std::size_t(n)))
            return false;
    }
}
} // namespace

fs::path temporaryName(const fs::path& file)
{
    fs::path name = file;
    name += ".partial";
    return name;
}

void commitTemporary(const fs::path& file)
{
    const fs::path temporary = temporaryName(file);
    std::error_code error;
    if (!synchronise(temporary, O_RDWR))
        error = std::error_code(errno, std::generic_category());
    else
        fs::rename(temporary, file, error);
    if (error)
    {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw InputError({file.string()}, fmt::format("cannot be replaced by its new version: {}", error.message()));
    }
    // Some file systems cannot fsync a folder; the rename itself has succeeded.
    const fs::path folder = file.parent_path();
    synchronise(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
}

void synchroniseFile(const fs::path& file)
{
    synchronise(file, O_RDWR);
}

void copyToTemporary(const fs::path& file)
{
    const fs::path temporary = temporaryName(file);
    const int from = ::open(file.c_str(), O_RDONLY), to = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const bool opened = from >= 0 && to >= 0, copied = opened && copyBytes(from, to);
    int error = errno;
    if (from >= 0)
        ::close(from);
    const bool closed = to < 0 || ::close(to) == 0;
    if (copied && closed)
        return;
    error = copied ? errno : error;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError({file.string()},
                     fmt::format("cannot be copied to {}: {}", temporary.string(), std::strerror(error)));
}

void replaceText(const fs::path& file, const std::string& text)
{
    {
        std::ofstream stream(temporaryName(file), std::ios::binary | std::ios::trunc);
        stream.write(text.data(), std::streamsize(text.size()));
        stream.flush();
        if (!stream)
        {
            const std::string reason = std::strerror(errno);
            std::error_code ignored;
            fs::remove(temporaryName(file), ignored);
            throw InputError({file.string()}, fmt::format("cannot be written: {}", reason));
        }
    }
    commitTemporary(file);
}

void makeFolder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder))
        throw InputError({folder.string()},
                         fmt::format("this folder cannot be made: {}", error ? error.message() : "a file is there"));
}
} // namespace mpm::output
