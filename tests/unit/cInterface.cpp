// The participant through mpm.h, as a C program meets it: windows, surfaces, states, handles, threads.
#include "support/blockParticipant.hpp"

#include <atomic>
#include <cmath>
#include <thread>

using namespace mpm;
using namespace mpm::tests;
using Catch::Matchers::StartsWith;

TEST_CASE("a window in C: the wall pushes the block, the books balance")
{
    Soil soil;
    double force[3] = {}, time = 0, step = 0;
    mpm_advance reached{};
    for (int i = 1; i <= 10; ++i)
    {
        soil.push(-0.45 + 0.01 * i, window);
        REQUIRE(mpm_participant_advance(soil.p, window, &reached) == MPM_OK);
        REQUIRE(mpm_participant_accept_window(soil.p) == MPM_OK);
    }
    REQUIRE(mpm_participant_time(soil.p, &time) == MPM_OK);
    CHECK(reached.time == time);
    CHECK(time == Approx(0.1));
    CHECK(reached.substeps >= 5); // deltaT is 2 ms
    REQUIRE(mpm_participant_window_average(soil.p, "wall", MPM_FORCE, force, 3) == MPM_OK);
    CHECK(force[0] < 0); // the soil resists a push to the right
    CHECK(force[2] == 0);
    mpm_resultants sums{};
    REQUIRE(mpm_participant_resultants(soil.p, "wall", &sums) == MPM_OK);
    CHECK(sums.force[0] == force[0]);
    CHECK(sums.impulse[0] == Approx(force[0] * window));
    mpm_balance balance{};
    double work = 0;
    REQUIRE(mpm_participant_balance(soil.p, &balance) == MPM_OK);
    REQUIRE(mpm_participant_interface_work(soil.p, "wall", &work) == MPM_OK);
    CHECK(work > 0);
    CHECK(balance.interface_work == work);
    CHECK(std::abs(balance.residual) < 1e-9 * work);
    CHECK(balance.momentum[0] > 0);
    REQUIRE(mpm_participant_stable_time_step(soil.p, &step) == MPM_OK);
    CHECK(step == 0.002); // deltaT
    REQUIRE(mpm_participant_finalize(soil.p) == MPM_OK);
    CHECK(std::filesystem::exists(soil.folder / "0.1" / "state.h5"));
}

TEST_CASE("what a surface is")
{
    Soil soil;
    size_t count = 0;
    CHECK((mpm_participant_surface_count(soil.p, &count) == MPM_OK && count == 1));
    char name[8];
    CHECK((mpm_participant_surface_name(soil.p, 0, nullptr, 0, &count) == MPM_OK && count == 5));
    CHECK(mpm_participant_surface_name(soil.p, 0, name, 4, &count) == MPM_BUFFER_TOO_SMALL);
    CHECK(count == 5);
    CHECK((mpm_participant_surface_name(soil.p, 0, name, 8, &count) == MPM_OK && std::string(name) == "wall"));
    CHECK(mpm_participant_surface_name(soil.p, 1, name, 8, &count) == MPM_UNKNOWN_SURFACE);
    std::vector<double> x(12);
    CHECK((mpm_participant_vertices(soil.p, "wall", x.data(), 12, &count) == MPM_OK && count == 12));
    CHECK(x == wallVertices);
    double point[3] = {};
    CHECK((mpm_participant_reference(soil.p, "wall", point) == MPM_OK && point[0] == Approx(-0.5)));
    CHECK((point[1] == Approx(0.575) && point[2] == 0));
    std::vector<std::int64_t> e(8);
    CHECK((mpm_participant_elements(soil.p, "wall", e.data(), 8, &count) == MPM_OK && count == 8));
    CHECK(e == wallSegments);
    std::vector<mpm_field> fields(20);
    REQUIRE(mpm_participant_fields(soil.p, "wall", fields.data(), 20, &count) == MPM_OK);
    fields.resize(count);
    for (const auto& field : fields)
    {
        REQUIRE(mpm_participant_value_count(soil.p, "wall", field.name, &count) == MPM_OK);
        CHECK(count == size_t(field.components * (field.support == MPM_VERTEX ? 4 : 1)));
        CHECK(std::string(field.word) == mpm_field_word(field.name));
        if (field.name == MPM_FORCE)
            CHECK((std::string(field.unit) == "N/m" && field.extensive == 1 && field.direction == MPM_READ));
    }
    CHECK(fields.size() >= 7);
    CHECK((mpm_abi_version() == MPM_ABI_VERSION && std::string(mpm_version()).size() >= 5));
}

