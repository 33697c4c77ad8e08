#include "case/caseLock.hpp"

#include "base/error.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mpm::cases
{
namespace
{
std::string thisProcess(const std::string& program)
{
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0)
        host = {"?"};
    std::array<char, 64> start{};
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    if (::localtime_r(&now, &local))
        std::strftime(start.data(), start.size(), "%Y-%m-%d %H:%M:%S", &local);
    return fmt::format("{}, process {} on {} since {}", program, ::getpid(), host.data(), start.data());
}

/// The holder's text; whatever else is in the file stays out of the message.
std::string readHolder(int descriptor)
{
    std::array<char, 512> text{};
    const ssize_t n = ::pread(descriptor, text.data(), text.size(), 0);
    std::string holder(text.data(), n > 0 ? std::size_t(n) : 0);
    holder.erase(std::min(holder.find('\n'), holder.size()));
    for (const char c : holder)
        if (static_cast<unsigned char>(c) < ' ')
            return "";
    return holder;
}
} // namespace

CaseLock::CaseLock(const std::filesystem::path& caseFolder, const std::string& program)
    : folder_(caseFolder), file_(caseFolder / ".caseLock")
{
    lock(program);
}

CaseLock::CaseLock(const Options& options, const std::string& program)
    : folder_(options.caseFolder), file_(options.caseFolder / ".caseLock")
{
    if (!options.dryRun)
        lock(program);
}

void CaseLock::lock(const std::string& program)
{
    while (!open()) // the holder removed the file between our open and our lock: that was not the lock any more
        ::close(descriptor_);
    if (!note_.empty())
    {
        std::fputs(fmt::format("--> {}: note: {}\n", program, note_).c_str(), stderr);
        return;
    }
    const std::string text = thisProcess(program) + "\n";
    // A text that cannot be written (full disk, somebody else's file) costs the message its name, no more.
    if (::ftruncate(descriptor_, 0) == 0)
        (void)!::pwrite(descriptor_, text.data(), text.size(), 0);
}

CaseLock::~CaseLock()
{
    if (descriptor_ < 0)
        return;
    if (note_.empty() && stillNamed())
        ::unlink(file_.c_str()); // before the lock goes, or it could be another's
    ::close(descriptor_);
}

/// False if the file locked is not the one of this name any more.
bool CaseLock::open()
{
    constexpr int flags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | flags, 0666);
    const int refused = errno;
    if (descriptor_ < 0 && refused == EACCES)
        descriptor_ = ::open(file_.c_str(), O_RDONLY | flags); // left behind by another user: a lock all the same
    if (descriptor_ < 0)
        throw InputError({folder_.string()}, fmt::format("this folder cannot be written to: {}: {}",
                                                         file_.filename().string(), std::strerror(refused)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0)
        return stillNamed();
    const int error = errno;
    if (error == EWOULDBLOCK)
        refuse();
    if (error == EINTR)
        return false;
    note_ = fmt::format("{}: this file system has no locks ({}): a second program in this case would not be noticed",
                        folder_.string(), std::strerror(error));
    ::unlink(file_.c_str());
    return true;
}

bool CaseLock::stillNamed() const
{
    struct stat here = {}, there = {};
    return ::fstat(descriptor_, &here) == 0 && ::lstat(file_.c_str(), &there) == 0 && here.st_ino == there.st_ino &&
           here.st_dev == there.st_dev;
}

void CaseLock::refuse() const
{
    const std::string holder = readHolder(descriptor_);
    ::close(descriptor_);
    throw InputError({folder_.string()},
                     fmt::format("this case is in use by {}; allowed: one program at a time (wait for its end, or stop "
                                 "it; a dead one is in nobody's way)",
                                 holder.empty() ? "another program of libmpm" : holder));
}
} // namespace mpm::cases
