#include "app/chart/chart_scenes.hpp"

#include <fmt/format.h>

#include "core/load/scene_file.hpp"

namespace carom::chart {

namespace {

std::string periodic_box(double packing_fraction) {
  return fmt::format(
      "[box]\npacking_fraction = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\n",
      packing_fraction);
}

std::string equal_disks(std::size_t count) {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"hexagonal\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n",
      count);
}

std::string sheared_box(double packing_fraction, double rate) {
  return periodic_box(packing_fraction) + fmt::format("shear_rate = {}\n", rate);
}

std::string placed_disks(std::size_t count) {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n",
      count);
}

std::string mixed_disks(std::size_t count) {
  return fmt::format(
      "[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\n"
      "radius = {{ uniform = [0.3, 0.7] }}\nmass = {{ from_radius = 1.2732 }}\n",
      count);
}

// At v = 4 sqrt(kT / m), which some disk always has, pairwise divides steps above 0.0625 diameters.
constexpr double longest_step = 0.064;

// Walls in a gas that can catch disks: polylines with acute wedges of 30 degrees and less, inner corners, and free ends
// that disks graze.
std::string corners() {
  std::string text = "[box]\nwidth = 36.0\nheight = 36.0\nleft = \"periodic\"\nright = \"periodic\"\n";
  for (const double x : {2.0, 14.0, 26.0}) {
    for (const double y : {3.0, 21.0}) {
      text += fmt::format("[[walls]]\npoints = [[{}, {}], [{}, {}], [{}, {}], [{}, {}]]\n", x, y, x + 6.0, y + 1.5, x,
                          y + 3.0, x + 6.0, y + 3.0);
      text += fmt::format("[[walls]]\npoints = [[{}, {}], [{}, {}], [{}, {}]]\n", x + 8.0, y, x + 8.0, y + 5.0, x + 3.0,
                          y + 5.0);
    }
  }
  return text;
}

// A channel three diameters high whose floor rises by one: disks between walls that close until there is just room for
// two of them, one above the other.
// above the other, just have room.
const char* const closing_walls =
    "[box]\nwidth = 200.0\nheight = 3.0\nleft = \"periodic\"\nright = \"periodic\"\ntop = \"wall\"\n"
    "bottom = { motion = { vibrate = [0.0, 0.5], period = 5.0 } }\n";

std::vector<ChartScene> make_scenes() {
  constexpr std::size_t many = 1024;
  const std::string walls = "[box]\nwidth = 36.0\nheight = 36.0\n[physics]\ngravity = 0.1\n";
  return {
      {"dilute", "dilute gas, fraction 0.1", periodic_box(0.1) + equal_disks(many), 20.0, 3.75, 24.0, longest_step},
      {"fluid", "fluid, fraction 0.5", periodic_box(0.5) + equal_disks(many), 4.0, 0.28, 3.5, longest_step},
      {"dense", "dense, fraction 0.68", periodic_box(0.68) + equal_disks(many), 6.0, 0.1, 1.3, longest_step},
      {"cooling", "granular cooling, e = 0.9", periodic_box(0.3) + "[physics]\nrestitution = 0.9\n" + equal_disks(many),
       6.0, 0.8, 10.0, longest_step, Figure::cooling, false},
      {"gravity", "gravity with walls", walls + equal_disks(500), 60.0, 0.8, 10.0, longest_step, Figure::pressure, true,
       false},
      {"mixed", "mixed radii and masses", periodic_box(0.5) + mixed_disks(many), 4.0, 0.28, 3.5, longest_step},
      {"brownian", "Brownian motion", periodic_box(0.3) + "[physics]\ndiffusion = 1.0\n" + equal_disks(400), 6.0,
       0.0256, 0.256, 0.0064, Figure::spread, false, false},
      {"corners", "corners, wedges and ends", corners() + placed_disks(300), 60.0, 0.8, 10.0, longest_step,
       Figure::pressure, true, false},
      {"closing", "between walls that close", closing_walls + placed_disks(200), 60.0, 0.8, 10.0, longest_step,
       Figure::pressure, true, false},
      {"shear", "shear flow, fraction 0.5", sheared_box(0.5, 0.1) + equal_disks(many), 4.0, 0.28, 3.5, longest_step},
  };
}

}  // namespace

const std::vector<ChartScene>& chart_scenes() {
  static const std::vector<ChartScene> scenes = make_scenes();
  return scenes;
}

ChartScene fluid_of(std::size_t disks) {
  return {"fluid", "", periodic_box(0.5) + equal_disks(disks), 1.0, 0.0, 0.32, longest_step};
}

Scene scene_of(const ChartScene& scene, std::uint64_t seed, Method method, double dt, double t_end) {
  if (scene.own) {
    Scene own = *scene.own;
    own.seed += seed - 1;
    own.run = RunPlan{};
    own.run.method = method;
    own.run.dt = dt;
    own.run.t_end = t_end;
    return own;
  }
  // A step is needed for parsing; the melting of a Brownian scene has none.
  Scene s = parse_scene(scene.text + "[run]\nmethod = \"exact\"\ndt = 1.0\nt_end = 0.0\n", scene.name, "",
                        {{"seed", fmt::format("{}", seed)}});
  s.run = RunPlan{};
  s.run.method = method;
  s.run.dt = dt;
  s.run.t_end = t_end;
  return s;
}

}  // namespace carom::chart