TEST_CASE("a state as bytes goes on bitwise in another participant of the same case")
{
    Soil soil, other;
    mpm_state *state = nullptr, *copy = nullptr;
    for (int i = 0; i < 3; ++i)
        REQUIRE(mpm_participant_advance(soil.p, window, nullptr) == MPM_OK);
    REQUIRE(mpm_participant_save_state(soil.p, &state) == MPM_OK);
    size_t count = 0;
    REQUIRE(mpm_state_serialise(soil.p, state, nullptr, 0, &count) == MPM_OK);
    std::vector<char> bytes(count);
    CHECK(mpm_state_serialise(soil.p, state, bytes.data(), count - 1, &count) == MPM_BUFFER_TOO_SMALL);
    REQUIRE(mpm_state_serialise(soil.p, state, bytes.data(), count, &count) == MPM_OK);
    REQUIRE(mpm_state_deserialise(other.p, bytes.data(), count, &copy) == MPM_OK);
    REQUIRE(mpm_participant_restore_state(other.p, copy) == MPM_OK);
    for (auto* one : {&soil, &other})
    {
        one->push(-0.4, window);
        REQUIRE(mpm_participant_advance(one->p, window, nullptr) == MPM_OK);
    }
    CHECK(same(seen(soil.p), seen(other.p)));
    mpm_state_free(state);
    mpm_state_free(copy);
}

TEST_CASE("handles that are none")
{
    Soil soil, other;
    auto* const freed = other.p;
    double time = 7;
    CHECK(mpm_participant_time(nullptr, &time) == MPM_BAD_HANDLE);
    CHECK(mpm_participant_time(reinterpret_cast<mpm_participant*>(&soil), &time) == MPM_BAD_HANDLE);
    mpm_state* state = nullptr;
    REQUIRE(mpm_participant_save_state(soil.p, &state) == MPM_OK);
    CHECK(mpm_participant_time(reinterpret_cast<mpm_participant*>(state), &time) == MPM_BAD_HANDLE);
    CHECK(mpm_state_free(reinterpret_cast<mpm_state*>(soil.p)) == MPM_BAD_HANDLE);
    CHECK(mpm_participant_destroy(freed) == MPM_OK);
    CHECK(mpm_participant_destroy(freed) == MPM_BAD_HANDLE);
    CHECK(mpm_participant_time(freed, &time) == MPM_BAD_HANDLE);
    other.make();
    CHECK(other.p != freed);
    CHECK(mpm_participant_time(freed, &time) == MPM_BAD_HANDLE);
    CHECK(time == 7);
    CHECK_THAT(mpm_last_error(), StartsWith("badHandle"));
    CHECK(mpm_participant_time(soil.p, &time) == MPM_OK);
    CHECK(std::string(mpm_last_error()).empty());
    CHECK(mpm_state_free(state) == MPM_OK);
    CHECK(mpm_state_free(state) == MPM_BAD_HANDLE);
    CHECK((mpm_state_free(nullptr) == MPM_OK && mpm_participant_destroy(nullptr) == MPM_OK));
}

TEST_CASE("two threads: errors are each one's own, one participant is one thread's at a time")
{
    Soil other;
    double time = 0;
    CHECK(mpm_participant_time(nullptr, &time) == MPM_BAD_HANDLE);
    mpm_status found = MPM_OK;
    std::string fresh = "something", own;
    std::thread([&] {
        fresh = mpm_last_error();
        found = mpm_participant_advance(other.p, 0, nullptr);
        own = mpm_last_error();
    }).join();
    CHECK(fresh.empty());
    CHECK(found == MPM_BAD_WINDOW);
    CHECK_THAT(own, StartsWith("badWindow"));
    CHECK_THAT(mpm_last_error(), StartsWith("badHandle"));
    // Who is slow to look may find the other one done: then once more.
    mpm_status met = MPM_OK, ended = MPM_OK;
    for (int round = 0; ended != MPM_BUSY && round < 100; ++round)
    {
        const Soil soil;
        std::atomic<bool> done = false;
        std::thread stepping([&] {
            found = mpm_participant_advance(soil.p, 0.5, nullptr);
            done = true;
        });
        for (met = MPM_OK; met != MPM_BUSY && !done;)
            met = mpm_participant_time(soil.p, &time);
        if (met == MPM_BUSY)
            ended = mpm_participant_destroy(soil.p);
        stepping.join();
        CHECK((found == MPM_OK || found == MPM_BUSY)); // it may have come second itself
        if (met == MPM_BUSY) // and the participant is there still, unless the call under way had ended before
            CHECK(mpm_participant_time(soil.p, &time) == (ended == MPM_BUSY ? MPM_OK : MPM_BAD_HANDLE));
    }
    CHECK(ended == MPM_BUSY);
}
