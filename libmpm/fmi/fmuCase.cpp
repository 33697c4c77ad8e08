#include "fmi/fmuCase.hpp"

#include "base/error.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <unistd.h>
#include <vector>

namespace mpm::fmi
{
namespace fs = std::filesystem;

namespace
{
/// Temporary folders of instances that nobody freed go when the process ends; not when a child of fork() does.
class Leftovers
{
  public:
    ~Leftovers()
    {
        std::error_code none;
        if (getpid() == process_)
            for (const fs::path& folder : folders_)
                fs::remove_all(folder, none);
    }
    void add(const fs::path& folder)
    {
        const std::lock_guard lock(mutex_);
        folders_.insert(folder);
    }
    void remove(const fs::path& folder)
    {
        const std::lock_guard lock(mutex_);
        folders_.erase(folder);
    }

  private:
    std::mutex mutex_;
    std::set<fs::path> folders_;
    pid_t process_ = getpid();
};

Leftovers& leftovers()
{
    static Leftovers folders;
    return folders;
}
} // namespace

std::string tokenOf(const fs::path& caseFolder)
{
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(caseFolder))
        if (entry.is_regular_file())
            files.insert(entry.path().lexically_relative(caseFolder).generic_string());
    std::uint64_t names = hashOf("libmpm"), contents = hashOf("libmpm");
    std::vector<char> part(1 << 20);
    for (const std::string& file : files)
    {
        names = hashOf(file + "\n", names);
        std::ifstream in(caseFolder / file, std::ios::binary);
        do
        {
            in.read(part.data(), std::streamsize(part.size()));
            contents = hashOf({part.data(), std::size_t(in.gcount())}, contents);
        } while (in);
        contents = hashOf("\n", contents);
    }
    return fmt::format("{{{:016x}-{:016x}}}", names, contents);
}

CaseCopy::CaseCopy(const fs::path& caseFolder, const std::string& outputFolder)
{
    std::error_code error;
    if (outputFolder.empty())
    {
        std::string name = (fs::temp_directory_path() / "libmpm-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw InputError(fmt::format("cannot make a folder below {}", fs::temp_directory_path().string()));
        temporary_ = name;
        leftovers().add(temporary_);
        folder_ = temporary_ / caseFolderName;
    }
    else
    {
        folder_ = fs::absolute(outputFolder);
        if (fs::exists(folder_) && !(fs::is_directory(folder_) && fs::is_empty(folder_)))
            throw InputError(fmt::format("outputFolder: found '{}', which is there already, allowed: a new or an "
                                         "empty folder",
                                         outputFolder));
        made_ = fs::create_directories(folder_, error);
    }
    if (!error)
        fs::copy(caseFolder, folder_, fs::copy_options::recursive, error);
    // what was unpacked may be read-only; a calculation writes beside it
    if (!error)
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            fs::permissions(entry, fs::perms::owner_write, fs::perm_options::add, error);
    if (!error)
        fs::permissions(folder_, fs::perms::owner_write, fs::perm_options::add, error);
    if (!error)
        return;
    tidy();
    throw InputError(fmt::format("cannot copy the case to {}: {}", folder_.string(), error.message()));
}

void CaseCopy::tidy() const
{
    std::error_code none;
    if (isTemporary())
        leftovers().remove(temporary_);
    if (isTemporary() || made_)
        fs::remove_all(isTemporary() ? temporary_ : folder_, none);
    else
        for (const auto& entry : fs::directory_iterator(folder_, none))
            fs::remove_all(entry, none);
}

CaseCopy::~CaseCopy()
{
    if (isTemporary() || !kept_)
        tidy();
}
} // namespace mpm::fmi
