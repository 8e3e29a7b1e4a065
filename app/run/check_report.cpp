#include "app/run/check_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/load/method_choice.hpp"
#include "core/load/method_rates.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"
#include "core/step/thermostat.hpp"

namespace carom {

namespace {

std::string range_text(double low, double high) {
  return low == high ? fmt::format("{:g}", low) : fmt::format("{:g} to {:g}", low, high);
}

std::string sides_text(const Scene& scene) {
  const Domain& box = scene.box;
  std::string text;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", side_names[k],
                        side_kind_names[static_cast<std::size_t>(box.side(side))]);
  }
  if (!scene.walls.empty()) text += "; " + counted(scene.walls.size(), "inner wall");
  const auto sinks = std::count_if(scene.walls.begin(), scene.walls.end(), [](const InnerWall& w) { return w.sink; });
  if (sinks > 0) text += fmt::format(", of which {}", counted(static_cast<Count>(sinks), "sink"));
  return text;
}

// " at speeds up to 2, accelerations up to 8, 0.8 times gravity's": below 1 of it, what lies on a wall that goes up and
// down stays there.
std::string motion_text(double speed, double acceleration, double gravity) {
  std::string text = fmt::format(" at speeds up to {:.3g}", speed);
  if (acceleration == 0.0) return text;
  text += fmt::format(", accelerations up to {:.3g}", acceleration);
  return gravity > 0.0 ? text + fmt::format(", {:.3g} times gravity's", acceleration / gravity) : text;
}

// Restitution at walls: one for all, or each with the name of its side.
std::string walls_text(const Domain& box) {
  std::string text;
  bool equal = true;
  std::optional<double> first;
  for (const Side side : all_sides) {
    if (box.side(side) != SideKind::wall) continue;
    const std::string_view name = side_names[static_cast<std::size_t>(side)];
    if (box.is_thermal(side)) {
      equal = false;
      text += fmt::format(", the {} wall at temperature {:g}", name, box.temperature(side));
      continue;
    }
    equal = equal && box.restitution(side) == first.value_or(box.restitution(side));
    if (!first) first = box.restitution(side);
    text += fmt::format(", {:g} at the {} wall", box.restitution(side), name);
  }
  return equal && first ? fmt::format(", {:g} at walls", *first) : text;
}

// Each side that moves, then the largest figures of all inner walls.
std::string moving_walls_text(const Scene& scene) {
  const double gravity = scene.physics.gravity.size;
  std::string text;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    const SideMotion& motion = scene.box.motions[k];
    if (!scene.box.moves(side)) continue;
    text += fmt::format("; the {} wall moves{}", side_names[k],
                        motion_text(motion.largest_speed(), motion.largest_acceleration(), gravity));
  }
  if (!scene.box.inner_walls_move) return text;
  double acceleration = 0.0;
  for (const InnerWall& wall : scene.walls) acceleration = std::max(acceleration, wall.motion.largest_acceleration());
  return text + "; inner walls move" + motion_text(fastest_inner_wall(scene), acceleration, gravity);
}

std::string gravity_text(const Gravity& g) {
  if (!g.acts()) return "no gravity; ";
  if (!g.is_tilted() && g.down > 0.0) return fmt::format("gravity {:g} downwards; ", g.down);
  return fmt::format("gravity [{:g}, {:g}]; ", 0.0 - g.left, 0.0 - g.down);
}

std::string restitution_text(const Restitution& r) {
  if (r.viscosity == 0.0) return fmt::format("{:g}", r.least);
  return fmt::format("max({:g}, 1 - {:g} v^(1/5))", r.least, r.viscosity);
}

// "0.9 of disks, 0.5 of light with heavy".
std::string restitutions_text(const Scene& scene) {
  const Physics& p = scene.physics;
  std::string text = restitution_text({p.restitution, p.law.viscosity}) + " of disks";
  for (const GroupPair& pair : p.law.pairs) {
    text += fmt::format(", {} of {} with {}", restitution_text(pair.restitution), name_of_group(scene, pair.first),
                        name_of_group(scene, pair.second));
  }
  return text;
}

