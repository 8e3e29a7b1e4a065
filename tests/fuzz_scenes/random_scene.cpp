#include "tests/fuzz_scenes/random_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "tests/fuzz_scenes/random_disks.hpp"
#include "tests/fuzz_scenes/random_restitution.hpp"
#include "tests/fuzz_scenes/random_roughness.hpp"

namespace carom::fuzz {

namespace {

enum Sides : std::size_t { left, right, bottom, top };

struct Draft {
  std::string method;
  Units units;
  Cast cast = Cast::gas;
  Crowd crowd;
  double width = 0.0, height = 0.0;
  std::array<std::string, 4> sides;
  double shear = 0.0;  // only in a box periodic along both axes, without other forces
  double gravity = 0.0, restitution = 1.0, wall_restitution = 1.0, diffusion = 0.0;
  bool only_reflects = false;  // walls that only reflect: no thermal ones
  double speed = 0.0;          // typical speed of disks
  double dt = 0.0, t_end = 0.0;

  double spacing() const {
    return std::sqrt(width * height / static_cast<double>(std::max<std::size_t>(crowd.disks, 1)));
  }
};

Units random_units(Dice& dice) {
  if (dice.chance(0.7)) return {};
  const auto power = [&](int most) {
    const int k = static_cast<int>(dice.below(static_cast<std::size_t>(2 * most + 1))) - most;
    return std::ldexp(1.0, k);
  };
  return {power(20), power(30), power(20)};
}

Cast random_cast(Dice& dice) {
  const double u = dice.unit();
  if (u < 0.36) return Cast::gas;
  if (u < 0.48) return Cast::few;
  if (u < 0.68) return Cast::touching;
  if (u < 0.78) return Cast::giants;
  if (u < 0.82) return Cast::grown;
  if (u < 0.86) return Cast::crowd;
  if (u < 0.96) return Cast::pile;
  return Cast::none;
}

std::string random_method(Dice& dice) {
  const double u = dice.unit();
  return u < 0.45 ? "exact" : u < 0.78 ? "pairwise" : u < 0.98 ? "rollback" : "auto";
}

void choose_sides(Dice& dice, Draft& draft) {
  draft.sides.fill("wall");
  const std::size_t kind = dice.below(8);
  if (kind == 0 || kind == 1 || kind == 2) draft.sides[left] = draft.sides[right] = "periodic";
  if (kind == 1 || kind == 2 || kind == 3) draft.sides[bottom] = draft.sides[top] = "periodic";
  if (kind < 5) return;
  for (std::string& side : draft.sides) {
    if (side == "wall" && dice.chance(0.4)) side = "sink";
  }
}

// Strains of up to some units while disks move by about their distance.
void choose_shear(Dice& dice, Draft& draft) {
  const bool periodic =
      std::all_of(draft.sides.begin(), draft.sides.end(), [](const std::string& s) { return s == "periodic"; });
  const bool some = draft.cast == Cast::gas || draft.cast == Cast::few || draft.cast == Cast::touching;
  if (!periodic || !some || draft.crowd.width > 0.0 || !dice.chance(0.5)) return;
  const double rate = draft.units.speed / draft.crowd.largest * dice.decades(-3, 0);
  draft.shear = rounded(dice.chance(0.5) ? rate : -rate);
  if (draft.method == "auto") draft.method = "pairwise";
}

void choose_box(Dice& dice, Draft& draft) {
  const double r = draft.crowd.largest;
  if (draft.crowd.width > 0.0) {
    draft.width = draft.crowd.width;
    draft.height = draft.crowd.height;
    return;
  }
  const double area =
      draft.crowd.disks == 0 ? r * r * dice.in(20.0, 1000.0) : draft.crowd.area / draft.crowd.packing_fraction;
  const double aspect = dice.chance(0.7) ? dice.in(0.5, 2.0) : dice.decades(-2, 2);
  double narrowest = dice.chance(0.1) ? 4.0 * r : 4.01 * r;  // two diameters, the least width of a periodic box
  if (draft.shear != 0.0) narrowest *= 2.0;
  draft.height = std::max(narrowest, std::sqrt(area / aspect));
  draft.width = std::max(narrowest, area / draft.height);
  draft.height = std::max(narrowest, area / draft.width);
}

void choose_physics(Dice& dice, Draft& draft) {
  const bool pile = draft.cast == Cast::pile;
  const Units& units = draft.units;
  const double v2 = units.speed * units.speed;
  if (pile || dice.chance(0.35)) {
    draft.gravity =
        pile ? rounded(v2 / units.length * dice.in(0.1, 2.0)) : rounded(v2 / draft.height * dice.decades(-2, 1));
  }
  draft.restitution = pile ? dice.pick({0.0, 0.2, 0.5, 0.8}) : random_restitution(dice);
  draft.wall_restitution = random_restitution(dice);
  if (draft.shear != 0.0) draft.gravity = 0.0;
  draft.speed = units.speed;
  if (draft.crowd.at_rest) draft.speed = std::max(1e-3 * units.speed, std::sqrt(draft.gravity * units.length));
}

void choose_times(Dice& dice, Draft& draft) {
  const bool crowd = draft.cast == Cast::crowd;
  const bool pile = draft.cast == Cast::pile;
  const bool exact = draft.method == "exact";
  const double share =
      dice.chance(0.85) ? dice.pick({0.03, 0.1, 0.3, 0.5, 0.7, 1.0}) : dice.pick({1e-6, 1e-3, 3.0, 10.0});
  const double dt = rounded(share * draft.crowd.smallest / draft.speed);
  const auto steps = static_cast<double>(crowd ? 3 + dice.below(6) : pile ? 20 + dice.below(300) : 10 + dice.below(70));
  const double part = dice.chance(0.7) ? 0.0 : dice.unit();  // part of a step that is left over at the end
  const bool brownian = dice.chance(0.18) && draft.shear == 0.0;
  if (!exact || brownian) draft.dt = dt;
  if (brownian) draft.diffusion = rounded(0.5 * draft.speed * draft.speed * dt);
  draft.t_end = (steps + part) * dt;
  if (exact && !brownian) {
    draft.t_end = draft.spacing() / draft.speed * (crowd ? dice.in(0.2, 2.0) : dice.in(0.3, 30.0));
  }
  if (draft.method == "auto") draft.t_end = 3.0 * draft.crowd.smallest / draft.speed;
  if (dice.chance(0.01)) draft.t_end = 0.0;
}

// Some walls have their own restitution, or a temperature.
std::string side_line(Dice& dice, const Draft& draft, std::string_view name, const std::string& kind) {
  if (kind == "wall" && !draft.only_reflects && draft.diffusion == 0.0 && dice.chance(0.04)) {
    const double energy = draft.units.mass * draft.units.speed * draft.units.speed;
    return fmt::format("{} = {{ kind = \"wall\", temperature = {} }}\n", name, rounded(energy * dice.decades(-1, 1)));
  }
  if (kind == "wall" && draft.diffusion == 0.0 && dice.chance(0.05)) {
    const bool across_x = name == "left" || name == "right";
    const double amplitude = rounded((across_x ? draft.width : draft.height) * dice.decades(-4, -2));
    const double period = rounded(amplitude / draft.units.speed * dice.decades(0, 2));
    return fmt::format("{} = {{ motion = {{ vibrate = [{}, {}], period = {}, shape = \"{}\" }} }}\n", name,
                       across_x ? amplitude : 0.0, across_x ? 0.0 : amplitude, period,
                       dice.chance(0.5) ? "sine" : "parabola");
  }
  if (kind != "wall" || !dice.chance(0.1)) return fmt::format("{} = \"{}\"\n", name, kind);
  return fmt::format("{} = {{ kind = \"wall\", restitution = {} }}\n", name, random_restitution(dice));
}

std::string box_text(Dice& dice, const Draft& draft) {
  std::string text = "[box]\n";
  if (draft.crowd.packing_fraction > 0.0 && dice.chance(0.25)) {
    text += fmt::format("packing_fraction = {}\naspect = {}\n",
                        rounded(draft.crowd.area / (draft.width * draft.height)), rounded(draft.width / draft.height));
  } else {
    text += fmt::format("width = {}\nheight = {}\n", draft.width, draft.height);
  }
  if (draft.shear != 0.0) text += fmt::format("shear_rate = {}\n", draft.shear);
  constexpr std::array<const char*, 4> names{"left", "right", "bottom", "top"};
  for (std::size_t s = 0; s < names.size(); ++s) text += side_line(dice, draft, names[s], draft.sides[s]);
  if (draft.wall_restitution < 1.0) text += fmt::format("wall_restitution = {}\n", draft.wall_restitution);
  return text;
}

// Mostly downwards, otherwise along another axis or in any direction.
std::string gravity_text(Dice& dice, double g) {
  if (dice.chance(0.6)) return fmt::format("{}", g);
  if (dice.chance(0.3)) return dice.pick({0.0, 1.0}) > 0.0 ? fmt::format("[{}, 0]", g) : fmt::format("[{}, 0]", -g);
  return fmt::format("[{}, {}]", rounded(g * dice.in(-1.0, 1.0)), rounded(g * dice.in(-1.0, 0.2)));
}

// In some scenes with real velocities.
std::string thermostat_text(Dice& dice, const Draft& draft) {
  if (draft.diffusion > 0.0 || !dice.chance(0.08)) return "";
  const double energy = draft.units.mass * draft.units.speed * draft.units.speed;
  const double least = draft.dt > 0.0 ? draft.dt : 0.01 * draft.crowd.smallest / draft.speed;
  const double dt = dice.chance(0.3) ? least : least * dice.in(1.0, 30.0);
  return fmt::format("thermostat = {{ kind = \"{}\", temperature = {}, rate = {}, dt = {} }}\n",
                     dice.chance(0.5) ? "langevin" : "andersen", rounded(energy * dice.in(0.05, 1.0)),
                     rounded(dice.in(0.01, 0.9) / dt), dt);
}

std::string physics_text(Dice& dice, const Draft& draft) {
  std::string text = "[physics]\n";
  if (draft.gravity > 0.0) text += fmt::format("gravity = {}\n", gravity_text(dice, draft.gravity));
  if (draft.restitution < 1.0) text += fmt::format("restitution = {}\n", draft.restitution);
  if (draft.diffusion > 0.0) text += fmt::format("diffusion = {}\n", draft.diffusion);
  if (draft.diffusion > 0.0 && dice.chance(0.3)) text += "accumulate = true\n";
  text += thermostat_text(dice, draft);
  if (draft.shear != 0.0) return text;
  const bool dissipates = draft.restitution < 1.0 || draft.wall_restitution < 1.0;
  if (!dice.chance(draft.method != "exact" ? 0.04 : dissipates ? 0.85 : 0.1)) return text;
  // A heap at rest has some events per contact in each contact time.
  const double least = dice.chance(0.05) ? 0.0 : 2e-5 * static_cast<double>(draft.crowd.disks) * draft.t_end;
  const double time = std::max(least, draft.units.length / draft.units.speed * dice.decades(-6, 0));
  return text + fmt::format("collapse = {{ model = \"tc\", contact_time = {} }}\n", rounded(time));
}

// The crowd's text, in some scenes with a region, which is most of the box, so that there is room for all disks.
std::string disks_text(Dice& dice, const Draft& draft) {
  std::string text = draft.crowd.text;
  for (std::size_t at = 0; (at = text.find(region_mark, at)) != std::string::npos;) {
    std::string region;
    const bool thin = draft.crowd.packing_fraction < 0.3;
    if (thin && dice.chance(0.15)) {
      const double x = draft.width * dice.in(0.0, 0.08), y = draft.height * dice.in(0.0, 0.08);
      region = fmt::format("region = [{}, {}, {}, {}]\n", x, y, draft.width * dice.in(0.92, 1.0), draft.height * 0.95);
      if (dice.chance(0.3)) region = fmt::format("region = [0.0, {}, {}, {}]\n", y, draft.width, draft.height * 0.95);
    }
    text.replace(at, region_mark.size(), region);
  }
  return text;
}

// Fixed disks, after the others; if the disks are listed one by one the fixed disks are along the left side.
std::string obstacles_text(Dice& dice, const Draft& draft) {
  const bool room = draft.cast == Cast::gas || draft.cast == Cast::few || draft.cast == Cast::pile ||
                    draft.cast == Cast::none || draft.cast == Cast::grown;
  if (!room || draft.crowd.packing_fraction > (draft.cast == Cast::grown ? 0.6 : 0.4) || !dice.chance(0.25)) return "";
  const double r = draft.crowd.disks > 0 ? draft.crowd.largest : 0.1 * std::min(draft.width, draft.height);
  const std::size_t count = 1 + dice.below(5);
  const double largest = rounded(0.25 * r * dice.pick({1e-3, 0.1, 1.0}));
  return fmt::format("[[disks]]\nfixed = true\ncount = {}\npositions = \"random\"\nradius = {{ uniform = [{}, {}] }}\n",
                     count, 0.5 * largest, largest);
}

// Some walls vibrate, or drift as far as their room allows; across periodic sides they drift without limit.
std::string wall_motion_line(Dice& dice, const Draft& draft, double x, double y, double length) {
  if (draft.only_reflects || draft.diffusion > 0.0 || !dice.chance(0.4)) return "";
  const auto room = [&](double c, double size) { return std::max(0.0, std::min(c, size - c) - length); };
  const double free_x = room(x, draft.width);
  const double free_y = room(y, draft.height);
  if (dice.chance(0.5)) {
    const double ax = rounded(free_x * dice.decades(-4, -1));
    const double ay = rounded(free_y * dice.decades(-4, -1));
    const double size = std::max(ax, ay);
    if (!(size > 0.0)) return "";
    return fmt::format("motion = {{ vibrate = [{}, {}], period = {}, shape = \"{}\" }}\n", ax, -ay,
                       rounded(size / draft.units.speed * dice.decades(0, 2)), dice.chance(0.5) ? "sine" : "parabola");
  }
  const auto speed = [&](bool periodic, double free) {
    const double wanted = draft.units.speed * dice.decades(-2, 0);
    return rounded(periodic || !(draft.t_end > 0.0) ? wanted : std::min(wanted, 0.9 * free / draft.t_end));
  };
  const double vx = speed(draft.sides[left] == "periodic", free_x);
  const double vy = speed(draft.sides[bottom] == "periodic", free_y);
  return vx > 0.0 || vy > 0.0 ? fmt::format("motion = {{ velocity = [{}, {}] }}\n", -vx, vy) : "";
}

// Short inner walls, some of them sinks unless there is Brownian motion.
std::string walls_text(Dice& dice, const Draft& draft) {
  const bool room =
      draft.cast == Cast::gas || draft.cast == Cast::few || draft.cast == Cast::pile || draft.cast == Cast::grown;
  if (!room || draft.crowd.packing_fraction > (draft.cast == Cast::grown ? 0.55 : 0.35) || !dice.chance(0.2)) return "";
  std::string text;
  for (std::size_t k = 1 + dice.below(3); k > 0; --k) {
    const double length = draft.crowd.largest * dice.pick({0.01, 0.5, 2.0});
    const auto near = [&](double c, double side) { return std::clamp(c + length * dice.in(-1.0, 1.0), 0.0, side); };
    const double x = draft.width * dice.unit();
    const double y = draft.height * dice.unit();
    text += fmt::format("[[walls]]\npoints = [[{}, {}], [{}, {}], [{}, {}]]\n", x, y, near(x, draft.width),
                        near(y, draft.height), near(x, draft.width), near(y, draft.height));
    if (!draft.only_reflects && draft.diffusion == 0.0 && dice.chance(0.15)) {
      text += "kind = \"sink\"\n";
    } else if (dice.chance(0.5)) {
      text += fmt::format("restitution = {}\n", random_restitution(dice));
    }
    text += wall_motion_line(dice, draft, x, y, length);
  }
  return text;
}

std::string sources_text(Dice& dice, const Draft& draft) {
  if (draft.shear != 0.0) return "";
  const std::size_t sources = draft.cast == Cast::none ? 1 + dice.below(2) : dice.chance(0.2) ? 1 + dice.below(3) : 0;
  std::string text;
  for (std::size_t k = 0; k < sources; ++k) {
    text += "[[sources]]\n";
    constexpr std::array<const char*, 4> names{"left", "right", "bottom", "top"};
    const std::size_t side = dice.below(names.size());
    if (draft.sides[side] != "periodic" && dice.chance(0.6)) {
      text += fmt::format("side = \"{}\"\n", names[side]);
    } else {
      const double x = dice.in(0.0, 0.5);
      const double y = dice.in(0.0, 0.5);
      const double x1 = dice.in(x, 1.0);
      const double y1 = dice.in(y, 1.0);
      text += fmt::format("region = [{}, {}, {}, {}]\n", x * draft.width, y * draft.height, x1 * draft.width,
                          y1 * draft.height);
    }
    const double time = draft.t_end > 0.0 ? draft.t_end : 1.0;
    text += fmt::format("rate = {}\n", rounded(dice.decades(-1, 2) / time));
    if (dice.chance(0.3)) text += fmt::format("limit = {}\n", dice.below(12));
    if (dice.chance(0.4)) {
      text += fmt::format("velocities = {{ uniform = {} }}\n", rounded(draft.units.speed * dice.unit()));
    } else if (dice.chance(0.8)) {
      const double mass = draft.units.mass * draft.units.speed * draft.units.speed;
      text += fmt::format("velocities = {{ maxwell = {} }}\n", rounded(mass * dice.unit()));
    }
    text += random_sizes(dice, draft.units, draft.crowd.largest * dice.in(0.05, 1.0));
  }
  return text;
}

std::string seed_text(Dice& dice) {
  return dice.chance(0.02) ? "seed = \"18446744073709551615\"\n" : fmt::format("seed = {}\n", dice.below(1'000'000));
}

std::string run_text(Dice& dice, const Draft& draft) {
  std::string text = fmt::format("[run]\nmethod = \"{}\"\n", draft.method);
  if (draft.method == "auto") text += "accuracy = 0.01\n";
  if (draft.dt > 0.0 && draft.method != "auto") text += fmt::format("dt = {}\n", draft.dt);
  text += fmt::format("t_end = {}\n[output]\nseries = true\n", draft.t_end);
  if (dice.chance(0.8)) text += fmt::format("every = {}\n", rounded(draft.t_end / dice.in(1.0, 40.0)));
  if (!dice.chance(0.1)) return text;
  text += fmt::format("[analysis]\nwhat = [\"speeds\", \"density\", \"pressure\"{}]\nevery = {}\n",
                      dice.chance(0.5) ? ", \"displacement\", \"bond_order\", \"bond_autocorrelation\"" : "",
                      rounded(draft.t_end / 7.0));
  return text;
}

}  // namespace

std::string random_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt) {
  Dice dice(seed, number, attempt);
  Draft draft;
  draft.method = random_method(dice);
  draft.units = random_units(dice);
  draft.cast = random_cast(dice);
  draft.crowd = random_crowd(dice, draft.cast, draft.units);
  choose_sides(dice, draft);
  choose_shear(dice, draft);
  choose_box(dice, draft);
  choose_physics(dice, draft);
  choose_times(dice, draft);
  std::string text = fmt::format("title = \"random scene {}.{} of seed {}\"\n", number, attempt, seed);
  text += seed_text(dice);
  text += box_text(dice, draft);
  text += physics_text(dice, draft);
  text += disks_text(dice, draft);
  if (draft.shear == 0.0) {  // if a moving side runs into one, the scene is drawn again
    text += obstacles_text(dice, draft);
    text += walls_text(dice, draft);
  }
  text += sources_text(dice, draft);
  if (draft.cast == Cast::grown && dice.chance(0.3)) text += "[growth]\nslowness = 0.5\nsteps = 2000\n";
  text += run_text(dice, draft);
  text = with_restitution_laws(dice, draft.units, draft.restitution, draft.diffusion > 0.0, std::move(text));
  if (draft.diffusion > 0.0 || !dice.chance(0.15)) return text;
  return with_rough_disks(dice, draft.units, draft.crowd.largest, draft.method == "exact" && draft.gravity > 0.0, text);
}

