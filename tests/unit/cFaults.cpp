// Each named error of the C interface, and that it changed nothing: neither what is seen nor what happens next.
#include "support/blockParticipant.hpp"

#include <cmath>
#include <limits>

using namespace mpm;
using namespace mpm::tests;
using Catch::Matchers::StartsWith;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// After a window in contact: makes a mistake, which has to be `status`, to say something, and to change nothing that
/// is seen or that would happen next.
template <class Mistake>
void changesNothing(Soil& soil, mpm_status status, Mistake&& mistake)
{
    mpm_state* start = nullptr;
    REQUIRE(mpm_participant_save_state(soil.p, &start) == MPM_OK);
    soil.push(-0.44, window);
    REQUIRE(mpm_participant_advance(soil.p, window, nullptr) == MPM_OK);
    const auto next = seen(soil.p);
    REQUIRE(mpm_participant_restore_state(soil.p, start) == MPM_OK);
    soil.push(-0.44, window);
    const auto before = seen(soil.p);
    const auto found = mistake();
    INFO(mpm_last_error());
    CHECK(found == status);
    CHECK_THAT(mpm_last_error(), StartsWith(mpm_status_word(status)));
    CHECK(same(seen(soil.p), before));
    soil.push(-0.44, window);
    CHECK(mpm_participant_advance(soil.p, window, nullptr) == MPM_OK);
    CHECK(same(seen(soil.p), next));
    CHECK_FALSE(same(next, before)); // the witness sees something
    REQUIRE(mpm_participant_restore_state(soil.p, start) == MPM_OK);
    REQUIRE(mpm_state_free(start) == MPM_OK);
}
} // namespace

