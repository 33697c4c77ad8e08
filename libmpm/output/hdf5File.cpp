#include "output/hdf5File.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <hdf5.h>
#include <type_traits>
#include <utility>

namespace mpm::output
{
namespace
{
static_assert(std::is_same_v<hid_t, std::int64_t>, "Hdf5File keeps HDF5's handles as int64");

constexpr hsize_t longestText = 64u << 20; ///< bytes; texts are dictionaries and names
constexpr int maxRank = 4;

/// Owns one HDF5 handle of any kind.
class Handle
{
  public:
    using Closer = herr_t (*)(hid_t);
    Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
    ~Handle()
    {
        if (id_ >= 0)
            closer_(id_);
    }
    Handle(Handle&& other) : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
    Handle& operator=(Handle&&) = delete;
    operator hid_t() const { return id_; }
    bool good() const { return id_ >= 0; }

  private:
    hid_t id_;
    Closer closer_;
};

template <class T>
hid_t memoryType()
{
    if constexpr (std::is_same_v<T, double>)
        return H5T_NATIVE_DOUBLE;
    else if constexpr (std::is_same_v<T, float>)
        return H5T_NATIVE_FLOAT;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return H5T_NATIVE_INT64;
    else
        return H5T_NATIVE_INT32;
}

template <class T>
hid_t fileType()
{
    if constexpr (std::is_same_v<T, double>)
        return H5T_IEEE_F64LE;
    else if constexpr (std::is_same_v<T, float>)
        return H5T_IEEE_F32LE;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return H5T_STD_I64LE;
    else
        return H5T_STD_I32LE;
}

template <class T>
std::string typeName()
{
    return fmt::format("{}-bit {}", 8 * sizeof(T), std::is_floating_point_v<T> ? "float" : "integer");
}

std::string describeType(hid_t type)
{
    const auto bits = 8 * H5Tget_size(type);
    switch (H5Tget_class(type))
    {
    case H5T_FLOAT:
        return fmt::format("{}-bit float", bits);
    case H5T_INTEGER:
        return fmt::format("{}-bit {}integer", bits, H5Tget_sign(type) == H5T_SGN_NONE ? "unsigned " : "");
    case H5T_STRING:
        return H5Tis_variable_str(type) > 0 ? "text of variable length" : "text";
    default:
        return "another type";
    }
}

template <class T>
bool isType(hid_t type)
{
    if (H5Tget_size(type) != sizeof(T))
        return false;
    if constexpr (std::is_floating_point_v<T>)
        return H5Tequal(type, std::is_same_v<T, double> ? H5T_IEEE_F64LE : H5T_IEEE_F32LE) > 0 ||
               H5Tequal(type, std::is_same_v<T, double> ? H5T_IEEE_F64BE : H5T_IEEE_F32BE) > 0;
    else
        return H5Tget_class(type) == H5T_INTEGER && H5Tget_sign(type) == H5T_SGN_2 &&
               H5Tget_precision(type) == 8 * sizeof(T);
}

std::string shapeText(const Shape& shape)
{
    std::string out;
    for (Index n : shape)
        out += (out.empty() ? "" : " x ") + (n < 0 ? std::string("any") : std::to_string(n));
    return out.empty() ? "a single value" : out;
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

Handle fixedTextType(std::size_t length)
{
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(length, 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

std::string withoutPadding(const char* text, std::size_t length)
{
    while (length > 0 && text[length - 1] == '\0')
        --length;
    return std::string(text, length);
}

void silenceHdf5()
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// A file access that leaves memory and descriptors when the last handle goes, whatever is still open.
hid_t strongAccess()
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    return access;
}

std::uint64_t lengthOnDisk(const std::filesystem::path& file)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : std::uint64_t(size);
}

Handle openDataset(const Hdf5File& file, hid_t id, const std::string& name)
{
    if (!file.exists(name))
        file.fail(name, "is missing");
    Handle dataset(H5Dopen2(id, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.good())
        file.fail(name, "is not a dataset that can be read");
    return dataset;
}

Shape extents(const Hdf5File& file, hid_t space, const std::string& name)
{
    const int rank = H5Sget_simple_extent_ndims(space);
    if (H5Sget_simple_extent_type(space) == H5S_NULL || rank < 0 || rank > maxRank)
        file.fail(name, fmt::format("has rank {}, at most {} is allowed", rank, maxRank));
    std::array<hsize_t, maxRank> dims{};
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    Shape out;
    for (int k = 0; k < rank; ++k)
    {
        if (dims[std::size_t(k)] > hsize_t(1) << 62)
            file.fail(name, "has an absurd extent");
        out.push_back(Index(dims[std::size_t(k)]));
    }
    return out;
}

/// Number of elements, or a failure if they cannot all lie in the file.
std::uint64_t countInside(const Hdf5File& file, hid_t dataset, const Shape& shape, std::size_t elementSize,
                          const std::string& name)
{
    const std::uint64_t length = lengthOnDisk(file.path());
    std::uint64_t count = 1;
    for (Index n : shape)
        if (n == 0)
            return 0;
    for (Index n : shape)
    {
        if (std::uint64_t(n) > length / elementSize / count)
            file.fail(name, fmt::format("claims {} elements of {} bytes, more than the file's {} bytes can hold",
                                        shapeText(shape), elementSize, length));
        count *= std::uint64_t(n);
    }
    const Handle properties(H5Dget_create_plist(dataset), H5Pclose);
    const auto layout = H5Pget_layout(properties);
    if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) != 0)
        file.fail(name, "keeps its values in another file, which is not allowed");
    if (H5Dget_storage_size(dataset) < count * elementSize)
        file.fail(name, "is compressed or was never written; plain storage is required");
    return count;
}

Handle openAttribute(const Hdf5File& file, hid_t id, const std::string& object, const std::string& name)
{
    if (!file.hasAttribute(object, name))
        file.fail(object, fmt::format("attribute {} is missing", name));
    Handle attribute(H5Aopen_by_name(id, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!attribute.good())
        file.fail(object, fmt::format("attribute {} cannot be read", name));
    return attribute;
}

template <class T>
void readAttribute(const Hdf5File& file, hid_t id, const std::string& object, const std::string& name,
                   const Shape& expected, T* values)
{
    const Handle attribute = openAttribute(file, id, object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (!isType<T>(type))
        file.fail(object, fmt::format("attribute {} is {}, {} expected", name, describeType(type), typeName<T>()));
    const Shape found = extents(file, space, object);
    if (found != expected)
        file.fail(object, fmt::format("attribute {} has the shape {}, {} expected", name, shapeText(found),
                                      shapeText(expected)));
    if (H5Aread(attribute, memoryType<T>(), values) < 0)
        file.fail(object, fmt::format("attribute {} cannot be read", name));
}

void writeAttribute(const Hdf5File& file, hid_t id, const std::string& object, const std::string& name, hid_t onDisk,
                    hid_t inMemory, const Shape& shape, const void* values)
{
    std::vector<hsize_t> dims(shape.begin(), shape.end());
    const Handle space(dims.empty() ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(int(dims.size()), dims.data(), nullptr),
                       H5Sclose);
    const Handle attribute(H5Acreate_by_name(id, object.c_str(), name.c_str(), onDisk, space, H5P_DEFAULT, H5P_DEFAULT,
                                             H5P_DEFAULT),
                           H5Aclose);
    if (!attribute.good() || H5Awrite(attribute, inMemory, values) < 0)
        file.fail(object, fmt::format("attribute {} cannot be written", name));
}
} // namespace

Hdf5File::Hdf5File(std::filesystem::path file, std::int64_t handle)
    : path_(std::move(file)), file_(handle), allowance_(16 * lengthOnDisk(path_))
{
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), allowance_(other.allowance_)
{
}

Hdf5File::~Hdf5File()
{
    if (file_ >= 0)
        H5Fclose(file_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& file)
{
    silenceHdf5();
    const Handle access(strongAccess(), H5Pclose);
    const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (id < 0)
        throw InputError({file.string()}, "cannot be written (is the folder there and writable?)");
    return Hdf5File(file, id);
}

namespace
{
hid_t openExisting(const std::filesystem::path& file, unsigned mode)
{
    silenceHdf5();
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw InputError({file.string()}, "no such file");
    if (!std::filesystem::is_regular_file(file, error))
        throw InputError({file.string()}, "is not a file");
    if (H5Fis_hdf5(file.c_str()) <= 0)
        throw InputError({file.string()}, "is not an HDF5 file (truncated, foreign, or not readable)");
    const Handle access(strongAccess(), H5Pclose);
    const hid_t id = H5Fopen(file.c_str(), mode, access);
    if (id < 0)
        throw InputError({file.string()}, "cannot be opened as HDF5: truncated, damaged, or locked by another program");
    return id;
}
} // namespace

Hdf5File Hdf5File::open(const std::filesystem::path& file)
{
    return Hdf5File(file, openExisting(file, H5F_ACC_RDONLY));
}

Hdf5File Hdf5File::edit(const std::filesystem::path& file)
{
    return Hdf5File(file, openExisting(file, H5F_ACC_RDWR));
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

void Hdf5File::fail(const std::string& object, const std::string& message) const
{
    throw InputError({path_.string()}, fmt::format("{}: {}", object, message));
}

void Hdf5File::makeGroup(const std::string& name)
{
    for (const auto& group : pathsDownTo(name))
    {
        if (exists(group))
            continue;
        const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
        if (!made.good())
            fail(group, "this group cannot be made");
    }
}

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, const Shape& shape, const std::string& unit)
{
    makeGroup(name.substr(0, name.rfind('/')));
    std::vector<hsize_t> dims(shape.begin(), shape.end());
    const Handle space(dims.empty() ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(int(dims.size()), dims.data(), nullptr),
                       H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != hssize_t(values.size()))
        fail(name, fmt::format("{} values do not fill the shape {}", values.size(), shapeText(shape)));
    const Handle dataset(H5Dcreate2(file_, name.c_str(), fileType<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose);
    if (!dataset.good())
        fail(name, "this dataset cannot be made");
    if (!values.empty() && H5Dwrite(dataset, memoryType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        fail(name, "this dataset cannot be written (disk full?)");
    if (!unit.empty())
        setAttribute(name, "unit", unit);
}

void Hdf5File::writeScalar(const std::string& name, double value, const std::string& unit)
{
    write<double>(name, std::span<const double>(&value, 1), {}, unit);
}

void Hdf5File::writeScalar(const std::string& name, Index value, const std::string& unit)
{
    write<std::int64_t>(name, std::span<const std::int64_t>(&value, 1), {}, unit);
}

void Hdf5File::writeText(const std::string& name, const std::string& text)
{
    makeGroup(name.substr(0, name.rfind('/')));
    const Handle type = fixedTextType(text.size());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle dataset(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    if (!dataset.good() || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0)
        fail(name, "this text cannot be written");
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, double value)
{
    writeAttribute(*this, file_, object, name, fileType<double>(), memoryType<double>(), {}, &value);
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, Index value)
{
    writeAttribute(*this, file_, object, name, fileType<Index>(), memoryType<Index>(), {}, &value);
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const Vector3& value)
{
    writeAttribute(*this, file_, object, name, fileType<double>(), memoryType<double>(), {3}, value.data());
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const std::string& value)
{
    const Handle type = fixedTextType(value.size());
    writeAttribute(*this, file_, object, name, type, type, {}, value.c_str());
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const std::vector<std::string>& value)
{
    std::size_t length = 1;
    for (const auto& text : value)
        length = std::max(length, text.size());
    std::vector<char> block(length * value.size() + 1, '\0');
    for (std::size_t i = 0; i < value.size(); ++i)
        std::memcpy(block.data() + i * length, value[i].data(), value[i].size());
    const Handle type = fixedTextType(length);
    writeAttribute(*this, file_, object, name, type, type, {Index(value.size())}, block.data());
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

Shape Hdf5File::shape(const std::string& name) const
{
    const Handle dataset = openDataset(*this, file_, name);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    return extents(*this, space, name);
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name, const Shape& expected) const
{
    const Handle dataset = openDataset(*this, file_, name);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    if (!isType<T>(type))
        fail(name, fmt::format("holds values of {}, {} expected", describeType(type), typeName<T>()));
    const Shape found = extents(*this, space, name);
    bool fits = found.size() == expected.size();
    for (std::size_t k = 0; fits && k < found.size(); ++k)
        fits = expected[k] < 0 || found[k] == expected[k];
    if (!fits)
        fail(name, fmt::format("has the shape {}, {} expected", shapeText(found), shapeText(expected)));
    const std::uint64_t count = countInside(*this, dataset, found, sizeof(T), name);
    if (count * sizeof(T) > allowance_)
        fail(name, "the file claims far more data than its length");
    allowance_ -= count * sizeof(T);
    std::vector<T> values(count);
    if (count > 0 && H5Dread(dataset, memoryType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        fail(name, "cannot be read: truncated or damaged");
    return values;
}

std::string Hdf5File::readText(const std::string& name) const
{
    const Handle dataset = openDataset(*this, file_, name);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
        fail(name, fmt::format("holds {}, text of fixed length expected", describeType(type)));
    const std::size_t length = H5Tget_size(type);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    if (!extents(*this, space, name).empty() || length > longestText)
        fail(name, "must be a single text of at most 64 MiB");
    countInside(*this, dataset, {1}, length, name);
    if (length > allowance_)
        fail(name, "the file claims far more data than its length");
    allowance_ -= length;
    std::vector<char> block(length);
    const Handle plain = fixedTextType(length);
    H5Tset_cset(plain, H5Tget_cset(type));
    if (H5Dread(dataset, plain, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) < 0)
        fail(name, "this text cannot be read");
    return withoutPadding(block.data(), length);
}

double Hdf5File::realAttribute(const std::string& object, const std::string& name) const
{
    double value = 0;
    readAttribute(*this, file_, object, name, {}, &value);
    return value;
}

Index Hdf5File::integerAttribute(const std::string& object, const std::string& name) const
{
    Index value = 0;
    readAttribute(*this, file_, object, name, {}, &value);
    return value;
}

Vector3 Hdf5File::vectorAttribute(const std::string& object, const std::string& name) const
{
    Vector3 value{};
    readAttribute(*this, file_, object, name, {3}, value.data());
    return value;
}

std::string Hdf5File::textAttribute(const std::string& object, const std::string& name) const
{
    const auto texts = textsAttribute(object, name);
    if (texts.size() != 1)
        fail(object, fmt::format("attribute {} holds {} texts, one expected", name, texts.size()));
    return texts.front();
}

std::vector<std::string> Hdf5File::textsAttribute(const std::string& object, const std::string& name) const
{
    const Handle attribute = openAttribute(*this, file_, object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
        fail(object, fmt::format("attribute {} is {}, text of fixed length expected", name, describeType(type)));
    const Shape found = extents(*this, space, object);
    const std::size_t length = H5Tget_size(type);
    const std::uint64_t count = found.empty() ? 1 : std::uint64_t(found.front());
    if (found.size() > 1 || count > longestText || length > longestText || count * length > allowance_)
        fail(object, fmt::format("attribute {} is longer than the file", name));
    allowance_ -= count * length;
    std::vector<char> block(count * length + 1);
    const Handle plain = fixedTextType(length);
    H5Tset_cset(plain, H5Tget_cset(type));
    if (count > 0 && H5Aread(attribute, plain, block.data()) < 0)
        fail(object, fmt::format("attribute {} cannot be read", name));
    std::vector<std::string> texts;
    for (std::uint64_t i = 0; i < count; ++i)
        texts.push_back(withoutPadding(block.data() + i * length, length));
    return texts;
}

template void Hdf5File::write<double>(const std::string&, std::span<const double>, const Shape&, const std::string&);
template void Hdf5File::write<float>(const std::string&, std::span<const float>, const Shape&, const std::string&);
template void Hdf5File::write<std::int64_t>(const std::string&, std::span<const std::int64_t>, const Shape&,
                                            const std::string&);
template void Hdf5File::write<std::int32_t>(const std::string&, std::span<const std::int32_t>, const Shape&,
                                            const std::string&);
template std::vector<double> Hdf5File::read<double>(const std::string&, const Shape&) const;
template std::vector<float> Hdf5File::read<float>(const std::string&, const Shape&) const;
template std::vector<std::int64_t> Hdf5File::read<std::int64_t>(const std::string&, const Shape&) const;
template std::vector<std::int32_t> Hdf5File::read<std::int32_t>(const std::string&, const Shape&) const;
} // namespace mpm::output
