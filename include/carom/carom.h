/* Carom from C: hard disks in a rectangle, stepped, looked at and changed by a program.
 *
 * A world is a handle. Only one thread at a time may call functions of a world; worlds share nothing. No call throws,
 * prints or touches a signal. Every call that can fail returns a carom_status, and carom_error() of the world has a
 * line that says what was wrong. A failed call leaves the world as it was, but for one that steps, which leaves it at
 * the end of the last step made; and where memory runs out within a step or a change, the state is lost: from then on
 * numbers are 0 and all else CAROM_FAILED, until carom_load_memory takes up a saved one. Any call may return
 * CAROM_FAILED (no memory) and CAROM_INPUT (a null pointer, NaN); below stands what else it may return. Lengths, times
 * and masses are in the scene's own units. The bits are those of `carom run` of the same scene, whatever the program's
 * compiler flags, rounding mode and threads. docs/library.md shows the use. */
#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

/* What a C++ program that lists the fields of a struct may leave out. */
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
  CAROM_FAILED = 1,   /* the machine: memory, a file that cannot be written */
  CAROM_INPUT = 2,    /* a bad scene, a number out of range, an array too short, a null pointer */
  CAROM_PHYSICS = 3,  /* the method cannot go on (a step far too long, inelastic collapse) */
  CAROM_NO_ROOM = 4,  /* a disk that would overlap another, an inner wall or a side that has moved in */
  CAROM_NOT_FOUND = 5 /* no disk of this id, or none that a query asks for */
} carom_status;

/* How a world is computed; no bit depends on it. Set by carom_options_init before anything is changed. */
typedef struct carom_options {
  int threads;   /* 1; 0: all cores */
  int reference; /* 0; 1: the plain serial engine, for comparisons */
} carom_options;

typedef enum carom_method { CAROM_EXACT = 0, CAROM_PAIRWISE = 1, CAROM_ROLLBACK = 2 } carom_method;
typedef enum carom_side { CAROM_WALL = 0, CAROM_PERIODIC = 1, CAROM_SINK = 2 } carom_side;

/* A scene without disks, to which carom_add adds. Set by carom_scene_init: a box of 1 x 1 with elastic walls. What a
 * scene file can say besides (sources, growth, collapse models) needs one: carom_from_text. */
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
  double spin CAROM_OPTIONAL; /* angular velocity, counter-clockwise, 1 / time; of smooth disks 0, and not read */
} carom_disk;

/* What a ray has met. */
typedef enum carom_met { CAROM_MET_DISK = 0, CAROM_MET_WALL = 1, CAROM_MET_SINK = 2 } carom_met;

typedef struct carom_hit {
  double distance; /* along the ray to the disk's edge, or to the wall; 0 if the ray begins inside a disk */
  double x, y;     /* there, inside the box */
  uint32_t id;     /* of the disk; of an inner wall the number of its [[walls]] table, from 0 */
  int what;        /* carom_met */
} carom_hit;

typedef struct carom_contact {
  double time;       /* exact: of the collision; pairwise and rollback: the end of the step */
  uint32_t id1, id2; /* id1 < id2 */
} carom_contact;

/* --- The library -------------------------------------------------------------------------------------------------- */

CAROM_API const char* carom_version(void);                    /* "0.1.0" */
CAROM_API const char* carom_status_text(carom_status status); /* "no room"; never null */
CAROM_API void carom_options_init(carom_options* options);    /* null: does nothing */
CAROM_API void carom_scene_init(carom_scene* scene);          /* likewise */

/* --- Making a world -------------------------------------------------------------------------------------------------
 * options may be null: the usual ones. *world is set whenever there is memory for it: after a failure it is good for
 * carom_error and carom_destroy only. A scene is TOML (docs/scene.md); what it says of [output] and [analysis] is left
 * to carom run. CAROM_INPUT for a bad scene, with its file, line and key, and for disks that find no place. */

