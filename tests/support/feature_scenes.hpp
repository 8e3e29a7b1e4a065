// Random small scenes over every combination of features, as TOML text, and the comparison of engines on them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene.hpp"
#include "core/start/initial_state.hpp"

namespace carom::test {

struct Features {
  std::string method = "pairwise";
  std::string sides = "wall";  // wall | periodic | periodic_x | sink | soft | hot | moving
  bool gravity = false;
  double restitution = 1.0;
  std::string diffusion;        // empty | "replace" | "accumulate"
  std::string radii = "equal";  // equal | mixed | wide
  bool own_masses = false;
  bool source = false;
  int seed = 1;
  bool obstacles = false;    // fixed disks of many sizes, some of them across the sides
  std::string law{};         // empty | "viscoelastic" | "pairs": of groups, with restitutions of both kinds
  bool tilted = false;       // gravity is a vector
  std::string thermostat{};  // empty | "langevin" | "andersen"
  std::string rough{};       // empty | "sticking", smooth walls | "sliding", walls that are rough likewise
  double shear = 0.0;        // rate, of periodic sides

  std::string name() const {
    return method + "_" + sides + (gravity ? "_g" : "") + (restitution < 1.0 ? "_e" : "") +
           (diffusion.empty() ? "" : "_" + diffusion) + "_" + radii + (own_masses ? "_m" : "") +
           (source ? "_source" : "") + (obstacles ? "_fixed" : "") + (tilted ? "_tilted" : "") +
           (law.empty() ? "" : "_" + law) + (thermostat.empty() ? "" : "_" + thermostat) +
           (rough.empty() ? "" : "_" + rough) +
           (shear == 0.0  ? ""
            : shear > 0.0 ? "_shear"
                          : "_counter_shear");
  }
};

// In the name of a test.
inline std::string method_and_sides(const ::testing::TestParamInfo<std::tuple<const char*, const char*>>& info) {
  return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param);
}

inline std::string sides_text(const std::string& sides, int seed) {
  if (sides == "periodic_x") return "left = \"periodic\"\nright = \"periodic\"\nbottom = \"wall\"\ntop = \"sink\"\n";
  // A restitution of its own for each side.
  if (sides == "soft") {
    return "left = { restitution = 0.9 }\nright = { kind = \"wall\", restitution = 0.4 }\nbottom = \"wall\"\n"
           "top = { restitution = 0.0 }\n";
  }
  // Two thermal sides and two that are not.
  if (sides == "hot") return "left = { temperature = 9.0 }\nright = { temperature = 0.5 }\n";
  // A piston that moves in, one that moves out, and a floor that vibrates several times.
  if (sides == "moving") {
    return "left = { motion = { velocity = [2.0, 0.0] } }\nright = { place = 23.5, motion = { velocity = [1.0, 0.0] } "
           "}\n"
           "bottom = { restitution = 0.9, motion = { vibrate = [0.0, 0.1], period = 0.17, shape = \"" +
           std::string(seed % 2 == 0 ? "parabola" : "sine") + "\" } }\ntop = \"wall\"\n";
  }
  std::string text;
  for (const char* side : {"left", "right", "bottom", "top"}) text += std::string(side) + " = \"" + sides + "\"\n";
  return text;
}

// Of the groups in disks_text and obstacles_text.
inline std::string pairs_text(const Features& f) {
  if (f.law != "pairs") return "";
  const auto pair = [](const std::string& a, const std::string& b, const std::string& restitution) {
    return "[[physics.pairs]]\ngroups = [\"" + a + "\", \"" + b + "\"]\nrestitution = " + restitution + "\n";
  };
  const std::string slow_ones_bounce = f.diffusion == "replace" ? "0.9" : "{ viscoelastic = 0.1 }";
  return pair("first", "first", "0.8") + pair("second", "first", slow_ones_bounce) +
         (f.obstacles ? pair("pegs", "second", "0.6") : "") + (f.source ? pair("sources", "second", "0.5") : "");
}

inline std::string physics_text(const Features& f) {
  std::string text = "[physics]\n";
  if (f.gravity) text += f.tilted ? "gravity = [2.0, -1.5]\n" : "gravity = 3.0\n";
  if (f.law == "viscoelastic") {
    text += "restitution = { viscoelastic = 0.15, least = 0.3 }\n";
  } else if (f.restitution < 1.0) {
    text += "restitution = " + std::to_string(f.restitution) + "\n";
  }
  if (!f.diffusion.empty()) text += "diffusion = 0.3\n";
  if (!f.thermostat.empty()) {
    text += "thermostat = { kind = \"" + f.thermostat + "\", temperature = 4.0, rate = 4.0, dt = 0.07 }\n";
  }
  if (f.rough == "sticking") text += "roughness = { tangential_restitution = 0.6 }\n";
  if (f.rough == "sliding") text += "roughness = { tangential_restitution = 0.4, friction = 0.3, inertia = 0.4 }\n";
  if (f.diffusion == "accumulate") text += "accumulate = true\n";
  return text + pairs_text(f);
}

