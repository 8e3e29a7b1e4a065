#include "parallel/slabs/slab_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/cell_index.hpp"
#include "core/disks/disk_columns.hpp"
#include "core/step/source.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/exact/listed_box.hpp"
#include "parallel/ranks/message.hpp"

namespace carom {

namespace {

// The number of rows whose disks are counted to cut slabs.
constexpr std::size_t rows_counted = 4096;

// The feature of the scene that slabs do not support; empty if there is none.
std::string unknown_to_slabs(const Scene& scene) {
  if (scene.run.method != Method::exact) return "";
  if (scene.box.shear.acts()) return "a shear flow";
  return can_list_in(scene.box) ? "" : "a box that is so long compared with its period";
}

double largest_radius_ever(const Scene& scene, double largest) {
  constexpr double rounding = 1.0 + 1e-12;
  for (const Source& source : scene.sources) largest = std::max(largest, rounding * largest_radius_of(source));
  return largest;
}

std::string why_alone(const Scene& scene, double largest, int ranks) {
  const bool is_exact = scene.run.method == Method::exact;
  const std::string unknown = unknown_to_slabs(scene);
  if (!unknown.empty()) return fmt::format("exact does not support {} on several ranks yet", unknown);
  const double least = least_thickness * largest;
  // For exact, the thickness is checked in each window.
  if (is_exact || ranks == 1 || least * ranks <= scene.box.height) return "";
  return fmt::format(
      "{} slabs of a box of height {:g} would be thinner than two diameters of the largest disk, whose radius is {:g}; "
      "use at most {}",
      ranks, scene.box.height, largest, std::max(1, static_cast<int>(scene.box.height / least)));
}

}  // namespace

void check_ranks_know(Method method) {
  if (method == Method::rollback) {
    throw InputError(
        "method rollback cannot run on several ranks, as its frames need the whole box: use one rank, or --method "
        "exact");
  }
}

SlabStart slab_start(const Scene& scene, DiskColumns columns, double smallest, double largest, Count disks, int ranks) {
  SlabStart start;
  start.smallest_radius = smallest;
  start.largest_radius = largest_radius_ever(scene, largest);
  start.alone = why_alone(scene, start.largest_radius, ranks);
  start.columns = columns;
  start.disks = disks;
  return start;
}

double thinnest_slab(const Scene& scene, const SlabStart& start) {
  const bool may_be_thin = scene.run.method == Method::exact || !start.alone.empty();
  return may_be_thin ? 0.0 : least_thickness * start.largest_radius;
}

SlabStart slab_start(const Scene& scene, const Disks& all, int ranks) {
  SlabStart start = slab_start(scene, columns_of(all), smallest_radius(all), largest_radius(all), all.size(), ranks);
  start.counts = count_classes(all, start.largest_radius);
  start.cut = cut_into_slabs(scene.box, all, ranks, thinnest_slab(scene, start));
  return start;
}

SlabStart slab_start(const Scene& scene, DiskSource& all, int ranks) {
  if (all.size() == 0) return slab_start(scene, all.read(0, 0), ranks);
  double smallest = HUGE_VAL;
  double largest = 0.0;
  bool spins = false;
  std::vector<std::int64_t> disks_of_row(rows_counted, 0);
  const double rows_per_length = static_cast<double>(rows_counted) / scene.box.height;
  visit_pieces(all, [&](const Disks& some) {
    smallest = std::min(smallest, smallest_radius(some));
    largest = std::max(largest, largest_radius(some));
    spins = some.spins();
    for (const double y : some.y) ++disks_of_row[cell_index(y * rows_per_length, rows_counted)];
  });
  SlabStart start = slab_start(scene, {all.has_radii(), all.has_masses(), spins}, smallest, largest, all.size(), ranks);
  if (start.columns.radius) {
    visit_pieces(all, [&](const Disks& some) {
      const std::vector<std::size_t> counts = count_classes(some, start.largest_radius);
      start.counts.resize(std::max(start.counts.size(), counts.size()), 0);
      for (std::size_t k = 0; k < counts.size(); ++k) start.counts[k] += counts[k];
    });
  } else {
    start.counts.assign(class_of_radius(largest, start.largest_radius) + 1, 0);
    start.counts.back() = all.size();
  }
  start.cut = cut_by_rows(scene.box, disks_of_row, ranks);
  keep_thick(start.cut, thinnest_slab(scene, start));
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
  put_text(message, start.alone);
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
  start.alone = reader.get_text();
  return start;
}

Disks deal_out(Ranks& ranks, const SlabStart& start, DiskSource* all, Disks part) {
  truncate(part, 0);
  const auto expected = static_cast<std::size_t>(start.disks) / static_cast<std::size_t>(ranks.count());
  reserve(part, expected + expected / 32, start.columns);
  // Some at a time, so that no rank has a second copy of all disks.
  for (std::size_t begin = 0; begin < start.disks; begin += disks_of_a_read) {
    std::vector<Disk> piece;
    if (all != nullptr) {
      const Disks some = all->read(begin, std::min(all->size(), begin + disks_of_a_read));
      for (std::size_t i = 0; i < some.size(); ++i) piece.push_back(disk_at(some, i));
    }
    Bytes message;
    put_all(message, piece);
    for (const Disk& disk : MessageReader(ranks.share(message)).get_all<Disk>()) {
      if (start.cut.rank_at(disk.y) == ranks.rank()) push_back(part, disk, start.columns);
    }
  }
  return part;
}

void keep_own_disks(const SlabCut& cut, int rank, Disks& disks) {
  std::vector<unsigned char> gone(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) gone[i] = cut.rank_at(disks.y[i]) == rank ? 0 : 1;
  remove_marked(disks, gone);
  for_each_column(disks, [](auto& column) { column.shrink_to_fit(); });
}

}  // namespace carom
