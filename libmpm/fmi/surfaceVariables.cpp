// Variables of a coupling surface: scalars for what a rigid surface is as a whole, arrays for fields at vertices.
#include "fmi/variableList.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace mpm::fmi
{
using coupling::Field;
using coupling::FieldName;
using coupling::Participant;

namespace
{
constexpr const char* atTheEnd = "at the end of the communication step";
constexpr const char* asMean = "mean over the last communication step";

/// "Traction" as the name of a variable: "traction".
std::string nameOf(const Field& field)
{
    std::string word = coupling::fieldWord(field.name);
    word[0] = char(std::tolower(static_cast<unsigned char>(word[0])));
    return word;
}

Unit unitOf(const Field& field)
{
    return {coupling::unitText(field), field.dimensions, 0, 1};
}

bool isAveraged(FieldName name)
{
    return name == FieldName::Force || name == FieldName::Torque || name == FieldName::Traction;
}

/// A field as it is at the end of the last step, or its mean over it; before the first step there is no mean.
void readField(const Reading& from, const std::string& surface, FieldName field, bool mean, std::span<double> out)
{
    if (mean && from.window > 0)
        from.participant.windowAverage(surface, field, out);
    else
        from.participant.readField(surface, field, out);
}

class SurfaceVariables
{
  public:
    SurfaceVariables(VariableList& list, const Participant& participant, const std::string& surface)
        : list_(list), participant_(participant), surface_(surface), prefix_(namePart(surface) + ".")
    {}

    void addVertices()
    {
        Variable v{prefix_ + "vertices", "vertices in the reference configuration", Type::float64,
                   Causality::calculatedParameter, metre};
        v.shape = {participant_.mesh(surface_).vertices.size(), 3};
        v.read = [surface = surface_](const Reading& from, std::span<double> out) {
            auto at = out.begin();
            for (const Vector3& x : from.participant.mesh(surface).vertices)
                at = std::copy(x.begin(), x.end(), at);
        };
        list_.add(std::move(v));
    }

    void addPose()
    {
        InputField input{surface_, FieldName::RigidPose, {}};
        const Vector3 reference = participant_.reference(surface_);
        const std::string where = fmt::format("of the reference point {}", atTheEnd);
        for (std::size_t i = 0; i < axes(); ++i)
            input.variables.push_back(list_.addInput(name("position", i), where, metre, {reference[i]}));
        if (list_.dim() == 2)
            input.variables.push_back(
                list_.addInput(prefix_ + "angle", "rotation from the reference configuration", radian, {0}));
        else
            for (const char* part : {"w", "x", "y", "z"})
                input.variables.push_back(list_.addInput(
                    prefix_ + "quaternion." + part, "unit quaternion of the rotation from the reference configuration",
                    {}, {*part == 'w' ? 1.0 : 0.0}));
        list_.addInputField(std::move(input));
    }

    void addTwist()
    {
        InputField input{surface_, FieldName::RigidTwist, {}};
        const std::string where = fmt::format("of the reference point {}", atTheEnd);
        for (std::size_t i = 0; i < axes(); ++i)
            input.variables.push_back(list_.addInput(name("velocity", i), where, metrePerSecond, {0}));
        for (std::size_t i = list_.dim() == 2 ? 2 : 0; i < 3; ++i)
            input.variables.push_back(list_.addInput(name("angularVelocity", i), atTheEnd, radianPerSecond, {0}));
        list_.addInputField(std::move(input));
    }

    void addInputArray(const Field& field)
    {
        const auto shape = shapeOf(field);
        const std::vector<double> zeros(participant_.valueCount(surface_, field.name), 0.0);
        const auto at = list_.addInput(prefix_ + "atVertices." + nameOf(field),
                                       fmt::format("at the vertices, {}", atTheEnd), unitOf(field), zeros, shape);
        list_.addInputField({surface_, field.name, {at}});
    }

    void addOutputs(const Field& field)
    {
        const bool mean = isAveraged(field.name);
        const char* when = mean ? asMean : atTheEnd;
        const auto read = [surface = surface_, name = field.name, mean](const Reading& from, std::span<double> out) {
            readField(from, surface, name, mean, out);
        };
        if (field.support == coupling::Support::vertex)
            list_.addOutput(prefix_ + "atVertices." + nameOf(field), fmt::format("at the vertices, {}", when),
                            unitOf(field), read, shapeOf(field));
        else if (field.components == 1)
            list_.addOutput(prefix_ + nameOf(field), when, unitOf(field), read);
        else
        {
            addComponents(field, nameOf(field), true);
            addComponents(field, nameOf(field) + "Now", false);
        }
    }

    void addWork()
    {
        list_.addOutput(prefix_ + "interfaceWork", "work of the surface on the soil since the start", list_.work(),
                        [surface = surface_](const Reading& from, std::span<double> out) {
                            out[0] = from.participant.interfaceWork(surface);
                        });
    }

  private:
    std::size_t axes() const { return std::size_t(list_.dim()); }

    std::string name(const std::string& vector, std::size_t axis) const
    {
        return fmt::format("{}{}.{}", prefix_, vector, axisNames[axis]);
    }

    VariableList::Shape shapeOf(const Field& field) const
    {
        VariableList::Shape shape{participant_.mesh(surface_).vertices.size()};
        if (field.components > 1)
            shape.push_back(std::size_t(field.components));
        return shape;
    }

    /// Of a vector of the whole surface, one scalar a component.
    void addComponents(const Field& field, const std::string& word, bool mean)
    {
        const bool torque = field.name == FieldName::Torque;
        const std::string description = fmt::format(
            "of the soil on the surface{}, {}", torque ? " about the reference point" : "", mean ? asMean : atTheEnd);
        const bool inPlane = list_.dim() == 2 && torque;
        for (std::size_t i = inPlane ? 2 : 0; i < (inPlane ? 3 : axes()); ++i)
            list_.addOutput(
                name(word, i), description, unitOf(field),
                [surface = surface_, field = field.name, mean, i](const Reading& from, std::span<double> out) {
                    Vector3 value{};
                    readField(from, surface, field, mean, value);
                    out[0] = value[i];
                });
    }

    VariableList& list_;
    const Participant& participant_;
    std::string surface_, prefix_;
};
} // namespace

void addSurface(VariableList& list, const Participant& participant, const std::string& surface)
{
    SurfaceVariables variables(list, participant, surface);
    variables.addVertices();
    for (const Field& field : participant.fields(surface))
        if (field.name == FieldName::RigidPose)
            variables.addPose();
        else if (field.name == FieldName::RigidTwist)
            variables.addTwist();
        else if (field.direction == coupling::Direction::written)
            variables.addInputArray(field);
        else
            variables.addOutputs(field);
    variables.addWork();
}
} // namespace mpm::fmi
