/* A rigid wall is pushed into the left side of the collapsing column; its force is printed window by window.
 *
 *     cp -r <libmpm>/cases/collapsingSoilColumn column && seedParticles -case column
 *     lib=$(pkg-config --variable=libdir libmpm)
 *     cc pushedWall.c -o pushedWall $(pkg-config --cflags --libs libmpm) -Wl,-rpath,$lib
 *     ./pushedWall column 0.2
 *
 * or with CMake: cmake -S . -B build -DCMAKE_PREFIX_PATH=<where libmpm is> && cmake --build build
 */
#include <mpm.h>
#include <stdio.h>
#include <stdlib.h>

static const double speed = 0.5;           /* of the wall [m/s] */
static const double window = 0.02;         /* between exchanges [s] */
static const double width = 0.8;           /* of the wall: more than a cell [m] */
static const double bottom = 0.3, top = 6; /* it does not touch the ground [m] */
static const double gap = 0.14;            /* to the column, about half a cell [m] */

/* a word of the case that is for mpmSolve alone, taken away */
static const mpm_setting noStrainPaths[] = {{"system/controlDict", "recordStrain", ""}};

static void check(mpm_status status)
{
    if (status == MPM_OK)
        return;
    fprintf(stderr, "pushedWall: %s\n", mpm_last_error());
    exit(1);
}

static void addWall(mpm_participant* soil)
{
    const double vertices[] = {-gap - width, bottom, 0, -gap, bottom, 0, -gap, top, 0, -gap - width, top, 0};
    const int64_t segments[] = {0, 1, 1, 2, 2, 3, 3, 0}; /* counter-clockwise: the normal (e_y, -e_x) points out */
    mpm_surface_options options = {sizeof(options), 0.3, 1, 1, {0, 0, 0}};
    check(mpm_participant_add_coupling_surface(soil, "wall", MPM_RIGID, vertices, 4, segments, 4, &options));
}

int main(int count, char** arguments)
{
    mpm_participant* soil;
    const double end = count > 2 ? atof(arguments[2]) : 0.2;
    double time, force[3], work;
    double pose[7] = {-gap - width / 2, (bottom + top) / 2, 0, 1, 0, 0, 0}; /* centre, and a quaternion: no rotation */
    const double twist[6] = {speed, 0, 0, 0, 0, 0};
    if (count < 2)
    {
        fprintf(stderr, "pushedWall CASE [END]: a copy of cases/collapsingSoilColumn, seeded; end in s\n");
        return 1;
    }
    check(mpm_participant_create(arguments[1], noStrainPaths, 1, 0, &soil));
    addWall(soil);
    check(mpm_participant_initialize(soil));
    printf("libmpm %s\n%10s %14s %14s %9s\n", mpm_version(), "time [s]", "F_x [N/m]", "F_y [N/m]", "substeps");
    for (check(mpm_participant_time(soil, &time)); time < end - window / 2;)
    {
        mpm_advance reached;
        pose[0] += speed * window; /* where the wall is at the end of the window */
        check(mpm_participant_write_field(soil, "wall", MPM_RIGID_POSE, pose, 7, window));
        check(mpm_participant_write_field(soil, "wall", MPM_RIGID_TWIST, twist, 6, window));
        check(mpm_participant_advance(soil, window, &reached));
        check(mpm_participant_window_average(soil, "wall", MPM_FORCE, force, 3));
        check(mpm_participant_accept_window(soil));
        time = reached.time;
        printf("%10.4f %14.6g %14.6g %9d\n", time, force[0], force[1], (int)reached.substeps);
    }
    check(mpm_participant_interface_work(soil, "wall", &work));
    printf("work of the wall on the soil: %g J/m\n", work);
    check(mpm_participant_finalize(soil));
    check(mpm_participant_destroy(soil));
    return 0;
}
