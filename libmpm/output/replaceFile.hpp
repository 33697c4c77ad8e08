#pragma once
/// Files that are never half-written: the new content goes to a temporary name in the same folder, is brought to the
/// disk (fsync) and renamed over the old file, which POSIX does at once or not at all. Whatever happens before the
/// rename leaves the old file as it was; a left-over temporary is overwritten by the next try.
#include <filesystem>
#include <string>

namespace mpm::output
{
/// "<file>.partial": the temporary name that belongs to a file.
std::filesystem::path temporaryName(const std::filesystem::path& file);

/// fsync of the temporary, rename to `file`, fsync of the folder. Throws InputError and removes the temporary if the
/// file system refuses.
void commitTemporary(const std::filesystem::path& file);

/// Copies a file to its temporary, to be changed there. Throws InputError and removes the temporary if it cannot.
/// (std::filesystem::copy_file goes on byte by byte behind the 2 GB that one call of sendfile takes.)
void copyToTemporary(const std::filesystem::path& file);

/// fsync of a file that is there; nothing if the file system refuses.
void synchroniseFile(const std::filesystem::path& file);

/// Writes a whole text file that way.
void replaceText(const std::filesystem::path& file, const std::string& text);

/// Makes a folder and those above it. Throws InputError naming it and the reason.
void makeFolder(const std::filesystem::path& folder);
} // namespace mpm::output
