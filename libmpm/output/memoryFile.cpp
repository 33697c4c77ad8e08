#include "output/memoryFile.hpp"

#include "base/error.hpp"

#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mpm::output
{
MemoryFile::MemoryFile() : descriptor_(::memfd_create("libmpm", MFD_CLOEXEC)) {}

MemoryFile::~MemoryFile()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

std::filesystem::path MemoryFile::path() const
{
    return descriptor_ >= 0 ? "/proc/self/fd/" + std::to_string(descriptor_) : "/dev/null";
}

double MemoryFile::bytes() const
{
    struct stat status = {};
    return descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 ? double(status.st_size) : 0;
}

std::vector<std::byte> MemoryFile::read() const
{
    std::vector<std::byte> out(std::size_t(bytes()), std::byte{});
    for (std::size_t done = 0; done < out.size();)
    {
        const auto got = ::pread(descriptor_, out.data() + done, out.size() - done, off_t(done));
        if (got <= 0)
            throw InputError({"a file in memory"}, "cannot be read back");
        done += std::size_t(got);
    }
    if (out.empty())
        throw InputError({"a file in memory"}, "this system has none");
    return out;
}

void MemoryFile::write(std::span<const std::byte> bytes) const
{
    if (descriptor_ < 0 || ::ftruncate(descriptor_, 0) != 0)
        throw InputError({"a file in memory"}, "this system has none");
    for (std::size_t done = 0; done < bytes.size();)
    {
        const auto put = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, off_t(done));
        if (put <= 0)
            throw InputError({"a file in memory"}, "cannot be written: no memory left");
        done += std::size_t(put);
    }
}
} // namespace mpm::output