TEST_CASE("mistakes have names and change nothing")
{
    Soil soil;
    REQUIRE(mpm_participant_advance(soil.p, window, nullptr) == MPM_OK); // begins to push
    std::vector<double> v(64, 7.0);
    const auto write = [&](const char* surface, int32_t field, std::vector<double> values, double time) {
        return [&soil, surface, field, values, time] {
            return mpm_participant_write_field(soil.p, surface, field, values.data(), values.size(), time);
        };
    };
    const auto advance = [&](double length) {
        return [&soil, length] { return mpm_participant_advance(soil.p, length, nullptr); };
    };
    SECTION("call order")
    {
        changesNothing(soil, MPM_CALL_ORDER, [&] { return mpm_participant_initialize(soil.p); });
        changesNothing(soil, MPM_CALL_ORDER, [&] { return soil.addWall("another"); });
        changesNothing(soil, MPM_CALL_ORDER,
                       [&] { return mpm_participant_set_interpolation(soil.p, "wall", MPM_RIGID_POSE, MPM_HERMITE); });
    }
    SECTION("names")
    {
        changesNothing(soil, MPM_UNKNOWN_SURFACE, write("wal", MPM_RIGID_POSE, {0, 0, 0, 1, 0, 0, 0}, 0));
        changesNothing(soil, MPM_UNKNOWN_FIELD, write("wall", MPM_FORCE, {0, 0, 0}, 0)); // it is read
        changesNothing(soil, MPM_UNKNOWN_FIELD,
                       [&] { return mpm_participant_read_field(soil.p, "wall", MPM_STRESS, v.data(), 24); });
        CHECK(v == std::vector<double>(64, 7.0));
    }
    SECTION("values")
    {
        changesNothing(soil, MPM_WRONG_SIZE, write("wall", MPM_RIGID_POSE, {0, 0, 0, 1, 0, 0}, window));
        changesNothing(soil, MPM_WRONG_SIZE,
                       [&] { return mpm_participant_read_field(soil.p, "wall", MPM_FORCE, v.data(), 4); });
        changesNothing(soil, MPM_NOT_FINITE, write("wall", MPM_RIGID_POSE, {notANumber, 0, 0, 1, 0, 0, 0}, window));
        changesNothing(soil, MPM_NOT_FINITE, write("wall", MPM_RIGID_TWIST, {0, 0, 0, 0, 0, INFINITY}, window));
        changesNothing(soil, MPM_BAD_VALUE, write("wall", MPM_RIGID_POSE, {0, 0, 0, 0, 0, 0, 0}, window));
        changesNothing(soil, MPM_BAD_VALUE, write("wall", MPM_RIGID_POSE, {0, 0, 1, 1, 0, 0, 0}, window));
        changesNothing(soil, MPM_BAD_VALUE, write("wall", MPM_RIGID_POSE, {-0.4, 0.6, 0, 1, 0, 0, 0}, -0.1));
        changesNothing(soil, MPM_BAD_VALUE, write("wall", 17, {0}, 0));
        CHECK(v == std::vector<double>(64, 7.0));
    }
    SECTION("windows")
    {
        for (const double length : {0.0, -window, notANumber, double(INFINITY), 1e-300})
            changesNothing(soil, MPM_BAD_WINDOW, advance(length));
    }
    SECTION("a pose that jumps through the soil")
    {
        changesNothing(soil, MPM_JUMP, [&] {
            const auto said = soil.write({1.9, 0.575, 0, 1, 0, 0, 0}, window);
            return said == MPM_OK ? mpm_participant_advance(soil.p, window, nullptr) : said;
        });
    }
    SECTION("states")
    {
        mpm_state* state = nullptr;
        size_t count = 0;
        REQUIRE(mpm_participant_save_state(soil.p, &state) == MPM_OK);
        REQUIRE(mpm_state_serialise(soil.p, state, nullptr, 0, &count) == MPM_OK);
        std::vector<unsigned char> bytes(count);
        REQUIRE(mpm_state_serialise(soil.p, state, bytes.data(), bytes.size(), &count) == MPM_OK);
        REQUIRE(mpm_state_free(state) == MPM_OK);
        mpm_state* again = nullptr;
        const auto use = [&](const std::vector<unsigned char>& some) {
            return [&] { return mpm_state_deserialise(soil.p, some.data(), some.size(), &again); };
        };
        changesNothing(soil, MPM_BAD_STATE, use({}));
        changesNothing(soil, MPM_BAD_STATE, use({1, 2, 3}));
        auto damaged = bytes;
        damaged.pop_back();
        changesNothing(soil, MPM_BAD_STATE, use(damaged));
        damaged = bytes;
        damaged[bytes.size() / 2] ^= 1;
        changesNothing(soil, MPM_BAD_STATE, use(damaged));
        CHECK(again == nullptr);
        tests::TemporaryFolder stiffer;
        tests::writeBlockCase(stiffer.path(), 1.1e6);
        mpm_participant* other = nullptr;
        REQUIRE(mpm_participant_create(stiffer.path().c_str(), nullptr, 0, 1, &other) == MPM_OK);
        REQUIRE(mpm_participant_initialize(other) == MPM_OK);
        mpm_state* foreign = nullptr;
        REQUIRE(mpm_participant_save_state(other, &foreign) == MPM_OK);
        changesNothing(soil, MPM_BAD_STATE, [&] { return mpm_participant_restore_state(soil.p, foreign); });
        CHECK(mpm_participant_destroy(other) == MPM_OK);
        changesNothing(soil, MPM_BAD_STATE, [&] { return mpm_participant_restore_state(soil.p, foreign); });
        CHECK(mpm_state_free(foreign) == MPM_OK);
        changesNothing(soil, MPM_BAD_HANDLE, [&] { return mpm_participant_restore_state(soil.p, foreign); });
    }
    SECTION("files")
    {
        changesNothing(soil, MPM_FILES, [&] {
            return mpm_participant_export_surface(soil.p, "wall", (soil.folder / "no/such/wall.vtp").c_str());
        });
    }
    SECTION("null")
    {
        changesNothing(soil, MPM_NULL_ARGUMENT,
                       [&] { return mpm_participant_write_field(soil.p, "wall", MPM_RIGID_POSE, nullptr, 7, 0); });
        changesNothing(soil, MPM_NULL_ARGUMENT, [&] { return mpm_participant_time(soil.p, nullptr); });
        changesNothing(soil, MPM_NULL_ARGUMENT, [&] { return mpm_participant_kind(soil.p, nullptr, nullptr); });
        changesNothing(soil, MPM_WRONG_SIZE, [&] {
            return mpm_participant_write_field(soil.p, "wall", MPM_RIGID_POSE, v.data(), SIZE_MAX, 0);
        });
    }
}

TEST_CASE("surfaces that are none")
{
    Soil soil(false);
    auto flipped = wallSegments;
    std::reverse(flipped.begin(), flipped.end());
    auto open = wallSegments;
    open.resize(6);
    auto twice = wallSegments;
    twice.insert(twice.end(), {0, 1});
    const std::vector<double> point = {-0.8, 0.15, 0, -0.8, 0.15, 0, -0.2, 1, 0, -0.8, 1, 0};
    CHECK(soil.addWall("a", wallVertices, flipped) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", wallVertices, open) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", wallVertices, twice) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", wallVertices, {0, 1, 1, 2, 2, 3, 3, 4}) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", wallVertices, {0, 1, 1, 2, 2, 3, 3, -1}) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", point) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", {}, {}) == MPM_BAD_SURFACE);
    CHECK(soil.addWall("a", {-0.8, notANumber, 0, -0.2, 0.15, 0, -0.2, 1, 0, -0.8, 1, 0}) != MPM_OK);
    CHECK(soil.addWall("a", wallVertices, wallSegments, 3) == MPM_BAD_VALUE);
    const double x = 0;
    const std::int64_t e = 0;
    CHECK(mpm_participant_add_coupling_surface(soil.p, "a", MPM_RIGID, &x, SIZE_MAX / 2, &e, 1, nullptr) ==
          MPM_WRONG_SIZE);
    const mpm_surface_options strange{3, 0, 1, 1, {}};
    CHECK(mpm_participant_add_coupling_surface(soil.p, "a", MPM_RIGID, wallVertices.data(), 4, wallSegments.data(), 4,
                                               &strange) == MPM_WRONG_SIZE);
    size_t count = 7;
    CHECK((mpm_participant_surface_count(soil.p, &count) == MPM_OK && count == 0));
    CHECK(soil.addWall("a") == MPM_OK);
    CHECK(soil.addWall("a") != MPM_OK); // the name is taken
    CHECK((mpm_participant_surface_count(soil.p, &count) == MPM_OK && count == 1));
    CHECK(mpm_participant_advance(soil.p, window, nullptr) == MPM_CALL_ORDER);
    CHECK(mpm_participant_initialize(soil.p) == MPM_OK);
    CHECK(mpm_participant_finalize(soil.p) == MPM_OK);
    CHECK(mpm_participant_advance(soil.p, window, nullptr) == MPM_CALL_ORDER);
}

