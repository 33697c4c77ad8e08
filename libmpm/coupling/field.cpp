#include "coupling/field.hpp"

#include "base/error.hpp"
#include "coupling/couplingError.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
namespace
{
constexpr std::array<const char*, 9> fieldWords = {"Displacement", "Velocity", "RigidPose", "RigidTwist", "Force",
                                                   "Torque",       "Traction", "Stress",    "ContactArea"};
constexpr std::array<const char*, 3> kindWords = {"Rigid", "Deformable", "Monitor"};

/// The number of a word; CouplingError with the words there are, and the nearest of them.
template <std::size_t count>
std::size_t position(const std::array<const char*, count>& words, const std::string& word, Fault fault,
                     const char* what)
{
    const std::vector<std::string> all(words.begin(), words.end());
    for (std::size_t n = 0; n < count; ++n)
        if (all[n] == word)
            return n;
    const std::string near = nearestWord(word, all);
    throw CouplingError(fault, fmt::format("found {} '{}', allowed are {}{}", what, word, joinWords(all, " and "),
                                           near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
}

/// In 2D what is extensive is per metre.
std::array<int, 7> dimensionsOf(FieldName name, int dim)
{
    const int perMetre = dim == 2 ? 1 : 0;
    switch (name)
    {
    case FieldName::Displacement:
    case FieldName::RigidPose:
        return {0, 1};
    case FieldName::Velocity:
    case FieldName::RigidTwist:
        return {0, 1, -1};
    case FieldName::Force:
        return {1, 1 - perMetre, -2};
    case FieldName::Torque:
        return {1, 2 - perMetre, -2};
    case FieldName::Traction:
    case FieldName::Stress:
        return {1, -1, -2};
    case FieldName::ContactArea:
        return {0, 2 - perMetre};
    }
    return {};
}

Field make(FieldName name, Direction direction, Support support, int dim)
{
    Field out{name, direction, support, 1, 3, dimensionsOf(name, dim), false};
    if (name == FieldName::ContactArea)
        out.rank = 0, out.components = 1;
    else if (name == FieldName::Stress)
        out.rank = 2, out.components = 6;
    else if (name == FieldName::RigidPose)
        out.components = 7;
    else if (name == FieldName::RigidTwist)
        out.components = 6;
    out.extensive = name == FieldName::Force || name == FieldName::Torque || name == FieldName::ContactArea;
    return out;
}
} // namespace

const char* fieldWord(FieldName name)
{
    return fieldWords[std::size_t(name)];
}

FieldName fieldName(const std::string& word)
{
    return FieldName(position(fieldWords, word, Fault::unknownField, "a field"));
}

const char* kindWord(SurfaceKind kind)
{
    return kindWords[std::size_t(kind)];
}

SurfaceKind surfaceKind(const std::string& word)
{
    return SurfaceKind(position(kindWords, word, Fault::badSurface, "a surface of kind"));
}

std::string unitText(const Field& field)
{
    const int metres = field.dimensions[1];
    switch (field.name)
    {
    case FieldName::Displacement:
    case FieldName::RigidPose:
        return "m";
    case FieldName::Velocity:
    case FieldName::RigidTwist:
        return "m/s";
    case FieldName::Force:
        return metres == 1 ? "N" : "N/m";
    case FieldName::Torque:
        return metres == 2 ? "N m" : "N m/m";
    case FieldName::Traction:
    case FieldName::Stress:
        return "Pa";
    case FieldName::ContactArea:
        return metres == 2 ? "m^2" : "m";
    }
    return "";
}

std::vector<Field> fieldsOf(SurfaceKind kind, int dim)
{
    using enum FieldName;
    std::vector<Field> out;
    const auto add = [&](Direction direction, Support support, std::initializer_list<FieldName> names) {
        for (const auto name : names)
            out.push_back(make(name, direction, support, dim));
    };
    switch (kind)
    {
    case SurfaceKind::Rigid:
        add(Direction::written, Support::surface, {RigidPose, RigidTwist});
        add(Direction::read, Support::surface, {Force, Torque, ContactArea});
        add(Direction::read, Support::vertex, {Traction, Displacement, Velocity});
        break;
    case SurfaceKind::Deformable:
        add(Direction::written, Support::vertex, {Displacement, Velocity});
        add(Direction::read, Support::vertex, {Force, Traction, ContactArea});
        break;
    case SurfaceKind::Monitor:
        add(Direction::written, Support::vertex, {Force, Traction});
        add(Direction::read, Support::vertex, {Displacement, Velocity, Stress});
        break;
    }
    return out;
}
} // namespace mpm::coupling
