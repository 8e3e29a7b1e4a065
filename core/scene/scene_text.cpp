#include "core/scene/scene_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/scene/disk_group.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_output.hpp"

namespace carom {

namespace {

template <class Enum>
std::size_t index(Enum value) {
  return static_cast<std::size_t>(value);
}

// The fewest digits that give the same double back, at most 17; always a TOML float, so that -0.0 stays.
std::string decimal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string quoted_toml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

template <class T, class Write>
std::string list_of(const std::vector<T>& values, Write write) {
  std::string text = "[";
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += k % 8 == 0 ? ",\n  " : ", ";
    text += write(values[k]);
  }
  return text + "]";
}

// On one line, since an inline table has no line breaks.
std::string list_in_line(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + decimal(value);
  return "[" + text + "]";
}

std::string pair(const Vec2& v) {
  return fmt::format("[{}, {}]", decimal(v.x), decimal(v.y));
}

std::string size_text(const SizeLaw& law, std::string_view other_key) {
  switch (law.kind) {
    case SizeLaw::Kind::constant:
      return decimal(law.value);
    case SizeLaw::Kind::list:
      return list_of(law.values, decimal);
    case SizeLaw::Kind::uniform:
      return fmt::format("{{ uniform = [{}, {}] }}", decimal(law.low), decimal(law.high));
    case SizeLaw::Kind::normal:
      return fmt::format("{{ normal = [{}, {}] }}", decimal(law.value), decimal(law.deviation));
    case SizeLaw::Kind::lognormal:
      return fmt::format("{{ lognormal = [{}, {}] }}", decimal(law.value), decimal(law.deviation));
    case SizeLaw::Kind::choice:
      return fmt::format("{{ choice = {}, weights = {} }}", list_in_line(law.values), list_in_line(law.weights));
    case SizeLaw::Kind::from_other:
      break;
  }
  return fmt::format("{{ {} = {} }}", other_key, decimal(law.density));
}

std::string positions_text(const PositionLaw& law) {
  if (law.kind == PositionLaw::Kind::list) return list_of(law.list, pair);
  return quoted_toml(position_names[index(law.kind)]);
}

// Empty if there is no region.
std::string region_line(const PositionLaw& law) {
  if (!law.region) return "";
  const StartRegion& r = *law.region;
  if (r.circle) return fmt::format("region = {{ circle = {} }}\n", list_in_line({r.centre.x, r.centre.y, r.radius}));
  return fmt::format("region = {}\n", list_in_line({r.low.x, r.low.y, r.high.x, r.high.y}));
}

// Empty for disks at rest, which is what an absent key means.
std::string velocities_line(const VelocityLaw& law) {
  switch (law.kind) {
    case VelocityLaw::Kind::rest:
      return "";
    case VelocityLaw::Kind::maxwell:
      return fmt::format("velocities = {{ maxwell = {} }}\n", decimal(law.temperature));
    case VelocityLaw::Kind::uniform:
      return fmt::format("velocities = {{ uniform = {} }}\n", decimal(law.limit));
    case VelocityLaw::Kind::list:
      break;
  }
  return fmt::format("velocities = {}\n", list_of(law.list, pair));
}

// Empty if disks have no initial spin.
std::string spin_line(const SpinLaw& law) {
  if (law.temperature > 0.0) return fmt::format("spin_temperature = {}\n", decimal(law.temperature));
  if (!law.list.empty()) return fmt::format("spin = {}\n", list_of(law.list, decimal));
  return law.value == 0.0 ? "" : fmt::format("spin = {}\n", decimal(law.value));
}

// The keys of a roughness that differ from their defaults, without braces.
std::string roughness_text(const Roughness& r) {
  const std::string friction = r.friction < HUGE_VAL ? fmt::format(", friction = {}", decimal(r.friction)) : "";
  return fmt::format("tangential_restitution = {}{}", decimal(r.restitution), friction);
}

// wall_restitution, the value of sides without a restitution of their own; sides that are not walls always have that
// value.
double common_restitution(const Domain& box) {
  for (const Side side : all_sides) {
    if (box.side(side) != SideKind::wall) return box.restitution(side);
  }
  return box.restitution(Side::left);
}

std::string motion_text(const SideMotion& motion, std::size_t s) {
  const auto across = [&](double inward) {
    const double v = s % 2 == 0 ? inward : -inward;
    return s < 2 ? pair({v, 0.0}) : pair({0.0, v});
  };
  if (motion.kind == SideMotion::Kind::steady) return fmt::format("{{ velocity = {} }}", across(motion.speed));
  return fmt::format("{{ vibrate = {}, period = {}, shape = \"{}\" }}", across(motion.amplitude),
                     decimal(motion.period), motion.kind == SideMotion::Kind::sine ? "sine" : "parabola");
}

std::string side_text(const Domain& box, std::size_t s, double common, const std::optional<double>& place) {
  const std::string kind = quoted_toml(side_kind_names[index(box.sides[s])]);
  if (box.motions[s].moves()) {
    return fmt::format("{{ kind = {}, restitution = {}{}, motion = {} }}", kind, decimal(box.restitutions[s]),
                       place ? fmt::format(", place = {}", decimal(*place)) : "", motion_text(box.motions[s], s));
  }
  if (box.temperatures[s] > 0.0) {
    return fmt::format("{{ kind = {}, temperature = {} }}", kind, decimal(box.temperatures[s]));
  }
  if (box.restitutions[s] == common) return kind;
  return fmt::format("{{ kind = {}, restitution = {} }}", kind, decimal(box.restitutions[s]));
}

std::string box_text(const Scene& scene) {
  const Domain& box = scene.box;
  std::string text = fmt::format("\n[box]\nwidth = {}\nheight = {}\n", decimal(box.width), decimal(box.height));
  if (box.shear.acts()) text += fmt::format("shear_rate = {}\n", decimal(box.shear.rate));
  const double common = common_restitution(box);
  for (std::size_t s = 0; s < side_names.size(); ++s) {
    text += fmt::format("{} = {}\n", side_names[s], side_text(box, s, common, scene.side_places[s]));
  }
  text += fmt::format("wall_restitution = {}\n", decimal(common));
  const Surfaces& surfaces = scene.physics.surfaces;
  if (!surfaces.are_rough() || surfaces.walls == Roughness{}) return text;
  return text + fmt::format("wall_roughness = {{ {} }}\n", roughness_text(surfaces.walls));
}

std::string gravity_text(const Gravity& g) {
  return g.is_tilted() || g.down < 0.0 ? pair({0.0 - g.left, 0.0 - g.down}) : decimal(g.down);
}

std::string restitution_text(const Restitution& r) {
  if (r.viscosity == 0.0) return decimal(r.least);
  return fmt::format("{{ viscoelastic = {}, least = {} }}", decimal(r.viscosity), decimal(r.least));
}

std::string physics_text(const Scene& scene) {
  const Physics& physics = scene.physics;
  std::string text = fmt::format("\n[physics]\ngravity = {}\nrestitution = {}\n", gravity_text(physics.gravity),
                                 restitution_text({physics.restitution, physics.law.viscosity}));
  if (const Surfaces& surfaces = physics.surfaces; surfaces.are_rough()) {
    text +=
        fmt::format("roughness = {{ {}, inertia = {} }}\n", roughness_text(surfaces.disks), decimal(surfaces.inertia));
  }
  if (physics.diffusion > 0.0) {
    text += fmt::format("diffusion = {}\naccumulate = {}\n", decimal(physics.diffusion), physics.accumulate);
  }
  if (physics.collapse_contact_time) {
    text +=
        fmt::format("collapse = {{ model = \"tc\", contact_time = {} }}\n", decimal(*physics.collapse_contact_time));
  }
  if (const Thermostat& bath = physics.thermostat; bath.acts()) {
    text += fmt::format("thermostat = {{ kind = \"{}\", temperature = {}, rate = {}{} }}\n",
                        thermostat_names[static_cast<std::size_t>(bath.kind)], decimal(bath.temperature),
                        decimal(bath.rate), bath.dt > 0.0 ? fmt::format(", dt = {}", decimal(bath.dt)) : "");
  }
  for (const GroupPair& pair : physics.law.pairs) {
    text += fmt::format("\n[[physics.pairs]]\ngroups = [\"{}\", \"{}\"]\nrestitution = {}\n",
                        name_of_group(scene, pair.first), name_of_group(scene, pair.second),
                        restitution_text(pair.restitution));
  }
  return text;
}

std::string group_text(const DiskGroup& group) {
  std::string text = "\n[[disks]]\n";
  if (!group.name.empty()) text += fmt::format("name = \"{}\"\n", group.name);
  text += fmt::format("count = {}\npositions = {}\n{}{}", group.count, positions_text(group.positions),
                      region_line(group.positions), velocities_line(group.velocities));
  if (group.drift != Vec2{}) text += fmt::format("drift = {}\n", pair(group.drift));
  text += spin_line(group.spins);
  text += fmt::format("radius = {}\n", size_text(group.radius, "from_mass"));
  if (group.fixed) return text + "fixed = true\n";
  return text + fmt::format("mass = {}\n", size_text(group.mass, "from_radius"));
}

std::string wall_motion_line(const WallMotion& motion) {
  if (!motion.moves()) return "";
  if (!motion.pace.vibrates()) return fmt::format("motion = {{ velocity = {} }}\n", pair(motion.along));
  return fmt::format("motion = {{ vibrate = {}, period = {}, shape = \"{}\" }}\n", pair(motion.along),
                     decimal(motion.pace.period), motion.is_sine() ? "sine" : "parabola");
}

std::string wall_text(const InnerWall& wall) {
  const std::string kind = wall.sink ? "kind = \"sink\"" : fmt::format("restitution = {}", decimal(wall.restitution));
  return fmt::format("\n[[walls]]\npoints = {}\n{}\n{}", list_of(wall.points, pair), kind,
                     wall_motion_line(wall.motion));
}

// Empty if nothing grows.
std::string growth_text(const Scene& scene) {
  for (const DiskGroup& group : scene.groups) {
    if (group.positions.kind != PositionLaw::Kind::growth) continue;
    return fmt::format("\n[growth]\nslowness = {}\nsteps = {}\n", decimal(scene.growth.slowness), scene.growth.steps);
  }
  return "";
}

std::string source_text(const Source& source) {
  std::string text = "\n[[sources]]\n";
  if (source.side) {
    text += fmt::format("side = \"{}\"\n", side_names[index(*source.side)]);
  } else {
    text += fmt::format("region = [{}, {}, {}, {}]\n", decimal(source.region_low.x), decimal(source.region_low.y),
                        decimal(source.region_high.x), decimal(source.region_high.y));
  }
  text +=
      fmt::format("rate = {}\nradius = {}\nmass = {}\n{}", decimal(source.rate), size_text(source.radius, "from_mass"),
                  size_text(source.mass, "from_radius"), velocities_line(source.velocities));
  text += spin_line(source.spins);
  if (source.limit) text += fmt::format("limit = {}\n", *source.limit);
  return text;
}

std::string run_text(const RunPlan& run) {
  std::string text = "\n[run]\n";
  // The chosen method and step are written, so that the file gives this run even if another version would choose
  // differently.
  if (run.automatic)
    text += fmt::format("# chosen by method = \"auto\", accuracy = {}: {}\n", run.accuracy, run.choice);
  text += fmt::format("method = \"{}\"\n", method_names[index(run.method)]);
  if (run.dt > 0.0) text += fmt::format("dt = {}\n", decimal(run.dt));
  return text + fmt::format("t_end = {}\n", decimal(run.t_end));
}

// Empty if the trajectory has all disks in full precision, which are the defaults.
std::string selection_lines(const OutputPlan& output) {
  const Selection& select = output.select;
  std::string text;
  if (select.by_region) {
    text += fmt::format("select = [{}, {}, {}, {}]\n", decimal(select.low.x), decimal(select.low.y),
                        decimal(select.high.x), decimal(select.high.y));
  } else if (!select.group.empty()) {
    text += fmt::format("select = \"{}\"\n", select.group);
  } else if (select.stride > 1) {
    text += fmt::format("select = \"every {}th\"\n", select.stride);
  }
  if (output.single_precision) text += "precision = \"single\"\n";
  if (output.dimensions != 2) text += fmt::format("dimensions = {}\n", output.dimensions);
  return text;
}

std::string movie_text(const OutputPlan& output) {
  const PictureLook& look = output.look;
  if (!output.movie || look == PictureLook{}) return output.movie ? "true" : "false";
  std::string text = fmt::format("{{ colour = \"{}\", fps = {}", colour_names[index(look.colour)], decimal(look.fps));
  if (look.width > 0) text += fmt::format(", size = [{}, {}]", look.width, look.height);
  if (look.range) text += fmt::format(", range = [{}, {}]", decimal((*look.range)[0]), decimal((*look.range)[1]));
  return text + " }";
}

std::string output_text(const OutputPlan& output) {
  // Without frames no interval is written, so that none is taken over if frames are asked for later.
  const bool timed = output.every > 0.0 || wants_frames(output);
  const std::string every = timed ? fmt::format("every = {}\n", decimal(output.every)) : "";
  const std::string checkpoint =
      output.checkpoint > 0.0 ? fmt::format("checkpoint = {}\n", decimal(output.checkpoint)) : "";
  return fmt::format("\n[output]\n{}trajectory = \"{}\"\n{}series = {}\nplots = {}\nmovie = {}\n", every,
                     trajectory_names[index(output.trajectory)], selection_lines(output), output.series,
                     list_of(output.plots, [](const std::string& name) { return quoted_toml(name); }),
                     movie_text(output)) +
         (output.view ? "view = true\n" : "") + checkpoint;
}

// Empty if nothing is measured.
std::string analysis_text(const AnalysisPlan& plan) {
  if (!plan.any()) return "";
  std::vector<std::string> names;
  std::string lines;
  for (std::size_t k = 0; k < quantity_names.size(); ++k) {
    if (plan.wanted[k]) names.emplace_back(quantity_names[k]);
  }
  const auto rows = [](double every) { return every > 0.0 ? fmt::format(", every = {}", decimal(every)) : ""; };
  if (plan.wants(Quantity::pair_correlation)) {
    const auto name = [](const NamedIds& group) { return quoted_toml(group.name); };
    const std::string groups =
        plan.pair_groups.empty() ? "" : fmt::format(", groups = {}", list_of(plan.pair_groups, name));
    lines += fmt::format("pair_correlation = {{ r_max = {}, bins = {}{} }}\n", decimal(plan.pairs.r_max),
                         plan.pairs.bins, groups);
  }
  if (plan.wants(Quantity::speeds)) {
    lines += fmt::format("speeds = {{ max = {}, bins = {} }}\n", decimal(plan.speed_max), plan.speed_bins);
  }
  if (plan.wants(Quantity::density)) {
    lines += fmt::format("density = {{ axis = \"{}\", bins = {}{} }}\n", axis_names[plan.density_along_x ? 0 : 1],
                         plan.density_bins, rows(plan.density_every));
  }
  if (plan.wants(Quantity::profile)) {
    lines += fmt::format("profile = {{ axis = \"{}\", bins = {}{} }}\n", axis_names[plan.profile_along_x ? 0 : 1],
                         plan.profile_bins, rows(plan.profile_every));
  }
  if (plan.wants(Quantity::structure_factor)) {
    lines += fmt::format("structure_factor = {{ wave_numbers = {} }}\n", plan.wave_numbers);
  }
  if (plan.wants(Quantity::bond_correlation)) {
    lines +=
        fmt::format("bond_correlation = {{ r_max = {}, bins = {} }}\n", decimal(plan.bonds.r_max), plan.bonds.bins);
  }
  if (!plan.group.empty()) lines += fmt::format("select = \"{}\"\n", plan.group);
  return fmt::format("\n[analysis]\nwhat = {}\nevery = {}\nstart = {}\n{}", list_of(names, quoted_toml),
                     decimal(plan.every), decimal(plan.start), lines);
}

// TOML integers end at 2^63 - 1; a larger seed is written as a string.
std::string seed_text(std::uint64_t seed) {
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return seed > largest ? fmt::format("\"{}\"", seed) : fmt::format("{}", seed);
}

}  // namespace

std::string resolved_toml(const Scene& scene) {
  std::string text = fmt::format("title = {}\nseed = {}\n", quoted_toml(scene.title), seed_text(scene.seed));
  text += box_text(scene);
  text += physics_text(scene);
  for (const DiskGroup& group : scene.groups) text += group_text(group);
  text += growth_text(scene);
  for (const Source& source : scene.sources) text += source_text(source);
  for (const InnerWall& wall : scene.walls) text += wall_text(wall);
  return text + run_text(scene.run) + output_text(scene.output) + analysis_text(scene.analysis);
}

}  // namespace carom