CAROM_API carom_status carom_from_file(const char* path, const carom_options* options, carom_world** world);
CAROM_API carom_status carom_from_text(const char* text, size_t length, const carom_options* options,
                                       carom_world** world);
CAROM_API carom_status carom_from_scene(const carom_scene* scene, const carom_options* options, carom_world** world);
/* A checkpoint of carom run or carom_save, or the folder of a run; and what carom_save_memory gave. CAROM_INPUT where
 * it is none, or damaged. */
CAROM_API carom_status carom_from_checkpoint(const char* path, const carom_options* options, carom_world** world);
CAROM_API carom_status carom_from_memory(const void* bytes, size_t size, const carom_options* options,
                                         carom_world** world);
CAROM_API void carom_destroy(carom_world* world); /* null: does nothing */

/* What was wrong with the last call on this world that failed, one line; empty if none did. Valid until the next call
 * on it. Never null, for a null world either. */
CAROM_API const char* carom_error(const carom_world* world);
/* The next warning of the physics, one line, likewise; null if there is none. */
CAROM_API const char* carom_next_warning(carom_world* world);

/* --- Stepping -------------------------------------------------------------------------------------------------------
 * CAROM_PHYSICS where the method cannot go on. */

/* At most `steps` steps; fewer where the scene's end is reached. */
CAROM_API carom_status carom_step(carom_world* world, uint64_t steps);
/* Steps until the time is t or later, or the scene's end. A step is dt, or a window of the exact method; none is cut
 * short. */
CAROM_API carom_status carom_run_until(carom_world* world, double t);
/* Likewise, and calls go_on(context) before each step: where it returns 0, that is the end. It may look at the world
 * and change it, as between any two steps, but not destroy it. */
CAROM_API carom_status carom_run_while(carom_world* world, double t, int (*go_on)(void* context), void* context);

/* --- Looking at a world; of a null world all is 0 ----------------------------------------------------------------- */

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
CAROM_API double carom_height(const carom_world* world);    /* likewise */
/* Energies, mass length^2 / time^2: the sum of m v^2 / 2, without spins, and of m (gravity y - gravity_x x). NaN where
 * there is no memory for the order in which they are summed; carom_error() then says so. */
CAROM_API double carom_kinetic_energy(const carom_world* world);
CAROM_API double carom_potential_energy(const carom_world* world);

/* All disks in order of id, into arrays with room for `room` disks (of xy: for 2 room numbers); CAROM_INPUT where
 * carom_count() is more. */
CAROM_API carom_status carom_disks(const carom_world* world, carom_disk* disks, size_t room);
CAROM_API carom_status carom_ids(const carom_world* world, uint32_t* ids, size_t room);
CAROM_API carom_status carom_positions(const carom_world* world, double* xy, size_t room);  /* x0, y0, x1, y1, ... */
CAROM_API carom_status carom_velocities(const carom_world* world, double* xy, size_t room); /* likewise */
CAROM_API carom_status carom_radii(const carom_world* world, double* radii, size_t room);
CAROM_API carom_status carom_spins(const carom_world* world, double* spins, size_t room);     /* 0 of smooth disks */
CAROM_API carom_status carom_groups(const carom_world* world, uint32_t* groups, size_t room); /* carom_group_of each */
/* Those at time t within the last step: *count is how many, *time the time that they are of (null: not asked for).
 * That is t with the exact method; after a change, and with pairwise and rollback, it is the step's end. CAROM_INPUT
 * where t is after that step or before it, or *count is more than room. */
CAROM_API carom_status carom_disks_at(const carom_world* world, double t, carom_disk* disks, size_t room, size_t* count,
                                      double* time);
/* The pairs of disks that met in the last step, in order of time and ids. exact: those that collided in the window,
 * once for each collision; pairwise: those that touched or overlapped when the disks had drifted, before they were
 * pushed apart (of a step in parts, of its last part; in a pile, in the last round); rollback: those whose approach
 * ended the frame. Walls and fixed disks are left out, and disks that a sink took. None before the first step, and
 * after a change or carom_load_memory. *count is how many there are; CAROM_INPUT, and none given, where that is more
 * than room. */
