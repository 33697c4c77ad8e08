#ifndef MPM_H
#define MPM_H
#pragma once
/* libmpm in C: a case of the material point method as one participant of a coupled simulation.
 *
 *     mpm_participant* soil;
 *     mpm_participant_create("columnSpringWall", NULL, 0, 0, &soil);
 *     mpm_participant_initialize(soil);
 *     while (time < end)
 *     {
 *         mpm_participant_write_field(soil, "wall", MPM_RIGID_POSE, pose, 7, window);
 *         if (mpm_participant_advance(soil, window, &reached) != MPM_OK)
 *             break;                                                          // mpm_last_error() says why
 *         mpm_participant_window_average(soil, "wall", MPM_FORCE, force, 3);
 *         mpm_participant_accept_window(soil);
 *     }
 *     mpm_participant_finalize(soil);
 *     mpm_participant_destroy(soil);
 *
 * Lifecycle, windows, samples, contact: libmpm/coupling/participant.hpp; each function here is one call of that class.
 *
 * Status: every call that can fail returns one. No exception and no signal leaves the library. After a status other
 * than MPM_OK the participant is as it was before the call, and what the call would have written (but *count) is
 * untouched.
 *
 * Handles are numbers in the guise of pointers: a null, freed or foreign one is MPM_BAD_HANDLE. None is used twice.
 *
 * Threads: several participants may be used at once, one participant by one thread at a time: a second one that meets a
 * call under way gets MPM_BUSY. mpm_last_error() is per thread.
 *
 * Buffers are the caller's. Field values come and go in arrays of exactly mpm_participant_value_count() doubles. For
 * what has a length of its own (text, lists, states) the call says in *count how long it is; with capacity 0 nothing is
 * copied, with one that is too small it is MPM_BUFFER_TOO_SMALL. So: ask, allocate, call again. Text is UTF-8 and ends
 * in 0, which is counted.
 *
 * Values: SI units, tension positive. Vectors have three components in 2D too (z = 0), stresses six: xx yy zz xy yz zx.
 * In 2D what is extensive is per metre of thickness.
 */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default) /* nothing else of the library is seen */
#endif

/* Number of this interface: changes whenever a program compiled against an older one would go wrong. */
#define MPM_ABI_VERSION 1

typedef int32_t mpm_status;
enum
{
    MPM_OK = 0,
    MPM_CALL_ORDER = 1,      /* a call that the lifecycle does not allow now */
    MPM_UNKNOWN_SURFACE = 2, /* no coupling surface of that name */
    MPM_UNKNOWN_FIELD = 3,   /* the surface has no such field, or not in this direction */
    MPM_WRONG_SIZE = 4,      /* more or fewer values than the field has */
    MPM_NOT_FINITE = 5,      /* a NaN or an infinity among the values */
    MPM_BAD_VALUE = 6,       /* a value none may have: quaternion of length 0, z in 2D, an enumerator not below */
    MPM_BAD_WINDOW = 7,      /* no positive, finite time a step can be taken in */
    MPM_BAD_SURFACE = 8,     /* open, flipped, duplicate, degenerate elements; outside the grid; in the soil */
    MPM_JUMP = 9,            /* a surface would move more than half a cell in one substep */
    MPM_BAD_STATE = 10,      /* a saved state that is none, is damaged, or belongs to another case */
    MPM_FILES = 11,          /* a file cannot be written or read */

    MPM_INPUT = 20,            /* the case: file:line, what was found, what is allowed */
    MPM_DISCARDED = 21,        /* the calculation cannot go on; of advance: back at the window's start */
    MPM_NULL_ARGUMENT = 22,    /* an argument that must point to something does not */
    MPM_BUFFER_TOO_SMALL = 23, /* *count says what it takes */
    MPM_BAD_HANDLE = 24,       /* no participant, or no state: never made, or destroyed */
    MPM_BUSY = 25,             /* another thread is in a call of this participant */
    MPM_OUT_OF_MEMORY = 26,
    MPM_INTERNAL = 27 /* a mistake of ours */
};

enum /* kinds of surfaces: who moves it, written -> read */
{
    MPM_RIGID = 0,      /* master; RigidPose RigidTwist -> Force Torque ContactArea, Traction Displacement Velocity */
    MPM_DEFORMABLE = 1, /* master, each vertex; Displacement Velocity -> Force Traction ContactArea */
    MPM_MONITOR = 2     /* the soil; Force Traction -> Displacement Velocity Stress */
};

