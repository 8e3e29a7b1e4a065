// The distance from the borders between regions up to which the exact method does not know the motion of disks before
// the border pass: several machines would have to send each other these disks. Counts and lengths only; no time is
// measured.
#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>

#include "bench/figures/figures.hpp"
#include "bench/support/bench_scenes.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {

namespace {

constexpr std::size_t disks = 200'000;
constexpr int regions = 4;
constexpr int windows = 4;

// The disks that the slices of a run left to their borders.
class BorderZone {
 public:
  explicit BorderZone(const Start& start)
      : wide_(start.scene.box.width >= start.scene.box.height),
        longer_(wide_ ? start.scene.box.width : start.scene.box.height),
        shorter_(wide_ ? start.scene.box.height : start.scene.box.width),
        periodic_(wide_ ? start.scene.box.periodic_x() : start.scene.box.periodic_y()) {
    const Disks& d = start.state.disks;
    const double n = static_cast<double>(d.size());
    spacing_ = std::sqrt(longer_ * shorter_ / n);
    double sum = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) sum += d.radius_of(i);
    diameter_ = 2.0 * sum / n;
  }

  void see(const SliceBorders& slice) {
    const bool first = slice.window.slice_start == 0.0;
    if (first) events_before_ = at_borders_before_ = 0;
    events_ += slice.events - events_before_;
    at_borders_ += slice.at_borders - at_borders_before_;
    events_before_ = slice.events;
    at_borders_before_ = slice.at_borders;
    ++slices_;
    skin_ = slice.lists.skin();
    for (const Region& region : slice.regions) {
      const Sides sides = sides_of(region, slice.regions.back().worker.region.last_key);
      for (const std::uint32_t i : region.border) see_disk(slice, region, sides, i);
      for (const BlockedDisk& blocked : region.worker.blocked) see_disk(slice, region, sides, blocked.disk);
    }
  }

  // A line of the table.
  std::string row(const std::string& name, double packing_fraction) {
    std::sort(depth_.begin(), depth_.end());
    const double borders = static_cast<double>(slices_) * (periodic_ ? regions : regions - 1);
    const auto all = static_cast<double>(depth_.size());
    return fmt::format("{},{},{:.2f},{:.2f},{:.3f},{:.1f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.3f}\n", name,
                       packing_fraction, spacing_ / diameter_, skin_ / diameter_,
                       static_cast<double>(events_) / (static_cast<double>(slices_) * static_cast<double>(disks)),
                       all / borders * spacing_ / shorter_, share_within(0.5) / diameter_,
                       share_within(0.99) / diameter_, depth_.back() / diameter_, depth_.back() / spacing_,
                       listed_ / diameter_, 100.0 * static_cast<double>(at_borders_) / static_cast<double>(events_));
  }
  double deepest() const { return depth_.back() / spacing_; }
  static const char* header() {
    return "scene,packing_fraction,spacing_in_diameters,skin_in_diameters,events_a_disk_and_slice,rows_a_border,"
           "median_in_diameters,99_percent_in_diameters,deepest_in_diameters,deepest_in_spacings,"
           "listed_in_diameters,percent_of_events\n";
  }

 private:
  // The ends of a region along the longer side; length.
  struct Sides {
    double low, high;
  };

  Sides sides_of(const Region& region, std::uint32_t last_key) const {
    const double per_key = longer_ / last_key;
    return {region.worker.region.first_key * per_key, region.worker.region.last_key * per_key};
  }

  // The distance from the nearer border; 0 for a disk that has left its region since disks were sorted.
  double depth_at(const Sides& sides, Vec2 place) const {
    const double middle = 0.5 * (sides.low + sides.high);
    double off = (wide_ ? place.x : place.y) - middle;
    if (periodic_) off = nearest_image(off, longer_);
    const double half = 0.5 * (sides.high - sides.low);
    double depth = half - std::abs(off);
    if (!periodic_ && sides.low == 0.0) depth = half - off;  // a wall there is not a border
    if (!periodic_ && sides.high >= longer_ * (1.0 - 1e-9)) depth = half + off;
    return std::max(0.0, depth);
  }

