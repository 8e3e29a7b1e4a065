#include "io/tables/series.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/measure/invariants.hpp"

namespace carom {

IntervalMeans SeriesMeter::means(const Disks& disks, const Energy& energy, const State& now) const {
  const double elapsed = now.time - done_.counted_until;
  if (!(elapsed > 0.0)) return done_.means;
  const Counters& c = now.counters;
  const double disk_time = elapsed * static_cast<double>(disks.size());
  const auto collisions = static_cast<double>(c.collisions - done_.before.collisions);
  IntervalMeans mean{pressure(energy, c.virial - done_.before.virial, elapsed, box_at(box_, now.time)),
                     disk_time > 0.0 ? 2.0 * collisions / disk_time : 0.0,
                     {}};
  for (std::size_t side = 0; side < 4; ++side) {
    mean.force[side] = (c.wall_impulse[side] - done_.before.wall_impulse[side]) / elapsed;
  }
  return mean;
}

SeriesRow SeriesMeter::row(const Disks& disks, const State& now, const BlockRunner& run) {
  const Counters& c = now.counters;
  const std::vector<std::size_t> order = by_id(disks);
  const Energy energy = energy_of(disks, order, gravity_, run);
  const Momentum momentum = momentum_of(disks, order, run);
  done_.means = means(disks, energy, now);
  const auto of_velocities = [&](double value) { return drawn_ ? std::numeric_limits<double>::quiet_NaN() : value; };
  const SeriesRow row{static_cast<double>(disks.size()),
                      of_velocities(energy.kinetic),
                      energy.potential,
                      of_velocities(energy.total()),
                      of_velocities(momentum.x),
                      of_velocities(momentum.y),
                      static_cast<double>(c.collisions),
                      static_cast<double>(c.wall_collisions),
                      of_velocities(done_.means.pressure),
                      done_.means.collision_rate,
                      with_overlap_ ? max_overlap(disks, box_, run) : 0.0,
                      static_cast<double>(c.removed),
                      static_cast<double>(c.emitted),
                      static_cast<double>(c.waiting),
                      of_velocities(done_.means.force[0]),
                      of_velocities(done_.means.force[1]),
                      of_velocities(done_.means.force[2]),
                      of_velocities(done_.means.force[3])};
  done_.before = c;
  done_.counted_until = now.time;
  return row;
}

SeriesWriter::SeriesWriter(const std::string& path, const Scene& scene)
    : file_(path),
      sources_(scene),
      meter_(scene, true),
      groups_(scene),
      with_displacement_(scene.analysis.wants(Quantity::displacement)) {
  std::string heading = "t";
  for (const SeriesColumn& column : series_columns) heading += fmt::format(",{}", column.name);
  if (with_displacement_) heading += fmt::format(",{}", displacement_column);
  for (const std::string& name : side_column_names(sources_)) heading += "," + name;
  for (const GroupColumn& column : groups_.columns()) heading += fmt::format(",{}", column.name);
  file_.write(heading + "\n");
}

SeriesWriter::SeriesWriter(const std::string& path, const Scene& scene, const SeriesMark& from)
    : file_(path, from.file.bytes),
      sources_(scene),
      meter_(scene, true, from.meter),
      groups_(scene),
      with_displacement_(scene.analysis.wants(Quantity::displacement)),
      rows_(from.file.frames) {}

SeriesMark SeriesWriter::mark() {
  file_.sync();
  return {{file_.name(), rows_, file_.bytes()}, meter_.mark()};
}

SeriesRow SeriesWriter::write(const Disks& disks, double time, const State& now, double displacement,
                              const BlockRunner& run) {
  const SeriesRow row = meter_.row(disks, now, run);
  // {} writes the shortest text that reads back as the same double.
  std::string line = fmt::format("{}", time);
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (series_columns[k].whole) {
      fmt::format_to(std::back_inserter(line), ",{}", static_cast<Count>(row[k]));
    } else {
      fmt::format_to(std::back_inserter(line), ",{}", row[k]);
    }
  }
  if (with_displacement_) fmt::format_to(std::back_inserter(line), ",{}", displacement);
  for (const double value : side_column_values(sources_, now.counters)) {
    fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  for (const double value : groups_.row(disks)) fmt::format_to(std::back_inserter(line), ",{}", value);
  file_.write(line + "\n");
  file_.flush();
  ++rows_;
  return row;
}

}  // namespace carom
