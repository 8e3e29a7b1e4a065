#include "io/tables/series.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/measure/invariants.hpp"
#include "core/measure/shear_flow.hpp"

namespace carom {

// order, energy: of the disks, whose velocities are relative to a shear flow.
IntervalMeans SeriesMeter::means(const Disks& disks, const std::vector<std::size_t>& order, const Energy& energy,
                                 const State& now, const BlockRunner& run) const {
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
  if (box_.shear.acts()) {
    const double virial = c.shear_virial - done_.before.shear_virial;
    mean.shear_stress = shear_stress(momentum_flow(disks, order, run), virial, elapsed, box_);
  }
  return mean;
}

SeriesRow SeriesMeter::row(const Disks& disks, double time, const State& now, const BlockRunner& run) {
  const Counters& c = now.counters;
  const std::vector<std::size_t> order = by_id(disks);
  const Energy energy = energy_of(disks, order, gravity_, run);
  const Momentum momentum = momentum_of(disks, order, run);
  if (box_.shear.acts()) {
    const Disks relative = relative_to_flow(disks, box_);
    const Energy thermal = energy_of(relative, order, gravity_, run);
    done_.means = means(relative, order, thermal, now, run);
    const double temperature = disks.empty() ? 0.0 : thermal.kinetic / static_cast<double>(disks.size());
    const double stress = done_.means.shear_stress;
    shear_row_ = {stress, stress / box_.shear.rate, temperature, c.shear_work};
  } else {
    done_.means = means(disks, order, energy, now, run);
  }
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
                      with_overlap_ ? max_overlap(disks, box_at(box_, time), run) : 0.0,
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
  for (const std::string& name : rotation_column_names(scene)) heading += "," + name;
  if (scene.box.shear.acts()) {
    for (const ShearColumn& column : shear_columns) heading += fmt::format(",{}", column.name);
  }
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
  const SeriesRow row = meter_.row(disks, time, now, run);
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
  for (const double value : rotation_column_values(disks, run)) fmt::format_to(std::back_inserter(line), ",{}", value);
  if (sources_.box.shear.acts()) {
    for (const double value : meter_.shear_row()) fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  for (const double value : groups_.row(relative_to_flow(disks, sources_.box)))
    fmt::format_to(std::back_inserter(line), ",{}", value);
  file_.write(line + "\n");
  file_.flush();
  ++rows_;
  return row;
}

}  // namespace carom