// "0.5 along surfaces, friction 0.3".
std::string roughness_text(const Roughness& r) {
  const std::string friction = r.friction < HUGE_VAL ? fmt::format(", friction {:g}", r.friction) : "";
  return fmt::format("{:g} along surfaces{}", r.restitution, friction);
}

// Empty where disks are smooth.
std::string surfaces_text(const Surfaces& surfaces) {
  if (!surfaces.are_rough()) return "";
  const std::string walls = surfaces.walls.acts() ? fmt::format(" (walls: {})", roughness_text(surfaces.walls)) : "";
  return fmt::format("; rough disks: restitution {}{}", roughness_text(surfaces.disks), walls);
}

std::string physics_text(const Scene& scene) {
  const Physics& p = scene.physics;
  std::string text = gravity_text(p.gravity);
  const bool elastic = p.restitution == 1.0 && !p.law.dissipates();
  text += !elastic ? fmt::format("restitution {}", restitutions_text(scene)) : "elastic collisions";
  const std::string walls = walls_text(scene.box);
  text += elastic && walls == ", 1 at walls" ? ", at walls too" : walls;
  text += moving_walls_text(scene);
  text += surfaces_text(p.surfaces);
  if (scene.box.shear.acts()) text += fmt::format("; a shear flow of rate {:g}", scene.box.shear.rate);
  if (const auto& tc = p.collapse_contact_time) text += fmt::format("; the TC model, contact time {:g}", *tc);
  if (p.diffusion > 0.0) {
    text += fmt::format("; Brownian motion, D = {:g}{}", p.diffusion, p.accumulate ? ", accumulating velocity" : "");
  }
  if (const Thermostat& bath = p.thermostat; bath.acts()) {
    text += fmt::format("; a thermostat ({}) at temperature {:g}, rate {:g}, kicks every {:g}",
                        thermostat_names[static_cast<std::size_t>(bath.kind)], bath.temperature, bath.rate,
                        kick_interval(scene));
  }
  for (const Source& source : scene.sources) text += fmt::format("; a source of {:g} disks per unit time", source.rate);
  return text;
}

std::string method_text(const Scene& scene) {
  const std::string_view name = name_of(scene.run.method);
  if (!uses_dt(scene)) return fmt::format("{} to t = {:g}", name, scene.run.t_end);
  // A window ends at a draw, or before; a frame of rollback may be shorter than dt.
  const char* const each = scene.run.method == Method::exact ? "draw" : "step";
  return fmt::format("{}, dt = {:g}, {}{} to t = {:g}", name, scene.run.dt,
                     counted(make_step_clock(scene.run.dt, scene.run.t_end).steps, each),
                     scene.run.method == Method::rollback ? " or more" : "", scene.run.t_end);
}

std::string step_text(const Scene& scene, const Findings& f) {
  const double safe = f.steps.safe();
  if (std::isinf(safe)) return "any: nothing moves";
  std::string text = fmt::format("{:.3g} or less", safe);
  if (f.steps.at_start > f.steps.later) {
    text += fmt::format(": {:.3g} at the speeds of the start, {:.3g} ", f.steps.at_start, f.steps.later);
    text += f.steps.landing_speed > 0.0 ? fmt::format("after falling (speed {:.3g})", f.steps.landing_speed)
            : f.steps.driven            ? "at those that walls or a thermostat give"
                                        : "at those of sources";
  } else {
    text += scene.physics.diffusion > 0.0 ? " for Brownian motion" : " at the speeds of the start";
  }
  if (f.steps.resting < std::min(f.steps.later, f.steps.at_start)) {
    text += fmt::format(", {:.3g} for a pile", f.steps.resting);
  }
  return text + (scene.run.dt <= safe ? "; dt is safe" : "; dt is longer");
}

std::string disks_text(const Scene& scene, const Findings& f) {
  std::string text =
      f.disks > 0 ? fmt::format("{}, radius {}, mass {}", f.disks, range_text(f.smallest_radius, f.largest_radius),
                                range_text(f.smallest_mass, f.largest_mass))
                  : "none at the start";
  Count fixed = 0;
  for (const DiskGroup& group : scene.groups) fixed += group.fixed ? group.count : 0;
  if (fixed > 0) text += fmt::format("; {} fixed", fixed);
  if (f.population.end > f.population.start) {
    text += fmt::format("; with what sources emit up to {:.0f} at t = {:g}", f.population.end, scene.run.t_end);
  }
  return text;
}