enum /* fields; libmpm/coupling/field.hpp */
{
    MPM_DISPLACEMENT = 0, /* [m] */
    MPM_VELOCITY = 1,     /* [m/s] */
    MPM_RIGID_POSE = 2,   /* place of the reference point [m] and unit quaternion: x y z qw qx qy qz */
    MPM_RIGID_TWIST = 3,  /* its velocity [m/s] and the angular velocity [rad/s]: vx vy vz wx wy wz */
    MPM_FORCE = 4,        /* [N]; read: of the soil on the surface, written: on the soil */
    MPM_TORQUE = 5,       /* [N m] about the reference point */
    MPM_TRACTION = 6,     /* [Pa] */
    MPM_STRESS = 7,       /* [Pa], six components */
    MPM_CONTACT_AREA = 8  /* [m^2] */
};

enum
{
    MPM_WRITTEN = 0, /* by the master */
    MPM_READ = 1
};

enum
{
    MPM_SURFACE = 0, /* one value for the whole */
    MPM_VERTEX = 1   /* one a vertex */
};

enum /* between written samples */
{
    MPM_CONSTANT = 0,
    MPM_LINEAR = 1, /* default */
    MPM_HERMITE = 2
};

enum
{
    MPM_NEAREST_NEIGHBOUR = 0,
    MPM_NEAREST_PROJECTION = 1
};

enum /* lifecycle */
{
    MPM_CREATED = 0,
    MPM_INITIALIZED = 1,
    MPM_STEPPING = 2,
    MPM_FINALIZED = 3
};

typedef struct mpm_participant mpm_participant; /* opaque */
typedef struct mpm_state mpm_state;             /* opaque; a saved state */

typedef struct mpm_setting /* a word of a dictionary with another value than the file's */
{
    const char* file;  /* "constant/materialProperties" */
    const char* word;  /* "soil.cohesion" */
    const char* value; /* "2e3"; "" takes the word away */
} mpm_setting;

typedef struct mpm_surface_options
{
    size_t size;                   /* sizeof(mpm_surface_options): what is beyond it takes its default */
    double mu;                     /* Coulomb friction; default 0 */
    int32_t separation;            /* 0: the surface also holds; default 1 */
    int32_t reference_is_centroid; /* 1 (default): `reference` is not looked at */
    double reference[3];           /* the point RigidPose speaks of [m] */
} mpm_surface_options;

typedef struct mpm_field
{
    int32_t name;          /* MPM_DISPLACEMENT, ... */
    int32_t direction;     /* MPM_WRITTEN, MPM_READ */
    int32_t support;       /* MPM_SURFACE, MPM_VERTEX */
    int32_t rank;          /* 0 scalar, 1 vector, 2 symmetric tensor; pose and twist count as 1 */
    int32_t components;    /* doubles a value: 1, 3, 6, 7 */
    int32_t extensive;     /* 1: it adds up over a surface, and is mapped conservatively */
    int32_t dimensions[7]; /* exponents of kg m s K mol A cd */
    char word[20];         /* "Displacement" */
    char unit[16];         /* "m", "N/m" */
} mpm_field;

typedef struct mpm_advance
{
    double time;      /* where the participant is now [s] */
    int64_t substeps; /* taken in this window */
} mpm_advance;

typedef struct mpm_resultants /* of the soil on a surface; per metre in 2D */
{
    double force[3], torque[3];           /* means of the last window [N, N m] */
    double impulse[3], moment_impulse[3]; /* of the last window [N s, N m s] */
    double contact_area;                  /* at its end [m^2] */
} mpm_resultants;

typedef struct mpm_balance /* sums over the whole soil now [J, N s] */
{
    double kinetic_energy, strain_energy, dissipation, gravity_work;
    double interface_work; /* of all surfaces on the soil since initialize */
    double motion_work;    /* the same by the soil's own books, with walls and bodies whose motion is prescribed */
    double residual;       /* what the budget does not explain */
    double momentum[3];
} mpm_balance;

/* "0.1.0"; MPM_ABI_VERSION of the library that is loaded. */
const char* mpm_version(void);
int32_t mpm_abi_version(void);
/* What this thread's last call had to complain of; "" after MPM_OK. Never null, valid until the thread's next call. */
const char* mpm_last_error(void);
/* "callOrder", ...; "Displacement", ...; "unknown" for numbers that are none. */
const char* mpm_status_word(mpm_status status);
const char* mpm_field_word(int32_t field);

/* Making and ending one. threads: 0 takes OpenMP's number. All mistakes of the case are found here: MPM_INPUT. */
mpm_status mpm_participant_create(const char* case_folder, const mpm_setting* settings, size_t setting_count,
                                  int32_t threads, mpm_participant** participant);
/* A null one is MPM_OK. Nothing is written: that is what finalize does. */
mpm_status mpm_participant_destroy(mpm_participant* participant);

/* Before initialize.
 * vertices: vertex_count times x y z [m]. elements: element_count times the vertices, from 0, of a segment in 2D
 * (outward normal (e_y, -e_x)) or a triangle in 3D. options: null for the defaults. Whether it fits the grid is
 * looked at by initialize, whether it lies in the soil by the first advance: a pose may place it first. */
