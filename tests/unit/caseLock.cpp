// One program at a time in a case folder, and nobody kept out by a dead one.
#include "case/caseLock.hpp"
#include "base/error.hpp"
#include "support/fileContents.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using mpm::cases::CaseLock;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
int refusal = 0; ///< what flock answers below; 0: it works
}

/// Stands before the C library's: a file system without locks.
extern "C" int flock(int descriptor, int operation) noexcept
{
    if (refusal != 0)
    {
        errno = refusal;
        return -1;
    }
    return int(::syscall(SYS_flock, descriptor, operation));
}

namespace
{
std::string refusedWith(const fs::path& folder)
{
    try
    {
        const CaseLock lock(folder, "second");
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return "";
}

/// A process that holds the lock until it is killed.
pid_t holder(const fs::path& folder)
{
    int ready[2];
    REQUIRE(::pipe(ready) == 0);
    const pid_t child = ::fork();
    if (child == 0)
    {
        const CaseLock lock(folder, "first");
        (void)!::write(ready[1], "x", 1);
        for (;;)
            ::pause();
    }
    char byte = 0;
    REQUIRE(::read(ready[0], &byte, 1) == 1);
    ::close(ready[0]);
    ::close(ready[1]);
    return child;
}

void end(pid_t child)
{
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
}
} // namespace

TEST_CASE("a second program is refused, with the name of the first")
{
    const TemporaryFolder folder;
    {
        const CaseLock lock(folder.path(), "first");
        CHECK(lock.note().empty());
        const auto message = refusedWith(folder.path());
        CHECK(message.find("in use by first, process " + std::to_string(::getpid()) + " on ") != std::string::npos);
        CHECK(message.find(" since 2") != std::string::npos);
    }
    CHECK(fs::is_empty(folder.path()));
    CHECK(refusedWith(folder.path()) == "");
}

TEST_CASE("a dead process holds nothing, and its file is in nobody's way")
{
    const TemporaryFolder folder;
    const pid_t child = holder(folder.path());
    CHECK(refusedWith(folder.path()).find("first, process " + std::to_string(child)) != std::string::npos);
    end(child);
    CHECK(fs::exists(folder.path() / ".caseLock"));
    {
        const CaseLock lock(folder.path(), "next");
        const auto text = tests::contents(folder.path() / ".caseLock");
        CHECK(text.rfind("next, process ", 0) == 0);
        CHECK(text.find("first") == std::string::npos);
    }
    CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("the lock does not outlive the program in one it starts")
{
    const TemporaryFolder folder;
    pid_t child = 0;
    {
        const CaseLock lock(folder.path(), "first");
        child = ::fork();
        if (child == 0)
        {
            ::execlp("sleep", "sleep", "60", nullptr);
            ::_exit(1);
        }
        // wait until the other program runs: until then its copy of the descriptor is open
        for (int k = 0; k < 5000; ++k)
        {
            std::error_code error;
            if (fs::read_symlink("/proc/" + std::to_string(child) + "/exe", error) !=
                fs::read_symlink("/proc/self/exe"))
                break;
            ::usleep(1000);
        }
    }
    CHECK(refusedWith(folder.path()) == "");
    end(child);
}

TEST_CASE("what somebody left under the lock's name is not followed, and not printed")
{
    const TemporaryFolder folder, elsewhere;
    fs::create_symlink(elsewhere.path() / "victim", folder.path() / ".caseLock");
    CHECK(refusedWith(folder.path()).find("cannot be written to") != std::string::npos);
    CHECK(fs::is_empty(elsewhere.path()));
    fs::remove(folder.path() / ".caseLock");

    const pid_t child = holder(folder.path());
    std::ofstream(folder.path() / ".caseLock") << "\x1b[31mred\n";
    CHECK(refusedWith(folder.path()).find("in use by another program of libmpm") != std::string::npos);
    end(child);
}

TEST_CASE("a file system without locks is a note, not an error")
{
    const TemporaryFolder folder;
    for (const int error : {ENOLCK, EOPNOTSUPP, ENOSYS})
    {
        refusal = error;
        const CaseLock lock(folder.path(), "first");
        refusal = 0;
        CHECK(lock.note().find("this file system has no locks") != std::string::npos);
        CHECK(fs::is_empty(folder.path()));
    }
}

TEST_CASE("a folder that cannot be written to refuses programs that write, and only those")
{
    const TemporaryFolder folder;
    const fs::path missing = folder.path() / "missing";
    CHECK(refusedWith(missing).find("cannot be written to") != std::string::npos);
    cases::Options options;
    options.caseFolder = missing;
    options.dryRun = true;
    const CaseLock lock(options, "reader");
    CHECK(fs::is_empty(folder.path()));
}