std::string outputs_text(const Scene& scene, const Findings& f) {
  const OutputForesight& o = f.outputs;
  if (o.files.empty()) return "none asked for";
  std::vector<std::string> files;
  for (const auto& [name, bytes] : o.files) files.push_back(fmt::format("{} {}B", name, short_number(bytes)));
  std::string text;
  if (o.frames > 0) text += counted(o.frames, "frame");
  if (o.samples > 0) text += (text.empty() ? "" : ", ") + counted(o.samples, "sample");
  text +=
      fmt::format("{}{}; about {}B in all", text.empty() ? "" : ": ", fmt::join(files, ", "), short_number(o.bytes()));
  if (has_sinks(scene)) text += ", less as sinks take disks away";
  return o.not_tried.empty() ? text : text + fmt::format(" (guessed: {})", o.not_tried);
}

// The parts that make up the cost, those that matter.
std::string cost_text(const Scene& scene, const Findings& f) {
  if (!f.stopped.empty()) return fmt::format("stops early: {}", f.stopped);
  std::string text = fmt::format("about {} on this machine, from a trial: steps {}", duration_text(f.seconds()),
                                 duration_text(f.step_seconds));
  const auto part = [&](const char* name, double seconds) {
    if (seconds > 0.01 * f.seconds()) text += fmt::format(", {} {}", name, duration_text(seconds));
  };
  part("the start", f.start_seconds);
  part("frames and movie", f.outputs.files_s);
  part("analysis", f.outputs.analysis_s);
  part("plots", f.outputs.plots_s);
  if (has_sinks(scene) && f.population.end > f.population.start) text += "; less as sinks take disks away";
  // The trial sees the disks fall.
  if (!settles(scene)) return text;
  if (scene.run.method == Method::pairwise) {
    text += "; once disks lie in a pile, a step takes 5 to 50 times as long, the longer the taller it is";
  } else if (const std::optional<double> tc = scene.physics.collapse_contact_time) {
    const double each = 0.5 * rates::pile_collisions / *tc;
    text += fmt::format("; once disks lie in a pile, each makes about {:.0e} collisions in a unit of time", each);
  }
  return text;
}

std::string offer_text(const MethodOffer& offer, bool best) {
  const std::string_view name = name_of(offer.method);
  if (!offer.possible) return fmt::format("  {:<10}no: {}\n", name, offer.why);
  const std::string dt = offer.dt > 0.0 ? fmt::format("dt = {:g}, ", offer.dt) : "";
  const std::string error = offer.error > 0.0 ? fmt::format("{:.1e}", offer.error) : "rounding only";
  return fmt::format("{}{:<10}{}error {}, about {} of one core: {}\n", best ? "> " : "  ", name, dt, error,
                     duration_text(offer.seconds), offer.why);
}

// What the error is one of.
const char* averages_of(const Scene& scene, const MethodChoice& choice) {
  if (scene.physics.diffusion > 0.0) return "mean square displacement";
  // Where disks come to rest, how often they still hit each other depends on the step: soft hits become load.
  if (choice.scales.settles) return "energy lost; not collisions, of which a pile has as many as steps show";
  return disks_dissipate(scene) ? "collision rate, pressure, cooling rate" : "collision rate, pressure";
}

// Which method and step an accuracy needs. Costs are those of the machine that core/load/method_rates.hpp was measured
// on.
std::string choice_text(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  std::string text =
      fmt::format("for an error of {:g} in averages over disks and time ({}):\n", accuracy, averages_of(scene, choice));
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    text += offer_text(choice.offers[k], static_cast<int>(k) == choice.best);
  }
  if (choice.offers.empty()) return text + fmt::format("  {}\n", choice.why);
  if (choice.best < 0) return text + "  out of reach: ask for a larger error, or name a method and its dt\n";
  const MethodOffer& best = choice.offers[static_cast<std::size_t>(choice.best)];
  const std::string dt = best.dt > 0.0 ? fmt::format(" --dt {:g}", best.dt) : "";
  const std::string automatic =
      scene.box.shear.acts() ? "" : fmt::format(", or method = \"auto\", accuracy = {:g} in [run]", accuracy);
  return text + fmt::format("  take it with --method {}{}{}\n", name_of(best.method), dt, automatic);
}

