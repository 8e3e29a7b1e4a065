#include "tests/fuzz_scenes/wide_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/fuzz_scenes/random_restitution.hpp"
#include "tests/fuzz_scenes/random_roughness.hpp"
#include "tests/fuzz_scenes/wide_draft.hpp"

namespace carom::fuzz {

namespace {

constexpr double pi = std::numbers::pi;

Units wide_units(Dice& dice) {
  if (dice.chance(0.8)) return {};
  const auto power = [&](int most) { return std::ldexp(1.0, static_cast<int>(dice.below(2 * 20 + 1)) - most); };
  return {power(20), power(20), power(20)};
}

std::string wide_method(Dice& dice) {
  const double u = dice.unit();
  return u < 0.6 ? "exact" : u < 0.85 ? "pairwise" : "rollback";
}

void choose_sides(Dice& dice, WideDraft& draft) {
  const double u = dice.unit();
  draft.periodic_x = u < 0.65;
  draft.periodic_y = u < 0.5 || u > 0.85;
}

double choose_packing(Dice& dice) {
  const double u = dice.unit();
  return u < 0.25 ? dice.in(0.005, 0.03) : u < 0.75 ? dice.in(0.05, 0.4) : dice.in(0.4, 0.8);
}

void choose_disks(Dice& dice, WideDraft& draft) {
  draft.radius = draft.units.length * (dice.chance(0.5) ? 0.5 : rounded(dice.in(0.3, 1.0)));
  draft.ratio = dice.chance(0.5) ? 1.0 : dice.pick({1.01, 1.4, 3.0, 10.0});
  draft.packing = choose_packing(dice);
  const double mean = pi * draft.radius * draft.radius * (draft.ratio == 1.0 ? 1.0 : 0.45);
  const bool sheared = draft.periodic_x && draft.periodic_y && dice.chance(0.25);
  const bool flat = dice.chance(0.6);
  const double most = draft.for_oracle ? 40.0 : 400.0;
  double narrow = 0.0, aspect = 0.0;
  if (flat) {
    narrow = 2.0 * draft.radius * (dice.chance(0.1) ? 2.0001 : dice.in(2.01, 6.0));
    if (sheared) narrow *= 2.0;
    aspect = std::pow(20.0, dice.unit());
  } else {
    const double count = dice.chance(0.5) ? dice.in(5.0, 0.1 * most) : dice.in(5.0, most);
    aspect = dice.in(1.0, 3.0);
    narrow = std::max(std::sqrt(count * mean / draft.packing / aspect), (sheared ? 8.01 : 4.01) * draft.radius);
  }
  draft.width = rounded(narrow * 1.0005) * aspect;
  draft.height = rounded(narrow * 1.0005);
  if (dice.chance(0.4)) std::swap(draft.width, draft.height);
  const double count = draft.packing * draft.width * draft.height / mean;
  draft.disks = static_cast<std::size_t>(std::clamp(count, 1.0, most));
  if (sheared) draft.shear = dice.pick({-1.0, 1.0}) * draft.units.speed / draft.radius * dice.decades(-3, 0);
  draft.shear = rounded(draft.shear);
  if (draft.shear == 0.0 && draft.packing < 0.4 && dice.chance(0.25)) {
    draft.giant = std::max(draft.radius, draft.narrow() * dice.in(0.08, 0.24));
    draft.giants = 1 + dice.below(2);
  }
}

void choose_motion(Dice& dice, WideDraft& draft) {
  draft.thermal = draft.units.speed * dice.pick({1.0, 1.0, 1.0, 0.1, 1e-3, 0.0});
  const bool flows = draft.thermal == 0.0 || dice.chance(0.35);
  if (flows) draft.flow = draft.units.speed * dice.pick({1.0, 3.0, 20.0});
  if (draft.shear == 0.0 && dice.chance(0.25)) {
    draft.gravity = rounded(draft.fastest() * draft.fastest() / draft.height * dice.decades(-3, 1));
  }
  draft.restitution = dice.chance(0.6) ? 1.0 : random_restitution(dice);
}

// In a run a disk moves by some distances to its neighbours, or through the box several times.
void choose_times(Dice& dice, WideDraft& draft) {
  const auto all = static_cast<double>(draft.disks + draft.giants);
  const double spacing = std::sqrt(draft.width * draft.height / all);
  const double speed = dice.chance(0.5) || draft.thermal == 0.0 ? draft.fastest() : draft.thermal;
  const double far = spacing * std::max(1.0, 0.2 / draft.packing * spacing / std::max(draft.width, draft.height));
  draft.t_end = far / speed * dice.in(0.5, draft.for_oracle ? 8.0 : 25.0);
  if (dice.chance(0.2)) draft.t_end *= 10.0;  // a run of many windows
  draft.t_end = std::min(draft.t_end, 300.0 * std::max(draft.width, draft.height) / draft.fastest());
  const bool brownian = !draft.for_oracle && draft.shear == 0.0 && dice.chance(0.08);
  if (draft.is_exact() && !brownian) return;
  draft.dt = rounded(draft.radius / draft.ratio / draft.fastest() * dice.pick({0.05, 0.2, 0.5, 1.0, 3.0}));
  draft.t_end = std::min(draft.t_end, draft.dt * (50.0 + 400.0 * dice.unit()));
  if (brownian) draft.diffusion = rounded(0.5 * draft.fastest() * draft.fastest() * draft.dt);
}

std::string moving_side(Dice& dice, const WideDraft& draft, bool across_x, bool far_side) {
  const double size = across_x ? draft.width : draft.height;
  const double speed = draft.fastest() * dice.decades(-2, 1);
  std::string motion;
  if (dice.chance(0.6)) {
    const double amplitude = rounded(size * dice.decades(-4, -1) * 0.5);
    motion = fmt::format("vibrate = [{}, {}], period = {}, shape = \"{}\"", across_x ? amplitude : 0.0,
                         across_x ? 0.0 : amplitude, rounded(6.0 * amplitude / speed),
                         dice.chance(0.5) ? "sine" : "parabola");
  } else {
    const double most = draft.t_end > 0.0 ? dice.in(0.01, 0.2) * size / draft.t_end : speed;
    double v = rounded(std::min(speed, most) * (far_side ? -1.0 : 1.0));
    if (dice.chance(0.3)) v = -v;
    motion = fmt::format("velocity = [{}, {}]", across_x ? v : 0.0, across_x ? 0.0 : v);
  }
  const double restitution = dice.chance(0.7) ? 1.0 : random_restitution(dice);
  return fmt::format("{{ kind = \"wall\", restitution = {}, motion = {{ {} }} }}", restitution, motion);
}

std::string side_text(Dice& dice, const WideDraft& draft, bool across_x, bool far_side) {
  if (across_x ? draft.periodic_x : draft.periodic_y) return "\"periodic\"";
  const double u = dice.unit();
  const double energy = draft.units.mass * draft.fastest() * draft.fastest();
  if (draft.diffusion == 0.0 && u < 0.2) return moving_side(dice, draft, across_x, far_side);
  if (u < 0.3) return fmt::format("{{ kind = \"wall\", restitution = {} }}", random_restitution(dice));
  if (draft.for_oracle) return "\"wall\"";
  if (u < 0.4) return "\"sink\"";
  if (u < 0.45 && draft.diffusion == 0.0) {
    return fmt::format("{{ kind = \"wall\", temperature = {} }}", rounded(energy * dice.in(0.1, 2.0)));
  }
  return "\"wall\"";
}

std::string box_text(Dice& dice, const WideDraft& draft) {
  std::string text = fmt::format("[box]\nwidth = {}\nheight = {}\n", draft.width, draft.height);
  text += fmt::format("left = {}\n", side_text(dice, draft, true, false));
  text += fmt::format("right = {}\n", side_text(dice, draft, true, true));
  text += fmt::format("bottom = {}\n", side_text(dice, draft, false, false));
  text += fmt::format("top = {}\n", side_text(dice, draft, false, true));
  if (draft.shear != 0.0) text += fmt::format("shear_rate = {}\n", draft.shear);
  return text;
}

std::string gravity_text(Dice& dice, double g) {
  if (dice.chance(0.5)) return fmt::format("gravity = {}\n", g);
  return fmt::format("gravity = [{}, {}]\n", rounded(g * dice.in(-1.0, 1.0)), rounded(g * dice.in(-1.0, 0.2)));
}

std::string thermostat_text(Dice& dice, const WideDraft& draft) {
  if (draft.for_oracle || draft.diffusion > 0.0 || !dice.chance(0.06)) return "";
  const double least = draft.dt > 0.0 ? draft.dt : 0.02 * draft.t_end;
  const double dt = least * dice.in(1.0, 10.0);
  return fmt::format("thermostat = {{ kind = \"{}\", temperature = {}, rate = {}, dt = {} }}\n",
                     dice.chance(0.5) ? "langevin" : "andersen",
                     rounded(draft.units.mass * draft.fastest() * draft.fastest() * dice.in(0.05, 1.0)),
                     rounded(dice.in(0.01, 0.9) / dt), dt);
}

std::string physics_text(Dice& dice, const WideDraft& draft) {
  std::string text = "[physics]\n";
  if (draft.gravity > 0.0) text += gravity_text(dice, draft.gravity);
  if (draft.restitution < 1.0) text += fmt::format("restitution = {}\n", draft.restitution);
  if (draft.diffusion > 0.0) text += fmt::format("diffusion = {}\n", draft.diffusion);
  text += thermostat_text(dice, draft);
  if (draft.for_oracle || draft.shear != 0.0 || !draft.is_exact()) return text;
  if (!dice.chance(draft.restitution < 1.0 ? 0.5 : 0.05)) return text;
  const double time = 1e-3 * draft.units.length / draft.fastest() * dice.decades(-2, 1);
  return text + fmt::format("collapse = {{ model = \"tc\", contact_time = {} }}\n", rounded(time));
}

std::string masses_text(Dice& dice, const WideDraft& draft, double heavier) {
  const double mass = rounded(draft.units.mass * heavier);
  if (dice.chance(0.5)) return fmt::format("mass = {}\n", mass);
  return fmt::format("mass = {{ uniform = [{}, {}] }}\n", rounded(mass * dice.pick({0.5, 0.05, 1e-3})), mass);
}

std::string motion_text(Dice& dice, const WideDraft& draft, std::size_t count, double direction) {
  std::string text;
  if (draft.thermal > 0.0) {
    text = count > 1 && dice.chance(0.6) ? fmt::format("velocities = {{ maxwell = {} }}\n",
                                                       rounded(draft.units.mass * draft.thermal * draft.thermal * 0.5))
                                         : fmt::format("velocities = {{ uniform = {} }}\n", rounded(draft.thermal));
  }
  if (draft.flow == 0.0) return text;
  const double u = dice.unit();
  const double vx = draft.flow * direction * (u < 0.5 ? 1.0 : u < 0.7 ? 0.0 : dice.in(-1.0, 1.0));
  const double vy = draft.flow * (u < 0.5 ? 0.0 : u < 0.7 ? direction : dice.in(-1.0, 1.0));
  return text + fmt::format("drift = [{}, {}]\n", rounded(vx), rounded(vy));
}

std::string small_disks_text(Dice& dice, const WideDraft& draft, std::size_t count, double direction) {
  const bool crowded = draft.packing > 0.4;
  const char* const positions = !crowded                                 ? "random"
                                : draft.ratio == 1.0 && dice.chance(0.6) ? dice.pick({"square", "hexagonal"})
                                                                         : "growth";
  std::string text = fmt::format("[[disks]]\ncount = {}\npositions = \"{}\"\n", count, positions);
  text += motion_text(dice, draft, count, direction);
  const double r = draft.radius;
  text += draft.ratio == 1.0 ? fmt::format("radius = {}\n", r)
                             : fmt::format("radius = {{ uniform = [{}, {}] }}\n", rounded(r / draft.ratio), r);
  text += masses_text(dice, draft, 1.0);
  if (crowded || !dice.chance(0.3)) return text;
  // A cluster half as dense as random disks can be.
  const double size = r * std::sqrt(static_cast<double>(count) / 0.25) + r;
  if (size > 0.5 * draft.narrow()) return text;
  const double x = dice.in(size, draft.width - size);
  const double y = dice.in(size, draft.height - size);
  return text + fmt::format("region = {{ circle = [{}, {}, {}] }}\n", x, y, size);
}

std::string disks_text(Dice& dice, const WideDraft& draft) {
  std::string text;
  if (draft.giants > 0) {
    text += fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\nradius = {}\n", draft.giants, draft.giant);
    if (dice.chance(0.3)) text += fmt::format("velocities = {{ uniform = {} }}\n", rounded(0.1 * draft.fastest()));
    text += masses_text(dice, draft, dice.pick({1.0, 100.0, 1e6}));
  }
  const bool jets = draft.packing < 0.4 && draft.disks > 1 && dice.chance(0.4);
  const std::size_t first = jets ? 1 + dice.below(draft.disks - 1) : draft.disks;
  text += small_disks_text(dice, draft, first, 1.0);
  if (jets) text += small_disks_text(dice, draft, draft.disks - first, dice.pick({-1.0, 0.0, 1.0}));
  if (draft.packing < 0.4 && dice.chance(0.15)) {  // one disk that is faster than all others
    const double v = draft.fastest() * dice.pick({3.0, 20.0});
    text += fmt::format("[[disks]]\ncount = 1\npositions = \"random\"\nvelocities = [[{}, {}]]\nradius = {}\n",
                        rounded(v), rounded(v * dice.in(-1.0, 1.0)), draft.radius);
    text += masses_text(dice, draft, dice.pick({1.0, 0.01}));
  }
  return text;
}

std::string sources_text(Dice& dice, const WideDraft& draft) {
  if (draft.for_oracle || draft.shear != 0.0 || !dice.chance(0.15)) return "";
  std::string text = "[[sources]]\n";
  if (!draft.periodic_x && dice.chance(0.5)) {
    text += fmt::format("side = \"{}\"\n", dice.pick({"left", "right"}));
  } else {
    const double x = dice.in(0.0, 0.9), y = dice.in(0.0, 0.9);
    text += fmt::format("region = [{}, {}, {}, {}]\n", x * draft.width, y * draft.height, draft.width * dice.in(x, 1.0),
                        draft.height * dice.in(y, 1.0));
  }
  text += fmt::format("rate = {}\n", rounded(dice.decades(0, 2) / draft.t_end));
  text += fmt::format("velocities = {{ uniform = {} }}\n", rounded(draft.fastest() * dice.unit()));
  return text + fmt::format("radius = {}\nmass = {}\n", rounded(draft.radius * dice.in(0.1, 1.0)), draft.units.mass);
}

std::string run_text(Dice& dice, const WideDraft& draft) {
  std::string text = fmt::format("[run]\nmethod = \"{}\"\n", draft.method);
  if (draft.dt > 0.0) text += fmt::format("dt = {}\n", draft.dt);
  text += fmt::format("t_end = {}\n[output]\nseries = true\nevery = {}\n", draft.t_end,
                      rounded(draft.t_end / dice.in(1.0, 60.0)));
  if (draft.for_oracle || !dice.chance(0.05)) return text;
  return text +
         fmt::format("[analysis]\nwhat = [\"speeds\", \"density\", \"pressure\", \"displacement\"]\nevery = {}\n",
                     rounded(draft.t_end / 7.0));
}

WideDraft choose(Dice& dice, bool for_oracle) {
  WideDraft draft;
  draft.for_oracle = for_oracle;
  draft.method = for_oracle ? "exact" : wide_method(dice);
  draft.units = wide_units(dice);
  choose_sides(dice, draft);
  choose_disks(dice, draft);
  choose_motion(dice, draft);
  choose_times(dice, draft);
  return draft;
}

std::string text_of(Dice& dice, const WideDraft& draft, const std::string& title) {
  std::string text = fmt::format("title = \"{}\"\nseed = {}\n", title, dice.below(1'000'000));
  text += box_text(dice, draft);
  text += physics_text(dice, draft);
  text += disks_text(dice, draft);
  if (draft.shear == 0.0) {
    text += wide_obstacles_text(dice, draft);
    text += wide_walls_text(dice, draft);
  }
  text += sources_text(dice, draft);
  text += run_text(dice, draft);
  text = with_restitution_laws(dice, draft.units, draft.restitution, draft.diffusion > 0.0, std::move(text));
  if (draft.diffusion > 0.0 || !dice.chance(0.1)) return text;
  return with_rough_disks(dice, draft.units, draft.radius, draft.is_exact() && draft.gravity > 0.0, text);
}

}  // namespace

std::string wide_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt) {
  Dice dice(seed ^ 0x77696465ULL, number, attempt);
  const WideDraft draft = choose(dice, false);
  return text_of(dice, draft, fmt::format("wide scene {}.{} of seed {}", number, attempt, seed));
}

std::string wide_oracle_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt) {
  Dice dice(seed ^ 0x776f7261636cULL, number, attempt);
  const WideDraft draft = choose(dice, true);
  return text_of(dice, draft, fmt::format("wide oracle scene {}.{} of seed {}", number, attempt, seed));
}

}  // namespace carom::fuzz
