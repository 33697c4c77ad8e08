// Work in a process of its own: whatever becomes of it, the caller gets an answer or a reason, and nothing is written.
#include "base/childProcess.hpp"
#include "support/fileContents.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace mpm;
using Catch::Matchers::Contains;
using mpm::tests::contents;
using mpm::tests::TemporaryFolder;
using mpm::tests::writeContents;
namespace fs = std::filesystem;

namespace
{
std::string failureOf(const std::function<std::string()>& work, ChildLimits limits = {})
{
    const ChildAnswer answer = runInChild(work, limits);
    CHECK(answer.bytes.empty() != answer.failure.empty());
    return answer.failure;
}
} // namespace

TEST_CASE("the answer of a child comes back whole, also a long one")
{
    std::string bytes(3000000, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = char(i * i >> 7);
    const ChildAnswer answer = runInChild([&] { return bytes; }, {});
    CHECK(answer.failure == "");
    CHECK(answer.bytes == bytes);
}

TEST_CASE("a child that crashes, hangs, leaves or raves is a reason, not an end")
{
    CHECK_THAT(failureOf([]() -> std::string { std::abort(); }), Contains("signal 6"));
    CHECK_THAT(failureOf([]() -> std::string { ::_exit(9); }), Contains("exit code 9"));
    CHECK_THAT(failureOf([]() -> std::string { throw 1; }), Contains("without an answer"));
    CHECK_THAT(failureOf([] { return std::string(); }), Contains("without an answer"));
    const auto forever = []() -> std::string {
        for (;;)
            ::pause();
    };
    CHECK_THAT(failureOf(forever, {.seconds = 0.2}), Contains("longer than 0.2 s"));
    CHECK_THAT(failureOf([] { return std::string(3u << 20, 'x'); }, {.answerBytes = 1u << 20}), Contains("1 MB"));
#ifndef __SANITIZE_ADDRESS__ // whose memory is not bounded, and which looks for leaks at exit
    CHECK_THAT(failureOf([]() -> std::string { std::exit(0); }), Contains("exit code 0 and without an answer"));
    const auto large = [] { return std::string(std::size_t(1) << 28, 'x').substr(0, 1); };
    CHECK_THAT(failureOf(large, {.moreMemory = 1e8}), Contains("without an answer"));
    CHECK(runInChild(large, {.moreMemory = 4e8}).bytes == "x");
#endif
    CHECK(::waitpid(-1, nullptr, WNOHANG) == -1); // no child is left behind
}

TEST_CASE("a child reads files and starts threads, but changes nothing and starts no program")
{
    TemporaryFolder folder;
    const fs::path there = folder / "there", other = folder / "other";
    writeContents(there, "held");
    const auto tried = [&](const std::string& what, const std::function<bool()>& attempt) {
        INFO(what);
        const ChildAnswer answer = runInChild([&] { return std::string(attempt() ? "done" : "refused"); }, {});
        CHECK(answer.failure == "");
        CHECK(answer.bytes == "refused");
    };
    CHECK(runInChild([&] { return contents(there); }, {}).bytes == "held");
    CHECK(runInChild(
              [] {
                  std::string said;
                  std::thread([&] { said = "from a thread"; }).join();
                  return said;
              },
              {})
              .bytes == "from a thread");
    tried("new file", [&] { return ::open(other.c_str(), O_WRONLY | O_CREAT, 0600) >= 0; });
    tried("old file", [&] { return ::open(there.c_str(), O_RDWR) >= 0; });
    tried("cut", [&] { return ::truncate(there.c_str(), 0) == 0; });
    tried("remove", [&] { return ::unlink(there.c_str()) == 0; });
    tried("rename", [&] { return ::rename(there.c_str(), other.c_str()) == 0; });
    tried("link", [&] { return ::link(there.c_str(), other.c_str()) == 0; });
    tried("folder", [&] { return ::mkdir(other.c_str(), 0700) == 0; });
    tried("mode", [&] { return ::chmod(there.c_str(), 0777) == 0; });
    tried("program", [&] { return std::system(("touch " + other.string()).c_str()) == 0; });
    tried("process", [] { return ::fork() >= 0; });
    tried("kill", [] { return ::kill(::getppid(), 0) == 0; });
    CHECK(contents(there) == "held");
    CHECK_FALSE(fs::exists(other));
}
