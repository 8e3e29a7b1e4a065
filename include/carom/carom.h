/* Carom from C: hard disks in a rectangle that a program steps, looks at and changes.
 *
 * A world is a handle. Only one thread at a time may call functions of a world; worlds share nothing. No call throws,
 * prints or changes signal handlers. Every call that can fail returns a carom_status, and carom_error() of the world
 * then returns a line that says what was wrong. After a failed call the world is as it was, with two exceptions. A
 * failed call that steps leaves it at the end of the last step made. If memory runs out within a step or a change, the
 * state is lost: from then on all numbers are 0 and all other calls return CAROM_FAILED, until carom_load_memory loads
 * a saved state. Any call may return CAROM_FAILED (no memory) or CAROM_INPUT (a null pointer, NaN); other values are
 * given with each function. Lengths, times and masses are in the scene's own units. The bits are those of `carom run`
 * with the same scene, for any compiler flags, rounding mode and number of threads of the program. docs/library.md
 * shows how to use it. */
#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

/* Marks fields that a C++ program may omit when it lists the fields of a struct. */
#if defined(__cplusplus) && __cplusplus >= 201402L
#define CAROM_OPTIONAL = 0
#else
#define CAROM_OPTIONAL
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct carom_world carom_world;

typedef enum carom_status {
  CAROM_OK = 0,
  CAROM_FAILED = 1,   /* of the machine: no memory, a file that cannot be written */
  CAROM_INPUT = 2,    /* a bad scene, a number out of range, an array too short, a null pointer */
  CAROM_PHYSICS = 3,  /* the method cannot continue (a step far too long, inelastic collapse) */
  CAROM_NO_ROOM = 4,  /* a disk that would overlap another, an inner wall or a side that has moved in */
  CAROM_NOT_FOUND = 5 /* no disk of this id, or none that a query asks for */
} carom_status;

/* How a world is computed; results do not depend on it, not even in a bit. Call carom_options_init before changing any
 * field. The comments give the defaults. */
typedef struct carom_options {
  int threads;   /* 1; 0: all cores */
  int reference; /* 0; 1: the plain serial engine, for comparisons */
} carom_options;

typedef enum carom_method { CAROM_EXACT = 0, CAROM_PAIRWISE = 1, CAROM_ROLLBACK = 2 } carom_method;
typedef enum carom_side { CAROM_WALL = 0, CAROM_PERIODIC = 1, CAROM_SINK = 2 } carom_side;

/* A scene without disks, which carom_add adds. carom_scene_init sets the defaults: a box of 1 x 1 with elastic walls.
 * Further features of scene files (sources, growth, collapse models) need carom_from_text or carom_from_file. */
typedef struct carom_scene {
  double width, height;
  int left, right, bottom, top; /* carom_side; periodic ones in opposite pairs */
  double wall_restitution;      /* 1; in [0, 1] */
  double gravity;               /* 0; along -y, length / time^2 */
  double restitution;           /* 1; of two disks, in [0, 1] */
  double diffusion;             /* 0; length^2 / time */
  int method;                   /* CAROM_EXACT */
  double dt;                    /* 0; the step of pairwise and rollback, and of Brownian motion */
  double t_end;                 /* 1e9 */
  uint64_t seed;                /* 1 */
  double gravity_x;             /* 0; along +x, length / time^2: the vector is (gravity_x, -gravity) */
} carom_scene;

typedef struct carom_disk {
  double x, y;   /* centre; length */
  double vx, vy; /* length / time */
  double radius; /* length */
  double mass;
  uint32_t id;
  double spin CAROM_OPTIONAL; /* angular velocity, counter-clockwise, 1 / time; 0 for smooth disks, and not read */
} carom_disk;

/* The kind of object that a ray has met. */
typedef enum carom_met { CAROM_MET_DISK = 0, CAROM_MET_WALL = 1, CAROM_MET_SINK = 2 } carom_met;

typedef struct carom_hit {
  double distance; /* along the ray to the disk's edge, or to the wall; 0 if the ray begins inside a disk */
  double x, y;     /* that point, inside the box */
  uint32_t id;     /* of the disk; for an inner wall the number of its [[walls]] table, from 0 */
  int what;        /* carom_met */
} carom_hit;

typedef struct carom_contact {
  double time;       /* exact: time of the collision; pairwise and rollback: end of the step */
  uint32_t id1, id2; /* id1 < id2 */
} carom_contact;

/* --- The library -------------------------------------------------------------------------------------------------- */

CAROM_API const char* carom_version(void);                    /* "0.1.0" */
CAROM_API const char* carom_status_text(carom_status status); /* "no room"; never null */
CAROM_API void carom_options_init(carom_options* options);    /* null: does nothing */
CAROM_API void carom_scene_init(carom_scene* scene);          /* null: does nothing */

