#pragma once
/// One program at a time writes in a case folder.
///
///     const CaseLock lock("column", "mpmSolve");      // InputError if another program writes there
///
/// The file <case>/.caseLock is locked by flock(2): the kernel lets go when the process ends, however it ends, so a
/// dead process holds nothing. Its text is for the message: "mpmSolve, process 4711 on HOST since 2026-01-31 12:03:05".
/// The file goes with the lock; one that a killed process left behind is taken over by the next. Programs that only
/// read, and -dry-run, need no lock.
///
/// Errors: the case is in use (by whom); the file cannot be made (read-only folder, full disk). A file system without
/// locks is no error: a note on stderr says so. flock over NFS holds between machines; where a file system locks only
/// within a machine, so does this.
#include "case/application.hpp"

#include <filesystem>
#include <string>

namespace mpm::cases
{
class CaseLock
{
  public:
    CaseLock(const std::filesystem::path& caseFolder, const std::string& program);
    /// Of the utility's case, unless nothing is going to be written (-dry-run).
    CaseLock(const Options& options, const std::string& program);
    ~CaseLock();
    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

    /// Empty if the lock holds.
    const std::string& note() const { return note_; }

  private:
    void lock(const std::string& program);
    bool open();
    bool stillNamed() const;
    [[noreturn]] void refuse() const;

    std::filesystem::path folder_, file_;
    std::string note_;
    int descriptor_ = -1;
};
} // namespace mpm::cases