mpm_status mpm_participant_add_coupling_surface(mpm_participant* participant, const char* surface, int32_t kind,
                                                const double* vertices, size_t vertex_count, const int64_t* elements,
                                                size_t element_count, const mpm_surface_options* options);
mpm_status mpm_participant_set_interpolation(mpm_participant* participant, const char* surface, int32_t field,
                                             int32_t interpolation);
/* From now on fields at vertices are exchanged on this mesh. */
mpm_status mpm_participant_set_partner_mesh(mpm_participant* participant, const char* surface, const double* vertices,
                                            size_t vertex_count, const int64_t* elements, size_t element_count,
                                            int32_t method);
mpm_status mpm_participant_initialize(mpm_participant* participant);

/* At any time. */
mpm_status mpm_participant_lifecycle(mpm_participant* participant, int32_t* lifecycle);
mpm_status mpm_participant_dimension(mpm_participant* participant, int32_t* dimension);
mpm_status mpm_participant_time(mpm_participant* participant, double* time);
mpm_status mpm_participant_surface_count(mpm_participant* participant, size_t* count);
mpm_status mpm_participant_surface_name(mpm_participant* participant, size_t index, char* name, size_t capacity,
                                        size_t* count);
mpm_status mpm_participant_kind(mpm_participant* participant, const char* surface, int32_t* kind);
mpm_status mpm_participant_fields(mpm_participant* participant, const char* surface, mpm_field* fields, size_t capacity,
                                  size_t* count);
/* In the reference configuration; the partner's, where one was set. Counted are doubles (3 a vertex) and
 * indices (2 or 3 an element). */
mpm_status mpm_participant_vertices(mpm_participant* participant, const char* surface, double* vertices,
                                    size_t capacity, size_t* count);
mpm_status mpm_participant_elements(mpm_participant* participant, const char* surface, int64_t* elements,
                                    size_t capacity, size_t* count);
/* The point that RigidPose places and torques are about, in the reference configuration: x y z [m]. */
mpm_status mpm_participant_reference(mpm_participant* participant, const char* surface, double* point);
/* Doubles that write_field and read_field exchange for a field: components, times vertices. */
mpm_status mpm_participant_value_count(mpm_participant* participant, const char* surface, int32_t field, size_t* count);

/* From initialize on.
 * What a field is at time() + relative_time [s]; holds until something later was said. */
mpm_status mpm_participant_write_field(mpm_participant* participant, const char* surface, int32_t field,
                                       const double* values, size_t count, double relative_time);
/* Steps to time() + window [s]. MPM_DISCARDED: back at the window's start, result tells so. result may be null. */
mpm_status mpm_participant_advance(mpm_participant* participant, double window, mpm_advance* result);
/* The largest step the scheme may take now [s]; deltaT where it is fixed. */
mpm_status mpm_participant_stable_time_step(mpm_participant* participant, double* step);
/* At time(): forces and tractions of the last substep. */
mpm_status mpm_participant_read_field(mpm_participant* participant, const char* surface, int32_t field, double* values,
                                      size_t count);
/* Force, Torque, Traction: impulse of the last window over its length. */
mpm_status mpm_participant_window_average(mpm_participant* participant, const char* surface, int32_t field,
                                          double* values, size_t count);
mpm_status mpm_participant_resultants(mpm_participant* participant, const char* surface, mpm_resultants* resultants);
/* Of the surface on the soil since initialize [J]. */
mpm_status mpm_participant_interface_work(mpm_participant* participant, const char* surface, double* work);
mpm_status mpm_participant_balance(mpm_participant* participant, mpm_balance* balance);

/* All there is, hidden state included: a restored participant goes on bitwise as the saved one did. A state
 * outlives its participant, and is to be freed. */
mpm_status mpm_participant_save_state(mpm_participant* participant, mpm_state** state);
mpm_status mpm_participant_restore_state(mpm_participant* participant, mpm_state* state);
mpm_status mpm_state_free(mpm_state* state);
/* As bytes, for another process of the same program and case. */
mpm_status mpm_state_serialise(mpm_participant* participant, mpm_state* state, void* bytes, size_t capacity,
                               size_t* count);
mpm_status mpm_state_deserialise(mpm_participant* participant, const void* bytes, size_t count, mpm_state** state);

/* The way since the last accepted window stands: only now its rows and due states go to disk. */
mpm_status mpm_participant_accept_window(mpm_participant* participant);
/* The surface as it is now: .stl (3D), .vtp or .msh by the ending. */
mpm_status mpm_participant_export_surface(mpm_participant* participant, const char* surface, const char* file);
/* Writes the state of the last accepted window, so that the case can go on from it. */
mpm_status mpm_participant_finalize(mpm_participant* participant);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
