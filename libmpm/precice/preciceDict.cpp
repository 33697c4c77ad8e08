#include "precice/preciceDict.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace mpm::precice
{
using coupling::SurfaceKind;
using dictionary::Bound;
using dictionary::Dictionary;
using enum Quantity;

namespace
{
constexpr std::array<const char*, 8> words = {"Displacement", "Rotation", "Velocity", "AngularVelocity",
                                              "Force",        "Torque",   "Traction", "ContactArea"};

std::vector<Quantity> allowed(SurfaceKind kind, bool read)
{
    switch (kind)
    {
    case SurfaceKind::Rigid:
        return read ? std::vector{Displacement, Rotation, Velocity, AngularVelocity}
                    : std::vector{Force, Torque, ContactArea};
    case SurfaceKind::Deformable:
        return read ? std::vector{Displacement, Velocity} : std::vector{Force, Traction, ContactArea};
    case SurfaceKind::Monitor:
        return read ? std::vector{Force, Traction} : std::vector{Displacement, Velocity};
    }
    return {};
}

/// `read (Displacement Velocity);` or `read { Displacement NameThere; }`: word there, name in preCICE.
std::vector<std::pair<std::string, std::string>> pairsOf(const Dictionary& d, const std::string& word,
                                                         const std::string& help)
{
    std::vector<std::pair<std::string, std::string>> pairs;
    if (d.holdsDict(word))
    {
        const Dictionary& names = d.subDict(word, help);
        for (const auto& quantity : names.words())
            pairs.emplace_back(quantity, names.get<std::string>({quantity, "its name in preCICE's configuration"}));
        return pairs;
    }
    for (const auto& quantity : d.get<std::vector<std::string>>({word, help, {}, {}, std::vector<std::string>{}}))
        pairs.emplace_back(quantity, quantity);
    return pairs;
}

std::vector<DataLink> readLinks(const Dictionary& d, SurfaceKind kind, bool read)
{
    const std::string word = read ? "read" : "write";
    const auto may = allowed(kind, read);
    std::vector<std::string> names;
    for (Quantity quantity : may)
        names.push_back(quantityWord(quantity));
    std::vector<DataLink> links;
    const std::string help = read ? "data the partner moves or loads the surface by" : "data the partner gets";
    for (const auto& [quantity, data] : pairsOf(d, word, help))
    {
        const auto found = std::find(names.begin(), names.end(), quantity);
        if (found == names.end())
        {
            const std::string near = nearestWord(quantity, names);
            d.fail(word, quantity,
                   fmt::format("{} for a {} surface{}", joinWords(names, " and "), kindWord(kind),
                               near.empty() ? "" : " (did you mean '" + near + "'?)"));
        }
        const DataLink link{may[std::size_t(found - names.begin())], data, d.where(word)};
        for (const auto& other : links)
            if (other.quantity == link.quantity || other.data == link.data)
                d.fail(word, fmt::format("{} twice", other.data == link.data ? data : quantity), "each once");
        links.push_back(link);
    }
    return links;
}

SurfaceLink readSurfaceLink(const Dictionary& d, const KnownSurface& surface)
{
    SurfaceLink link;
    link.surface = surface.name;
    link.kind = surface.kind;
    link.where = d.where();
    link.mesh = d.get<std::string>({"mesh", "name of its mesh in preCICE's configuration", {}, {}, surface.name});
    link.read = readLinks(d, surface.kind, true);
    link.write = readLinks(d, surface.kind, false);
    if (link.read.empty() && link.write.empty())
        throw InputError(link.where, fmt::format("{}: found neither read nor write, allowed is one or both, such as "
                                                 "write (Force);",
                                                 surface.name));
    return link;
}

void readSurfaces(const Dictionary& d, const std::vector<KnownSurface>& known, PreciceCoupling& out)
{
    std::vector<std::string> names;
    for (const auto& surface : known)
        names.push_back(surface.name);
    for (const auto& name : d.dictNames())
    {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
        {
            const std::string near = nearestWord(name, names);
            throw InputError(d.where(name), fmt::format("found the surface {}, allowed {} of surfaces in this file{}",
                                                        name, names.empty() ? "those" : joinWords(names, " and "),
                                                        near.empty() ? "" : " (did you mean '" + near + "'?)"));
        }
        auto link = readSurfaceLink(d.subDict(name, "a coupling surface"), known[std::size_t(found - names.begin())]);
        for (const auto& other : out.surfaces)
            if (other.mesh == link.mesh)
                d.subDict(name).fail("mesh",
                                     fmt::format("{}, which is the mesh of {} already", link.mesh, other.surface),
                                     "a mesh of its own for each surface");
        out.surfaces.push_back(std::move(link));
    }
    if (out.surfaces.empty())
        throw InputError(d.where(), fmt::format("surfaces: found none, allowed {}",
                                                names.empty() ? "those of surfaces in this file" : joinWords(names)));
}
/// It is shared with the partner, so it may lie outside the case folder.
std::filesystem::path configFile(const Dictionary& d, const std::filesystem::path& caseFolder)
{
    const auto name = d.get<std::string>({"config", "preCICE's configuration, from the case folder"});
    const auto path = (caseFolder / name).lexically_normal();
    if (!std::filesystem::is_regular_file(path))
        d.fail("config", "'" + name + "', no such file", "preCICE's configuration, from the case folder");
    return path;
}
} // namespace

const char* quantityWord(Quantity quantity)
{
    return words[std::size_t(quantity)];
}

int componentsOf(Quantity quantity, int dim)
{
    const bool turns = quantity == Rotation || quantity == AngularVelocity || quantity == Torque;
    return quantity == ContactArea || (turns && dim == 2) ? 1 : dim;
}

PreciceCoupling readPrecice(const Dictionary& couplingDict, const std::filesystem::path& caseFolder,
                            const std::vector<KnownSurface>& known)
{
    couplingDict.passOver("surfaces", "the coupling surfaces");
    const Dictionary& d = couplingDict.subDict("preciceCoupling", "how preCICE couples the case");
    PreciceCoupling out;
    out.config = configFile(d, caseFolder);
    out.participant = d.get<std::string>({"participant", "our name in the configuration", {}, {}, "Soil"});
    if (d.found("maxStep"))
        out.maxStep = d.get<double>(
            {"maxStep", "time between two exchanges, at most", dictionary::unit::time, Bound::positive()});
    out.samples = d.get<Index>(
        {"samples", "times a step at which what is read is looked up", {}, Bound::between(1, 1000), Index(1)});
    out.windowAverage =
        d.choose("forces", "what is written as Force, Torque and Traction",
                 {{"windowAverage", "impulse of the step over its length"}, {"instantaneous", "those at its end"}},
                 "windowAverage") == "windowAverage";
    readSurfaces(d.subDict("surfaces", "what is exchanged on which surface"), known, out);
    d.rejectUnread();
    return out;
}
} // namespace mpm::precice