Json choice_json(const Scene& scene, double accuracy) {
  const MethodChoice choice = choose_method(scene, accuracy);
  Json j{{"accuracy", accuracy}, {"method", nullptr}, {"why", choice.why}};
  for (std::size_t k = 0; k < choice.offers.size(); ++k) {
    const MethodOffer& o = choice.offers[k];
    const std::string_view name = name_of(o.method);
    if (static_cast<int>(k) == choice.best) j["method"] = name;
    j["offers"].push_back({{"method", name},
                           {"possible", o.possible},
                           {"dt", o.dt},
                           {"error", o.error},
                           {"cpu_s", o.seconds},
                           {"why", o.why}});
  }
  return j;
}

struct Told {
  const Scene& scene;
  const Findings& found;
  const std::optional<double>& accuracy;
};

Json file_sizes(const OutputForesight& outputs) {
  Json sizes = Json::object();
  for (const auto& [name, bytes] : outputs.files) sizes[name] = std::round(bytes);
  return sizes;
}

Json ranks_json(const Told& t) {
  if (!t.found.ranks) return absent();
  const RankForesight& r = *t.found.ranks;
  Json ranks{{"count", r.ranks},
             {"disks", r.disks},
             {"first_memory_bytes", r.first_bytes},
             {"memory_bytes", r.other_bytes},
             {"tried", r.traffic.ranks},
             {"messages", r.traffic.messages},
             {"bytes", r.traffic.bytes}};
  if (!r.alone.empty()) ranks["alone"] = r.alone;
  return ranks;
}

std::string ranks_text(const RankForesight& r) {
  if (!r.alone.empty()) return fmt::format("{}, of which one runs all disks: {}", r.ranks, r.alone);
  const std::string tried = r.traffic.ranks < r.ranks ? fmt::format(", from a trial on {}", r.traffic.ranks) : "";
  return fmt::format("{} with about {:.0f} disks each: {}B of memory, the first {}B; {:.1f} messages with {}B a step{}",
                     r.ranks, r.disks, short_number(r.other_bytes), short_number(r.first_bytes), r.traffic.messages,
                     short_number(r.traffic.bytes), tried);
}