CAROM_API carom_status carom_contacts(const carom_world* world, carom_contact* contacts, size_t room, size_t* count);
/* One disk; CAROM_NOT_FOUND where there is none of this id. */
CAROM_API carom_status carom_get(const carom_world* world, uint32_t id, carom_disk* disk);

/* The [[disks]] table of the scene that a disk with this id is of, or was, or would be, counted from 0; for a disk from
 * a source or of carom_add, the number of tables. Of fixed disks too, as queries have their ids. */
CAROM_API uint32_t carom_group_of(const carom_world* world, uint32_t id);

/* --- Changing it, between two steps ------------------------------------------------------------------------------- */

/* A new disk. disk->id is not read: the disk gets one that none has had before, written to *id where that is not null.
 * The whole disk has to lie inside the box, along a period its centre alone, and there the radius is a quarter of the
 * period at most, an eighth in a sheared box; radius and mass are above 0. CAROM_INPUT where that is not so,
 * CAROM_NO_ROOM where it would overlap another, an inner wall or sink, or a side that has moved in. */
CAROM_API carom_status carom_add(carom_world* world, const carom_disk* disk, uint32_t* id);
/* CAROM_NOT_FOUND where there is no disk of this id. Velocities: length / time. */
CAROM_API carom_status carom_remove(carom_world* world, uint32_t id);
CAROM_API carom_status carom_set_velocity(carom_world* world, uint32_t id, double vx, double vy);

/* --- Asking ---------------------------------------------------------------------------------------------------------
 * Fixed disks are seen too, with the ids that they have among the disks of the scene; inner walls by rays alone.
 * CAROM_INPUT in a sheared box. */

/* The disks whose centres lie in the rectangle with corners (x0, y0) and (x1, y1), its sides included, ids ascending.
 * It may reach across periodic sides. *count is how many there are; CAROM_INPUT, and no ids, where that is more than
 * room, or where x0 > x1 or y0 > y1. */
CAROM_API carom_status carom_query_box(const carom_world* world, double x0, double y0, double x1, double y1,
                                       uint32_t* ids, size_t room, size_t* count);
/* The disk whose centre is nearest to (x, y) in the box, nearest images counted; of two as near, that with the smaller
 * id. distance: to that centre, or null. CAROM_NOT_FOUND where there is no disk, CAROM_INPUT outside the box. */
CAROM_API carom_status carom_nearest(const carom_world* world, double x, double y, uint32_t* id, double* distance);
/* The first disk or inner wall on a line of this length from (x, y) in the box along (dx, dy), of any length but 0. The
 * line goes through periodic sides, and ends at others. CAROM_NOT_FOUND where it meets nothing; CAROM_INPUT for a
 * length below 0, or where the line is longer than 10^6 times the box's shorter side. */
CAROM_API carom_status carom_cast_ray(const carom_world* world, double x, double y, double dx, double dy, double length,
                                      carom_hit* hit);

/* --- Saving ------------------------------------------------------------------------------------------------------- */

/* Everything from which to go on, bit for bit, in a file that `carom resume` takes too, in place of an older one.
 * CAROM_INPUT where a file that is no checkpoint has the name, CAROM_FAILED where it cannot be written; what was there
 * before stays then. */
CAROM_API carom_status carom_save(const carom_world* world, const char* path);
/* The same in memory: *size bytes, CAROM_INPUT where room is less. bytes may be null where only the size is asked for;
 * it changes with every step. */
CAROM_API carom_status carom_save_memory(const carom_world* world, void* bytes, size_t room, size_t* size);
/* Goes back, or on, to what was saved, of this world or of another. CAROM_INPUT where it is damaged. */
CAROM_API carom_status carom_load_memory(carom_world* world, const void* bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
