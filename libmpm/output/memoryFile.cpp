#include "output/memoryFile.hpp"

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
} // namespace mpm::output
