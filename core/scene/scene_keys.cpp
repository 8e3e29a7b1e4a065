#include "core/scene/scene_keys.hpp"

#include <algorithm>

#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

using enum KeyKind;
constexpr auto none = Dimension::none;

constexpr std::string_view side_says = "What this side does.";
constexpr std::string_view side_allowed = "NAMES, or a table `{ kind = ... }`";
constexpr std::string_view bins_allowed = "a whole number from 1 to 100000";
constexpr std::string_view fps_allowed = "a number from 0.1 to 1000";
constexpr std::string_view size_allowed = "two even whole numbers from 320 to 8192";
constexpr std::string_view radius_allowed =
    "a number above 0, a list of them, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... "
    "}`, `{ from_mass = ... }`, or `{ frame = ... }`";
constexpr std::string_view mass_allowed =
    "a number above 0, a list of them, `{ uniform = ... }`, `{ normal = ... }`, `{ lognormal = ... }`, `{ choice = ... "
    "}`, `{ from_radius = ... }`, or `{ frame = ... }`";
constexpr std::string_view velocities_allowed =
    "`{ maxwell = ... }`, `{ uniform = ... }`, a list of [vx, vy], `{ file = ... }`, or `{ frame = ... }`";
constexpr std::string_view restitution_allowed = "a number from 0 to 1, or `{ viscoelastic = ... }`";
constexpr std::string_view range_allowed = "[low, high] with 0 < low <= high";

