#include "bench/support/gas_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carom::bench {

namespace {

const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
const std::string walls = "left = \"wall\"\nright = \"wall\"\nbottom = \"wall\"\ntop = \"wall\"\n";

// A thousand pegs, or corners of a polyline, 0.6 above and below the middle of the strip at the bottom.
std::string row_of_places(double width) {
  constexpr int places = 1000;
  std::string list;
  for (int k = 0; k < places; ++k) {
    list += fmt::format("[{:.3f}, {:.1f}], ", width * (k + 0.5) / places, k % 2 == 0 ? 1.4 : 2.6);
  }
  return list;
}

GasFeature feature(std::string name, std::string physics) {
  return {std::move(name), periodic, std::move(physics)};
}

}  // namespace

std::vector<GasFeature> gas_features() {
  std::vector<GasFeature> all{
      feature("plain", ""),
      feature("gravity", "gravity = 0.001\n"),
      feature("tilted_gravity", "gravity = [0.0005, -0.001]\n"),
      feature("inelastic", "restitution = 0.99\n"),
      feature("viscoelastic", "restitution = { viscoelastic = 0.01 }\n"),
      feature("pairs", "[[physics.pairs]]\ngroups = [\"gas\", \"gas\"]\nrestitution = 0.99\n"),
      feature("rough", "roughness = { tangential_restitution = 0.99 }\n"),
      // The speed of a step, sqrt(2 D / dt), is 1 as in the plain gas.
      feature("brownian", "diffusion = 0.0025\n"),
      feature("langevin", "thermostat = { kind = \"langevin\", temperature = 1.0, rate = 0.01, dt = 0.05 }\n"),
      feature("andersen", "thermostat = { kind = \"andersen\", temperature = 1.0, rate = 0.01, dt = 0.05 }\n"),
      feature("radii", ""),
      feature("masses", ""),
      {"walls", walls, ""},
      {"thermal_walls",
       "left = { temperature = 1.0 }\nright = { temperature = 1.0 }\nbottom = \"periodic\"\n"
       "top = \"periodic\"\n",
       ""},
      {"moving_wall",
       "left = \"wall\"\nright = \"wall\"\ntop = \"wall\"\n"
       "bottom = { motion = { vibrate = [0.0, 0.01], period = 2.0 } }\n",
       ""},
      {"shear", periodic + "shear_rate = 0.0001\n", ""},
      feature("fixed_disks", ""),
      feature("inner_walls", ""),
      feature("moving_inner_walls", "")};
  const auto named = [&](const char* name) -> GasFeature& {
    return *std::find_if(all.begin(), all.end(), [&](const GasFeature& f) { return f.name == name; });
  };
  named("brownian").velocities = "";
  named("radii").radius = "{ uniform = [0.45, 0.55] }";
  named("masses").mass = "{ uniform = [0.5, 1.5] }";
  named("fixed_disks").obstacles = "[[disks]]\nfixed = true\ncount = 1000\nradius = 0.2\npositions = [{}]\n";
  named("inner_walls").obstacles = "[[walls]]\npoints = [{}]\n";
  named("moving_inner_walls").obstacles = "[[walls]]\npoints = [{}]\nmotion = {{ velocity = [0.1, 0.0] }}\n";
  return all;
}

std::string gas_text(std::size_t count, const std::string& name) {
  const std::vector<GasFeature> all = gas_features();
  const auto f = std::find_if(all.begin(), all.end(), [&](const GasFeature& one) { return one.name == name; });
  if (f == all.end()) throw std::invalid_argument("no feature " + name);
  constexpr double packing_fraction = 0.5, strip = 4.0;
  const double side = std::sqrt(static_cast<double>(count) * std::numbers::pi * 0.25 / packing_fraction);
  const bool has_strip = !f->obstacles.empty();
  const std::string size = has_strip ? fmt::format("width = {0:.6f}\nheight = {1:.6f}\n", side, side + strip)
                                     : fmt::format("packing_fraction = {}\n", packing_fraction);
  const std::string region =
      has_strip ? fmt::format("region = [0, {}, {:.6f}, {:.6f}]\n", strip, side, side + strip) : "";
  const std::string obstacles = has_strip ? fmt::format(fmt::runtime(f->obstacles), row_of_places(side)) : "";
  return fmt::format(
      "[box]\n{}{}[physics]\n{}{}[[disks]]\nname = \"gas\"\ncount = {}\npositions = \"hexagonal\"\n{}{}radius = {}\n"
      "mass = {}\n",
      size, f->sides, f->physics, obstacles, count, region, f->velocities, f->radius, f->mass);
}

}  // namespace carom::bench
