#pragma once
/// The ZIP archive an FMU is (FMI 3.0.2, section 2.5): written beside its name and renamed once it is whole, so that
/// there is never half an FMU. InputError if it cannot be written.
#include <filesystem>
#include <string>

struct zip;
struct zip_source;

namespace mpm::fmi
{
class FmuArchive
{
  public:
    explicit FmuArchive(const std::filesystem::path& file);
    ~FmuArchive(); ///< without close() nothing is written
    FmuArchive(const FmuArchive&) = delete;
    FmuArchive& operator=(const FmuArchive&) = delete;

    void addText(const std::string& name, const std::string& text);
    void addFile(const std::string& name, const std::filesystem::path& file);
    /// All files below a folder, as name/...
    void addFolder(const std::string& name, const std::filesystem::path& folder);
    void close();

  private:
    void add(const std::string& name, ::zip_source* source);
    [[noreturn]] void fail() const;

    std::filesystem::path file_;
    struct zip* zip_ = nullptr;
};
} // namespace mpm::fmi
