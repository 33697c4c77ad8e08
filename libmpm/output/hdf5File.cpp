#include "output/hdf5File.hpp"

#include "base/error.hpp"
#include "output/hdf5Handle.hpp"
#include "output/hdf5Probe.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <type_traits>
#include <utility>

namespace mpm::output
{
namespace
{
static_assert(std::is_same_v<hid_t, std::int64_t>, "Hdf5File keeps HDF5's handles as int64");

constexpr int maxRank = 4;
constexpr Index blocksAhead = 16; ///< blocks of a dataset between looks at the disk

/// HDF5's type for an element in a file (little-endian) or in memory (native).
template <class Element>
Handle typeOf(const Element& element, bool inFile)
{
    const bool wide = element.bytes == 8;
    switch (element.kind)
    {
    case Element::Kind::real:
        return {H5Tcopy(inFile ? (wide ? H5T_IEEE_F64LE : H5T_IEEE_F32LE)
                        : wide ? H5T_NATIVE_DOUBLE
                               : H5T_NATIVE_FLOAT),
                H5Tclose};
    case Element::Kind::integer:
        return {H5Tcopy(inFile ? (wide ? H5T_STD_I64LE : H5T_STD_I32LE)
                        : wide ? H5T_NATIVE_INT64
                               : H5T_NATIVE_INT32),
                H5Tclose};
    default:
        Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        H5Tset_size(type, element.bytes);
        H5Tset_strpad(type, H5T_STR_NULLPAD);
        H5Tset_cset(type, H5T_CSET_UTF8);
        return type;
    }
}

template <class Element>
Element elementIn(hid_t type)
{
    using Kind = typename Element::Kind;
    const std::size_t bytes = H5Tget_size(type);
    const auto is = [&](hid_t little, hid_t big) { return H5Tequal(type, little) > 0 || H5Tequal(type, big) > 0; };
    if (is(H5T_IEEE_F64LE, H5T_IEEE_F64BE) || is(H5T_IEEE_F32LE, H5T_IEEE_F32BE))
        return {Kind::real, bytes};
    if (is(H5T_STD_I64LE, H5T_STD_I64BE) || is(H5T_STD_I32LE, H5T_STD_I32BE))
        return {Kind::integer, bytes};
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0)
        return {Kind::text, bytes};
    return {};
}

Handle spaceOf(const Shape& shape)
{
    const std::vector<hsize_t> dims(shape.begin(), shape.end());
    return {dims.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(int(dims.size()), dims.data(), nullptr), H5Sclose};
}

/// Selects rows first ... first + n - 1 in the space of a dataset; returns the space of such a block in memory.
Handle selectRows(hid_t space, const Shape& shape, Index first, Index n)
{
    std::vector<hsize_t> count(shape.begin(), shape.end()), start(shape.size(), 0);
    count.front() = hsize_t(n);
    start.front() = hsize_t(first);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    return {H5Screate_simple(int(count.size()), count.data(), nullptr), H5Sclose};
}

/// "/a", "/a/b", ... of "/a/b/c", the whole name last.
std::vector<std::string> pathsDownTo(const std::string& name)
{
    std::vector<std::string> out;
    for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1))
        out.push_back(name.substr(0, slash));
    if (name.size() > 1)
        out.push_back(name);
    return out;
}

/// File access in which closing the file closes everything in it, and what is written is in the format of HDF5 1.8,
/// whose superblock, headers and heaps carry checksums: damage is noticed before the library walks through it.
///
/// At the program's end HDF5 would try once more to write a file that met a full disk, and crash: every file is closed
/// here, nothing is left for that moment. Has to be said before the library's first call.
Handle strongAccess()
{
    [[maybe_unused]] static const herr_t noFarewell = H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // our messages, not HDF5's
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    return access;
}

/// Without the time an object is made at: the same content is the same file.
Handle timeless(hid_t kind)
{
    Handle list(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(list, false);
    return list;
}

std::uint64_t lengthOnDisk(const std::filesystem::path& file)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : std::uint64_t(size);
}

Handle openDataset(hid_t file, const std::string& name)
{
    return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
}

Handle openAttribute(hid_t file, const std::string& object, const std::string& name)
{
    return {H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
}
} // namespace

// Files ---------------------------------------------------------------------------------------------------------------

Hdf5File::Hdf5File(std::filesystem::path file, std::int64_t handle, bool onDisk)
    : path_(std::move(file)), file_(handle), onDisk_(onDisk), allowance_(16 * lengthOnDisk(path_))
{}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), onDisk_(other.onDisk_),
      allowance_(other.allowance_)
{}

