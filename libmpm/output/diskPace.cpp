#include "output/diskPace.hpp"

#include <fcntl.h>
#include <sys/stat.h>

namespace mpm::output
{
#ifdef __linux__
namespace
{
constexpr std::uint64_t piece = std::uint64_t(32) << 20, ahead = 8 * piece;
} // namespace

void DiskPace::follow(int descriptor)
{
    struct stat status;
    if (descriptor < 0 || ::fstat(descriptor, &status) != 0)
        return;
    const auto end = std::uint64_t(status.st_size);
    for (; begun_ + piece <= end; begun_ += piece)
        ::sync_file_range(descriptor, off64_t(begun_), off64_t(piece), SYNC_FILE_RANGE_WRITE);
    for (; taken_ + ahead <= end; taken_ += piece)
    {
        ::sync_file_range(descriptor, off64_t(taken_), off64_t(piece),
                          SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE | SYNC_FILE_RANGE_WAIT_AFTER);
        ::posix_fadvise(descriptor, off_t(taken_), off_t(piece), POSIX_FADV_DONTNEED);
    }
}
#else
void DiskPace::follow(int) {}
#endif
} // namespace mpm::output