constexpr SceneKey keys[] = {
    {"", "title", text, none, "\"\"", "Shown in messages, movies and files.", R"(title = "gas")",
     "text of at most 1000 characters"},
    {"", "seed", special, none, "1", "Of all random numbers: the same seed, the same run.", "seed = 7",
     "a whole number from 0 to 18446744073709551615"},
    {"", "box", special, none, "required", "The rectangle.", "[box]", "a table"},
    {"", "physics", special, none, "no forces, elastic", "What acts on the disks.", "[physics]", "a table"},
    {"", "disks", special, none, "required, or sources", "A group of disks.", "[[disks]]", "one or more tables"},
    {"", "growth", special, none, "its defaults", "How disks grow into their places.", "[growth]", "a table"},
    {"", "sources", special, none, "none", "Disks that come later.", "[[sources]]", "one or more tables"},
    {"", "walls", special, none, "none", "Walls within the box.", "[[walls]]", "one or more tables"},
    {"", "run", special, none, "required", "Method, step, end.", "[run]", "a table"},
    {"", "output", special, none, "nothing is written", "What a run writes.", "[output]", "a table"},
    {"", "analysis", special, none, "nothing is measured", "What a run measures.", "[analysis]", "a table"},

    {"box", "width", positive, Dimension::length, "required without packing_fraction", "From left to right.",
     "width = 100.0"},
    {"box", "height", positive, Dimension::length, "required without packing_fraction", "From bottom to top.",
     "height = 100.0"},
    {"box", "packing_fraction", positive, none, "from width and height",
     "Area of the disks at the start over that of the box, which is made to fit.", "packing_fraction = 0.5",
     "a number above 0 and below pi / sqrt(12) = 0.9069"},
    {"box", "aspect", positive, none, "1", "Width over height; only beside `packing_fraction`.", "aspect = 2.0"},
    {"box", "left", special, none, "\"wall\"", side_says, R"(left = "periodic")", side_allowed, side_kind_names},
    {"box", "right", special, none, "\"wall\"", side_says, R"(right = "periodic")", side_allowed, side_kind_names},
    {"box", "bottom", special, none, "\"wall\"", side_says, R"(bottom = "sink")", side_allowed, side_kind_names},
    {"box", "top", special, none, "\"wall\"", side_says, R"(top = { kind = "wall", restitution = 0.5 })", side_allowed,
     side_kind_names},
    {"box", "wall_restitution", unit_interval, none, "1",
     "Speed away from a wall over speed towards it, in a collision of disk and wall, where the side has no "
     "`restitution` of its own.",
     "wall_restitution = 0.9"},
    {"box.side",
     "kind",
     choice,
     none,
     "\"wall\"",
     "What the side does.",
     R"(left = { kind = "wall" })",
     {},
     side_kind_names},
    {"box.side", "restitution", unit_interval, none, "wall_restitution",
     "Of a wall: speed away from it over speed towards it.", "left = { restitution = 0.5 }"},
    {"box.side", "temperature", positive, Dimension::energy, "not thermal",
     "T of a thermal wall (k_B = 1): whatever the velocity with which a disk reaches it, the disk leaves with one "
     "drawn "
     "from Maxwell's flux distribution. Takes the place of `restitution`. Not with Brownian motion.",
     "left = { temperature = 2.0 }"},
    {"box.side", "motion", special, none, "at rest",
     "How a wall moves, whatever meets it: it reflects disks in its own frame. Not with sources, Brownian motion or "
     "`temperature`.",
     "right = { motion = { velocity = [-0.1, 0.0] } }", "`{ velocity = ... }` or `{ vibrate = ... }`"},
    {"box.side", "place", non_negative, Dimension::length, "as near to the edge as its motion allows",
     "Of a wall that moves: its x or y at time 0, or at the middle of its vibration. The box stays the rectangle that "
     "it is; a side moves within it.",
     "right = { place = 50.0, motion = { velocity = [0.1, 0.0] } }"},
    {"box.side.motion", "velocity", special, Dimension::speed, "",
     "Constant, across the side: along it, motion would do nothing to disks without friction.",
     "right = { motion = { velocity = [-0.1, 0.0] } }", "[vx, vy]"},
    {"box.side.motion", "vibrate", special, Dimension::length, "",
     "Amplitude of a vibration across the side, which begins at the middle in this direction.",
     "bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0 } }", "[ax, ay]"},
    {"box.side.motion", "period", positive, Dimension::time, "required by vibrate", "Of the vibration.",
     "bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0 } }"},
    {"box.side.motion",
     "shape",
     choice,
     none,
     "\"parabola\"",
     "Of the vibration: a parabola for each half period, nearly a sine, so that `exact` has quadratics to solve.",
     R"(bottom = { motion = { vibrate = [0.0, 0.5], period = 2.0, shape = "parabola" } })",
     {},
     vibration_shapes},

    {"physics", "gravity", non_negative, Dimension::acceleration, "0",
     "Acceleration of all disks: a number is downwards, along -y; a list is a vector.", "gravity = [0.1, -0.5]",
     "a number, 0 or more, or [gx, gy]"},
    {"physics", "restitution", unit_interval, none, "1",
     "Speed of separation over speed of approach, along the line of centres, in a collision of two disks, fixed ones "
     "included.",
     "restitution = 0.8", restitution_allowed},
    {"physics", "pairs", special, none, "none", "The restitution of two groups.", "[[physics.pairs]]",
     "one or more tables"},
    {"physics.restitution", "viscoelastic", positive, none, "required",
     "a of e(v) = max(`least`, 1 - a v^(1/5)), v the speed of approach along the line of centres: slow disks lose a "
     "smaller part of their energy. In (time / length)^(1/5).",
     "restitution = { viscoelastic = 0.1 }"},
    {"physics.restitution", "least", unit_interval, none, "0", "What e does not fall below, however fast.",
     "restitution = { viscoelastic = 0.1, least = 0.4 }", "a number from 0 to below 1"},
    {"physics.pairs", "groups", special, none, "required",
     "Names of two groups, or one name twice; `sources` for the disks of all sources.",
     R"(groups = ["tracer", "sources"])", "a list of two names"},
    {"physics.pairs", "restitution", unit_interval, none, "required",
     "Takes the place of that of `[physics]` where a disk of one group meets one of the other.", "restitution = 0.5",
     restitution_allowed},
    {"physics", "diffusion", positive, Dimension::diffusion, "no Brownian motion",
     "D of a single disk in Brownian motion: each step draws a displacement of variance 2 D dt in x and in y.",
     "diffusion = 0.1"},
    {"physics", "accumulate", flag, none, "false",
     "With `diffusion`: the displacement over dt is added to the velocity instead of taking its place.",
     "accumulate = true"},
    {"physics", "collapse", special, none, "collapse ends the run, with status 3",
     "Method `exact` only: what to do about inelastic collapse.", R"(collapse = { model = "tc", contact_time = 1e-6 })",
     "`{ model = \"tc\", contact_time = ... }`"},
    {"physics.collapse",
     "model",
     choice,
     none,
     "required",
     "The TC model, the only one.",
     R"(model = "tc")",
     {},
     collapse_models},
    {"physics.collapse", "contact_time", positive, Dimension::time, "required",
     "How long a disk's collisions stay elastic after one. Small against the time between collisions of a gas.",
     "contact_time = 1e-6"},

    {"physics", "thermostat", special, none, "none", "Friction and noise, or velocities drawn anew.",
     R"(thermostat = { kind = "langevin", temperature = 1.0, rate = 0.5, dt = 0.1 })",
     "`{ kind = ..., temperature = ..., rate = ..., dt = ... }`"},
    {"physics.thermostat",
     "kind",
     choice,
     none,
     "required",
     "`langevin`: every disk keeps the share c of its velocity, (1 - q) / (1 + q) with q = `rate` `dt` / 2, and gets "
     "sqrt((1 - c^2) T / m) times a normal deviate. `andersen`: a disk gets a velocity of Maxwell's with probability "
     "`rate` `dt`.",
     R"(kind = "langevin")",
     {},
     thermostat_names},
    {"physics.thermostat", "temperature", positive, Dimension::energy, "required",
     "T (k_B = 1); Maxwell's distribution stays as it is, whatever `dt` is.", "temperature = 1.0"},
    {"physics.thermostat", "rate", positive, Dimension::frequency, "required",
     "Of friction, or at which a disk gets a new velocity. `rate` times `dt` is 1 at most.", "rate = 0.5"},
    {"physics.thermostat", "dt", positive, Dimension::time, "`run.dt`",
     "Between two kicks, the first at 0. In the stepping methods no less than `run.dt`: there a kick is at the start "
     "of "
     "a step.",
     "dt = 0.1"},

    {"disks", "count", count, none, "required", "How many disks the group has; 4 10^9 in all at most.", "count = 1000"},
    {"disks", "positions", special, none, "required",
     "Centres. Random without overlap; spread over the box on a lattice; grown into each other's gaps, which is "
     "denser; "
     "or given.",
     R"(positions = "random")", "NAMES, a list of [x, y], `{ file = ... }`, or `{ frame = ... }`", position_names},
    {"disks", "velocities", special, none, "at rest", "Velocities at the start.", "velocities = { maxwell = 1.0 }",
     velocities_allowed},
    {"disks", "radius", positive, Dimension::length, "required", "Radii.", "radius = 0.5", radius_allowed},
    {"disks", "mass", positive, Dimension::mass, "required, but not by fixed disks", "Masses.", "mass = 1.0",
     mass_allowed},
    {"disks", "fixed", flag, none, "false",
     "Obstacles: disks of infinite mass, which never move and have no weight, no velocity and no energy. Others "
     "collide with them as with each other, by `restitution`. They may overlap each other and stick out of the box.",
     "fixed = true"},
    {"disks", "region", special, Dimension::length, "the box",
     "Where random disks and lattices start: whole disks within this rectangle or circle. A rectangle from one "
     "periodic "
     "side to the other has no edge there.",
     "region = [0.0, 0.0, 50.0, 100.0]", "[x0, y0, x1, y1], or `{ circle = ... }`"},
    {"disks", "drift", special, Dimension::speed, "[0, 0]", "A velocity that all disks of the group get on top.",
     "drift = [1.0, 0.0]", "[vx, vy]"},
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
     "scaled "
     "so that the mean kinetic energy of a disk is T exactly; `drift` comes on top. From a side of a source: as gas "
     "flows through a hole.",
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
     "radius = { choice = [1.0, 1.4], weights = [2, 1] }", "as many numbers, 0 or more"},
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
     "as many numbers, 0 or more"},
    {"disks.mass", "from_radius", positive, Dimension::density, "", "Density rho: m = pi rho r^2.",
     "mass = { from_radius = 1.0 }"},
    {"disks.mass", "frame", text, none, "", "See `{ frame = ... }`. Not for sources.",
     R"(mass = { frame = "out/melt" })"},
    {"frame", "frame", text, none, "required", "A run's folder, or a trajectory; from the scene's folder.",
     R"(positions = { frame = "out/melt" })"},
    {"frame", "index", count, none, "the last", "Which frame, counted from 1.",
     R"(positions = { frame = "out/melt", index = 5 })"},
    {"frame", "time", number, Dimension::time, "the last", "The frame nearest to this time.",
     R"(positions = { frame = "out/melt", time = 2.5 })"},

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
    {"sources", "radius", positive, Dimension::length, "required", "Radii; no list.", "radius = 0.5", radius_allowed},
    {"sources", "mass", positive, Dimension::mass, "required", "Masses; no list.", "mass = 1.0", mass_allowed},
    {"sources", "velocities", special, none, "at rest",
     "Velocities; no list. Through a side the component across it always points inward.",
     "velocities = { maxwell = 1.0 }", velocities_allowed},
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

    {"run",
     "method",
     choice,
     none,
     "\"exact\"",
     "See [methods.md](methods.md); `auto` chooses method and dt by `accuracy`.",
     R"(method = "pairwise")",
     {},
     method_words},
    {"run", "dt", positive, Dimension::time, "required by rollback, pairwise and Brownian motion", "The time step.",
     "dt = 0.01"},
    {"run", "t_end", non_negative, Dimension::time, "required", "The time at which the run ends; it starts at 0.",
     "t_end = 10.0"},
    {"run", "accuracy", positive, none, "required by auto", "Relative error that averages may have, for `auto`.",
     "accuracy = 1e-3", "a number above 0, at most 0.1"},

    {"output", "every", non_negative, Dimension::time, "t_end / 100",
     "Simulated time between two frames; 0: only the first and the last.", "every = 0.1"},
    {"output",
     "trajectory",
     choice,
     none,
     "\"none\"",
     "All frames, as trajectory.xyz (text) or trajectory.h5 (H5MD).",
     R"(trajectory = "xyz")",
     {},
     trajectory_names},
    {"output", "select", special, Dimension::length, "all disks",
     "Which disks the trajectory shows: every so many by id, those of a group, or those with their centre in a "
     "rectangle.",
     R"(select = "every 100th")", "`\"every 100th\"`, the name of a group, or [x0, y0, x1, y1]"},
    {"output",
     "precision",
     choice,
     none,
     "\"double\"",
     "Of positions and velocities in trajectory.h5.",
     R"(precision = "single")",
     {},
     precision_names},
    {"output", "dimensions", count, none, "2",
     "Components of positions and velocities in trajectory.h5; with 3, z is 0 and MDAnalysis reads the file.",
     "dimensions = 3", "2 or 3"},
    {"output", "series", flag, none, "false", "Writes series.csv, a row a frame.", "series = true"},
    {"output", "plots", special, none, "[]",
     "velocity.svg: velocities of up to ten disks, or the distribution of more, against time; energy.svg: energies.",
     R"(plots = ["velocity", "energy"])", "a list of NAMES", plot_names},
    {"output", "movie", special, none, "false", "Writes movie.mp4; a table says how it looks.", "movie = true",
     "`true`, `false` or a table"},
    {"output.movie",
     "colour",
     choice,
     none,
     "\"speed\"",
     "What the colour of a disk stands for; groups are those of `[[disks]]`.",
     R"(movie = { colour = "radius" })",
     {},
     colour_names},
    {"output.movie", "fps", positive, none, "25", "Frames a second.", "movie = { fps = 30 }", fps_allowed},
    {"output.movie", "size", special, none, "as the box's shape asks", "Width and height of the picture in pixels.",
     "movie = { size = [1280, 720] }", size_allowed},
    {"output.movie", "range", special, none, "as the run asks",
     "The ends of the colour scale, in the unit of the coloured quantity; disks beyond them have the colour of the "
     "end.",
     "movie = { range = [0, 2] }", "[low, high] with low < high; not with `\"group\"`"},
    {"output", "view", flag, none, "false",
     "Writes view.html, a page that plays the trajectory in any browser, when the run is done.", "view = true"},
    {"output", "checkpoint", positive, none, "only when a run is stopped",
     "Wall time between checkpoints, in seconds or with a unit.", R"(checkpoint = "10 min")",
     "a number above 0, or text such as `\"90 s\"`, `\"10 min\"`, `\"2 h\"`"},

    {"analysis", "what", special, none, "required", "What to measure.", R"(what = ["pair_correlation", "speeds"])",
     "a list of NAMES", quantity_names},
    {"analysis", "select", text, none, "all disks",
     "The group whose disks are measured, as if there were no others; pressure and collision rate stay those of all.",
     R"(select = "tracer")", "the name of a group"},
    {"analysis", "every", non_negative, Dimension::time, "as frames, or t_end / 100",
     "Simulated time between two samples; 0: only the first and the last.", "every = 0.05"},
    {"analysis", "start", non_negative, Dimension::time, "0", "Time of the first sample.", "start = 5.0"},
    {"analysis", "pair_correlation", special, none, "its defaults", "Options, where `what` names it.",
     "pair_correlation = { r_max = 5.0, bins = 250 }", "a table"},
    {"analysis", "speeds", special, none, "its defaults", "Options, where `what` names them.",
     "speeds = { max = 6.0, bins = 60 }", "a table"},
    {"analysis", "density", special, none, "its defaults", "Options, where `what` names it.",
     R"(density = { axis = "y", bins = 50 })", "a table"},
    {"analysis", "profile", special, none, "its defaults", "Options, where `what` names it.",
     R"(profile = { axis = "y", bins = 50 })", "a table"},
    {"analysis", "structure_factor", special, none, "its defaults", "Options, where `what` names it.",
     "structure_factor = { wave_numbers = 100 }", "a table"},
    {"analysis.pair_correlation", "r_max", positive, Dimension::length, "five diameters, if the box has room",
     "Distance up to which pairs are counted.", "pair_correlation = { r_max = 5.0 }"},
    {"analysis.pair_correlation", "bins", count, none, "fifty a diameter", "Bins from 0 to `r_max`.",
     "pair_correlation = { bins = 250 }", bins_allowed},
    {"analysis.speeds", "max", positive, none, "6", "Largest speed, in units of sqrt(T / m).",
     "speeds = { max = 6.0 }"},
    {"analysis.speeds", "bins", count, none, "60", "Bins from 0 to `max`.", "speeds = { bins = 60 }", bins_allowed},
    {"analysis.density",
     "axis",
     choice,
     none,
     "\"y\"",
     "The axis along which slabs follow each other.",
     R"(density = { axis = "x" })",
     {},
     axis_names},
    {"analysis.density", "bins", count, none, "50", "Slabs.", "density = { bins = 50 }", bins_allowed},
    {"analysis.profile",
     "axis",
     choice,
     none,
     "\"y\"",
     "The axis along which slabs follow each other.",
     R"(profile = { axis = "x" })",
     {},
     axis_names},
    {"analysis.profile", "bins", count, none, "50", "Slabs.", "profile = { bins = 50 }", bins_allowed},
    {"analysis.structure_factor", "wave_numbers", count, none, "a hundred",
     "k = 2 pi n / period for n from 1 to this, along each periodic axis.", "structure_factor = { wave_numbers = 100 }",
     bins_allowed},
};

bool is_index(std::string_view segment) {
  return !segment.empty() && std::all_of(segment.begin(), segment.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::span<const SceneKey> scene_keys() {
  return keys;
}

const SceneKey* find_scene_key(std::string_view table, std::string_view name) {
  const auto* const it = std::find_if(std::begin(keys), std::end(keys),
                                      [&](const SceneKey& k) { return k.table == table && k.name == name; });
  return it == std::end(keys) ? nullptr : it;
}

std::vector<std::string_view> key_names(std::string_view table) {
  std::vector<std::string_view> names;
  for (const SceneKey& key : keys) {
    if (key.table == table) names.push_back(key.name);
  }
  return names;
}

std::string table_of_path(std::string_view path) {
  std::string table;
  while (!path.empty()) {
    const std::size_t dot = path.find('.');
    const std::string_view segment = path.substr(0, dot);
    path.remove_prefix(dot == std::string_view::npos ? path.size() : dot + 1);
    if (is_index(segment)) continue;
    if (!table.empty()) table += '.';
    table += segment;
  }
  return table;
}

}  // namespace carom