// A new key is a row here.
const JsonKey<Told> check_keys[] = {
    {"scene", "", "the scene's file", [](const Told& t) -> Json { return t.scene.file; }},
    {"method", "", "`rollback`, `pairwise` or `exact`",
     [](const Told& t) -> Json { return name_of(t.scene.run.method); }},
    {"particles", "", "disks at the start", [](const Told& t) -> Json { return t.found.disks; }},
    {"particles_at_end", "", "disks at the end with what sources emit; fewer where sinks take some",
     [](const Told& t) -> Json { return t.found.population.end; }},
    {"width", "length", "of the box", [](const Told& t) -> Json { return t.scene.box.width; }},
    {"height", "length", "of the box", [](const Told& t) -> Json { return t.scene.box.height; }},
    {"packing_fraction", "", "at the start",
     [](const Told& t) -> Json { return json_number(t.found.packing_fraction); }},
    {"dt", "time", "the step; 0 where the scene gives none", [](const Told& t) -> Json { return t.scene.run.dt; }},
    {"safe_dt", "time",
     "the longest step that time stepping does not split, with `exact` and Brownian motion the longest between two "
     "draws; null if any is",
     [](const Told& t) -> Json { return json_number(t.found.steps.safe()); }},
    {"landing_speed", "length / time", "the largest after a fall; 0 without gravity",
     [](const Told& t) -> Json { return json_number(t.found.steps.landing_speed); }},
    {"t_end", "time", "the end of the run", [](const Told& t) -> Json { return t.scene.run.t_end; }},
    {"frames", "", "frames that a run makes", [](const Told& t) -> Json { return t.found.outputs.frames; }},
    {"memory_bytes", "bytes", "of a run, with ffmpeg's for its movie",
     [](const Told& t) -> Json { return t.found.memory_bytes; }},
    {"cost_s", "s", "wall time of a run on this machine, null if unknown",
     [](const Told& t) -> Json { return json_number(t.found.seconds()); }},
    {"cost_parts_s", "s", "an object: the same in parts, `start`, `steps`, `frames`, `analysis`, `plots`",
     [](const Told& t) -> Json {
       return Json{{"start", t.found.start_seconds},
                   {"steps", json_number(t.found.step_seconds)},
                   {"frames", t.found.outputs.files_s},
                   {"analysis", t.found.outputs.analysis_s},
                   {"plots", t.found.outputs.plots_s}};
     }},
    {"files_bytes", "bytes", "an object: the size of each file",
     [](const Told& t) -> Json { return file_sizes(t.found.outputs); }},
    {"collapse_expected", "", "whether inelastic collapse is to be expected",
     [](const Told& t) -> Json { return t.found.collapse.expected; }},
    {"troubles", "", "what will go wrong in a run, a list of texts",
     [](const Told& t) -> Json { return t.found.troubles; }},
    {"growth_s", "s", "only where disks grow: processor time of that",
     [](const Told& t) -> Json { return t.found.growth_seconds > 0.0 ? Json(t.found.growth_seconds) : absent(); }},
    {"ranks", "",
     "only with `--ranks`, an object: their `count`, `disks` of each, `memory_bytes` of each but the first, "
     "`first_memory_bytes` of that, and the `messages` and `bytes` that each sends in a step, from a trial on `tried` "
     "ranks, three at most; where the first runs all disks, why, as `alone`",
     [](const Told& t) -> Json { return ranks_json(t); }},
    {"choice", "", "only with `--accuracy`: an object with the method and step that it needs, and all `offers`",
     [](const Told& t) -> Json { return t.accuracy ? choice_json(t.scene, *t.accuracy) : absent(); }},
};

// tried: were steps, and outputs?
std::string memory_text(const Findings& f, bool tried) {
  const std::string bytes = short_number(f.memory_bytes);
  if (!tried) return fmt::format("at least {}B", bytes);
  const bool sources = f.population.end > f.population.start;
  const double movie = f.outputs.ffmpeg_bytes;
  return fmt::format("about {}B, as measured{}{}", bytes, sources ? ", with what sources add" : "",
                     movie > 0.0 ? fmt::format(", {}B of it for ffmpeg", short_number(movie)) : "");
}

std::string main_text(const Scene& scene, const Findings& f) {
  std::string text =
      fmt::format("{}: {}\n", one_line(scene.file), scene.title.empty() ? "a scene" : one_line(scene.title));
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  line("disks", disks_text(scene, f));
  line("box",
       fmt::format("{:g} x {:g}, packing fraction {:.4g}", scene.box.width, scene.box.height, f.packing_fraction));
  line("sides", sides_text(scene));
  line("physics", physics_text(scene));
  line("method", scene.run.automatic ? choice_text(scene) : method_text(scene));
  if (scene.run.method != Method::exact) line("safe step", step_text(scene, f));
  const bool tried = f.growth_seconds <= longest_growth;
  if (tried) line("outputs", outputs_text(scene, f));
  if (!tried) {
    line("growth",
         fmt::format("about {} of one core before the first step, not tried", duration_text(f.growth_seconds)));
  }
  line("memory", memory_text(f, tried));
  if (f.ranks) line("ranks", ranks_text(*f.ranks));
  line("cost", tried ? cost_text(scene, f) : "not tried either");
  for (const std::string& trouble : f.troubles) line("trouble", trouble);
  return text;
}

}  // namespace

std::string check_text(const Scene& scene, const Findings& found, const std::optional<double>& accuracy) {
  const std::string hint = "  --accuracy 1e-3 says which method and dt that needs\n";
  return main_text(scene, found) + (accuracy ? choice_text(scene, *accuracy) : hint);
}

std::string check_json(const Scene& scene, const Findings& found, const std::optional<double>& accuracy) {
  return json_object(check_keys, {scene, found, accuracy});
}

std::vector<KeyText> check_key_texts() {
  return key_texts(check_keys);
}

}  // namespace carom
