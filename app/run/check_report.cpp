#include "app/run/check_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/run/offers_report.hpp"
#include "app/run/scene_in_words.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/load/method_choice.hpp"
#include "core/load/method_rates.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/step_clock.hpp"
#include "core/step/step_start.hpp"

namespace carom {

namespace {

std::string range_text(double low, double high) {
  return low == high ? fmt::format("{:g}", low) : fmt::format("{:g} to {:g}", low, high);
}

std::string method_text(const Scene& scene) {
  const std::string_view name = name_of(scene.run.method);
  if (!uses_dt(scene)) return fmt::format("{} to t = {:g}", name, scene.run.t_end);
  // A window ends at a draw or before one; a frame of rollback may be shorter than dt.
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
    // If the disks are at rest at the start, any step.
    const std::string at_start = std::isinf(f.steps.at_start) ? "any" : fmt::format("{:.3g}", f.steps.at_start);
    text += fmt::format(": {} at the speeds of the start, {:.3g} ", at_start, f.steps.later);
    text += f.steps.landing_speed > 0.0 ? fmt::format("after falling (speed {:.3g})", f.steps.landing_speed)
            : f.steps.driven            ? "at the speeds that walls or a thermostat give"
                                        : "at the speeds of disks from sources";
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
    text += fmt::format("; with those from sources up to {:.0f} at t = {:g}", f.population.end, scene.run.t_end);
  }
  return text;
}

std::string outputs_text(const Scene& scene, const Findings& f) {
  const OutputForesight& o = f.outputs;
  if (o.files.empty()) return "none";
  std::vector<std::string> files;
  for (const auto& [name, bytes] : o.files) files.push_back(fmt::format("{} {}B", name, short_number(bytes)));
  std::string text;
  if (o.frames > 0) text += counted(o.frames, "frame");
  if (o.samples > 0) text += (text.empty() ? "" : ", ") + counted(o.samples, "sample");
  text +=
      fmt::format("{}{}; about {}B in all", text.empty() ? "" : ": ", fmt::join(files, ", "), short_number(o.bytes()));
  if (has_sinks(scene)) text += ", less if sinks remove disks";
  return o.not_tried.empty() ? text : text + fmt::format(" (guessed: {})", o.not_tried);
}

// The parts of the cost that matter.
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
  if (has_sinks(scene) && f.population.end > f.population.start) text += "; less if sinks remove disks";
  // The trial includes only the fall of the disks.
  if (!settles(scene)) return text;
  if (scene.run.method == Method::pairwise) {
    text += "; once disks lie in a pile, a step takes 5 to 50 times as long, most in a tall pile";
  } else if (const std::optional<double> tc = scene.physics.collapse_contact_time) {
    const double each = 0.5 * rates::pile_collisions / *tc;
    text += fmt::format(
        "; once disks lie in a pile, each makes about {:.0e} collisions in a unit of time, which then takes "
        "{} or more",
        each, duration_text(each * f.population.mean * rates::exact_collision));
  }
  return text;
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
  return fmt::format(
      "{} with about {:.0f} disks each: {}B of memory, {}B on the first; {:.1f} messages with {}B per step{}", r.ranks,
      r.disks, short_number(r.other_bytes), short_number(r.first_bytes), r.traffic.messages,
      short_number(r.traffic.bytes), tried);
}