/* --- Making a world -------------------------------------------------------------------------------------------------
 * options may be null, for the defaults. *world is set whenever there is memory for it; after a failure it may only be
 * used for carom_error and carom_destroy. A scene is TOML (docs/scene.md); its [output] and [analysis] are ignored
 * here. CAROM_INPUT for a bad scene (the error names file, line and key), and if disks find no place. */

CAROM_API carom_status carom_from_file(const char* path, const carom_options* options, carom_world** world);
CAROM_API carom_status carom_from_text(const char* text, size_t length, const carom_options* options,
                                       carom_world** world);
CAROM_API carom_status carom_from_scene(const carom_scene* scene, const carom_options* options, carom_world** world);
/* From a checkpoint of carom run or carom_save, or the folder of a run; and from bytes of carom_save_memory.
 * CAROM_INPUT if it is no checkpoint, or is damaged. */
CAROM_API carom_status carom_from_checkpoint(const char* path, const carom_options* options, carom_world** world);
CAROM_API carom_status carom_from_memory(const void* bytes, size_t size, const carom_options* options,
                                         carom_world** world);
CAROM_API void carom_destroy(carom_world* world); /* null: does nothing */

/* The error of the last failed call for this world, one line; empty if no call failed. Valid until the next call for
 * the world. Never null, not even for a null world. */
CAROM_API const char* carom_error(const carom_world* world);
/* The next warning of the physics, one line, valid until the next call for the world; null if there is none. */
CAROM_API const char* carom_next_warning(carom_world* world);

/* --- Stepping -------------------------------------------------------------------------------------------------------
 * CAROM_PHYSICS if the method cannot go on. */

/* Makes this number of steps, or fewer if the scene's end is reached. */
CAROM_API carom_status carom_step(carom_world* world, uint64_t steps);
/* Makes steps until the time is t or later, or until the scene's end. A step is dt long, or a window of the exact
 * method; none is cut short. */
CAROM_API carom_status carom_run_until(carom_world* world, double t);
/* The same, but calls go_on(context) before each step, and ends if it returns 0. go_on may look at the world and change
 * it, as is possible between any two steps, but must not destroy it. */
CAROM_API carom_status carom_run_while(carom_world* world, double t, int (*go_on)(void* context), void* context);

/* --- Looking at a world; for a null world all values are 0 -------------------------------------------------------- */

CAROM_API double carom_time(const carom_world* world);     /* end of the last step */
CAROM_API double carom_end_time(const carom_world* world); /* t_end of the scene */
CAROM_API int carom_done(const carom_world* world);        /* 1 at the scene's end */
CAROM_API size_t carom_count(const carom_world* world);    /* disks now */
CAROM_API uint64_t carom_steps(const carom_world* world);
CAROM_API uint64_t carom_collisions(const carom_world* world); /* of two disks */
CAROM_API uint64_t carom_wall_collisions(const carom_world* world);
CAROM_API uint64_t carom_removed(const carom_world* world); /* by sinks */
CAROM_API uint64_t carom_emitted(const carom_world* world); /* by sources */
CAROM_API uint64_t carom_hash(const carom_world* world);    /* state_hash of carom run */
CAROM_API double carom_width(const carom_world* world);     /* of the box; length */
CAROM_API double carom_height(const carom_world* world);    /* of the box; length */
/* Energies, mass length^2 / time^2: the sum of m v^2 / 2, without spins, and of m (gravity y - gravity_x x). NaN if
 * there is no memory to sort the terms of the sum; carom_error() then says so. */
CAROM_API double carom_kinetic_energy(const carom_world* world);
CAROM_API double carom_potential_energy(const carom_world* world);

/* Write all disks in order of id into arrays with room for `room` disks (xy: for 2 room numbers); CAROM_INPUT if
 * carom_count() is larger. */
CAROM_API carom_status carom_disks(const carom_world* world, carom_disk* disks, size_t room);
CAROM_API carom_status carom_ids(const carom_world* world, uint32_t* ids, size_t room);
CAROM_API carom_status carom_positions(const carom_world* world, double* xy, size_t room);  /* x0, y0, x1, y1, ... */
CAROM_API carom_status carom_velocities(const carom_world* world, double* xy, size_t room); /* vx0, vy0, vx1, ... */
CAROM_API carom_status carom_radii(const carom_world* world, double* radii, size_t room);
CAROM_API carom_status carom_spins(const carom_world* world, double* spins, size_t room);     /* 0 for smooth disks */
CAROM_API carom_status carom_groups(const carom_world* world, uint32_t* groups, size_t room); /* as carom_group_of */
/* The disks at time t within the last step. *count: their number; *time: the time to which they belong (time may be
 * null). That is t with the exact method; after a change, and with pairwise and rollback, it is the step's end.
 * CAROM_INPUT if t is not within that step, or if *count is larger than room. */