TEST_CASE("surfaces that do not fit the soil")
{
    const std::vector<double> inSoil = {0.1, 0.1, 0, 0.7, 0.1, 0, 0.7, 0.7, 0, 0.1, 0.7, 0},
                              thin = {-0.8, 0.15, 0, -0.75, 0.15, 0, -0.75, 1, 0, -0.8, 1, 0},
                              far = {-9, 0.15, 0, -8, 0.15, 0, -8, 1, 0, -9, 1, 0};
    for (const auto& where : {inSoil, thin, far})
    {
        Soil soil(false);
        INFO("from x = " << where[0]);
        auto said = soil.addWall("a", where);
        if (said == MPM_OK)
            said = mpm_participant_initialize(soil.p);
        if (said == MPM_OK) // the first pose could have put it elsewhere
            said = mpm_participant_advance(soil.p, window, nullptr);
        CHECK(said == MPM_BAD_SURFACE);
        CHECK_THAT(mpm_last_error(), StartsWith("badSurface: ") && Catch::Contains("a"));
        int32_t lifecycle = 7;
        CHECK((mpm_participant_lifecycle(soil.p, &lifecycle) == MPM_OK && lifecycle != MPM_STEPPING));
    }
}

TEST_CASE("a case that is none")
{
    tests::TemporaryFolder folder;
    auto* const untouched = reinterpret_cast<mpm_participant*>(&folder);
    mpm_participant* p = untouched;
    CHECK(mpm_participant_create((folder / "nowhere").c_str(), nullptr, 0, 1, &p) == MPM_INPUT);
    tests::writeBlockCase(folder.path());
    const mpm_setting wrong[] = {{"system/mpmSchemes", "shape", "round"}};
    CHECK(mpm_participant_create(folder.path().c_str(), wrong, 1, 1, &p) == MPM_INPUT);
    CHECK_THAT(mpm_last_error(), Catch::Contains("round") && Catch::Contains("uGIMP"));
    const mpm_setting unknown[] = {{"system/mpmSchemes", "colour", "red"}},
                      empty[] = {{"system/gridDict", nullptr, "1"}};
    CHECK(mpm_participant_create(folder.path().c_str(), unknown, 1, 1, &p) == MPM_INPUT);
    CHECK(mpm_participant_create(folder.path().c_str(), empty, 1, 1, &p) == MPM_NULL_ARGUMENT);
    CHECK(mpm_participant_create(folder.path().c_str(), nullptr, 1, 1, &p) == MPM_NULL_ARGUMENT);
    CHECK(mpm_participant_create(folder.path().c_str(), nullptr, 0, -1, &p) == MPM_BAD_VALUE);
    CHECK(mpm_participant_create(nullptr, nullptr, 0, 1, &p) == MPM_NULL_ARGUMENT);
    CHECK(mpm_participant_create(folder.path().c_str(), nullptr, 0, 1, nullptr) == MPM_NULL_ARGUMENT);
    CHECK(p == untouched);
    const mpm_setting settings[] = {{"system/controlDict", "adjustTimeStep", "yes"},
                                    {"system/controlDict", "deltaT", "1"},
                                    {"constant/materialProperties", "solid.E", "2.5e5"}};
    double stiff = 0, soft = 0;
    for (auto* step : {&stiff, &soft})
    {
        REQUIRE(mpm_participant_create(folder.path().c_str(), settings, step == &soft ? 3 : 2, 1, &p) == MPM_OK);
        REQUIRE(mpm_participant_initialize(p) == MPM_OK);
        REQUIRE(mpm_participant_stable_time_step(p, step) == MPM_OK);
        REQUIRE(mpm_participant_destroy(p) == MPM_OK);
    }
    CHECK(soft == Approx(2 * stiff)); // dt ~ 1/c ~ 1/sqrt(E)
}
