#pragma once
/// One HDF5 file: typed arrays with a shape, attributes and texts. A thin layer over the C library (hdf5File.cpp is the
/// only place that knows it; hdf5Values.cpp has the types), serial, little-endian on disk.
///
/// Names are absolute ("/particles/mass"); writing makes the groups in between. Every failure is an InputError that
/// names the file and the object; HDF5's own messages are switched off.
///
/// A reader does not trust its file. An array must have exactly the element type asked for (double, float, int64,
/// int32; either byte order), the shape asked for, its bytes inside the file: soft, external and virtual objects,
/// external storage, chunked, compressed or unallocated data are refused, and all that is read from one file may not
/// exceed sixteen times its length. So no file makes a program allocate much more than the file itself takes on disk.
/// A file shorter than it was written is refused when opened. Files are written in HDF5's 1.8 format, whose headers
/// carry checksums, so damage to them is found before it leads anywhere.
///
///     auto file = Hdf5File::create("state.h5");
///     file.write<double>("/particles/mass", mass, {n}, "kg");
///     file.setAttribute("/", "time", 0.25);
///     file.close();                                    // flushed, or InputError
///     auto again = Hdf5File::open("state.h5");
///     auto m = again.read<double>("/particles/mass", {-1});
#include "base/types.hpp"
#include "output/diskPace.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpm::output
{
using Shape = std::vector<Index>;

template <class T>
using RowFiller = std::function<void(Index first, Index rows, T* out)>;
template <class T>
using RowTaker = std::function<void(Index first, Index rows, const T* in)>;

class Hdf5File
{
  public:
    /// New and empty; an old file of that name is lost. Not onDisk: in memory, gone with the object.
    static Hdf5File create(const std::filesystem::path& file, bool onDisk = true);
    static Hdf5File open(const std::filesystem::path& file); ///< to read
    static Hdf5File edit(const std::filesystem::path& file); ///< to read and write
    ~Hdf5File();
    Hdf5File(Hdf5File&& other) noexcept;
    Hdf5File& operator=(Hdf5File&&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Closes and reports what could not be written; the destructor closes silently.
    void close();

    /// Its length, once all is flushed [bytes].
    double bytes() const;

    /// A group with those above it, if they are not there.
    void makeGroup(const std::string& name);
    /// A new dataset; values.size() = product of the shape. T: double, float, int64, int32.
    /// A unit becomes the attribute "unit" ("1" for pure numbers); an empty one is left out.
    template <class T>
    void write(const std::string& name, std::span<const T> values, const Shape& shape, const std::string& unit);
    /// The same block by block, for arrays that stand elsewhere in another order: fill(first, rows, out) puts the rows
    /// first ... first + rows - 1 one after the other. Memory: one block.
    template <class T>
    void writeRows(const std::string& name, const Shape& shape, const std::string& unit, const RowFiller<T>& fill);
    void writeScalar(const std::string& name, double value, const std::string& unit);
    void writeScalar(const std::string& name, Index value, const std::string& unit);
    /// A text as scalar dataset, fixed length, UTF-8 (no zero bytes inside).
    void writeText(const std::string& name, const std::string& text);
    void setAttribute(const std::string& object, const std::string& name, double value);
    void setAttribute(const std::string& object, const std::string& name, Index value);
    void setAttribute(const std::string& object, const std::string& name, const Vector3& value);
    void setAttribute(const std::string& object, const std::string& name, const std::string& value);
    void setAttribute(const std::string& object, const std::string& name, const std::vector<std::string>& value);
    /// Removes an object, if it is there.
    void remove(const std::string& name);

    bool exists(const std::string& name) const;
    bool hasAttribute(const std::string& object, const std::string& name) const;
    /// Names of a group's members, by name.
    std::vector<std::string> members(const std::string& group) const;
    /// Extents of a dataset (empty for a scalar).
    Shape shape(const std::string& name) const;
    /// The values; an expected extent of -1 allows any.
    template <class T>
    std::vector<T> read(const std::string& name, const Shape& expected) const;
    /// The same block by block: take(first, rows, in). The whole array is checked before the first block.
    template <class T>
    void readRows(const std::string& name, const Shape& expected, const RowTaker<T>& take) const;
    double readReal(const std::string& name) const { return read<double>(name, {}).front(); }
    std::string readText(const std::string& name) const;
    double realAttribute(const std::string& object, const std::string& name) const;
    Index integerAttribute(const std::string& object, const std::string& name) const;
    Vector3 vectorAttribute(const std::string& object, const std::string& name) const;
    std::string textAttribute(const std::string& object, const std::string& name) const;
    std::vector<std::string> textsAttribute(const std::string& object, const std::string& name) const;

    /// Throws InputError "file: object: message".
    [[noreturn]] void fail(const std::string& object, const std::string& message) const;

  private:
    /// Element type on the disk, without HDF5's words: real or integer of 4 or 8 bytes, text of any length.
    struct Element
    {
        enum class Kind
        {
            real,
            integer,
            text,
            other
        };
        Kind kind = Kind::other;
        std::size_t bytes = 0;
        bool operator==(const Element&) const = default;
        std::string text() const; ///< "64-bit float"
    };
    struct Found
    {
        Element element;
        Shape shape;
    };
    template <class T>
    static Element elementOf();

    Hdf5File(std::filesystem::path file, std::int64_t handle, bool onDisk = true);
    static std::int64_t openExisting(const std::filesystem::path& file, bool writable);

    // hdf5File.cpp: bytes and handles. An empty attribute name means the dataset itself.
    void store(const std::string& object, const std::string& attribute, Element element, const Shape& shape,
               const void* values);
    void followDisk();
    using BlockWork = std::function<void(Index first, Index rows)>;
    /// A dataset in blocks of `rows` rows; fill(first, rows) leaves the next block in `block`.
    void storeBlocks(const std::string& object, Element element, const Shape& shape, Index rows, const void* block,
                     const BlockWork& fill);
    void fetchBlocks(const std::string& object, Element element, const Shape& shape, Index rows, void* block,
                     const BlockWork& take) const;
    Found find(const std::string& object, const std::string& attribute) const;
    /// Checks that the bytes lie in the file and within the allowance, which they use up; returns the element count.
    std::uint64_t claim(const std::string& object, const std::string& attribute, const Found& found) const;
    void fetch(const std::string& object, const std::string& attribute, Element element, void* values) const;

    // hdf5Values.cpp: typed values on top of these.
    template <class T>
    Found expect(const std::string& object, const std::string& attribute, const Shape& expected) const;
    template <class T>
    std::vector<T> values(const std::string& object, const std::string& attribute, const Shape& expected) const;
    std::vector<std::string> texts(const std::string& object, const std::string& attribute) const;
    void storeTexts(const std::string& object, const std::string& attribute, const std::vector<std::string>& texts,
                    const Shape& shape);
    [[noreturn]] void fail(const std::string& object, const std::string& attribute, const std::string& message) const;

    std::filesystem::path path_;
    std::int64_t file_ = -1; ///< HDF5's handle
    bool onDisk_ = true;
    mutable std::uint64_t allowance_ = 0; ///< bytes that may still be read
    DiskPace pace_;
};
} // namespace mpm::output