  void see_disk(const SliceBorders& slice, const Region& region, const Sides& sides, std::uint32_t i) {
    depth_.push_back(depth_at(sides, place_of(slice, i)));
    slice.lists.for_each_neighbour(i, [&](std::uint32_t j) {
      if (region.worker.region.holds(j)) listed_ = std::max(listed_, depth_at(sides, place_of(slice, j)));
    });
  }

  // The disk's place at the end of the slice.
  static Vec2 place_of(const SliceBorders& slice, std::uint32_t i) {
    const PathSegment p =
        carried_to(slice.window.record[i].path, slice.window.slice_stop(), slice.window.rules.gravity);
    return {p.x, p.y};
  }

  bool wide_;
  double longer_, shorter_;  // sides of the box; regions lie one after another along the longer one
  bool periodic_;            // along the longer side
  double spacing_ = 0.0;     // mean distance of disks, the square root of the area per disk
  double diameter_ = 0.0;    // mean diameter
  double skin_ = 0.0;
  std::vector<double> depth_;  // of disks whose motion was not known; length
  double listed_ = 0.0;        // of the furthest disk in their lists; length
  Count slices_ = 0;
  Count events_ = 0, at_borders_ = 0;
  Count events_before_ = 0, at_borders_before_ = 0;  // of the window

  double share_within(double share) const {
    return depth_[static_cast<std::size_t>(share * static_cast<double>(depth_.size() - 1))];
  }
};

// The state after four collisions per disk.
Start mixed(const std::string& text, const char* name) {
  Scene scene = parse_scene(text + "[run]\nmethod = \"exact\"\nt_end = 1e12\n", name, "");
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2});
  engine->forget_paths();
  while (engine->state().counters.collisions < 2 * disks) engine->step();
  State state = engine->state();
  state.time = 0.0;
  state.counters = {};
  return {std::move(scene), std::move(state)};
}

Start with_radii(const char* positions, const char* radius) {
  return mixed(fmt::format("[box]\npacking_fraction = 0.5\nleft = \"periodic\"\nright = \"periodic\"\n"
                           "bottom = \"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = {}\npositions = \"{}\"\n"
                           "velocities = {{ maxwell = 1.0 }}\nradius = {{ uniform = {} }}\n"
                           "mass = {{ from_radius = 1.0 }}\n",
                           disks, positions, radius),
               "radii");
}

// The box is twice as high as wide, so that borders are perpendicular to gravity.
Start under_gravity() {
  return mixed(fmt::format("[box]\npacking_fraction = 0.3\naspect = 0.5\nleft = \"periodic\"\nright = \"periodic\"\n"
                           "[physics]\ngravity = 0.2\n[[disks]]\ncount = {}\npositions = \"hexagonal\"\n"
                           "velocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n",
                           disks),
               "gravity");
}

}  // namespace

std::vector<Figure> measure_borders(const std::string& folder) {
  auto file = fmt::output_file(folder + "/borders.csv");
  file.print("{}", BorderZone::header());
  double deepest = 0.0;
  const auto measure = [&](const std::string& name, double packing_fraction, const Start& start) {
    BorderZone zone(start);
    const auto engine =
        make_parallel_exact(start.scene, start.state, {regions}, [&](const SliceBorders& slice) { zone.see(slice); });
    engine->forget_paths();
    for (int k = 0; k < windows; ++k) engine->step();
    file.print("{}", zone.row(name, packing_fraction));
    deepest = std::max(deepest, zone.deepest());
  };
  for (const double packing_fraction : {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.85}) {
    measure("equal disks", packing_fraction, exact_gas(disks, packing_fraction));
  }
  measure("radii 1 : 2", 0.5, with_radii("hexagonal", "[0.35, 0.65]"));
  measure("radii 1 : 10", 0.5, with_radii("random", "[0.1, 1.0]"));
  measure("gravity 0.2", 0.3, under_gravity());
  return {{"exact: deepest disk that waits for a border, mean spacings", deepest, "", {}, {}}};
}

}  // namespace carom::bench