inline std::string disks_text(const Features& f) {
  const std::string mass = f.own_masses ? "{ uniform = [1, 20] }" : "1.5";
  const std::string spin = f.rough.empty() ? "" : f.seed % 2 == 0 ? "spin = 3.0\n" : "spin_temperature = 5.0\n";
  const std::string velocity = "velocities = { uniform = 4.0 }\n" + spin;
  const std::string first = f.law == "pairs" ? "[[disks]]\nname = \"first\"\n" : "[[disks]]\n";
  const std::string second = f.law == "pairs" ? "[[disks]]\nname = \"second\"\n" : "[[disks]]\n";
  if (f.radii == "wide") {
    return first + "count = 2\npositions = \"random\"\nradius = 4.0\nmass = " + mass + "\n" + velocity + second +
           "count = 120\npositions = \"random\"\nradius = { uniform = [0.08, 0.5] }\nmass = " + mass + "\n" + velocity;
  }
  const std::string radius = f.radii == "equal" ? "0.6" : "{ uniform = [0.3, 1.1] }";
  const std::string rest = "positions = \"random\"\nradius = " + radius + "\nmass = " + mass + "\n" + velocity;
  if (f.law == "pairs") return first + "count = 50\n" + rest + second + "count = 80\n" + rest;
  return first + "count = 130\n" + rest;
}

inline std::string obstacles_text(const Features& f) {
  if (!f.obstacles) return "";
  const std::string name = f.law == "pairs" ? "name = \"pegs\"\n" : "";
  if (f.sides == "moving") {  // where no side comes
    return "[[disks]]\n" + name +
           "fixed = true\ncount = 9\npositions = \"random\"\nregion = [17.0, 1.0, 22.0, 11.0]\nradius = { uniform = "
           "[0.05, 0.4] }\n[[disks]]\nfixed = true\ncount = 2\npositions = [[12.0, 17.9], [12.5, 18.0]]\n"
           "radius = [0.5, 0.6]\n";
  }
  return "[[disks]]\n" + name +
         "fixed = true\ncount = 9\npositions = \"random\"\nradius = { uniform = [0.05, 0.8] }\n"
         "[[disks]]\nfixed = true\ncount = 4\npositions = [[0.1, 9.0], [24.0, 4.0], [12.0, 0.2], [12.5, 0.0]]\n"
         "radius = [0.7, 0.4, 0.5, 0.6]\n";
}

// A line with a corner, an inelastic wall, a wall that touches both sides, and a sink unless Brownian motion forbids
// it. With moving sides, all of them move, too.
inline std::string walls_text(const Features& f) {
  if (!f.obstacles) return "";
  const bool moving = f.sides == "moving";
  const std::string shape = f.seed % 2 == 0 ? "parabola" : "sine";
  const auto motion = [&](const std::string& how) { return moving ? "motion = { " + how + " }\n" : std::string(); };
  std::string text =
      std::string("[[walls]]\npoints = [[") + (moving ? "7.0" : "3.0") + ", 3.0], [6.0, 4.5], [5.5, 8.0]]\n" +
      motion("vibrate = [0.3, -0.2], period = 0.3, shape = \"" + shape + "\"") +
      "[[walls]]\nfrom = [20.0, 12.0]\nto = [15.0, 12.0]\nrestitution = 0.6\n" + motion("velocity = [-1.5, 0.5]") +
      (moving ? "" : "[[walls]]\nfrom = [0.0, 14.0]\nto = [4.0, 18.0]\n");
  if (f.diffusion.empty()) {
    text += "[[walls]]\nfrom = [10.0, 2.0]\nto = [11.0, 2.5]\nkind = \"sink\"\n" + motion("velocity = [2.0, 1.0]");
  }
  return text;
}

// About 130 disks at a packing fraction near 0.3 to 0.5, moving up to a third of a radius a step: contacts in every
// step, crowded ones among them.
inline Scene feature_scene(const Features& f, int steps) {
  std::string text =
      "title = \"" + f.name() + "\"\nseed = " + std::to_string(f.seed) +
      "\n[box]\nwidth = 24.0\nheight = 18.0\nwall_restitution = " + (f.gravity ? "0.8" : "1.0") + "\n" +
      (f.rough == "sliding" ? "wall_roughness = { tangential_restitution = 0.8, friction = 0.5 }\n" : "") +
      (f.shear == 0.0 ? "" : "shear_rate = " + std::to_string(f.shear) + "\n") + sides_text(f.sides, f.seed) +
      physics_text(f) + obstacles_text(f) + disks_text(f) + walls_text(f);
  if (f.source) {
    text +=
        "[[sources]]\nregion = [4.0, 4.0, 20.0, 14.0]\nrate = 80.0\nradius = 0.25\nmass = 1.5\n"
        "velocities = { maxwell = 2.0 }\n";
    if (!f.rough.empty()) text += f.seed % 3 == 0 ? "spin = -2.0\n" : "spin_temperature = 1.0\n";
  }
  text += "[run]\nmethod = \"" + f.method + "\"\ndt = 0.03\nt_end = " + std::to_string(0.03 * steps) + "\n";
  return parse_scene(text, f.name(), "", {});
}

// All combinations of features for one method and one kind of sides.
inline std::vector<Features> all_features(const std::string& method, const std::string& sides) {
  std::vector<Features> all;
  int seed = 1;
  for (const bool gravity : {false, true}) {
    for (const double restitution : {1.0, 0.7}) {
      for (const char* diffusion : {"", "replace", "accumulate"}) {
        if ((sides == "hot" || sides == "moving") && *diffusion != '\0') continue;
        for (const char* radii : {"equal", "mixed", "wide"}) {
          for (const bool own_masses : {false, true}) {
            for (const bool source : {false, true}) {
              all.push_back({method, sides, gravity, restitution, diffusion, radii, own_masses, source, seed++});
            }
          }
        }
      }
    }
  }
  return all;
}

}  // namespace carom::test
