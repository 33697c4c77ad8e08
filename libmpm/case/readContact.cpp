#include "case/readContact.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
using dictionary::WordGroup;
using dictionary::WordPair;

namespace
{
std::vector<std::string> namesOf(const std::vector<constitutive::Material>& materials)
{
    std::vector<std::string> names;
    for (const auto& m : materials)
        names.push_back(m.name);
    return names;
}

std::size_t placeOf(const std::string& word, const std::vector<std::string>& names)
{
    return std::size_t(std::find(names.begin(), names.end(), word) - names.begin());
}

[[noreturn]] void failUnknown(const Dictionary& d, const std::string& entry, const std::string& word,
                              const std::vector<std::string>& names)
{
    const auto near = nearestWord(word, names);
    d.fail(entry, "'" + word + "'" + (near.empty() ? "" : " (did you mean '" + near + "'?)"), joinWords(names));
}
} // namespace

nodal::ContactProperties readContact(const Dictionary& d, const std::vector<constitutive::Material>& materials)
{
    nodal::ContactProperties out;
    const auto names = namesOf(materials);
    out.bodyOf.assign(materials.size(), -1);
    for (const auto& group :
         d.get<std::vector<WordGroup>>({"bodies", "materials that move apart; those not named are one body more"}))
    {
        for (const auto& word : group.words)
        {
            const std::size_t material = placeOf(word, names);
            if (material == names.size())
                failUnknown(d, "bodies", word, names);
            if (out.bodyOf[material] >= 0)
                d.fail("bodies", "material '" + word + "' twice", "each material in one body");
            out.bodyOf[material] = int(out.bodies.size());
        }
        out.bodies.push_back(group.words.front());
    }
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (out.bodyOf[m] < 0)
        {
            if (out.bodies.empty() || out.bodies.back() != "the rest")
                out.bodies.push_back("the rest");
            out.bodyOf[m] = int(out.bodies.size()) - 1;
        }
    if (out.bodies.size() < 2)
        d.fail("bodies", fmt::format("{} body", out.bodies.size()),
               fmt::format("two bodies or more of the materials {}; without the file all hold together",
                           joinWords(names, " and ")));
    const double mu = d.get<double>({"mu", "Coulomb friction coefficient", {}, Bound::nonNegative()});
    out.mu.assign(out.bodies.size(), std::vector<double>(out.bodies.size(), mu));
    std::vector<std::pair<std::size_t, std::size_t>> seen;
    for (const auto& pair : d.get<std::vector<WordPair>>(
             {"pairs", "friction coefficients of single pairs", {}, Bound::nonNegative(), std::vector<WordPair>{}}))
    {
        const std::size_t one = placeOf(pair.one, out.bodies), other = placeOf(pair.other, out.bodies);
        if (one == out.bodies.size())
            failUnknown(d, "pairs", pair.one, out.bodies);
        if (other == out.bodies.size())
            failUnknown(d, "pairs", pair.other, out.bodies);
        if (one == other)
            d.fail("pairs", "'" + pair.one + "' with itself", "two bodies");
        const std::pair<std::size_t, std::size_t> both = std::minmax(one, other);
        if (std::find(seen.begin(), seen.end(), both) != seen.end())
            d.fail("pairs", fmt::format("'{}' and '{}' twice", pair.one, pair.other), "each pair once");
        seen.push_back(both);
        out.mu[one][other] = out.mu[other][one] = pair.value;
    }
    const auto detection = d.choose("detection", "when bodies touch",
                                    {{"domains", "where particles' domains meet"},
                                     {"nodes", "where they carry the same node, a cell or more before"}},
                                    "domains");
    out.detection = detection == "nodes" ? nodal::ContactDetection::nodes : nodal::ContactDetection::domains;
    return out;
}

void readRigidMotions(const Dictionary& d, const std::vector<constitutive::Material>& materials, int dim,
                      nodal::ContactProperties* contact)
{
    for (std::size_t m = 0; m < materials.size(); ++m)
    {
        if (!materials[m].law->rigid())
            continue;
        const Dictionary& material = d.subDict(materials[m].name);
        if (!contact)
            material.fail("law", "rigid, and no constant/contactProperties",
                          "rigid for a body that others meet: bodies (" + materials[m].name + " ...);");
        const int body = contact->bodyOf[m];
        for (std::size_t other = 0; other < materials.size(); ++other)
            if (other != m && contact->bodyOf[other] == body)
                material.fail("law", "rigid, in one body with material '" + materials[other].name + "'",
                              "a body of its own in constant/contactProperties");
        contact->motion.resize(contact->bodies.size());
        nodal::RigidMotion motion;
        if (const auto* dict = material.findDict("motion", "how a rigid material moves; default: at rest"))
        {
            if (const auto* rotation = dict->findDict("rotation"); rotation && !rotation->found("centre"))
                rotation->fail("centre", "nothing", "a point of the axis at t = 0 [m]");
            motion = nodal::RigidMotion::read(*dict, dim, {});
        }
        contact->motion[std::size_t(body)] = std::make_shared<const nodal::RigidMotion>(motion);
    }
}
} // namespace mpm::cases
