// Keys of the file itself, its box and its physics. A part of scene_keys().
#pragma once

#include <string_view>

#include "core/scene/scene_keys.hpp"
#include "core/scene/scene_names.hpp"

namespace carom::keys_of_physics {

using enum KeyKind;
inline constexpr auto none = Dimension::none;

inline constexpr std::string_view side_says = "The kind of this side.";
inline constexpr std::string_view side_allowed = "NAMES, or a table `{ kind = ... }`";
inline constexpr std::string_view restitution_allowed = "a number from 0 to 1, or `{ viscoelastic = ... }`";

inline constexpr SceneKey keys[] = {
    {"", "title", text, none, "\"\"", "Shown in messages, movies and files.", R"(title = "gas")",
     "text of at most 1000 characters"},
    {"", "seed", special, none, "1", "Seed of all random numbers: the same seed gives the same run.", "seed = 7",
     "a whole number from 0 to 18446744073709551615"},
    {"", "box", special, none, "required", "The rectangle.", "[box]", "a table"},
    {"", "physics", special, none, "no forces, elastic", "Forces and rules of collisions.", "[physics]", "a table"},
    {"", "disks", special, none, "required without sources", "A group of disks.", "[[disks]]", "one or more tables"},
    {"", "growth", special, none, "its defaults", "How disks grow into their places.", "[growth]", "a table"},
    {"", "sources", special, none, "none", "Disks that come during the run.", "[[sources]]", "one or more tables"},
    {"", "walls", special, none, "none", "Walls within the box.", "[[walls]]", "one or more tables"},
    {"", "run", special, none, "required", "Method, step, end.", "[run]", "a table"},
    {"", "output", special, none, "nothing is written", "Files that a run writes.", "[output]", "a table"},
    {"", "analysis", special, none, "nothing is measured", "Measurements of a run.", "[analysis]", "a table"},

    {"box", "width", positive, Dimension::length, "required without packing_fraction", "From left to right.",
     "width = 100.0"},
    {"box", "height", positive, Dimension::length, "required without packing_fraction", "From bottom to top.",
     "height = 100.0"},
    {"box", "packing_fraction", positive, none, "from width and height",
     "Area of the disks at the start, with fixed ones, over that of the box. The box gets the size that this needs.",
     "packing_fraction = 0.5", "a number above 0 and below pi / sqrt(12) = 0.9069"},
    {"box", "aspect", positive, none, "1", "Width over height; only with `packing_fraction`.", "aspect = 2.0"},
    {"box", "left", special, none, "\"wall\"", side_says, R"(left = "periodic")", side_allowed, side_kind_names},
    {"box", "right", special, none, "\"wall\"", side_says, R"(right = "periodic")", side_allowed, side_kind_names},
    {"box", "bottom", special, none, "\"wall\"", side_says, R"(bottom = "sink")", side_allowed, side_kind_names},
    {"box", "top", special, none, "\"wall\"", side_says, R"(top = { kind = "wall", restitution = 0.5 })", side_allowed,
     side_kind_names},
    {"box", "shear_rate", special, Dimension::frequency, "0",
     "g of the flow vx = g (y - height / 2) in a box that is periodic both ways: the images above the box move at g "
     "height (Lees and Edwards). Velocities of `[[disks]]` are relative to this flow. Everything that is written "
     "includes the flow.",
     "shear_rate = 0.1", "a number, 0 or of either sign"},
    {"box", "wall_restitution", unit_interval, none, "1",
     "Speed of a disk away from a wall over its speed towards it, for sides and inner walls without a `restitution` of "
     "their own.",
     "wall_restitution = 0.9"},
    {"box", "wall_roughness", special, none, "smooth",
     "Roughness of the sides and inner walls, if disks are rough. With it a thermal side also draws the spin anew; "
     "without it the spin does not change.",
     "wall_roughness = { tangential_restitution = 0.5 }", "`{ tangential_restitution = ... }`"},
    {"box.wall_roughness", "tangential_restitution", number, none, "required",
     "As in `roughness` of `[physics]`, for the surface of a disk against that of the wall.",
     "wall_roughness = { tangential_restitution = 0.5 }", "a number from -1 to 1"},
    {"box.wall_roughness", "friction", non_negative, none, "no limit",
     "As in `roughness` of `[physics]`, against the wall.",
     "wall_roughness = { tangential_restitution = 0.5, friction = 0.3 }"},
    {"box.side",
     "kind",
     choice,
     none,
     "\"wall\"",
     "The kind of the side.",
     R"(left = { kind = "wall" })",
     {},
     side_kind_names},
    {"box.side", "restitution", unit_interval, none, "wall_restitution",
     "For a wall: speed of a disk away from it over its speed towards it.", "left = { restitution = 0.5 }"},
    {"box.side", "temperature", positive, Dimension::energy, "not thermal",
     "Temperature T of a thermal wall (k_B = 1). A disk leaves it with a velocity drawn from Maxwell's flux "
     "distribution, whatever velocity it came with. Replaces `restitution`. Not with Brownian motion.",
     "left = { temperature = 2.0 }"},
    {"box.side", "motion", special, none, "at rest",
     "The motion of a wall, which disks do not change. The wall reflects disks in its own frame. Not with Brownian "
     "motion or `temperature`.",
     "right = { motion = { velocity = [-0.1, 0.0] } }", "`{ velocity = ... }` or `{ vibrate = ... }`"},
    {"box.side", "place", non_negative, Dimension::length, "the edge; for a vibration, its amplitude inside the edge",
     "For a wall that moves: its x or y at time 0, or at the middle of its vibration. The box keeps its size; the side "
     "moves within it.",
     "right = { place = 50.0, motion = { velocity = [0.1, 0.0] } }"},
    {"box.side.motion", "velocity", special, Dimension::speed, "",
     "Constant velocity across the side. To drag disks along the side, use a moving inner wall with `wall_roughness`, "
     "a thousandth of a radius before the side if needed.",
     "right = { motion = { velocity = [-0.1, 0.0] } }", "[vx, vy]"},
    {"box.side.motion", "vibrate", special, Dimension::length, "",
     "Amplitude of a vibration across the side. The vibration begins at the middle, in this direction.",
     "bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0 } }", "[ax, ay]"},
    {"box.side.motion", "period", positive, Dimension::time, "required by vibrate", "Period of the vibration.",
     "bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0 } }"},
    {"box.side.motion",
     "shape",
     choice,
     none,
     "\"parabola\"",
     "Shape of the vibration: a parabola for each half period, nearly a sine, for which `exact` solves quadratics; or "
     "a sine, for which it finds contacts step by step.",
     R"(bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0, shape = "parabola" } })",
     {},
     vibration_shapes},

    {"physics", "gravity", non_negative, Dimension::acceleration, "0",
     "Acceleration of all disks: a number is downwards, along -y; a list is a vector.", "gravity = [0.1, -0.5]",
     "a number, 0 or more, downwards, or [gx, gy]"},
    {"physics", "restitution", unit_interval, none, "1",
     "Speed of separation over speed of approach, along the line of centres, in a collision of two disks, also of a "
     "disk and a fixed one.",
     "restitution = 0.8", restitution_allowed},
    {"physics", "pairs", special, none, "none", "The restitution of two groups with each other.", "[[physics.pairs]]",
     "one or more tables"},
    {"physics.restitution", "viscoelastic", positive, none, "required",
     "a in e(v) = max(`least`, 1 - a v^(1/5)), where v is the speed of approach along the line of centres: slow disks "
     "lose a smaller part of their energy. Its unit is (time / length)^(1/5).",
     "restitution = { viscoelastic = 0.1 }"},
    {"physics.restitution", "least", unit_interval, none, "0", "Lower bound of e.",
     "restitution = { viscoelastic = 0.1, least = 0.4 }", "a number from 0 to below 1"},
    {"physics.pairs", "groups", special, none, "required",
     "Names of two groups, or one name twice; `sources` for the disks of all sources.",
     R"(groups = ["tracer", "sources"])", "a list of two names"},
    {"physics.pairs", "restitution", unit_interval, none, "required",
     "Replaces the restitution of `[physics]` for these pairs.", "restitution = 0.5", restitution_allowed},
    {"physics", "roughness", special, none, "smooth",
     "Disks have rough surfaces and spin; fixed disks are as rough as others. Not with Brownian motion. Supports in a "
     "pile (method `pairwise`) have no friction.",
     "roughness = { tangential_restitution = 0.5, friction = 0.3 }",
     "`{ tangential_restitution = ..., friction = ..., inertia = ... }`"},
    {"physics.roughness", "tangential_restitution", number, none, "required",
     "b: a sticking contact multiplies the velocity of one surface along the other by -b. -1: smooth; 0: it stops; 1: "
     "it turns around, and no energy is lost.",
     "roughness = { tangential_restitution = 0.5 }", "a number from -1 to 1"},
    {"physics.roughness", "friction", non_negative, none, "no limit",
     "Coulomb's mu. If sticking needs a tangential impulse of more than mu times the normal one, the contact slides, "
     "and the tangential impulse is mu times the normal one.",
     "roughness = { tangential_restitution = 0.5, friction = 0.3 }"},
    {"physics.roughness", "inertia", positive, none, "0.5",
     "Moment of inertia of a disk over m r^2: 1/2 for a uniform disk, 2/5 for a sphere, 1 for a ring.",
     "roughness = { tangential_restitution = 0.5, inertia = 0.4 }", "a number from 1e-6 to 1"},
    {"physics", "diffusion", positive, Dimension::diffusion, "no Brownian motion",
     "D of a single disk in Brownian motion: each step draws a displacement of variance 2 D dt in x and in y.",
     "diffusion = 0.1"},
    {"physics", "accumulate", flag, none, "false",
     "With `diffusion`: the displacement over dt is added to the velocity instead of replacing it.",
     "accumulate = true"},
    {"physics", "collapse", special, none, "collapse ends the run, with status 3",
     "For method `exact`: the remedy for inelastic collapse.", R"(collapse = { model = "tc", contact_time = 1e-6 })",
     "`{ model = \"tc\", contact_time = ... }`"},
    {"physics.collapse",
     "model",
     choice,
     none,
     "required",
     "The TC model, the only choice.",
     R"(collapse = { model = "tc", contact_time = 1e-6 })",
     {},
     collapse_models},
    {"physics.collapse", "contact_time", positive, Dimension::time, "required",
     "Time after a collision of a disk in which its collisions are elastic. Has to be small against the time between "
     "collisions in a gas.",
     R"(collapse = { model = "tc", contact_time = 1e-6 })"},

    {"physics", "thermostat", special, none, "none", "Friction and noise, or newly drawn velocities.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })",
     "`{ kind = ..., temperature = ..., rate = ..., dt = ... }`"},
    {"physics.thermostat",
     "kind",
     choice,
     none,
     "required",
     "`langevin`: every disk keeps the share c of its velocity, (1 - q) / (1 + q) with q = `rate` `dt` / 2, and gets "
     "sqrt((1 - c^2) T / m) times a normal deviate. `andersen`: with probability `rate` `dt` a disk gets a new "
     "velocity from Maxwell's distribution.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })",
     {},
     thermostat_names},
    {"physics.thermostat", "temperature", positive, Dimension::energy, "required",
     "Temperature T (k_B = 1). Maxwell's distribution is invariant for any `dt`.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })"},
    {"physics.thermostat", "rate", positive, Dimension::frequency, "required",
     "Rate of friction, or rate at which a disk gets new velocities. `rate` times `dt` is at most 1.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })"},
    {"physics.thermostat", "dt", positive, Dimension::time, "`run.dt`; required without it",
     "Time between two kicks; the first is at 0. In the stepping methods at least `run.dt`: there a kick is at the "
     "start of a step.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })"},
};

}  // namespace carom::keys_of_physics
