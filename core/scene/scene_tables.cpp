#include "core/scene/scene_keys.hpp"

namespace carom {

namespace {

constexpr SceneTable tables[] = {
    {"", "The file itself", "Two keys of its own, then tables."},
    {"box", "`[box]`",
     "The rectangle from (0, 0) to (width, height): either `width` and `height`, or `packing_fraction`. Periodic sides "
     "come in opposite pairs. A sink takes away what touches it."},
    {"box.side", "`left = { ... }` in `[box]`, likewise `right`, `bottom` and `top`",
     "A side of which there is more to say than its kind."},
    {"box.side.motion", "`motion = { ... }` of a side", "Exactly one of `velocity` and `vibrate`."},
    {"box.wall_roughness", "`wall_roughness = { ... }` in `[box]`", "Rough sides and inner walls."},
    {"physics", "`[physics]`", "What acts on the disks. A scene states only what it has."},
    {"physics.restitution", "`restitution = { ... }` in `[physics]` and `[[physics.pairs]]`",
     "A restitution that depends on the speed of approach (Schwager and Poeschel 1998); see "
     "[methods.md](methods.md#what-they-share)."},
    {"physics.pairs", "`[[physics.pairs]]`",
     "The restitution of collisions between two groups, or within one; each pair once, in either order. Pairs that are "
     "not stated have the restitution of `[physics]`."},
    {"physics.roughness", "`roughness = { ... }` in `[physics]`",
     "Rough disks: Walton's rule with three parameters, `restitution` along the line of centres and these two along "
     "the surfaces; see [methods.md](methods.md#rough-disks)."},
    {"physics.collapse", "`collapse = { ... }` in `[physics]`",
     "The remedy for inelastic collapse under method `exact`: the TC model (Luding and McNamara 1998), in which a "
     "collision is elastic where one of its disks collided less than `contact_time` ago."},
    {"physics.thermostat", "`thermostat = { ... }` in `[physics]`",
     "Keeps the disks at a temperature by kicks at times k `dt`, between which they fly and collide as without it. Not "
     "with Brownian motion."},
    {"disks", "`[[disks]]`",
     "A group of disks; a scene may have many, or none where it has sources. Ids run on from 0 in the order of the "
     "file."},
    {"disks.positions", "`positions = { ... }` in `[[disks]]`", "Places from elsewhere; exactly one of these keys."},
    {"disks.region", "`region = { ... }` in `[[disks]]`", "A circle, in place of the four numbers of a rectangle."},
    {"disks.velocities", "`velocities = { ... }` in `[[disks]]` and `[[sources]]`", "Exactly one of these keys."},
    {"disks.radius", "`radius = { ... }` in `[[disks]]` and `[[sources]]`",
     "Exactly one of these keys; `weights` goes with `choice`. Every disk draws its own by its id."},
    {"disks.mass", "`mass = { ... }` in `[[disks]]` and `[[sources]]`",
     "Exactly one of these keys; `weights` goes with `choice`. Every disk draws its own by its id."},
    {"frame", "`{ frame = ... }` in `[[disks]]`",
     "Starts from a frame of an earlier run: `positions`, `velocities`, `radius`, `mass` and `spin` may each be taken "
     "from one. The last frame, unless `index` or `time` says which. In a box with `shear_rate` velocities are taken "
     "relative to the flow of the run that wrote them."},
    {"growth", "`[growth]`", "How `positions = \"growth\"` goes about it; only where some group grows."},
    {"sources", "`[[sources]]`",
     "Disks that come while the run goes on, the k-th at time k / `rate` and none at the end, through a side or "
     "anywhere in a region. A disk that would overlap another waits, and is tried at other places: by time "
     "stepping at one in every step; by `exact` at 32 at each time k / `rate`, and while fewer than eight wait three "
     "times in between. Where room is scarce fewer come than `rate` says. How many wait is counted (`waiting`), and a "
     "run warns at its end where more than a twentieth of them do."},
    {"walls", "`[[walls]]`",
     "Inner walls: segments without thickness, which disks touch from both sides and at their ends: funnels, shelves, "
     "pockets (`kind = \"sink\"`), slits; pistons, paddles and shakers where they move."},
    {"walls.motion", "`motion = { ... }` of `[[walls]]`",
     "Exactly one of `velocity` and `vibrate`. All the wall's segments move alike, and do not turn. The wall stays in "
     "the box, but goes round where that is periodic."},
    {"run", "`[run]`", "How the scene is run."},
    {"output", "`[output]`", "What a run writes."},
    {"output.movie", "`movie = { ... }` in `[output]`",
     "How the movie looks, and what `carom render` makes of the trajectory; see "
     "[output.md](output.md#movies-and-pictures)."},
    {"analysis", "`[analysis]`", "What a run measures, see [output.md](output.md#measuring-during-a-run)."},
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
