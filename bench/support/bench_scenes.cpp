#include "bench/support/bench_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "bench/support/gas_features.hpp"
#include "core/disks/disk_columns.hpp"
#include "core/load/scene_file.hpp"
#include "core/physics/event_order.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr double never = 1e6;

std::string sides(const char* kind) {
  return fmt::format("left = \"{0}\"\nright = \"{0}\"\nbottom = \"{0}\"\ntop = \"{0}\"\n", kind);
}

std::string run_text(double dt) {
  return fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {:.1f}\n", dt, never);
}

State after(const Scene& scene, State state, int steps) {
  const auto engine = make_parallel_engine(scene, std::move(state), {2});
  for (int k = 0; k < steps; ++k) engine->step();
  State end = engine->state();
  end.time = 0.0;
  end.counters = {};
  return end;
}

// The state after `steps` of dt, in a scene that goes on with another step.
Start prepared(const std::string& text, const char* name, double dt, int steps, double next_dt) {
  Scene scene = parse_scene(text + run_text(dt), name, "");
  State state = after(scene, initial_state(scene), steps);
  if (scene.physics.thermostat.acts()) state.intervals = 0;  // so that the next kick is due at once
  scene.run.dt = next_dt;
  return {std::move(scene), std::move(state)};
}

// Copies of a state that is periodic along x, side by side. A load between disks across a seam then acts between two
// copies.
State repeated(const State& tile, double width, std::size_t copies) {
  const auto n = static_cast<DiskId>(tile.disks.size());
  State all;
  all.next_id = n * static_cast<DiskId>(copies);
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[tile.disks.id[i]] = tile.disks.x[i];
  for (std::size_t copy = 0; copy < copies; ++copy) {
    const DiskId first = n * static_cast<DiskId>(copy);
    for (std::size_t i = 0; i < n; ++i) {
      Disk disk = disk_at(tile.disks, i);
      disk.id += first;
      disk.x += width * static_cast<double>(copy);
      append(all.disks, disk);
    }
    const DiskId before = n * static_cast<DiskId>(copy > 0 ? copy - 1 : copies - 1);
    const DiskId behind = n * static_cast<DiskId>(copy + 1 < copies ? copy + 1 : 0);
    for (ContactLoad load : tile.loads) {
      if (load.id2 < n) {
        const double dx = x[load.id2] - x[load.id1];
        load.id2 += dx > 0.5 * width ? before : dx < -0.5 * width ? behind : first;
      }
      load.id1 += first;
      if (load.id2 < load.id1) std::swap(load.id1, load.id2);
      all.loads.push_back(load);
    }
  }
  std::sort(all.loads.begin(), all.loads.end(), ids_order);
  return all;
}

template <class T>
void permute(std::vector<T>& column, const std::vector<std::size_t>& order) {
  if (column.empty()) return;
  std::vector<T> moved(column.size());
  for (std::size_t i = 0; i < order.size(); ++i) moved[i] = column[order[i]];
  column = std::move(moved);
}

}  // namespace

Start gas(std::size_t count, const std::string& feature) {
  return prepared(gas_text(count, feature), "gas", 0.02, 50, 0.005);
}

namespace {

// The state after four collisions per disk.
Start melted(Scene scene) {
  constexpr double collisions_a_disk = 4.0;
  const double count = static_cast<double>(scene.groups.back().count);
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2});
  while (static_cast<double>(engine->state().counters.collisions) < 0.5 * collisions_a_disk * count) {
    engine->step();
  }
  State state = engine->state();
  if (scene.physics.thermostat.acts()) state.intervals = 0;  // so that the next kick is due at once
  // Moving images and sides would be elsewhere at another time.
  if (!scene.box.shear.acts() && !scene.box.has_moving_side()) state.time = 0.0;
  state.counters = {};
  return {std::move(scene), std::move(state)};
}

}  // namespace

Start exact_gas(std::size_t count, double packing_fraction) {
  // Two disks run through more than a million units of time in a turn.
  const std::string text = fmt::format(
      "[box]\npacking_fraction = {}\n{}[[disks]]\ncount = {}\npositions = \"hexagonal\"\n"
      "velocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n[run]\nmethod = \"exact\"\nt_end = 1e12\n",
      packing_fraction, sides("periodic"), count);
  return melted(parse_scene(text, "gas", ""));
}

Start exact_gas_with(std::size_t count, const std::string& feature) {
  return melted(parse_scene(gas_text(count, feature) + "[run]\nmethod = \"exact\"\nt_end = 1e6\n", "gas", ""));
}

Start wide_radii() {
  // 10^6 small disks fill half of the area left by the large ones: (0.785 + 0.785) / (0.785 / 0.5 + 0.785) = 2 / 3 in
  // all.
  const std::string text = fmt::format(
      "[box]\npacking_fraction = 0.6667\n{}"
      "[[disks]]\ncount = 100\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 50.0\n"
      "mass = {{ from_radius = 1.2732 }}\n"
      "[[disks]]\ncount = 1_000_000\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 0.5\n"
      "mass = {{ from_radius = 1.2732 }}\n",
      sides("periodic"));
  return prepared(text, "wide radii", 0.02, 20, 0.005);
}

Start settled_pile(std::size_t tile_disks, std::size_t copies) {
  const double width = static_cast<double>(tile_disks) / 8.0;
  const std::string text = fmt::format(
      "[box]\nwidth = {:.1f}\nheight = 320.0\nwall_restitution = 0.5\nleft = \"periodic\"\nright = \"periodic\"\n"
      "[physics]\ngravity = 0.5\nrestitution = 0.5\n"
      "[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ uniform = 2.0 }}\n"
      "radius = {{ uniform = [1.0, 2.5] }}\nmass = {{ from_radius = 1.0 }}\n",
      width, tile_disks);
  // The pile falls for 36 units of time and comes to rest, with long steps; then there are a thousand steps of B's own
  // length.
  Start pile = prepared(text, "pile", 0.01, 20'000, 0.002);
  pile.state = repeated(after(pile.scene, std::move(pile.state), 1000), width, copies);
  pile.scene.box.width *= static_cast<double>(copies);
  return pile;
}

State shuffled(State state) {
  std::mt19937_64 random(1);  // gives the same numbers everywhere, unlike the standard's distributions
  std::vector<std::size_t> order(state.disks.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
    std::swap(order[i], order[random() % (i + 1)]);
  }
  for_each_column(state.disks, [&](auto& column) { permute(column, order); });
  return state;
}

}  // namespace carom::bench
