#include "fmi/fmuVariables.hpp"

#include "base/error.hpp"
#include "fmi/variableList.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace mpm::fmi
{
using coupling::Balance;
using coupling::FieldName;

// The list while it is made -------------------------------------------------------------------------------------------

std::size_t VariableList::add(Variable variable)
{
    variable.first = list_.valueCount;
    list_.valueCount += variable.size();
    list_.all.push_back(std::move(variable));
    return list_.all.size() - 1;
}

std::size_t VariableList::addInput(const std::string& name, const std::string& description, const Unit& unit,
                                   std::vector<double> start, const Shape& shape)
{
    Variable v{name, description, Type::float64, Causality::input, unit};
    v.start = std::move(start);
    v.shape = shape;
    return add(std::move(v));
}

void VariableList::addOutput(const std::string& name, const std::string& description, const Unit& unit, Read read,
                             const Shape& shape)
{
    Variable v{name, description, Type::float64, Causality::output, unit};
    v.read = std::move(read);
    v.shape = shape;
    add(std::move(v));
}

Unit VariableList::perThickness(Unit unit) const
{
    if (list_.dim == 2)
    {
        unit.exponents[1] -= 1;
        unit.name += "/m";
    }
    return unit;
}

Variables VariableList::take()
{
    std::set<std::string> names;
    for (const Variable& v : list_.all)
        if (!names.insert(v.name).second)
            throw InputError(fmt::format("system/couplingDict: found a surface whose variables would have names that "
                                         "are taken ('{}'), allowed: another name of the surface",
                                         v.name));
    return std::move(list_);
}

// What belongs to no surface ------------------------------------------------------------------------------------------

namespace
{
void addParameters(VariableList& list, const std::vector<Parameter>& parameters)
{
    Variable threads{"threads", "threads of the calculation; results do not depend on it", Type::int64,
                     Causality::parameter};
    threads.start = {1};
    list.add(std::move(threads));
    list.add({"outputFolder", "a new folder for the case with its results; empty: a temporary one, removed at the end",
              Type::string, Causality::parameter});
    for (const Parameter& p : parameters)
    {
        Variable v{p.name(), fmt::format("{} of {}", p.word, p.file), Type::float64, Causality::parameter, p.unit};
        if (p.values.size() > 1)
            v.shape = {p.values.size()};
        v.start = p.values;
        v.parameter = p;
        list.add(std::move(v));
    }
}

void addSums(VariableList& list)
{
    const auto sum = [&](const char* name, const char* description, double Balance::*member) {
        list.addOutput(fmt::format("energy.{}", name), description, list.work(),
                       [member](const Reading& from, std::span<double> out) { out[0] = from.balance.*member; });
    };
    sum("kinetic", "kinetic energy of the soil", &Balance::kineticEnergy);
    sum("strain", "elastic energy of the soil", &Balance::strainEnergy);
    sum("dissipation", "energy dissipated since the start", &Balance::dissipation);
    sum("gravityWork", "work of gravity since the start", &Balance::gravityWork);
    sum("interfaceWork", "work of all coupling surfaces on the soil since the start", &Balance::interfaceWork);
    sum("residual", "what the energy budget does not explain", &Balance::residual);
    for (std::size_t axis = 0; axis < std::size_t(list.dim()); ++axis)
        list.addOutput(fmt::format("momentum.{}", axisNames[axis]), "momentum of the soil",
                       list.perThickness({"N.s", {1, 1, -1}, 0, 1}),
                       [axis](const Reading& from, std::span<double> out) { out[0] = from.balance.momentum[axis]; });
}

void addSteps(VariableList& list)
{
    list.addOutput("timeStep", "mean time step within the last communication step", second,
                   [](const Reading& from, std::span<double> out) {
                       out[0] = from.substeps > 0 ? from.window / double(from.substeps) : 0;
                   });
    Variable substeps{"substeps", "time steps within the last communication step", Type::int64, Causality::output};
    substeps.read = [](const Reading& from, std::span<double> out) { out[0] = double(from.substeps); };
    list.add(std::move(substeps));
    list.addOutput("stableTimeStep", "largest time step the scheme may take now", second,
                   [](const Reading& from, std::span<double> out) { out[0] = from.participant.stableTimeStep(); });
}
} // namespace

// Variables -----------------------------------------------------------------------------------------------------------

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

Variables variablesOf(const coupling::Participant& participant, const std::vector<Parameter>& parameters)
{
    VariableList list(participant.dimension());
    list.add({"time", "time [s]", Type::float64, Causality::independent, second});
    addParameters(list, parameters);
    for (const std::string& surface : participant.surfaces())
        addSurface(list, participant, surface);
    addSums(list);
    addSteps(list);
    return list.take();
}
} // namespace mpm::fmi
