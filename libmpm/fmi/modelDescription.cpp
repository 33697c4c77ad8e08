#include "fmi/modelDescription.hpp"

#include "base/version.hpp"
#include "fmi/fmuLog.hpp"

#include <fmt/format.h>

#include <cctype>
#include <ctime>
#include <map>

namespace mpm::fmi
{
namespace
{
const char* causalityWord(Causality causality)
{
    switch (causality)
    {
    case Causality::independent:
        return "independent";
    case Causality::parameter:
        return "parameter";
    case Causality::calculatedParameter:
        return "calculatedParameter";
    case Causality::input:
        return "input";
    default:
        return "output";
    }
}

const char* variabilityWord(const Variable& v)
{
    if (v.causality == Causality::parameter || v.causality == Causality::calculatedParameter)
        return "fixed";
    return v.type == Type::float64 ? "continuous" : "discrete";
}

std::string attribute(const char* name, const std::string& value)
{
    return fmt::format(" {}=\"{}\"", name, xmlText(value));
}

std::string units(const Variables& variables)
{
    std::map<std::string, Unit> used;
    for (const Variable& v : variables.all)
        if (!v.unit.name.empty())
            used.emplace(v.unit.name, v.unit);
    std::string out = "  <UnitDefinitions>\n";
    for (const auto& [name, unit] : used)
    {
        out += fmt::format("    <Unit{}>\n      <BaseUnit", attribute("name", name));
        const std::array<const char*, 7> bases = {"kg", "m", "s", "K", "mol", "A", "cd"}; // the dictionaries' order
        for (std::size_t i = 0; i < bases.size(); ++i)
            if (unit.exponents[i] != 0)
                out += fmt::format(" {}=\"{}\"", bases[i], unit.exponents[i]);
        if (unit.rad != 0)
            out += fmt::format(" rad=\"{}\"", unit.rad);
        if (unit.factor != 1)
            out += fmt::format(" factor=\"{}\"", unit.factor);
        out += "/>\n    </Unit>\n";
    }
    return out + "  </UnitDefinitions>\n";
}

template <class Iterator>
std::string joined(Iterator first, Iterator last, const char* between)
{
    std::string out;
    for (Iterator i = first; i != last; ++i)
        out.append(i == first ? "" : between).append(fmt::format("{}", *i));
    return out;
}

std::string dateAndTime()
{
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    char text[32];
    return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts)));
}

std::string startOf(const Variable& v)
{
    bool same = true;
    for (const double number : v.start)
        same = same && number == v.start[0];
    return joined(v.start.begin(), same ? v.start.begin() + 1 : v.start.end(), " ");
}

std::string element(std::size_t reference, const Variable& v)
{
    const char* type = v.type == Type::float64 ? "Float64" : v.type == Type::int64 ? "Int64" : "String";
    std::string out = fmt::format("    <{}{} valueReference=\"{}\"{} causality=\"{}\" variability=\"{}\"", type,
                                  attribute("name", v.name), reference, attribute("description", v.description),
                                  causalityWord(v.causality), variabilityWord(v));
    if (!v.unit.name.empty())
        out += attribute("unit", v.unit.name);
    if (v.type == Type::int64 && v.causality == Causality::parameter)
        out += " min=\"0\"";
    if (!v.start.empty())
        out += attribute("start", startOf(v));
    std::string inner;
    for (const std::size_t size : v.shape)
        inner += fmt::format("      <Dimension start=\"{}\"/>\n", size);
    if (v.type == Type::string)
        inner += "      <Start value=\"\"/>\n";
    return out + (inner.empty() ? "/>\n" : fmt::format(">\n{}    </{}>\n", inner, type));
}

std::string structure(const Variables& variables)
{
    std::string outputs, unknowns;
    std::vector<std::size_t> parameters;
    for (std::size_t i = 0; i < variables.all.size(); ++i)
        if (variables.all[i].parameter)
            parameters.push_back(i);
    for (std::size_t i = 0; i < variables.all.size(); ++i)
    {
        const Causality causality = variables.all[i].causality;
        if (causality == Causality::output)
            outputs += fmt::format("    <Output valueReference=\"{}\" dependencies=\"\"/>\n", i);
        if (causality == Causality::output)
            unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\" dependencies=\"{}\"/>\n", i,
                                    joined(parameters.begin(), parameters.end(), " "));
        if (causality == Causality::calculatedParameter)
            unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\" dependencies=\"\"/>\n", i);
    }
    return "  <ModelStructure>\n" + outputs + unknowns + "  </ModelStructure>\n";
}
} // namespace