std::string random_oracle_scene(std::uint64_t seed, std::uint32_t number, std::uint32_t attempt) {
  Dice dice(seed ^ 0x6f7261636c65ULL, number, attempt);
  Draft draft;
  draft.method = "exact";
  draft.only_reflects = true;
  draft.units = random_units(dice);
  draft.cast = dice.chance(0.3) ? Cast::few : Cast::gas;
  const std::size_t disks = draft.cast == Cast::few ? 1 + dice.below(4) : 5 + dice.below(18);
  draft.crowd = random_gas(dice, disks, draft.units);
  draft.sides.fill("wall");
  if (dice.chance(0.5)) draft.sides[left] = draft.sides[right] = "periodic";
  if (dice.chance(0.4)) draft.sides[bottom] = draft.sides[top] = "periodic";
  choose_shear(dice, draft);
  choose_box(dice, draft);
  choose_physics(dice, draft);
  draft.t_end = draft.spacing() / draft.speed * dice.in(1.0, 15.0);
  std::string text = fmt::format("title = \"oracle scene {}.{} of seed {}\"\n", number, attempt, seed);
  text += seed_text(dice);
  text += box_text(dice, draft);
  text +=
      fmt::format("[physics]\ngravity = {}\nrestitution = {}\n", gravity_text(dice, draft.gravity), draft.restitution);
  text += disks_text(dice, draft);
  if (draft.shear == 0.0) {  // if a moving side runs into one, the scene is drawn again
    text += obstacles_text(dice, draft);
    text += walls_text(dice, draft);
  }
  text += run_text(dice, draft);
  text = with_restitution_laws(dice, draft.units, draft.restitution, draft.diffusion > 0.0, std::move(text));
  if (!dice.chance(0.25)) return text;
  return with_rough_disks(dice, draft.units, draft.crowd.largest, draft.gravity > 0.0, text);
}

}  // namespace carom::fuzz
