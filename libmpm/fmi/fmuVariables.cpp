#include "fmi/fmuVariables.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace mpm::fmi
{
using coupling::Direction;
using coupling::Field;
using coupling::FieldName;
using coupling::Participant;
using coupling::Support;

namespace
{
const Unit second{"s", {0, 0, 1}, 0, 1};
const Unit radian{"rad", {}, 1, 1};
const Unit radianPerSecond{"rad/s", {0, 0, -1}, 1, 1};
const Unit metre{"m", {0, 1}, 0, 1};
const Unit metrePerSecond{"m/s", {0, 1, -1}, 0, 1};

Unit unitOf(const Field& field)
{
    return {coupling::unitText(field), field.dimensions, 0, 1};
}

/// "Traction" as the name of a variable: "traction".
std::string lowered(std::string word)
{
    word[0] = char(std::tolower(static_cast<unsigned char>(word[0])));
    return word;
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

class List
{
  public:
    explicit List(const Participant& participant) : participant_(participant) { list_.dim = participant.dimension(); }

    void addTime() { add({"time", "time [s]", Type::float64, Causality::independent, second}); }

    void addParameters(const std::vector<Parameter>& parameters)
    {
        Variable threads{"threads", "threads of the calculation; results do not depend on it", Type::int64,
                         Causality::parameter};
        threads.start = {1};
        add(std::move(threads));
        add({"outputFolder", "a new folder for the case with its results; empty: a temporary one, removed at the end",
             Type::string, Causality::parameter});
        for (const Parameter& p : parameters)
        {
            Variable v{p.name(), fmt::format("{} of {}", p.word, p.file), Type::float64, Causality::parameter, p.unit};
            if (p.values.size() > 1)
                v.shape = {p.values.size()};
            v.start = p.values;
            v.parameter = p;
            add(std::move(v));
        }
    }

    void addSurface(const std::string& surface)
    {
        const std::string prefix = namePart(surface) + ".";
        const auto& mesh = participant_.mesh(surface);
        add({prefix + "vertices",
             "vertices in the reference configuration",
             Type::float64,
             Causality::calculatedParameter,
             metre,
             {mesh.vertices.size(), 3},
             {},
             [surface](const Reading& from, std::span<double> out) {
                 auto at = out.begin();
                 for (const Vector3& x : from.participant.mesh(surface).vertices)
                     at = std::copy(x.begin(), x.end(), at);
             }});
        for (const Field& field : participant_.fields(surface))
            if (field.name == FieldName::RigidPose)
                addPose(surface, prefix);
            else if (field.name == FieldName::RigidTwist)
                addTwist(surface, prefix);
            else if (field.direction == Direction::written)
                addInputArray(surface, prefix, field);
            else
                addOutputs(surface, prefix, field);
        add({prefix + "interfaceWork",
             "work of the surface on the soil since the start",
             Type::float64,
             Causality::output,
             work(),
             {},
             {},
             [surface](const Reading& from, std::span<double> out) {
                 out[0] = from.participant.interfaceWork(surface);
             }});
    }

    void addSums()
    {
        using coupling::Balance;
        const auto sum = [&](const char* name, const char* description, double Balance::*member) {
            add({fmt::format("energy.{}", name),
                 description,
                 Type::float64,
                 Causality::output,
                 work(),
                 {},
                 {},
                 [member](const Reading& from, std::span<double> out) {
                     out[0] = from.participant.balance().*member;
                 }});
        };
        sum("kinetic", "kinetic energy of the soil", &Balance::kineticEnergy);
        sum("strain", "elastic energy of the soil", &Balance::strainEnergy);
        sum("dissipation", "energy dissipated since the start", &Balance::dissipation);
        sum("gravityWork", "work of gravity since the start", &Balance::gravityWork);
        sum("interfaceWork", "work of all coupling surfaces on the soil since the start", &Balance::interfaceWork);
        sum("residual", "what the energy budget does not explain", &Balance::residual);
        const Unit momentum = perThickness({"N.s", {1, 1, -1}, 0, 1});
        for (int axis = 0; axis < list_.dim; ++axis)
            add({fmt::format("momentum.{}", axisNames[std::size_t(axis)]),
                 "momentum of the soil",
                 Type::float64,
                 Causality::output,
                 momentum,
                 {},
                 {},
                 [axis](const Reading& from, std::span<double> out) {
                     out[0] = from.participant.balance().momentum[std::size_t(axis)];
                 }});
        add({"timeStep",
             "mean time step within the last communication step",
             Type::float64,
             Causality::output,
             second,
             {},
             {},
             [](const Reading& from, std::span<double> out) {
                 out[0] = from.substeps > 0 ? from.window / double(from.substeps) : 0;
             }});
        add({"substeps",
             "time steps within the last communication step",
             Type::int64,
             Causality::output,
             {},
             {},
             {},
             [](const Reading& from, std::span<double> out) { out[0] = double(from.substeps); }});
        add({"stableTimeStep",
             "largest time step the scheme may take now",
             Type::float64,
             Causality::output,
             second,
             {},
             {},
             [](const Reading& from, std::span<double> out) { out[0] = from.participant.stableTimeStep(); }});
    }

    Variables take()
    {
        std::set<std::string> names;
        for (const Variable& v : list_.all)
            if (!names.insert(v.name).second)
                throw InputError("system/couplingDict: found a surface whose variables would have names that are "
                                 "taken ('" +
                                 v.name + "'), allowed: another name of the surface");
        return std::move(list_);
    }

  private:
    std::size_t add(Variable variable)
    {
        variable.first = list_.valueCount;
        list_.valueCount += variable.size();
        list_.all.push_back(std::move(variable));
        return list_.all.size() - 1;
    }

    /// In 2D what is extensive is per metre of thickness.
    Unit perThickness(Unit unit) const
    {
        if (list_.dim == 2)
        {
            unit.exponents[1] -= 1;
            unit.name += "/m";
        }
        return unit;
    }
    Unit work() const { return perThickness({"J", {1, 2, -2}, 0, 1}); }

    std::size_t addInput(const std::string& name, const std::string& description, const Unit& unit, double start)
    {
        return add({name, description, Type::float64, Causality::input, unit, {}, {start}});
    }

    void addPose(const std::string& surface, const std::string& prefix)
    {
        InputField input{surface, FieldName::RigidPose, {}};
        const Vector3 reference = participant_.reference(surface);
        for (std::size_t i = 0; i < std::size_t(list_.dim); ++i)
            input.variables.push_back(addInput(fmt::format("{}position.{}", prefix, axisNames[i]),
                                               "of the reference point at the end of the communication step", metre,
                                               reference[i]));
        if (list_.dim == 2)
            input.variables.push_back(
                addInput(prefix + "angle", "rotation from the reference configuration", radian, 0));
        else
            for (const char* part : {"w", "x", "y", "z"})
                input.variables.push_back(addInput(fmt::format("{}quaternion.{}", prefix, part),
                                                   "unit quaternion of the rotation from the reference configuration",
                                                   {}, *part == 'w' ? 1 : 0));
        list_.inputs.push_back(std::move(input));
    }

    void addTwist(const std::string& surface, const std::string& prefix)
    {
        InputField input{surface, FieldName::RigidTwist, {}};
        for (std::size_t i = 0; i < std::size_t(list_.dim); ++i)
            input.variables.push_back(addInput(fmt::format("{}velocity.{}", prefix, axisNames[i]),
                                               "of the reference point at the end of the communication step",
                                               metrePerSecond, 0));
        for (std::size_t i = list_.dim == 2 ? 2 : 0; i < 3; ++i)
            input.variables.push_back(addInput(fmt::format("{}angularVelocity.{}", prefix, axisNames[i]),
                                               "at the end of the communication step", radianPerSecond, 0));
        list_.inputs.push_back(std::move(input));
    }

    std::vector<std::size_t> shapeOf(const std::string& surface, const Field& field) const
    {
        std::vector<std::size_t> shape{participant_.mesh(surface).vertices.size()};
        if (field.components > 1)
            shape.push_back(std::size_t(field.components));
        return shape;
    }

    void addInputArray(const std::string& surface, const std::string& prefix, const Field& field)
    {
        const auto shape = shapeOf(surface, field);
        const auto size = std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>());
        list_.inputs.push_back({surface,
                                field.name,
                                {add({prefix + "atVertices." + lowered(coupling::fieldWord(field.name)),
                                      "at the vertices, at the end of the communication step", Type::float64,
                                      Causality::input, unitOf(field), shape, std::vector<double>(size, 0.0)})}});
    }

    void addOutputs(const std::string& surface, const std::string& prefix, const Field& field)
    {
        const std::string word = lowered(coupling::fieldWord(field.name));
        const FieldName name = field.name;
        const bool mean = isAveraged(name);
        const char* when = mean ? "mean over the last communication step" : "at the end of the communication step";
        if (field.support == Support::vertex)
            add({prefix + "atVertices." + word,
                 fmt::format("at the vertices, {}", when),
                 Type::float64,
                 Causality::output,
                 unitOf(field),
                 shapeOf(surface, field),
                 {},
                 [=](const Reading& from, std::span<double> out) { readField(from, surface, name, mean, out); }});
        else if (field.components == 1)
            add({prefix + word,
                 when,
                 Type::float64,
                 Causality::output,
                 unitOf(field),
                 {},
                 {},
                 [=](const Reading& from, std::span<double> out) { readField(from, surface, name, mean, out); }});
        else
            for (const bool now : {false, true})
                addComponents(surface, prefix + word + (now ? "Now" : ""), field, !now);
    }

    void addComponents(const std::string& surface, const std::string& prefix, const Field& field, bool mean)
    {
        const bool planeTorque = list_.dim == 2 && field.name == FieldName::Torque;
        const char* who = field.name == FieldName::Torque ? "of the soil on the surface about the reference point"
                                                          : "of the soil on the surface";
        for (std::size_t i = planeTorque ? 2 : 0; i < (planeTorque ? 3 : std::size_t(list_.dim)); ++i)
            add({fmt::format("{}.{}", prefix, axisNames[i]),
                 fmt::format("{}, {}", who,
                             mean ? "mean over the last communication step" : "at the end of the communication step"),
                 Type::float64,
                 Causality::output,
                 unitOf(field),
                 {},
                 {},
                 [=, name = field.name](const Reading& from, std::span<double> out) {
                     Vector3 value{};
                     readField(from, surface, name, mean, value);
                     out[0] = value[i];
                 }});
    }

    const Participant& participant_;
    Variables list_;
};
} // namespace

std::size_t Variable::size() const
{
    return std::accumulate(shape.begin(), shape.end(), std::size_t(type == Type::string ? 0 : 1), std::multiplies<>());
}

std::size_t Variables::at(const std::string& name) const
{
    const auto found = std::find_if(all.begin(), all.end(), [&](const Variable& v) { return v.name == name; });
    return std::size_t(found - all.begin());
}

std::vector<double> Variables::fieldValues(const InputField& input, std::span<const double> values) const
{
    std::vector<double> v;
    for (const std::size_t i : input.variables)
        v.insert(v.end(), values.begin() + std::ptrdiff_t(all[i].first),
                 values.begin() + std::ptrdiff_t(all[i].first + all[i].size()));
    if (dim == 2 && input.field == FieldName::RigidPose)
        return {v[0], v[1], 0, std::cos(v[2] / 2), 0, 0, std::sin(v[2] / 2)};
    if (dim == 2 && input.field == FieldName::RigidTwist)
        return {v[0], v[1], 0, 0, 0, v[2]};
    return v;
}

std::vector<double> Variables::startValues() const
{
    std::vector<double> values(valueCount, 0.0);
    for (const Variable& v : all)
        std::copy(v.start.begin(), v.start.end(), values.begin() + std::ptrdiff_t(v.first));
    return values;
}

Variables variablesOf(const Participant& participant, const std::vector<Parameter>& parameters)
{
    List list(participant);
    list.addTime();
    list.addParameters(parameters);
    for (const std::string& surface : participant.surfaces())
        list.addSurface(surface);
    list.addSums();
    return list.take();
}
} // namespace mpm::fmi
