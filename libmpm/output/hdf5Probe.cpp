#include "output/hdf5Probe.hpp"

#include "base/childProcess.hpp"
#include "base/error.hpp"

#include <array>
#include <cstdint>
#include <hdf5.h>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace mpm::output
{
namespace
{
constexpr double longest = 60;                         ///< [s]
constexpr double ample = 256e6;                        ///< bytes for HDF5's caches, beside the file's length
constexpr char whole = 'w', unopened = 'u', bad = 'b'; ///< first byte of an answer; after `bad` the object's name

/// What the process is at. It ends with the look, so no handle is closed.
struct Look
{
    std::uint64_t length; ///< of the file
    std::string object;
};

herr_t lookAtAttribute(hid_t object, const char* name, const H5A_info_t*, void* look)
{
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
    const hssize_t count = H5Sget_simple_extent_npoints(H5Aget_space(attribute));
    const std::size_t bytes = H5Tget_size(type), stored = H5Aget_storage_size(attribute);
    if (attribute < 0 || type < 0 || count < 0 || bytes == 0 || stored > static_cast<const Look*>(look)->length)
        return -1;
    const bool plain = H5Tdetect_class(type, H5T_VLEN) == 0 && H5Tis_variable_str(type) == 0;
    if (plain && std::size_t(count) == stored / bytes)
        return H5Aread(attribute, type, std::vector<char>(stored + 1).data());
    return 0;
}

herr_t lookAtObject(hid_t file, const char* name, const H5O_info_t* info, void* look)
{
    static_cast<Look*>(look)->object = name;
    if (H5Aiterate_by_name(file, name, H5_INDEX_NAME, H5_ITER_INC, nullptr, lookAtAttribute, look, H5P_DEFAULT) < 0)
        return -1;
    if (info->type != H5O_TYPE_DATASET)
        return 0;
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    const bool good = H5Tget_size(H5Dget_type(dataset)) > 0 &&
                      H5Sget_simple_extent_npoints(H5Dget_space(dataset)) >= 0 &&
                      H5Pget_layout(H5Dget_create_plist(dataset)) >= 0;
    H5Dget_storage_size(dataset); // 0 also means none
    return good ? 0 : -1;
}

std::string lookAtAll(const std::filesystem::path& name, std::uint64_t length)
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const hid_t file = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return {unopened};
    Look look{length, "."};
    if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, lookAtObject, &look, H5O_INFO_BASIC) < 0)
        return bad + (look.object == "." ? "/" : "/" + look.object);
    return {whole};
}

using Identity = std::array<std::int64_t, 5>;
std::set<Identity> known;
std::mutex knownMutex;

/// Device, inode, length and time of change of a file.
std::optional<Identity> identityOf(const std::filesystem::path& name)
{
    struct stat s;
    if (::stat(name.c_str(), &s) != 0)
        return std::nullopt;
    return Identity{std::int64_t(s.st_dev), std::int64_t(s.st_ino), std::int64_t(s.st_size), s.st_ctim.tv_sec,
                    s.st_ctim.tv_nsec};
}
} // namespace

void rememberHarmless(const std::filesystem::path& name)
{
    if (const auto file = identityOf(name))
    {
        const std::lock_guard guard(knownMutex);
        known.insert(*file);
    }
}

void requireHarmless(const std::filesystem::path& name)
{
    if (const auto file = identityOf(name))
    {
        const std::lock_guard guard(knownMutex);
        if (known.count(*file))
            return;
    }
    std::error_code ignored;
    const std::uint64_t length = std::filesystem::file_size(name, ignored);
    const ChildAnswer answer =
        runInChild([&] { return lookAtAll(name, length); }, {.seconds = longest, .moreMemory = ample + double(length)});
    if (!answer.ran)
        return;
    if (!answer.failure.empty())
        throw InputError({name.string()}, "damaged, or made to do harm: HDF5, which reads it, " + answer.failure);
    if (answer.bytes[0] == unopened)
        throw InputError({name.string()}, "cannot be opened as HDF5: truncated, damaged, or locked by another program");
    if (answer.bytes[0] == bad)
        throw InputError({name.string()}, "truncated or damaged at " + answer.bytes.substr(1) + " or behind it");
    rememberHarmless(name);
}
} // namespace mpm::output
