#include "output/hdf5Probe.hpp"

#include "base/childProcess.hpp"
#include "base/error.hpp"

#include <hdf5.h>
#include <vector>

namespace mpm::output
{
namespace
{
constexpr double longest = 60;                                 ///< [s]
constexpr std::size_t largestAttribute = std::size_t(1) << 30; ///< bytes

// The process ends with the look, so no handle is closed.

herr_t lookAtAttribute(hid_t object, const char* name, const H5A_info_t*, void*)
{
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(attribute);
    const hssize_t count = H5Sget_simple_extent_npoints(H5Aget_space(attribute));
    const std::size_t bytes = H5Tget_size(type), stored = H5Aget_storage_size(attribute);
    const bool plain = H5Tdetect_class(type, H5T_VLEN) == 0 && H5Tis_variable_str(type) == 0;
    if (plain && count > 0 && bytes > 0 && stored < largestAttribute && std::size_t(count) == stored / bytes)
        H5Aread(attribute, type, std::vector<char>(stored + 1).data());
    return 0;
}

herr_t lookAtObject(hid_t file, const char* name, const H5O_info_t* info, void*)
{
    H5Aiterate_by_name(file, name, H5_INDEX_NAME, H5_ITER_INC, nullptr, lookAtAttribute, nullptr, H5P_DEFAULT);
    if (info->type != H5O_TYPE_DATASET)
        return 0;
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    H5Tget_size(H5Dget_type(dataset));
    H5Sget_simple_extent_npoints(H5Dget_space(dataset));
    H5Pget_layout(H5Dget_create_plist(dataset));
    H5Dget_storage_size(dataset);
    return 0;
}
} // namespace

void requireHarmless(const std::filesystem::path& name)
{
    const auto look = [&] {
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        const hid_t file = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
        if (file >= 0)
            H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, lookAtObject, nullptr, H5O_INFO_BASIC);
        return std::string("seen");
    };
    const ChildAnswer answer = runInChild(look, {.seconds = longest});
    if (answer.ran && !answer.failure.empty())
        throw InputError({name.string()}, "damaged, or made to do harm: HDF5, which reads it, " + answer.failure);
}
} // namespace mpm::output
