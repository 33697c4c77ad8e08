#pragma once
/// Another utility as a process of its own: waited for, its log in a file, its price measured.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mpm::cases
{
struct ProcessResult
{
    int exitCode = -1;     ///< 128 + signal where one ended it; 127: it could not be started
    double cpuSeconds = 0; ///< user and system, all threads
    double wallSeconds = 0;
    bool ended(int code) const { return exitCode == code; }
};

/// Runs `program` with these arguments (word for word, no shell), standard output and error into `log`, nothing to
/// read, OMP_NUM_THREADS 1. It dies with its parent. `stopped` is asked about 100 times a second; once it says true
/// the child gets SIGTERM, ends its step and is waited for.
ProcessResult runProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                         const std::filesystem::path& log, const std::function<bool()>& stopped);

/// A utility of this installation: beside the running program.
std::filesystem::path utilityPath(const std::string& name);

/// What a utility said before it ended with an error: the text behind "error: ", one line; else the log's last line.
std::string errorInLog(const std::filesystem::path& log);
} // namespace mpm::cases
