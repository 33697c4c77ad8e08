#pragma once
/// The block of blockCase.hpp as a participant, through mpm.h, with a rigid wall that is about to be pushed into it.
#include "capi/mpm.h"
#include "support/blockCase.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <cstring>

namespace mpm::tests
{
inline const std::vector<double> wallVertices = {-0.8, 0.15, 0, -0.2, 0.15, 0, -0.2, 1, 0, -0.8, 1, 0};
inline const std::vector<std::int64_t> wallSegments = {0, 1, 1, 2, 2, 3, 3, 0};
constexpr double window = 0.01;

/// A case of its own, a participant with a rigid wall left of the block, moving against it.
struct Soil
{
    TemporaryFolder folder;
    mpm_participant* p = nullptr;

    explicit Soil(bool initialized = true)
    {
        writeBlockCase(folder.path());
        make();
        if (initialized)
        {
            REQUIRE(addWall("wall") == MPM_OK);
            REQUIRE(mpm_participant_initialize(p) == MPM_OK);
            push(-0.45, window);
        }
    }
    ~Soil() { mpm_participant_destroy(p); }

    void make()
    {
        const auto status = mpm_participant_create(folder.path().c_str(), nullptr, 0, 1, &p);
        INFO(mpm_last_error());
        REQUIRE(status == MPM_OK);
    }
    mpm_status addWall(const char* name, const std::vector<double>& x = wallVertices,
                       const std::vector<std::int64_t>& e = wallSegments, int32_t kind = MPM_RIGID)
    {
        return mpm_participant_add_coupling_surface(p, name, kind, x.data(), x.size() / 3, e.data(), e.size() / 2,
                                                    nullptr);
    }
    mpm_status write(const std::vector<double>& pose, double time)
    {
        return mpm_participant_write_field(p, "wall", MPM_RIGID_POSE, pose.data(), pose.size(), time);
    }
    void push(double x, double time) { REQUIRE(write({x, 0.575, 0, 1, 0, 0, 0}, time) == MPM_OK); }
};

/// All a master can see of where a participant is.
inline std::vector<double> seen(mpm_participant* p)
{
    mpm_balance b{};
    double time = 0, force[3] = {}, work = 0;
    int32_t lifecycle = 0;
    REQUIRE(mpm_participant_balance(p, &b) == MPM_OK);
    REQUIRE(mpm_participant_time(p, &time) == MPM_OK);
    REQUIRE(mpm_participant_lifecycle(p, &lifecycle) == MPM_OK);
    REQUIRE(mpm_participant_read_field(p, "wall", MPM_FORCE, force, 3) == MPM_OK);
    REQUIRE(mpm_participant_interface_work(p, "wall", &work) == MPM_OK);
    return {b.kinetic_energy,
            b.strain_energy,
            b.dissipation,
            b.gravity_work,
            b.interface_work,
            b.residual,
            b.momentum[0],
            b.momentum[1],
            force[0],
            force[1],
            force[2],
            work,
            time,
            double(lifecycle)};
}

inline bool same(const std::vector<double>& a, const std::vector<double>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
} // namespace mpm::tests
