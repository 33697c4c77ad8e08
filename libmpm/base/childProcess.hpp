#pragma once
/// Work in a process of its own, for libraries that may crash, hang, or end the program they run in.
///
///     const ChildAnswer answer = runInChild([&] { return bytesOf(parse(file)); }, {.seconds = 300});
///     if (!answer.failure.empty())
///         throw InputError({file, 0}, "the parser " + answer.failure); // "was ended by signal 11 (Segmentation
///         fault)"
///
/// The child is a fork: it sees everything the caller holds and nothing it does comes back but the bytes. It can read
/// files but not make, change or remove any, and can start no program (confine.hpp). Its standard output and error are
/// closed. It dies with its parent. Threads are not forked: do not call it while a thread holds a lock the work needs.
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace mpm
{
struct ChildLimits
{
    double seconds = 300;                   ///< of wall time, then it is ended
    std::uint64_t answerBytes = 1ull << 30; ///< a longer answer is a failure
    double moreMemory =
        std::numeric_limits<double>::infinity(); ///< than the caller has [bytes]; never above the machine
};

struct ChildAnswer
{
    std::string bytes;   ///< what the work returned; empty after a failure
    std::string failure; ///< why there is no answer, to stand after the name of who failed; empty if there is one
    bool ran = false;    ///< false: the process could not even be started
    bool late = false;   ///< it failed because its time was over
};

/// The work must return at least one byte and handle its own exceptions: one that escapes is a failure.
ChildAnswer runInChild(const std::function<std::string()>& work, const ChildLimits& limits);
} // namespace mpm