Hdf5File::~Hdf5File()
{
    if (file_ >= 0)
        H5Fclose(file_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& file, bool onDisk)
{
    const Handle access = strongAccess();
    if (!onDisk)
        H5Pset_fapl_core(access, 1 << 20, false); // grows by so many bytes
    const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, timeless(H5P_FILE_CREATE), access);
    if (id < 0)
        throw InputError({file.string()}, "cannot be written (is the folder there and writable?)");
    return Hdf5File(file, id, onDisk);
}

double Hdf5File::bytes() const
{
    H5Fflush(file_, H5F_SCOPE_GLOBAL);
    return double(H5Fget_file_image(file_, nullptr, 0)); // without the room a file in memory keeps
}

std::int64_t Hdf5File::openExisting(const std::filesystem::path& file, bool writable)
{
    const Handle access = strongAccess();
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw InputError({file.string()}, "no such file");
    if (!std::filesystem::is_regular_file(file, error))
        throw InputError({file.string()}, "is not a file");
    if (H5Fis_hdf5(file.c_str()) <= 0)
        throw InputError({file.string()}, "is not an HDF5 file (truncated, foreign, or not readable)");
    requireHarmless(file);
    const hid_t id = H5Fopen(file.c_str(), writable ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access);
    if (id < 0)
        throw InputError({file.string()}, "cannot be opened as HDF5: truncated, damaged, or locked by another program");
    return id;
}

Hdf5File Hdf5File::open(const std::filesystem::path& file)
{
    return Hdf5File(file, openExisting(file, false));
}

Hdf5File Hdf5File::edit(const std::filesystem::path& file)
{
    return Hdf5File(file, openExisting(file, true));
}

void Hdf5File::close()
{
    if (file_ < 0)
        return;
    const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
    const bool closed = H5Fclose(std::exchange(file_, -1)) >= 0;
    if (!flushed || !closed)
        throw InputError({path_.string()}, "could not be written to the end (disk full?)");
}

// Groups and names ----------------------------------------------------------------------------------------------------

void Hdf5File::makeGroup(const std::string& name)
{
    for (const auto& group : pathsDownTo(name))
    {
        if (exists(group))
            continue;
        const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, timeless(H5P_GROUP_CREATE), H5P_DEFAULT),
                          H5Gclose);
        if (!made.good())
            fail(group, "this group cannot be made");
    }
}

void Hdf5File::remove(const std::string& name)
{
    if (exists(name) && H5Ldelete(file_, name.c_str(), H5P_DEFAULT) < 0)
        fail(name, "cannot be removed");
}

bool Hdf5File::exists(const std::string& name) const
{
    for (const auto& part : pathsDownTo(name))
    {
        H5L_info_t info;
        if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0 ||
            H5Lget_info(file_, part.c_str(), &info, H5P_DEFAULT) < 0)
            return false;
        if (info.type != H5L_TYPE_HARD)
            fail(part, "is a link, which is not allowed");
    }
    return true;
}

bool Hdf5File::hasAttribute(const std::string& object, const std::string& name) const
{
    return exists(object) && H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::members(const std::string& group) const
{
    std::vector<std::string> names;
    if (!exists(group))
        return names;
    const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!opened.good())
        fail(group, "is not a group");
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    if (H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0)
        fail(group, "its members cannot be listed");
    return names;
}

// Bytes ---------------------------------------------------------------------------------------------------------------

