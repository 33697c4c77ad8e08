/* The soil as a process of its own: a case as a participant, through the C interface, at a Unix socket.
 *
 *     soilServer CASE SOCKET
 *
 * Answers one master until it says SOIL_FINISH or goes away; then the last accepted window is on disk, and the case goes
 * on from it. Exit code: 0 finished, 1 the case or the socket is wrong, 2 the master went away. */
#define _POSIX_C_SOURCE 200809L
#include "capi/mpm.h"
#include "protocol.h"

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static mpm_participant* soil;
static mpm_state* start;

static int complain(const char* what)
{
    fprintf(stderr, "--> soilServer: error: %s\n", what);
    return 1;
}

static int listenAt(const char* path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const int one = socket(AF_UNIX, SOCK_STREAM, 0);
    int master;
    if (one < 0 || strlen(path) >= sizeof(address.sun_path))
        return -1;
    strcpy(address.sun_path, path);
    if (bind(one, (struct sockaddr*)&address, sizeof(address)) != 0 || listen(one, 1) != 0)
        return -1;
    master = accept(one, NULL, NULL);
    close(one);
    unlink(path);
    return master;
}

/* The whole record, or 0. */
static int receiveAll(int from, void* record, size_t size)
{
    size_t done = 0;
    while (done < size)
    {
        const ssize_t got = read(from, (char*)record + done, size - done);
        if (got <= 0)
            return 0;
        done += (size_t)got;
    }
    return 1;
}

static mpm_status advanceSoil(const struct soil_question* asked, struct soil_answer* answer)
{
    const double pose[7] = {asked->displacement, 0, 0, 1, 0, 0, 0};
    double force[3] = {0, 0, 0};
    mpm_status status = mpm_participant_write_field(soil, "wall", MPM_RIGID_POSE, pose, 7, asked->window);
    if (status == MPM_OK)
        status = mpm_participant_advance(soil, asked->window, NULL);
    if (status == MPM_OK)
        status = mpm_participant_window_average(soil, "wall", MPM_FORCE, force, 3);
    if (status == MPM_OK)
        status = mpm_participant_interface_work(soil, "wall", &answer->work);
    answer->force = force[0];
    return status;
}

static mpm_status obey(const struct soil_question* asked, struct soil_answer* answer)
{
    switch (asked->verb)
    {
    case SOIL_SAVE:
        mpm_state_free(start);
        start = NULL;
        return mpm_participant_save_state(soil, &start);
    case SOIL_RESTORE:
        return mpm_participant_restore_state(soil, start);
    case SOIL_ADVANCE:
        return advanceSoil(asked, answer);
    case SOIL_ACCEPT:
        return mpm_participant_accept_window(soil);
    case SOIL_FINISH:
        return mpm_participant_finalize(soil);
    case SOIL_TIME:
        return MPM_OK;
    default:
        return MPM_BAD_VALUE;
    }
}

/* 1: finished, 0: the master went away. */
static int serve(int master)
{
    struct soil_question asked;
    while (receiveAll(master, &asked, sizeof(asked)))
    {
        struct soil_answer answer;
        memset(&answer, 0, sizeof(answer));
        answer.status = obey(&asked, &answer);
        if (answer.status != MPM_OK)
            snprintf(answer.text, sizeof(answer.text), "%s", mpm_last_error());
        mpm_participant_time(soil, &answer.time);
        if (send(master, &answer, sizeof(answer), MSG_NOSIGNAL) != (ssize_t)sizeof(answer))
            return 0;
        if (asked.verb == SOIL_FINISH)
            return 1;
    }
    return 0;
}

int main(int count, char** arguments)
{
    int master, finished;
    if (count != 3)
        return complain("soilServer CASE SOCKET");
    if (mpm_participant_create(arguments[1], NULL, 0, 1, &soil) != MPM_OK || mpm_participant_initialize(soil) != MPM_OK)
        return complain(mpm_last_error());
    master = listenAt(arguments[2]);
    if (master < 0)
        return complain("the socket cannot be made there");
    finished = serve(master);
    if (!finished && mpm_participant_finalize(soil) != MPM_OK)
        return complain(mpm_last_error());
    mpm_state_free(start);
    mpm_participant_destroy(soil);
    if (finished)
        return 0;
    complain("the wall went away; the last accepted window is on disk (startFrom latestTime goes on from there)");
    return 2;
}
