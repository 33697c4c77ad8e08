#include "base/error.hpp"
#include "output/hdf5File.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace mpm::output
{
namespace
{
std::string shapeText(const Shape& shape)
{
    std::string out;
    for (Index n : shape)
        out += fmt::format("{}{}", out.empty() ? "" : " x ", n < 0 ? std::string("any") : std::to_string(n));
    return out.empty() ? "a single value" : out;
}

bool fits(const Shape& found, const Shape& expected)
{
    return std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                      [](Index a, Index b) { return b < 0 || a == b; });
}

std::uint64_t product(const Shape& shape)
{
    std::uint64_t count = 1;
    for (Index n : shape)
        count *= std::uint64_t(n);
    return count;
}

/// Rows of about a quarter of a million bytes, which stay in the cache between HDF5 and us; a multiple of 64, so that
/// blocks begin where chunks of particles do.
Index blockRows(const Shape& shape)
{
    Index width = 1;
    for (std::size_t k = 1; k < shape.size(); ++k)
        width *= shape[k];
    return std::min(shape.front(), 64 * std::max<Index>(1, 512 / std::max<Index>(1, width)));
}
} // namespace

std::string Hdf5File::Element::text() const
{
    switch (kind)
    {
    case Kind::real:
        return fmt::format("{}-bit float", 8 * bytes);
    case Kind::integer:
        return fmt::format("{}-bit integer", 8 * bytes);
    case Kind::text:
        return "text";
    default:
        return "another type";
    }
}

template <class T>
Hdf5File::Element Hdf5File::elementOf()
{
    return {std::is_floating_point_v<T> ? Element::Kind::real : Element::Kind::integer, sizeof(T)};
}

void Hdf5File::fail(const std::string& object, const std::string& message) const
{
    throw InputError({path_.string()}, fmt::format("{}: {}", object, message));
}

void Hdf5File::fail(const std::string& object, const std::string& attribute, const std::string& message) const
{
    fail(object, attribute.empty() ? message : fmt::format("attribute {} {}", attribute, message));
}

// Writing -------------------------------------------------------------------------------------------------------------

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, const Shape& shape, const std::string& unit)
{
    if (product(shape) != values.size())
        fail(name, fmt::format("{} values do not fill the shape {}", values.size(), shapeText(shape)));
    store(name, "", elementOf<T>(), shape, values.data());
    if (!unit.empty())
        setAttribute(name, "unit", unit);
}

template <class T>
void Hdf5File::writeRows(const std::string& name, const Shape& shape, const std::string& unit, const RowFiller<T>& fill)
{
    const Index rows = blockRows(shape);
    std::vector<T> block(shape.front() > 0 ? product(shape) / std::uint64_t(shape.front()) * std::uint64_t(rows) : 0);
    storeBlocks(name, elementOf<T>(), shape, rows, block.data(),
                [&](Index first, Index n) { fill(first, n, block.data()); });
    if (!unit.empty())
        setAttribute(name, "unit", unit);
}

void Hdf5File::writeScalar(const std::string& name, double value, const std::string& unit)
{
    write<double>(name, std::span<const double>(&value, 1), {}, unit);
}

void Hdf5File::writeScalar(const std::string& name, Index value, const std::string& unit)
{
    write<Index>(name, std::span<const Index>(&value, 1), {}, unit);
}

void Hdf5File::writeText(const std::string& name, const std::string& text)
{
    storeTexts(name, "", {text}, {});
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, double value)
{
    store(object, name, elementOf<double>(), {}, &value);
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, Index value)
{
    store(object, name, elementOf<Index>(), {}, &value);
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const Vector3& value)
{
    store(object, name, elementOf<double>(), {3}, value.data());
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const std::string& value)
{
    storeTexts(object, name, {value}, {});
}

void Hdf5File::setAttribute(const std::string& object, const std::string& name, const std::vector<std::string>& value)
{
    storeTexts(object, name, value, {Index(value.size())});
}

/// All of the longest one's length, padded with zero bytes.
void Hdf5File::storeTexts(const std::string& object, const std::string& attribute,
                          const std::vector<std::string>& texts, const Shape& shape)
{
    std::size_t length = 1;
    for (const auto& text : texts)
        length = std::max(length, text.size());
    std::vector<char> block(length * texts.size() + 1, '\0');
    for (std::size_t i = 0; i < texts.size(); ++i)
        std::memcpy(block.data() + i * length, texts[i].data(), texts[i].size());
    store(object, attribute, {Element::Kind::text, length}, shape, block.data());
}

// Reading -------------------------------------------------------------------------------------------------------------

template <class T>
Hdf5File::Found Hdf5File::expect(const std::string& object, const std::string& attribute, const Shape& expected) const
{
    const Found found = find(object, attribute);
    if (found.element != elementOf<T>())
        fail(object, attribute,
             fmt::format("holds values of {}, {} expected", found.element.text(), elementOf<T>().text()));
    if (!fits(found.shape, expected))
        fail(object, attribute,
             fmt::format("has the shape {}, {} expected", shapeText(found.shape), shapeText(expected)));
    return found;
}