void Hdf5File::store(const std::string& object, const std::string& attribute, Element element, const Shape& shape,
                     const void* values)
{
    const Handle onDisk = typeOf(element, true), inMemory = typeOf(element, false), space = spaceOf(shape);
    const bool any = H5Sget_simple_extent_npoints(space) > 0;
    if (attribute.empty())
    {
        makeGroup(object.substr(0, object.rfind('/')));
        const Handle dataset(
            H5Dcreate2(file_, object.c_str(), onDisk, space, H5P_DEFAULT, timeless(H5P_DATASET_CREATE), H5P_DEFAULT),
            H5Dclose);
        if (!dataset.good() || (any && H5Dwrite(dataset, inMemory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
            fail(object, "cannot be written (disk full, or already there)");
        followDisk();
        return;
    }
    const Handle made(H5Acreate_by_name(file_, object.c_str(), attribute.c_str(), onDisk, space, H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
    if (!made.good() || H5Awrite(made, inMemory, values) < 0)
        fail(object, attribute, "cannot be written");
}

void Hdf5File::followDisk()
{
    void* descriptor = nullptr; // of the file driver for plain files, which is the default
    if (onDisk_ && H5Fget_vfd_handle(file_, H5P_DEFAULT, &descriptor) >= 0 && descriptor)
        pace_.follow(*static_cast<const int*>(descriptor));
}

void Hdf5File::storeBlocks(const std::string& object, Element element, const Shape& shape, Index rows,
                           const void* block, const BlockWork& fill)
{
    makeGroup(object.substr(0, object.rfind('/')));
    const Handle space = spaceOf(shape), inMemory = typeOf(element, false);
    const Handle dataset(H5Dcreate2(file_, object.c_str(), typeOf(element, true), space, H5P_DEFAULT,
                                    timeless(H5P_DATASET_CREATE), H5P_DEFAULT),
                         H5Dclose);
    bool good = dataset.good();
    for (Index first = 0; good && first < shape.front(); first += rows)
    {
        const Index n = std::min(rows, shape.front() - first);
        fill(first, n);
        const Handle part = selectRows(space, shape, first, n);
        good = H5Dwrite(dataset, inMemory, part, space, H5P_DEFAULT, block) >= 0;
        if (first / rows % blocksAhead == blocksAhead - 1)
            followDisk();
    }
    if (!good)
        fail(object, "cannot be written (disk full, or already there)");
}

void Hdf5File::fetchBlocks(const std::string& object, Element element, const Shape& shape, Index rows, void* block,
                           const BlockWork& take) const
{
    const Handle dataset = openDataset(file_, object), space = spaceOf(shape), inMemory = typeOf(element, false);
    for (Index first = 0; first < shape.front(); first += rows)
    {
        const Index n = std::min(rows, shape.front() - first);
        const Handle part = selectRows(space, shape, first, n);
        if (H5Dread(dataset, inMemory, part, space, H5P_DEFAULT, block) < 0)
            fail(object, "cannot be read: truncated or damaged");
        take(first, n);
    }
}

Hdf5File::Found Hdf5File::find(const std::string& object, const std::string& attribute) const
{
    const bool isDataset = attribute.empty();
    if (isDataset ? !exists(object) : !hasAttribute(object, attribute))
        fail(object, attribute, "is missing");
    const Handle opened = isDataset ? openDataset(file_, object) : openAttribute(file_, object, attribute);
    if (!opened.good())
        fail(object, attribute, "cannot be read (damaged, or not a dataset)");
    const Handle type(isDataset ? H5Dget_type(opened) : H5Aget_type(opened), H5Tclose);
    const Handle space(isDataset ? H5Dget_space(opened) : H5Aget_space(opened), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (H5Sget_simple_extent_type(space) == H5S_NULL || rank < 0 || rank > maxRank)
        fail(object, attribute, fmt::format("has rank {}, at most {} is allowed", rank, maxRank));
    std::array<hsize_t, maxRank> dims{};
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    Found found{elementIn<Element>(type), {}};
    for (int k = 0; k < rank; ++k)
        found.shape.push_back(Index(std::min<hsize_t>(dims[std::size_t(k)], hsize_t(1) << 62)));
    return found;
}

std::uint64_t Hdf5File::claim(const std::string& object, const std::string& attribute, const Found& found) const
{
    const std::uint64_t length = lengthOnDisk(path_), bytes = std::max<std::uint64_t>(1, found.element.bytes);
    std::uint64_t count = 1;
    for (Index n : found.shape)
        count = n == 0 ? 0 : count;
    for (Index n : found.shape)
    {
        if (count > 0 && std::uint64_t(n) > length / bytes / count)
            fail(object, attribute, fmt::format("claims more values than the file's {} bytes can hold", length));
        count *= std::uint64_t(n);
    }
    if (bytes > length || count * bytes > allowance_)
        fail(object, attribute, fmt::format("claims more values than the file's {} bytes can hold", length));
    allowance_ -= count * bytes;
    if (attribute.empty() && count > 0)
    {
        const Handle dataset = openDataset(file_, object);
        const Handle properties(H5Dget_create_plist(dataset), H5Pclose);
        const H5D_layout_t layout = H5Pget_layout(properties);
        if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) != 0)
            fail(object, "keeps its values in another file, which is not allowed");
        if (layout == H5D_CHUNKED || H5Dget_storage_size(dataset) < count * bytes)
            fail(object, "is in chunks, compressed or was never written; plain storage is required");
    }
    return count;
}

void Hdf5File::fetch(const std::string& object, const std::string& attribute, Element element, void* values) const
{
    const bool isDataset = attribute.empty();
    const Handle opened = isDataset ? openDataset(file_, object) : openAttribute(file_, object, attribute);
    const Handle inFile(isDataset ? H5Dget_type(opened) : H5Aget_type(opened), H5Tclose);
    const Handle inMemory = typeOf(element, false);
    if (element.kind == Element::Kind::text)
        H5Tset_cset(inMemory, H5Tget_cset(inFile));
    if ((isDataset ? H5Dread(opened, inMemory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values)
                   : H5Aread(opened, inMemory, values)) < 0)
        fail(object, attribute, "cannot be read: truncated or damaged");
}
} // namespace mpm::output
