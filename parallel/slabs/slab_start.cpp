#include "parallel/slabs/slab_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/base/check.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

namespace {

// What of the scene slabs cannot do yet; empty: they can do all of it.
std::string unsupported(const Scene& scene) {
  return settles(scene) ? "gravity with restitution below 1" : "";
}

double largest_radius_ever(const Scene& scene, double largest) {
  constexpr double rounding = 1.0 + 1e-12;
  for (const Source& source : scene.sources) largest = std::max(largest, rounding * largest_radius_of(source));
  return largest;
}

void check_thickness(const Scene& scene, double largest, int ranks) {
  const double least = least_thickness * largest;
  if (ranks == 1 || least * ranks <= scene.box.height) return;
  throw InputError(
      fmt::format("{} ranks: slabs of a box {:g} high would be thinner than two diameters of the largest disk, whose "
                  "radius is {:g}; use {} at most",
                  ranks, scene.box.height, largest, std::max(1, static_cast<int>(scene.box.height / least))));
}

}  // namespace

std::vector<std::size_t> class_counts(const Disks& d, double largest_radius) {
  std::vector<std::size_t> counts(1, 0);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const std::size_t k = class_of_radius(d.radius_of(i), largest_radius);
    if (k >= counts.size()) counts.resize(k + 1, 0);
    ++counts[k];
  }
  return counts;
}

SlabStart slab_start(const Scene& scene, DiskColumns columns, double smallest, double largest, Count disks, int ranks) {
  // Where slabs do not do, one rank has all disks (slab_exact.hpp).
  const bool is_exact = scene.run.method == Method::exact;
  const std::string what = is_exact ? "" : unsupported(scene);
  if (!what.empty()) throw InputError(fmt::format("several ranks do not know {} yet: use one", what));
  SlabStart start;
  start.smallest_radius = smallest;
  start.largest_radius = largest_radius_ever(scene, largest);
  if (!is_exact) check_thickness(scene, start.largest_radius, ranks);
  start.columns = columns;
  start.disks = disks;
  return start;
}

double thinnest_slab(const Scene& scene, const SlabStart& start) {
  return scene.run.method == Method::exact ? 0.0 : least_thickness * start.largest_radius;
}

SlabStart slab_start(const Scene& scene, const Disks& all, int ranks) {
  SlabStart start = slab_start(scene, columns_of(all), smallest_radius(all), largest_radius(all), all.size(), ranks);
  start.counts = class_counts(all, start.largest_radius);
  start.cut = cut_into_slabs(scene.box, all, ranks, thinnest_slab(scene, start));
  return start;
}

Bytes message_of(const SlabStart& start) {
  Bytes message;
  put_all(message, start.cut.bounds);
  put(message, start.columns);
  put(message, start.smallest_radius);
  put(message, start.largest_radius);
  put_all(message, start.counts);
  put(message, start.disks);
  return message;
}

SlabStart slab_start_of(const Bytes& message) {
  MessageReader reader(message);
  SlabStart start;
  start.cut.bounds = reader.get_all<double>();
  start.columns = reader.get<DiskColumns>();
  start.smallest_radius = reader.get<double>();
  start.largest_radius = reader.get<double>();
  start.counts = reader.get_all<std::size_t>();
  start.disks = reader.get<Count>();
  return start;
}

void keep_own_disks(const SlabCut& cut, int rank, Disks& disks) {
  std::vector<unsigned char> gone(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) gone[i] = cut.rank_at(disks.y[i]) == rank ? 0 : 1;
  remove_marked(disks, gone);
  for (std::vector<double>* column :
       {&disks.x, &disks.y, &disks.vx, &disks.vy, &disks.radius, &disks.mass, &disks.spin}) {
    column->shrink_to_fit();
  }
  disks.id.shrink_to_fit();
}

}  // namespace carom