template <class T>
std::vector<T> Hdf5File::values(const std::string& object, const std::string& attribute, const Shape& expected) const
{
    const Found found = expect<T>(object, attribute, expected);
    std::vector<T> values(claim(object, attribute, found));
    if (!values.empty())
        fetch(object, attribute, found.element, values.data());
    return values;
}

std::vector<std::string> Hdf5File::texts(const std::string& object, const std::string& attribute) const
{
    const Found found = find(object, attribute);
    if (found.element.kind != Element::Kind::text || found.shape.size() > 1)
        fail(object, attribute, fmt::format("holds {}, text of fixed length expected", found.element.text()));
    const std::uint64_t count = claim(object, attribute, found);
    const std::size_t length = found.element.bytes;
    std::vector<char> block(count * length + 1);
    if (count > 0)
        fetch(object, attribute, found.element, block.data());
    std::vector<std::string> out;
    for (std::uint64_t i = 0; i < count; ++i)
    {
        const char* text = block.data() + i * length;
        std::size_t used = length;
        while (used > 0 && text[used - 1] == '\0')
            --used;
        out.emplace_back(text, used);
    }
    return out;
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name, const Shape& expected) const
{
    return values<T>(name, "", expected);
}

template <class T>
void Hdf5File::readRows(const std::string& name, const Shape& expected, const RowTaker<T>& take) const
{
    const Found found = expect<T>(name, "", expected);
    const std::uint64_t count = claim(name, "", found);
    if (count == 0)
        return;
    const Index rows = blockRows(found.shape);
    std::vector<T> block(count / std::uint64_t(found.shape.front()) * std::uint64_t(rows));
    fetchBlocks(name, found.element, found.shape, rows, block.data(),
                [&](Index first, Index n) { take(first, n, block.data()); });
}

Shape Hdf5File::shape(const std::string& name) const
{
    return find(name, "").shape;
}

std::string Hdf5File::readText(const std::string& name) const
{
    const auto all = texts(name, "");
    if (all.size() != 1)
        fail(name, fmt::format("holds {} texts, one expected", all.size()));
    return all.front();
}

double Hdf5File::realAttribute(const std::string& object, const std::string& name) const
{
    return values<double>(object, name, {}).front();
}

Index Hdf5File::integerAttribute(const std::string& object, const std::string& name) const
{
    return values<Index>(object, name, {}).front();
}

Vector3 Hdf5File::vectorAttribute(const std::string& object, const std::string& name) const
{
    const auto found = values<double>(object, name, {3});
    return {found[0], found[1], found[2]};
}

std::string Hdf5File::textAttribute(const std::string& object, const std::string& name) const
{
    const auto all = texts(object, name);
    if (all.size() != 1)
        fail(object, name, fmt::format("holds {} texts, one expected", all.size()));
    return all.front();
}

std::vector<std::string> Hdf5File::textsAttribute(const std::string& object, const std::string& name) const
{
    return texts(object, name);
}

template void Hdf5File::write<double>(const std::string&, std::span<const double>, const Shape&, const std::string&);
template void Hdf5File::write<float>(const std::string&, std::span<const float>, const Shape&, const std::string&);
template void Hdf5File::write<std::int64_t>(const std::string&, std::span<const std::int64_t>, const Shape&,
                                            const std::string&);
template void Hdf5File::write<std::int32_t>(const std::string&, std::span<const std::int32_t>, const Shape&,
                                            const std::string&);
template void Hdf5File::writeRows<double>(const std::string&, const Shape&, const std::string&,
                                          const RowFiller<double>&);
template void Hdf5File::writeRows<float>(const std::string&, const Shape&, const std::string&, const RowFiller<float>&);
template void Hdf5File::writeRows<std::int32_t>(const std::string&, const Shape&, const std::string&,
                                                const RowFiller<std::int32_t>&);
template void Hdf5File::readRows<double>(const std::string&, const Shape&, const RowTaker<double>&) const;
template void Hdf5File::readRows<std::int64_t>(const std::string&, const Shape&, const RowTaker<std::int64_t>&) const;
template void Hdf5File::readRows<std::int32_t>(const std::string&, const Shape&, const RowTaker<std::int32_t>&) const;
template std::vector<double> Hdf5File::read<double>(const std::string&, const Shape&) const;
template std::vector<float> Hdf5File::read<float>(const std::string&, const Shape&) const;
template std::vector<std::int64_t> Hdf5File::read<std::int64_t>(const std::string&, const Shape&) const;
template std::vector<std::int32_t> Hdf5File::read<std::int32_t>(const std::string&, const Shape&) const;
} // namespace mpm::output
