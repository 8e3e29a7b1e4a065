#include "core/scene/scene_keys.hpp"

namespace carom {

namespace {

constexpr SceneTable tables[] = {
    {"", "The file itself", "The file has two keys of its own, and tables."},
    {"box", "`[box]`",
     "The rectangle from (0, 0) to (width, height): either `width` and `height`, or `packing_fraction`. Periodic sides "
     "come in opposite pairs. A sink removes every disk that touches it."},
    {"box.side", "`left = { ... }` in `[box]`, also `right`, `bottom` and `top`",
     "A side with more properties than its kind."},
    {"box.side.motion", "`motion = { ... }` of a side", "Exactly one of `velocity` and `vibrate`."},
    {"box.wall_roughness", "`wall_roughness = { ... }` in `[box]`", "The roughness of the sides and of inner walls."},
    {"physics", "`[physics]`",
     "The forces on the disks and the rules of their collisions. Leave out what the scene does not have."},
    {"physics.restitution", "`restitution = { ... }` in `[physics]` and `[[physics.pairs]]`",
     "A restitution that depends on the speed of approach (Schwager and Poeschel 1998); see "
     "[methods.md](methods.md#what-they-share)."},
    {"physics.pairs", "`[[physics.pairs]]`",
     "The restitution of collisions between two groups, or within one. State each pair once, in either order. All "
     "other pairs have the restitution of `[physics]`."},
    {"physics.roughness", "`roughness = { ... }` in `[physics]`",
     "Rough disks: Walton's rule with three parameters, `restitution` along the line of centres and these two along "
     "the surfaces; see [methods.md](methods.md#rough-disks)."},
    {"physics.collapse", "`collapse = { ... }` in `[physics]`",
     "The remedy for inelastic collapse under method `exact`: the TC model (Luding and McNamara 1998), in which a "
     "collision is elastic if one of its disks has collided less than `contact_time` before."},
    {"physics.thermostat", "`thermostat = { ... }` in `[physics]`",
     "Keeps the disks at a temperature by kicks at the times k `dt`. In between the disks fly and collide as usual. "
     "Not with Brownian motion."},
    {"disks", "`[[disks]]`",
     "A group of disks. A scene may have many of them, or none if it has sources. Ids count from 0 through all groups, "
     "in the order of the file."},
    {"disks.positions", "`positions = { ... }` in `[[disks]]`", "Positions from a file. Exactly one of these keys."},
    {"disks.region", "`region = { ... }` in `[[disks]]`", "A circle, instead of the four numbers of a rectangle."},
    {"disks.velocities", "`velocities = { ... }` in `[[disks]]` and `[[sources]]`", "Exactly one of these keys."},
    {"disks.radius", "`radius = { ... }` in `[[disks]]` and `[[sources]]`",
     "Exactly one of these keys; `weights` belongs to `choice`. The value of each disk depends on its id."},
    {"disks.mass", "`mass = { ... }` in `[[disks]]` and `[[sources]]`",
     "Exactly one of these keys; `weights` belongs to `choice`. The value of each disk depends on its id."},
    {"frame", "`{ frame = ... }` in `[[disks]]`",
     "Starts from a frame of an earlier run: `positions`, `velocities`, `radius`, `mass` and `spin` may each be taken "
     "from one. It is the last frame, unless `index` or `time` selects another. In a box with `shear_rate`, velocities "
     "are taken relative to the flow of the earlier run."},
    {"growth", "`[growth]`", "Settings of `positions = \"growth\"`. Only if a group of the scene has it."},
    {"sources", "`[[sources]]`",
     "Disks that come during the run, through a side or anywhere in a region. The k-th disk is due at time k / `rate`; "
     "none is due at the end of the run.\n\nA disk that would overlap another waits, and is tried at other places. "
     "Time stepping tries one place in every step. `exact` tries 32 places at each time k / `rate`, and three times in "
     "between while fewer than eight disks wait. Without room fewer disks come than `rate`: `waiting` counts those "
     "that wait, and a run warns at its end if more than a twentieth of them do."},
    {"walls", "`[[walls]]`",
     "Inner walls are segments without thickness, which disks touch from both sides and at their ends. They make "
     "funnels, shelves, slits and pockets (`kind = \"sink\"`) and, if they move, pistons, paddles and shakers."},
    {"walls.motion", "`motion = { ... }` of `[[walls]]`",
     "Exactly one of `velocity` and `vibrate`. All segments of the wall move alike, and do not turn. The wall has to "
     "stay in the box, but may cross periodic sides."},
    {"run", "`[run]`", "The method, the step and the end of the run."},
    {"output", "`[output]`", "The files that a run writes."},
    {"output.movie", "`movie = { ... }` in `[output]`",
     "The look of the movie, and of what `carom render` draws; see [output.md](output.md#movies-and-pictures)."},
    {"analysis", "`[analysis]`", "The measurements of a run; see [output.md](output.md#measuring-during-a-run)."},
    {"analysis.pair_correlation", "`pair_correlation = { ... }` in `[analysis]`", ""},
    {"analysis.bond_correlation", "`bond_correlation = { ... }` in `[analysis]`", ""},
    {"analysis.speeds", "`speeds = { ... }` in `[analysis]`", ""},
    {"analysis.density", "`density = { ... }` in `[analysis]`", ""},
    {"analysis.profile", "`profile = { ... }` in `[analysis]`", ""},
    {"analysis.structure_factor", "`structure_factor = { ... }` in `[analysis]`", ""},
};

}  // namespace

std::span<const SceneTable> scene_tables() {
  return tables;
}

}  // namespace carom
