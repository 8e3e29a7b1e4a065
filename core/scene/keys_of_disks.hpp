// Keys of initial disks, of sources and of inner walls. A part of scene_keys().
#pragma once

#include <string_view>

#include "core/scene/scene_keys.hpp"
#include "core/scene/scene_names.hpp"

namespace carom::keys_of_disks {

using enum KeyKind;
inline constexpr auto none = Dimension::none;

inline constexpr std::string_view radius_allowed =
    "a number above 0, a list of them, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... "
    "}`, `{ from_mass = ... }`, or `{ frame = ... }`";
inline constexpr std::string_view mass_allowed =
    "a number above 0, a list of them, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... "
    "}`, `{ from_radius = ... }`, or `{ frame = ... }`";
inline constexpr std::string_view velocities_allowed =
    "`{ maxwell = ... }`, `{ uniform = ... }`, a list of [vx, vy], `{ file = ... }`, or `{ frame = ... }`";
// The values allowed for disks from sources, whose number is not known.
inline constexpr std::string_view radius_drawn =
    "a number above 0, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... }`, or "
    "`{ from_mass = ... }`";
inline constexpr std::string_view mass_drawn =
    "a number above 0, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... }`, or "
    "`{ from_radius = ... }`";
inline constexpr std::string_view range_allowed = "[low, high] with 0 < low <= high";

inline constexpr SceneKey keys[] = {
    {"disks", "count", count, none, "required", "How many disks the group has; 4 10^9 in all at most.", "count = 1000"},
    {"disks", "positions", special, none, "required",
     "Centres. Random without overlap; spread over the box on a lattice; grown into each other's gaps, which is "
     "denser; or given.",
     R"(positions = "random")", "NAMES, a list of [x, y], `{ file = ... }`, or `{ frame = ... }`", position_names},
    {"disks", "velocities", special, none, "at rest", "Velocities at the start.", "velocities = { maxwell = 1.0 }",
     velocities_allowed},
    {"disks", "radius", positive, Dimension::length, "required", "Radii.", "radius = 0.5", radius_allowed},
    {"disks", "mass", positive, Dimension::mass, "required, but not of fixed disks", "Masses.", "mass = 1.0",
     mass_allowed},
    {"disks", "fixed", flag, none, "false",
     "Obstacles: disks of infinite mass, which never move and have no weight, no velocity and no energy. Others "
     "collide with them as with each other, by `restitution`. Their centres lie in the box; they may overlap each "
     "other, stick out of it, and be wider than it where its sides are not periodic. They take no `mass`, "
     "`velocities`, `drift` and `spin`.",
     "fixed = true"},
    {"disks", "region", special, Dimension::length, "the box",
     "Where random disks and lattices start: whole disks within this rectangle or circle. A rectangle from one "
     "periodic side to the other has no edge there.",
     "region = [0.0, 0.0, 50.0, 100.0]", "[x0, y0, x1, y1], or `{ circle = ... }`"},
    {"disks", "drift", special, Dimension::speed, "[0, 0]",
     "A velocity that all disks of the group get on top, at the start: Brownian disks forget it.", "drift = [1.0, 0.0]",
     "[vx, vy]"},
    {"disks", "spin", number, Dimension::frequency, "0",
     "Angular velocity of rough disks at the start, counter-clockwise.", "spin = 2.0",
     "a number, a list of them, or `{ frame = ... }`"},
    {"disks", "spin_temperature", non_negative, Dimension::energy, "not drawn",
     "T: spins of rough disks are normal deviates, scaled so that the mean of I w^2 is T exactly (k_B = 1). Takes the "
     "place of `spin`.",
     "spin_temperature = 1.0"},
    {"disks", "name", text, none, "none",
     "What the group is called, for `select`, columns of series.csv, and the legend of pictures. `sources` names the "
     "disks of all sources together.",
     R"(name = "tracer")", "a letter, then letters, digits, `_` or `-`, 40 in all at most; no two alike"},
    {"disks.positions", "file", text, Dimension::length, "",
     "A CSV file, a line `x,y` a disk; from the scene's folder.", R"(positions = { file = "p.csv" })"},
    {"disks.positions", "frame", text, none, "", "See `{ frame = ... }`.", R"(positions = { frame = "out/melt" })"},
    {"disks.region", "circle", special, Dimension::length, "", "Centre and radius.",
     "region = { circle = [50.0, 50.0, 40.0] }", "[x, y, r]"},
    {"disks.velocities", "maxwell", non_negative, Dimension::energy, "",
     "Temperature T of this group (k_B = 1), whatever the others have: normal deviates, their mean taken off, then "
     "scaled so that the mean kinetic energy of a disk is T exactly; `drift` comes on top. From a side of a source: as "
     "gas flows through a hole.",
     "velocities = { maxwell = 1.0 }"},
    {"disks.velocities", "uniform", non_negative, Dimension::speed, "", "v: each component uniform between -v and v.",
     "velocities = { uniform = 2.0 }"},
    {"disks.velocities", "file", text, Dimension::speed, "", "A CSV file, a line `vx,vy` a disk. Not for sources.",
     R"(velocities = { file = "v.csv" })"},
    {"disks.velocities", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(velocities = { frame = "out/melt" })"},
    {"disks.radius", "uniform", special, Dimension::length, "", "Each drawn uniformly between the two.",
     "radius = { uniform = [1, 5] }", range_allowed},
    {"disks.radius", "normal", special, Dimension::length, "",
     "Mean and standard deviation of normal deviates; one beyond 4 deviations is drawn again.",
     "radius = { normal = [1.0, 0.1] }", "[mean, deviation] with mean above 4 deviations"},
    {"disks.radius", "lognormal", special, Dimension::length, "",
     "Median, and the standard deviation of the logarithm; one beyond 4 deviations is drawn again.",
     "radius = { lognormal = [1.0, 0.2] }", "[median, sigma] with 0 <= sigma <= 2"},
    {"disks.radius", "choice", special, Dimension::length, "", "Each disk gets one of these.",
     "radius = { choice = [1.0, 1.4] }", "a list of numbers above 0"},
    {"disks.radius", "weights", special, none, "equal ones",
     "How often each of `choice` is taken, relative to the others.",
     "radius = { choice = [1.0, 1.4], weights = [2, 1] }", "as many numbers, each 0 or from 1e-9 to 1e9"},
    {"disks.radius", "from_mass", positive, Dimension::density, "", "Density rho: r = sqrt(m / (pi rho)).",
     "radius = { from_mass = 1.0 }"},
    {"disks.radius", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(radius = { frame = "out/melt" })"},
    {"disks.mass", "uniform", special, Dimension::mass, "", "Each drawn uniformly between the two.",
     "mass = { uniform = [1, 100] }", range_allowed},
    {"disks.mass", "normal", special, Dimension::mass, "",
     "Mean and standard deviation of normal deviates; one beyond 4 deviations is drawn again.",
     "mass = { normal = [1.0, 0.1] }", "[mean, deviation] with mean above 4 deviations"},
    {"disks.mass", "lognormal", special, Dimension::mass, "",
     "Median, and the standard deviation of the logarithm; one beyond 4 deviations is drawn again.",
     "mass = { lognormal = [1.0, 0.2] }", "[median, sigma] with 0 <= sigma <= 2"},
    {"disks.mass", "choice", special, Dimension::mass, "", "Each disk gets one of these.",
     "mass = { choice = [1.0, 1.4] }", "a list of numbers above 0"},
    {"disks.mass", "weights", special, none, "equal ones",
     "How often each of `choice` is taken, relative to the others.", "mass = { choice = [1.0, 1.4], weights = [2, 1] }",
     "as many numbers, each 0 or from 1e-9 to 1e9"},
    {"disks.mass", "from_radius", positive, Dimension::density, "", "Density rho: m = pi rho r^2.",
     "mass = { from_radius = 1.0 }"},
    {"disks.mass", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(mass = { frame = "out/melt" })"},
    {"frame", "frame", text, none, "required", "A run's folder, or a trajectory; from the scene's folder.",
     R"(positions = { frame = "out/melt" })"},
    {"frame", "index", ordinal, none, "the last", "Which frame, counted from 1.",
     R"(positions = { frame = "out/melt", index = 5 })"},
    {"frame", "time", number, Dimension::time, "the last",
     "The frame nearest to this time, which lies between those of the first and the last frame.",
     R"(positions = { frame = "out/melt", time = 2.5 })"},
    {"frame", "group", text, none, "all disks",
     "The disks of one group alone, by the name that it has in the scene.toml beside the trajectory; `sources`: those "
     "of "
     "all sources.",
     R"(positions = { frame = "out/melt", group = "tracer" })"},
    {"frame", "scale", positive, none, "as they were",
     "Only of `radius`: what the radii are multiplied by. Frames of time stepping may hold disks that overlap a "
     "little, which a start does not allow: a little less than 1 - `max_overlap` of that run's summary makes room.",
     R"(radius = { frame = "out/pile", scale = 0.999 })"},

    {"growth", "slowness", positive, none, "1",
     "How much further than usual disks move between two steps of growth: larger is slower, and a little denser.",
     "slowness = 10.0", "a number from 0.001 to 10000"},
    {"growth", "steps", count, none, "10000", "Gives up after so many steps of growth.", "steps = 10_000"},

    {"sources",
     "side",
     choice,
     none,
     "required, or region",
     "Disks enter touching this side, moving inward; it may not be periodic.",
     R"(side = "left")",
     {},
     side_names},
    {"sources", "region", special, Dimension::length, "required, or side",
     "Centres are drawn uniformly in this rectangle inside the box.", "region = [0.0, 0.0, 10.0, 5.0]",
     "[x0, y0, x1, y1]"},
    {"sources", "rate", non_negative, Dimension::frequency, "required", "Disks per unit time.", "rate = 10.0"},
    {"sources", "radius", positive, Dimension::length, "required", "Radii.", "radius = 0.5", radius_drawn},
    {"sources", "mass", positive, Dimension::mass, "required", "Masses.", "mass = 1.0", mass_drawn},
    {"sources", "velocities", special, none, "at rest",
     "Velocities. Through a side the component across it always points inward. Brownian disks forget them.",
     "velocities = { maxwell = 1.0 }", "`{ maxwell = ... }`, or `{ uniform = ... }`"},
    {"sources", "spin", number, Dimension::frequency, "no spin", "Of rough disks, as in `[[disks]]`; no list.",
     "spin = 2.0", "a number"},
    {"sources", "spin_temperature", non_negative, Dimension::energy, "not drawn",
     "Likewise; the mean square is T / I on average.", "spin_temperature = 1.0"},
    {"sources", "limit", count, none, "none", "So many disks come at most.", "limit = 500"},

    {"walls", "from", special, Dimension::length, "required, or points", "One end.", "from = [2.0, 8.0]", "[x, y]"},
    {"walls", "to", special, Dimension::length, "required, or points", "The other end.", "to = [5.0, 4.0]", "[x, y]"},
    {"walls", "points", special, Dimension::length, "required, or from and to",
     "A line of segments through these points, which lie in the box.", "points = [[2.0, 8.0], [4.5, 4.0], [4.5, 0.0]]",
     "a list of two [x, y] or more"},
    {"walls",
     "kind",
     choice,
     none,
     "\"wall\"",
     "What it does to disks that touch it.",
     R"(kind = "sink")",
     {},
     inner_wall_kind_names},
    {"walls", "restitution", unit_interval, none, "`wall_restitution` of `[box]`",
     "Speed away from the wall over speed towards it; not of a sink.", "restitution = 0.5"},
    {"walls", "motion", special, none, "at rest",
     "How the wall moves, whatever meets it: it reflects disks in its own frame, and does work. The points are those "
     "at time 0. Not with Brownian motion.",
     "motion = { velocity = [0.5, 0.0] }", "`{ velocity = ... }` or `{ vibrate = ... }`"},
    {"walls.motion", "velocity", special, Dimension::speed, "", "Constant.", "motion = { velocity = [0.5, 0.0] }",
     "[vx, vy]"},
    {"walls.motion", "vibrate", special, Dimension::length, "",
     "Amplitude of a vibration about the points, which begins there in this direction.",
     "motion = { vibrate = [0.0, 0.5], period = 2.0 }", "[ax, ay]"},
    {"walls.motion", "period", positive, Dimension::time, "required by vibrate", "Of the vibration.",
     "motion = { vibrate = [0.0, 0.5], period = 2.0 }"},
    {"walls.motion",
     "shape",
     choice,
     none,
     "\"parabola\"",
     "Of the vibration, as of a side.",
     R"(motion = { vibrate = [0.0, 0.5], period = 2.0, shape = "parabola" })",
     {},
     vibration_shapes},

    {"run",
     "method",
     choice,
     none,
     "\"exact\"",
     "See [methods.md](methods.md); `auto` chooses method and dt by `accuracy`.",
     R"(method = "pairwise")",
     {},
     method_words},
};

}  // namespace carom::keys_of_disks
