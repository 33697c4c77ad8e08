#pragma once
/* What goes through the socket: a question, an answer, both of fixed size, in the machine's own bytes. Both programs run
 * on one machine, and doubles arrive as they were sent. */
#include <stdint.h>

enum
{
    SOIL_SAVE = 1,    /* keep the state the window starts from */
    SOIL_RESTORE = 2, /* go back to it */
    SOIL_ADVANCE = 3, /* by `window`, with the wall displaced by `displacement` at its end */
    SOIL_ACCEPT = 4,
    SOIL_FINISH = 5,
    SOIL_TIME = 6
};

struct soil_question
{
    int64_t verb;
    double window, displacement;
};

struct soil_answer
{
    int64_t status; /* mpm_status; not 0: `text` says why */
    double time, force, work;
    char text[480];
};
