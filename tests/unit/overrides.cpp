// Words a run takes in place of those of its dictionaries, and how a state carries them.
#include "case/overrides.hpp"
#include "base/error.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::cases;
using Catch::Matchers::Contains;

namespace
{
Overrides sample()
{
    Overrides overrides("-withinTime 60");
    overrides.set("system/mpmSchemes", "shape", "cpGIMP");
    overrides.set("system/mpmSchemes", "splitting", "");
    overrides.set("system/controlDict", "deltaT", "0.0005");
    return overrides;
}
} // namespace

TEST_CASE("words are set, added and taken away in their own file only")
{
    auto schemes = dictionary::Dictionary::fromText("shape uGIMP; splitting { threshold 2; } picRate 2;");
    sample().apply("system/mpmSchemes", schemes);
    CHECK(schemes.get<std::string>({"shape", ""}) == "cpGIMP");
    CHECK_FALSE(schemes.found("splitting"));
    CHECK_FALSE(schemes.found("deltaT"));
    CHECK(schemes.get<double>({"picRate", ""}) == 2); // behind the one that is gone
    schemes.rejectUnread();
    CHECK_THAT(schemes.text(), Contains("cpGIMP") && !Contains("splitting"));
    auto control = dictionary::Dictionary::fromText("endTime 1;");
    sample().apply("system/controlDict", control);
    CHECK(control.get<double>({"deltaT", ""}) == 0.0005);
    CHECK(control.where("deltaT").text() == "-withinTime 60");
}

TEST_CASE("a state carries them")
{
    state::State state;
    CHECK(Overrides::recall(state).empty());
    sample().remember(state);
    const auto again = Overrides::recall(state);
    CHECK(again.reason() == "-withinTime 60");
    CHECK(again.describe() == sample().describe());
    CHECK(again.describe() == "shape cpGIMP, no splitting, deltaT 0.0005");
    Overrides().remember(state);
    CHECK(state.provenance.count("overrides") == 0);
    state.provenance["overrides"] = "-withinTime 60\nnonsense\n";
    CHECK_THROWS_AS(Overrides::recall(state), InputError);
}
