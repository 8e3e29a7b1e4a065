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
    {"disks", "count", count, none, "required", "Number of disks of the group; at most 4 10^9 in all groups together.",
     "count = 1000"},
    {"disks", "positions", special, none, "required",
     "Centres. `random`: without overlap. `square` and `hexagonal`: on a lattice over the box. `growth`: denser, as "
     "small disks grow into the gaps. Or given.",
     R"(positions = "random")", "NAMES, a list of [x, y], `{ file = ... }`, or `{ frame = ... }`", position_names},
    {"disks", "velocities", special, none, "at rest", "Velocities at the start.", "velocities = { maxwell = 1.0 }",
     velocities_allowed},
    {"disks", "radius", positive, Dimension::length, "required", "Radii.", "radius = 0.5", radius_allowed},
    {"disks", "mass", positive, Dimension::mass, "required, except for fixed disks", "Masses.", "mass = 1.0",
     mass_allowed},
    {"disks", "fixed", flag, none, "false",
     "Obstacles: disks of infinite mass, which never move and have no weight, no velocity and no energy. Other disks "
     "collide with them as with each other, by `restitution`. The centres of fixed disks lie in the box. Fixed disks "
     "may overlap each other, stick out of the box and, if its sides are not periodic, be wider than it. They have no "
     "`mass`, `velocities`, `drift` and `spin`.",
     "fixed = true"},
    {"disks", "region", special, Dimension::length, "the box",
     "The rectangle or circle in which `random` disks and lattices start; whole disks lie within it. A rectangle from "
     "one periodic side to the other has no edge there.",
     "region = [0.0, 0.0, 50.0, 100.0]", "[x0, y0, x1, y1], or `{ circle = ... }`"},
    {"disks", "drift", special, Dimension::speed, "[0, 0]",
     "A velocity that is added to that of each disk of the group at the start. Brownian disks forget it.",
     "drift = [1.0, 0.0]", "[vx, vy]"},
    {"disks", "spin", number, Dimension::frequency, "0",
     "Angular velocity of rough disks at the start, counter-clockwise.", "spin = 2.0",
     "a number, a list of them, or `{ frame = ... }`"},
    {"disks", "spin_temperature", non_negative, Dimension::energy, "not drawn",
     "Temperature T of the spins of rough disks (k_B = 1). The spins are normal deviates, scaled so that the mean of I "
     "w^2 is exactly T. Replaces `spin`.",
     "spin_temperature = 1.0"},
    {"disks", "name", text, none, "none",
     "Name of the group, for `select`, columns of series.csv, and the legend of pictures. `sources` is the name of the "
     "disks of all sources together.",
     R"(name = "tracer")", "a letter, then letters, digits, `_` or `-`; at most 40 characters; each name once"},
    {"disks.positions", "file", text, Dimension::length, "",
     "A CSV file with a line `x,y` for each disk. A relative path starts at the folder of the scene.",
     R"(positions = { file = "p.csv" })"},
    {"disks.positions", "frame", text, none, "", "See `{ frame = ... }`.", R"(positions = { frame = "out/melt" })"},
    {"disks.region", "circle", special, Dimension::length, "", "Centre and radius.",
     "region = { circle = [50.0, 50.0, 40.0] }", "[x, y, r]"},
    {"disks.velocities", "maxwell", non_negative, Dimension::energy, "",
     "Temperature T of this group (k_B = 1). The velocities are normal deviates, minus their mean, scaled so that the "
     "mean kinetic energy of a disk is exactly T. `drift` is added afterwards. Disks of a source with a `side` get the "
     "velocities of a gas that flows through a hole.",
     "velocities = { maxwell = 1.0 }"},
    {"disks.velocities", "uniform", non_negative, Dimension::speed, "",
     "v: each component is uniform between -v and v.", "velocities = { uniform = 2.0 }"},
    {"disks.velocities", "file", text, Dimension::speed, "",
     "A CSV file with a line `vx,vy` for each disk. Not for sources.", R"(velocities = { file = "v.csv" })"},
    {"disks.velocities", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(velocities = { frame = "out/melt" })"},
    {"disks.radius", "uniform", special, Dimension::length, "", "Each value is drawn uniformly between the two.",
     "radius = { uniform = [1, 5] }", range_allowed},
    {"disks.radius", "normal", special, Dimension::length, "",
     "Mean and standard deviation of normal deviates. A value beyond 4 deviations is drawn again.",
     "radius = { normal = [1.0, 0.1] }", "[mean, deviation] with mean above 4 deviations"},
    {"disks.radius", "lognormal", special, Dimension::length, "",
     "Median, and standard deviation of the logarithm. A value beyond 4 deviations is drawn again.",
     "radius = { lognormal = [1.0, 0.2] }", "[median, sigma] with 0 <= sigma <= 2"},
    {"disks.radius", "choice", special, Dimension::length, "", "Each disk gets one of these.",
     "radius = { choice = [1.0, 1.4] }", "a list of numbers above 0"},
    {"disks.radius", "weights", special, none, "equal weights", "Relative frequency of each value of `choice`.",
     "radius = { choice = [1.0, 1.4], weights = [2, 1] }",
     "one number for each value of `choice`, 0 or from 1e-9 to 1e9"},
    {"disks.radius", "from_mass", positive, Dimension::density, "", "Density rho: r = sqrt(m / (pi rho)).",
     "radius = { from_mass = 1.0 }"},
    {"disks.radius", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(radius = { frame = "out/melt" })"},
    {"disks.mass", "uniform", special, Dimension::mass, "", "Each value is drawn uniformly between the two.",
     "mass = { uniform = [1, 100] }", range_allowed},
    {"disks.mass", "normal", special, Dimension::mass, "",
     "Mean and standard deviation of normal deviates. A value beyond 4 deviations is drawn again.",
     "mass = { normal = [1.0, 0.1] }", "[mean, deviation] with mean above 4 deviations"},
    {"disks.mass", "lognormal", special, Dimension::mass, "",
     "Median, and standard deviation of the logarithm. A value beyond 4 deviations is drawn again.",
     "mass = { lognormal = [1.0, 0.2] }", "[median, sigma] with 0 <= sigma <= 2"},
    {"disks.mass", "choice", special, Dimension::mass, "", "Each disk gets one of these.",
     "mass = { choice = [1.0, 1.4] }", "a list of numbers above 0"},
    {"disks.mass", "weights", special, none, "equal weights", "Relative frequency of each value of `choice`.",
     "mass = { choice = [1.0, 1.4], weights = [2, 1] }",
     "one number for each value of `choice`, 0 or from 1e-9 to 1e9"},
    {"disks.mass", "from_radius", positive, Dimension::density, "", "Density rho: m = pi rho r^2.",
     "mass = { from_radius = 1.0 }"},
    {"disks.mass", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(mass = { frame = "out/melt" })"},
    {"frame", "frame", text, none, "required",
     "The folder of a run, or a trajectory. A relative path starts at the folder of the scene.",
     R"(positions = { frame = "out/melt" })"},
    {"frame", "index", ordinal, none, "the last", "Number of the frame, counted from 1.",
     R"(positions = { frame = "out/melt", index = 5 })"},
    {"frame", "time", number, Dimension::time, "the last",
     "The frame nearest to this time, which has to lie between the times of the first and the last frame.",
     R"(positions = { frame = "out/melt", time = 2.5 })"},
    {"frame", "group", text, none, "all disks",
     "Only the disks of one group, by its name in the scene.toml beside the trajectory; `sources`: those of all "
     "sources.",
     R"(positions = { frame = "out/melt", group = "tracer" })"},
    {"frame", "scale", positive, none, "no change",
     "Only for `radius`: factor of the radii. In frames of time stepping disks may overlap a little; at a start they "
     "must not. So use a little less than 1 - `max_overlap` of that run's summary.",
     R"(radius = { frame = "out/pile", scale = 0.999 })"},

    {"growth", "slowness", positive, none, "1",
     "Factor of the distance that disks move between two steps of growth. Larger is slower, and reaches slightly "
     "higher packing fractions.",
     "slowness = 10.0", "a number from 0.001 to 10000"},
    {"growth", "steps", count, none, "10000", "Number of steps of growth after which the start fails.",
     "steps = 10_000"},

    {"sources",
     "side",
     choice,
     none,
     "required without region",
     "Disks enter touching this side, moving inward; it may not be periodic.",
     R"(side = "left")",
     {},
     side_names},
    {"sources", "region", special, Dimension::length, "required without side",
     "Centres are drawn uniformly in this rectangle inside the box.", "region = [0.0, 0.0, 10.0, 5.0]",
     "[x0, y0, x1, y1]"},
    {"sources", "rate", non_negative, Dimension::frequency, "required", "Disks per unit time.", "rate = 10.0"},
    {"sources", "radius", positive, Dimension::length, "required", "Radii.", "radius = 0.5", radius_drawn},
    {"sources", "mass", positive, Dimension::mass, "required", "Masses.", "mass = 1.0", mass_drawn},
    {"sources", "velocities", special, none, "at rest",
     "Velocities of new disks. At a side the component across it always points inward. Brownian disks forget them.",
     "velocities = { maxwell = 1.0 }", "`{ maxwell = ... }`, or `{ uniform = ... }`"},
    {"sources", "spin", number, Dimension::frequency, "no spin",
     "Angular velocity of rough disks, as in `[[disks]]`; no list.", "spin = 2.0", "a number"},
    {"sources", "spin_temperature", non_negative, Dimension::energy, "not drawn",
     "As in `[[disks]]`, but the mean of I w^2 is T only on average.", "spin_temperature = 1.0"},
    {"sources", "limit", count, none, "none", "Largest number of disks that come.", "limit = 500"},

    {"walls", "from", special, Dimension::length, "required without points", "One end.", "from = [2.0, 8.0]", "[x, y]"},
    {"walls", "to", special, Dimension::length, "required without points", "The other end.", "to = [5.0, 4.0]",
     "[x, y]"},
    {"walls", "points", special, Dimension::length, "required without from and to",
     "A chain of segments through these points, which have to lie in the box.",
     "points = [[2.0, 8.0], [4.5, 4.0], [4.5, 0.0]]", "a list of two [x, y] or more"},
    {"walls",
     "kind",
     choice,
     none,
     "\"wall\"",
     "Whether the wall reflects the disks that touch it, or removes them.",
     R"(kind = "sink")",
     {},
     inner_wall_kind_names},
    {"walls", "restitution", unit_interval, none, "`wall_restitution` of `[box]`",
     "Speed away from the wall over speed towards it; not of a sink.", "restitution = 0.5"},
    {"walls", "motion", special, none, "at rest",
     "The motion of the wall, which disks do not change. The wall reflects disks in its own frame, and does work on "
     "them. Its points are those at time 0. Not with Brownian motion.",
     "motion = { velocity = [0.5, 0.0] }", "`{ velocity = ... }` or `{ vibrate = ... }`"},
    {"walls.motion", "velocity", special, Dimension::speed, "", "Constant velocity.",
     "motion = { velocity = [0.5, 0.0] }", "[vx, vy]"},
    {"walls.motion", "vibrate", special, Dimension::length, "",
     "Amplitude of a vibration about the points. The vibration begins there, in this direction.",
     "motion = { vibrate = [0.0, 0.5], period = 2.0 }", "[ax, ay]"},
    {"walls.motion", "period", positive, Dimension::time, "required by vibrate", "Period of the vibration.",
     "motion = { vibrate = [0.0, 0.5], period = 2.0 }"},
    {"walls.motion",
     "shape",
     choice,
     none,
     "\"parabola\"",
     "Shape of the vibration, as for a side.",
     R"(motion = { vibrate = [0.0, 0.5], period = 2.0, shape = "parabola" })",
     {},
     vibration_shapes},

    {"run",
     "method",
     choice,
     none,
     "\"exact\"",
     "The method; see [methods.md](methods.md). `auto` chooses method and dt by `accuracy`.",
     R"(method = "pairwise")",
     {},
     method_words},
};

}  // namespace carom::keys_of_disks
