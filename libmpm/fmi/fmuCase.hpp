#pragma once
/// The case an FMU carries, resources/case, and the copy an instance works on: an instance may not write into the
/// unpacked FMU (FMI 3.0.2, section 2.5.1.6).
#include <filesystem>
#include <string>
#include <string_view>

namespace mpm::fmi
{
/// Where the case lies below the resources of an FMU.
inline constexpr const char* caseFolderName = "case";

/// instantiationToken: "{...}" of the names and contents of all files of a case, so that a case that was changed in an
/// unpacked FMU is found out.
std::string tokenOf(const std::filesystem::path& caseFolder);

/// A copy of a case: in a new folder below the system's temporary ones, which goes with this object, or in a folder the
/// user named, which must be new or empty, and stays once keep() was called. InputError if it cannot be made.
class CaseCopy
{
  public:
    CaseCopy(const std::filesystem::path& caseFolder, const std::string& outputFolder);
    ~CaseCopy();
    CaseCopy(const CaseCopy&) = delete;
    CaseCopy& operator=(const CaseCopy&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    bool isTemporary() const { return !temporary_.empty(); }
    void keep() { kept_ = true; }

  private:
    void tidy() const;

    std::filesystem::path temporary_, folder_;
    bool made_ = false, kept_ = false;
};
} // namespace mpm::fmi
