#include "case/fileWatch.hpp"

#include "base/hash.hpp"

#include <array>
#include <chrono>
#include <fstream>
#include <thread>

namespace fs = std::filesystem;

namespace mpm::cases
{
namespace
{
bool isLeftByEditors(const std::string& name)
{
    return name.empty() || name.front() == '.' || name.front() == '#' || name.back() == '~' || name.ends_with(".swp") ||
           name.ends_with(".partial");
}

std::uint64_t hashOfFile(const fs::path& file)
{
    std::uint64_t hash = hashOf("");
    std::ifstream in(file, std::ios::binary);
    std::array<char, 65536> bytes;
    while (in.read(bytes.data(), bytes.size()), in.gcount() > 0)
        hash = hashOf({bytes.data(), std::size_t(in.gcount())}, hash);
    return hash;
}
} // namespace

FileWatch::FileWatch(std::vector<fs::path> folders, double interval, double settle)
    : folders_(std::move(folders)), interval_(interval), settle_(settle), known_(look({}))
{}

/// Files may go while they are looked at: what cannot be read is not there.
FileWatch::Prints FileWatch::look(const Prints& known) const
{
    Prints found;
    for (const fs::path& folder : folders_)
    {
        std::error_code error;
        for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
             !error && at != end; at.increment(error))
        {
            std::error_code gone;
            if (isLeftByEditors(at->path().filename().string()) || !at->is_regular_file(gone) || gone)
                continue;
            Print print{at->last_write_time(gone), at->file_size(gone), 0};
            if (gone)
                continue;
            const auto before = known.find(at->path());
            const bool same =
                before != known.end() && before->second.time == print.time && before->second.size == print.size;
            print.hash = same ? before->second.hash : hashOfFile(at->path());
            found.emplace(at->path(), print);
        }
    }
    return found;
}

std::optional<std::vector<fs::path>> FileWatch::wait(const std::function<bool()>& stop)
{
    using Clock = std::chrono::steady_clock;
    Prints last = look(known_);
    auto quietSince = Clock::now();
    while (!stop())
    {
        if (last == known_)
            known_ = last; // new times of old contents
        else if (std::chrono::duration<double>(Clock::now() - quietSince).count() >= settle_)
        {
            std::vector<fs::path> changed;
            for (const auto& [path, print] : last)
                if (const auto before = known_.find(path); before == known_.end() || !(before->second == print))
                    changed.push_back(path);
            for (const auto& [path, print] : known_)
                if (!last.count(path))
                    changed.push_back(path);
            known_ = std::move(last);
            return changed;
        }
        std::this_thread::sleep_for(std::chrono::duration<double>(interval_));
        Prints now = look(last);
        if (now != last)
            quietSince = Clock::now();
        last = std::move(now);
    }
    return std::nullopt;
}
} // namespace mpm::cases