CAROM_API carom_status carom_disks_at(const carom_world* world, double t, carom_disk* disks, size_t room, size_t* count,
                                      double* time);
/* The pairs of disks that met in the last step, in order of time and ids. exact: pairs that collided in the window,
 * once for each collision; pairwise: pairs that touched or overlapped after the drift, before they were pushed apart
 * (in the last part of a split step, and in a pile in the last round); rollback: pairs whose approach ended the frame.
 * Contacts with walls, fixed disks, and disks that a sink took are left out. There are none before the first step, and
 * after a change or carom_load_memory. *count: their number; if it is larger than room, none is written, and the call
 * returns CAROM_INPUT. */
CAROM_API carom_status carom_contacts(const carom_world* world, carom_contact* contacts, size_t room, size_t* count);
/* The disk with this id; CAROM_NOT_FOUND if there is none. */
CAROM_API carom_status carom_get(const carom_world* world, uint32_t id, carom_disk* disk);

/* The [[disks]] table of the scene to which a disk with this id belongs, belonged or would belong, counted from 0; for
 * disks from sources and from carom_add, the number of tables. Fixed disks have tables, too, as queries return their
 * ids. */
CAROM_API uint32_t carom_group_of(const carom_world* world, uint32_t id);

/* --- Changing it, between two steps ------------------------------------------------------------------------------- */

/* Adds a disk. disk->id is not read: the disk gets an id that no disk has had before, which is written to *id unless id
 * is null. The whole disk has to be inside the box; along a period only its centre, and there its radius must be at
 * most a quarter of the period, or an eighth in a sheared box. Radius and mass must be above 0. Otherwise CAROM_INPUT.
 * CAROM_NO_ROOM if it would overlap another disk, an inner wall or sink, or a side that has moved in. */
CAROM_API carom_status carom_add(carom_world* world, const carom_disk* disk, uint32_t* id);
/* Remove a disk, or set its velocity (length / time). CAROM_NOT_FOUND if there is no disk with this id. */
CAROM_API carom_status carom_remove(carom_world* world, uint32_t id);
CAROM_API carom_status carom_set_velocity(carom_world* world, uint32_t id, double vx, double vy);

/* --- Queries --------------------------------------------------------------------------------------------------------
 * Fixed disks are found, too, with their ids among the disks of the scene; inner walls only by rays. CAROM_INPUT in a
 * sheared box. */

/* The ids, ascending, of the disks whose centres are in the rectangle with corners (x0, y0) and (x1, y1), its sides
 * included. It may reach across periodic sides. *count: their number. CAROM_INPUT, and no ids, if that is larger than
 * room, or if x0 > x1 or y0 > y1. */
CAROM_API carom_status carom_query_box(const carom_world* world, double x0, double y0, double x1, double y1,
                                       uint32_t* ids, size_t room, size_t* count);
/* The disk whose centre, or an image of it, is nearest to (x, y), which must be inside the box (else CAROM_INPUT); of
 * two equally near disks that with the smaller id. distance: to that centre; may be null. CAROM_NOT_FOUND without
 * disks. */
CAROM_API carom_status carom_nearest(const carom_world* world, double x, double y, uint32_t* id, double* distance);
/* The first disk or inner wall on a line of this length from (x, y) in the box along (dx, dy), a vector of any length
 * but 0. The line goes through periodic sides and ends at others. CAROM_NOT_FOUND if it meets nothing; CAROM_INPUT for
 * a negative length, and if the line is longer than 10^6 times the box's shorter side. */
CAROM_API carom_status carom_cast_ray(const carom_world* world, double x, double y, double dx, double dy, double length,
                                      carom_hit* hit);

/* --- Saving ------------------------------------------------------------------------------------------------------- */

/* Saves all that is needed to go on, bit for bit, in a file that `carom resume` accepts, too; it replaces an older
 * checkpoint. CAROM_INPUT if a file with this name is no checkpoint, CAROM_FAILED if it cannot be written; then the
 * earlier file stays. */
CAROM_API carom_status carom_save(const carom_world* world, const char* path);
/* The same in memory: *size bytes; CAROM_INPUT if room is less. bytes may be null to get only the size, which changes
 * with every step. */
CAROM_API carom_status carom_save_memory(const carom_world* world, void* bytes, size_t room, size_t* size);
/* Loads a saved state, of this world or of another. CAROM_INPUT if it is damaged. */
CAROM_API carom_status carom_load_memory(carom_world* world, const void* bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