std::string xmlText(const std::string& text)
{
    std::string out;
    for (const char c : text)
        switch (c)
        {
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '&':
            out += "&amp;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    return out;
}

std::string identifierOf(const std::string& name)
{
    std::string out;
    for (const char c : name)
        out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (out.empty() || std::isdigit(static_cast<unsigned char>(out[0])))
        out.insert(out.begin(), '_');
    return out.substr(0, 60); // it names a file
}

std::string modelDescription(const ModelFacts& facts, const Variables& variables)
{
    const std::string tool = "libmpm " + projectVersion() + " (" + gitRevision() + ", " + kernelText() + ")";
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription\n";
    out += "  fmiVersion=\"3.0\"\n ";
    out += attribute("modelName", facts.modelName) + "\n ";
    out += attribute("instantiationToken", facts.token) + "\n ";
    out += attribute("description", "Soil by the material point method, coupled at surfaces") + "\n ";
    out += attribute("generationTool", tool) + "\n ";
    out += attribute("generationDateAndTime", dateAndTime()) + "\n";
    out += "  variableNamingConvention=\"structured\">\n";
    out += fmt::format("  <CoSimulation modelIdentifier=\"{}\" canGetAndSetFMUState=\"true\" "
                       "canSerializeFMUState=\"true\" canHandleVariableCommunicationStepSize=\"true\"/>\n",
                       facts.modelIdentifier);
    out += units(variables);
    out += "  <LogCategories>\n";
    for (const auto& [name, description] : logCategories)
        out += fmt::format("    <Category{}{}/>\n", attribute("name", name), attribute("description", description));
    out += "  </LogCategories>\n";
    out += fmt::format("  <DefaultExperiment startTime=\"{}\"", facts.startTime);
    if (facts.stopTime > facts.startTime)
        out += fmt::format(" stopTime=\"{}\"", facts.stopTime);
    out += fmt::format(" stepSize=\"{}\"/>\n  <ModelVariables>\n", facts.stepSize);
    for (std::size_t i = 0; i < variables.all.size(); ++i)
        out += element(i, variables.all[i]);
    return out + "  </ModelVariables>\n" + structure(variables) + "</fmiModelDescription>\n";
}

std::string documentationPage(const ModelFacts& facts, const Variables& variables)
{
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{0}</title></head>\n<body>\n"
        "<h1>{0}</h1>\n"
        "<p>A case of libmpm (material point method for soils) for FMI 3.0 Co-Simulation. The case lies in "
        "resources/case; an instance works on a copy of it, in a temporary folder or in "
        "<code>outputFolder</code>.</p>\n"
        "<p>Inputs hold for the end of a communication step: within it a surface goes from where it is to where the "
        "inputs say. Forces are those of the soil on the surface, as means over the last communication step, so that "
        "force times step is the impulse. Tension is positive; in 2D forces, torques and energies are per metre of "
        "thickness.</p>\n"
        "<p>Communication steps may vary; the time steps within them follow the stability limit. A step that cannot be "
        "taken returns fmi3Discard with the reason in the log, and nothing has changed. FMU states hold everything, "
        "and a repetition is the same to the last bit. Files are written for what the importer says it will not "
        "repeat (noSetFMUStatePriorToCurrentPoint), and at the end.</p>\n<h2>Variables</h2>\n<table>\n"
        "<tr><th>name</th><th>causality</th><th>unit</th><th>size</th><th>meaning</th></tr>\n",
        xmlText(facts.modelName));
    for (const Variable& v : variables.all)
    {
        const std::string size = joined(v.shape.begin(), v.shape.end(), " x ");
        out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", xmlText(v.name),
                           causalityWord(v.causality), xmlText(v.unit.name), size, xmlText(v.description));
    }
    return out + "</table>\n</body>\n</html>\n";
}

std::string externalDependencies()
{
    return fmt::format("The library in binaries/x86_64-linux needs, from Debian 12 or a system with the same "
                       "versions:\n\n"
                       "    libhdf5-103-1 (libhdf5_serial.so.103)\n    libmuparser2v5 (libmuparser.so.2)\n"
                       "    libfmt9 (libfmt.so.9)\n    libgomp1, libstdc++6, libc6\n\n"
                       "Its kernels are made for: {}. An FMU for other machines is exported with a portable build\n"
                       "(cmake --preset portable).\n",
                       kernelText());
}
} // namespace mpm::fmi