// For a new key, add a row here.
const JsonKey<Told> check_keys[] = {
    {"scene", "", "file of the scene", [](const Told& t) -> Json { return t.scene.file; }},
    {"method", "", "`rollback`, `pairwise` or `exact`",
     [](const Told& t) -> Json { return name_of(t.scene.run.method); }},
    {"particles", "", "disks at the start", [](const Told& t) -> Json { return t.found.disks; }},
    {"particles_at_end", "", "disks at the end, with those from sources; sinks make it fewer",
     [](const Told& t) -> Json { return t.found.population.end; }},
    {"width", "length", "width of the box", [](const Told& t) -> Json { return t.scene.box.width; }},
    {"height", "length", "height of the box", [](const Told& t) -> Json { return t.scene.box.height; }},
    {"packing_fraction", "", "packing fraction at the start, without fixed disks",
     [](const Told& t) -> Json { return json_number(t.found.packing_fraction); }},
    {"dt", "time", "the time step; 0 if the scene has none", [](const Told& t) -> Json { return t.scene.run.dt; }},
    {"safe_dt", "time",
     "the longest step that time stepping does not split; with `exact` and Brownian motion, the longest time between "
     "two draws; null if any step is safe",
     [](const Told& t) -> Json { return json_number(t.found.steps.safe()); }},
    {"landing_speed", "length / time", "largest speed after a fall; 0 without gravity",
     [](const Told& t) -> Json { return json_number(t.found.steps.landing_speed); }},
    {"t_end", "time", "time at the end of the run", [](const Told& t) -> Json { return t.scene.run.t_end; }},
    {"frames", "", "frames of the run", [](const Told& t) -> Json { return t.found.outputs.frames; }},
    {"memory_bytes", "bytes", "memory of the run, with that of ffmpeg for its movie",
     [](const Told& t) -> Json { return t.found.memory_bytes; }},
    {"cost_s", "s", "wall time of the run on this machine; null if unknown",
     [](const Told& t) -> Json { return json_number(t.found.seconds()); }},
    {"cost_parts_s", "s", "an object with the parts of this time: `start`, `steps`, `frames`, `analysis`, `plots`",
     [](const Told& t) -> Json {
       return Json{{"start", t.found.start_seconds},
                   {"steps", json_number(t.found.step_seconds)},
                   {"frames", t.found.outputs.files_s},
                   {"analysis", t.found.outputs.analysis_s},
                   {"plots", t.found.outputs.plots_s}};
     }},
    {"files_bytes", "bytes", "an object with the size of each file",
     [](const Told& t) -> Json { return file_sizes(t.found.outputs); }},
    {"collapse_expected", "", "true if inelastic collapse is expected",
     [](const Told& t) -> Json { return t.found.collapse.expected; }},
    {"troubles", "", "a list of texts: what will go wrong in the run",
     [](const Told& t) -> Json { return t.found.troubles; }},
    {"growth_s", "s", "only with `positions = \"growth\"`: processor time of the growth",
     [](const Told& t) -> Json { return t.found.growth_seconds > 0.0 ? Json(t.found.growth_seconds) : absent(); }},
    {"ranks", "", "only with `--ranks`: an object, see below", [](const Told& t) -> Json { return ranks_json(t); }},
    {"choice", "", "only with `--accuracy`: an object with the chosen method and step, and all `offers`",
     [](const Told& t) -> Json { return t.accuracy ? offers_json(t.scene, *t.accuracy) : absent(); }},
};

// tried: have steps and outputs been tried?
std::string memory_text(const Findings& f, bool tried) {
  const std::string bytes = short_number(f.memory_bytes);
  if (!tried) return fmt::format("at least {}B", bytes);
  const bool sources = f.population.end > f.population.start;
  const double movie = f.outputs.ffmpeg_bytes;
  return fmt::format("about {}B, as measured{}{}", bytes, sources ? ", with disks from sources" : "",
                     movie > 0.0 ? fmt::format(", {}B of it for ffmpeg", short_number(movie)) : "");
}

std::string box_text(const Scene& scene, const Findings& f) {
  std::string text =
      fmt::format("{:g} x {:g}, packing fraction {:.4g}", scene.box.width, scene.box.height, f.packing_fraction);
  if (f.packing_fraction_fixed > 0.0) {
    text += fmt::format(", {:.4g} with fixed disks", f.packing_fraction + f.packing_fraction_fixed);
  }
  return text;
}

std::string main_text(const Scene& scene, const Findings& f) {
  std::string text =
      fmt::format("{}: {}\n", one_line(scene.file), scene.title.empty() ? "a scene" : one_line(scene.title));
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  line("disks", disks_text(scene, f));
  line("box", box_text(scene, f));
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
  line("cost", tried ? cost_text(scene, f) : "unknown, as the growth was not tried");
  for (const std::string& trouble : f.troubles) line("trouble", trouble);
  return text;
}

}  // namespace

std::string check_text(const Scene& scene, const Findings& found, const std::optional<double>& accuracy) {
  const std::string hint = "  --accuracy 1e-3 finds the method and dt for that error\n";
  return main_text(scene, found) + (accuracy ? offers_text(scene, *accuracy) : hint);
}

std::string check_json(const Scene& scene, const Findings& found, const std::optional<double>& accuracy) {
  return json_object(check_keys, {scene, found, accuracy});
}

std::vector<KeyText> check_key_texts() {
  return key_texts(check_keys);
}

std::vector<KeyText> check_rank_key_texts() {
  return {{"count", "", "number of ranks"},
          {"disks", "", "disks of each rank"},
          {"first_memory_bytes", "bytes", "memory of the first rank"},
          {"memory_bytes", "bytes", "memory of each other rank"},
          {"messages", "", "messages that a rank sends in a step"},
          {"bytes", "bytes", "data that a rank sends in a step"},
          {"tried", "", "ranks of the trial that measured the last two, at most three"},
          {"alone", "", "only if the first rank runs all disks: the reason"}};
}

}  // namespace carom
