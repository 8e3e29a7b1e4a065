#include "io/tables/series.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/input_message.hpp"
#include "core/measure/blocked_tally.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/shear_flow.hpp"

namespace carom {

namespace {

// The sums over all disks for a row, from pieces of them.
struct RowTally {
  BlockedTally kinetic, potential, rotational, px, py;
  BlockedTally relative, flow;  // in a sheared box, of velocities relative to the flow

  void add(const Disks& d, const Domain& box, const Gravity& gravity, const BlockRunner& run) {
    const std::vector<std::size_t> order = by_id(d);
    kinetic.add(order, run, [&](std::size_t i) { return kinetic_energy_of(d, i); });
    if (gravity.acts()) potential.add(order, run, [&](std::size_t i) { return potential_energy_of(d, i, gravity); });
    if (d.spins()) rotational.add(order, run, [&](std::size_t i) { return rotational_energy_of(d, i); });
    px.add(order, run, [&](std::size_t i) { return d.mass_of(i) * d.vx[i]; });
    py.add(order, run, [&](std::size_t i) { return d.mass_of(i) * d.vy[i]; });
    if (!box.shear.acts()) return;
    const Disks there = relative_to_flow(d, box);
    relative.add(order, run, [&](std::size_t i) { return kinetic_energy_of(there, i); });
    flow.add(order, run, [&](std::size_t i) { return there.mass_of(i) * there.vx[i] * there.vy[i]; });
  }
};

double overlap_of(const DisksInPieces& disks, const Domain& box, const BlockRunner& run) {
  const std::optional<double> known = disks.max_overlap();
  return known ? *known : max_overlap(disks.whole(), box, run);
}

std::string heading_of(const Scene& scene) {
  std::string heading = "t";
  for (const SeriesColumn& column : series_columns) heading += fmt::format(",{}", column.name);
  if (scene.analysis.wants(Quantity::displacement)) heading += fmt::format(",{}", displacement_column);
  for (const SceneSink& sink : sinks_of(scene)) heading += fmt::format(",{}_{}", taken_column.name, sink.name);
  for (const std::string& name : side_column_names(EnergySources(scene))) heading += "," + name;
  for (const std::string& name : rotation_column_names(scene)) heading += "," + name;
  if (scene.box.shear.acts()) {
    for (const ColumnText& column : shear_columns) heading += fmt::format(",{}", column.name);
  }
  for (const GroupColumn& column : GroupMeter(scene).columns()) heading += fmt::format(",{}", column.name);
  return heading;
}

// Throws InputError if the file has other columns, for example because another version began it. A missing or short
// file is detected when it is opened.
const std::string& with_heading(const std::string& path, const Scene& scene) {
  std::ifstream file(path);
  std::string heading;
  if (std::getline(file, heading) && !file.eof() && heading != heading_of(scene)) {
    fail_input(path, "has other columns than this version of Carom writes", "expected the version that began the file");
  }
  return path;
}

}  // namespace

// energy, momentum_flow: of velocities relative to a shear flow.
IntervalMeans SeriesMeter::means(const Energy& energy, double momentum_flow, const State& now) const {
  const double elapsed = now.time - done_.counted_until;
  if (!(elapsed > 0.0)) return done_.means;
  const Counters& c = now.counters;
  const double disk_time = c.disk_time - done_.before.disk_time;
  const auto collisions = static_cast<double>(c.collisions - done_.before.collisions);
  IntervalMeans mean{pressure(energy, c.virial - done_.before.virial, elapsed, box_at(box_, now.time)),
                     disk_time > 0.0 ? 2.0 * collisions / disk_time : 0.0,
                     {}};
  for (std::size_t side = 0; side < 4; ++side) {
    mean.force[side] = (c.wall_impulse[side] - done_.before.wall_impulse[side]) / elapsed;
  }
  if (box_.shear.acts()) {
    const double virial = c.shear_virial - done_.before.shear_virial;
    mean.shear_stress = shear_stress(momentum_flow, virial, elapsed, box_);
  }
  return mean;
}

SeriesRow SeriesMeter::row(const DisksInPieces& disks, const State& now, const BlockRunner& run) {
  const Counters& c = now.counters;
  RowTally sums;
  disks.visit([&](const Disks& some) { sums.add(some, box_, gravity_, run); });
  const Energy energy{sums.kinetic.value(), sums.potential.value(), sums.rotational.value()};
  const auto count = static_cast<double>(disks.size());
  if (box_.shear.acts()) {
    const double relative = sums.relative.value();
    done_.means = means({relative}, sums.flow.value(), now);
    const double temperature = disks.size() == 0 ? 0.0 : relative / count;
    const double stress = done_.means.shear_stress;
    shear_row_ = {stress, stress / box_.shear.rate, temperature, c.shear_work};
  } else {
    done_.means = means(energy, 0.0, now);
  }
  const auto of_velocities = [&](double value) { return drawn_ ? std::numeric_limits<double>::quiet_NaN() : value; };
  const SeriesRow row{count,
                      of_velocities(energy.kinetic),
                      energy.potential,
                      of_velocities(energy.total()),
                      of_velocities(sums.px.value()),
                      of_velocities(sums.py.value()),
                      static_cast<double>(c.collisions),
                      static_cast<double>(c.wall_collisions),
                      of_velocities(done_.means.pressure),
                      done_.means.collision_rate,
                      with_overlap_ ? overlap_of(disks, box_at(box_, disks.time()), run) : 0.0,
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
      sinks_(sinks_of(scene)),
      meter_(scene, true),
      groups_(scene),
      rotates_(scene.physics.surfaces.are_rough()),
      with_displacement_(scene.analysis.wants(Quantity::displacement)) {
  file_.write(heading_of(scene) + "\n");
}

SeriesWriter::SeriesWriter(const std::string& path, const Scene& scene, const SeriesMark& from)
    : file_(with_heading(path, scene), from.file.bytes),
      sources_(scene),
      sinks_(sinks_of(scene)),
      meter_(scene, true, from.meter),
      groups_(scene),
      rotates_(scene.physics.surfaces.are_rough()),
      with_displacement_(scene.analysis.wants(Quantity::displacement)),
      rows_(from.file.frames) {}

SeriesMark SeriesWriter::mark() {
  file_.sync();
  return {{file_.name(), rows_, file_.bytes()}, meter_.mark()};
}

SeriesRow SeriesWriter::write(const DisksInPieces& disks, const State& now, double displacement,
                              const BlockRunner& run) {
  const SeriesRow row = meter_.row(disks, now, run);
  // {} writes the shortest text that reads back as the same double.
  std::string line = fmt::format("{}", disks.time());
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (series_columns[k].whole) {
      fmt::format_to(std::back_inserter(line), ",{}", static_cast<Count>(row[k]));
    } else {
      fmt::format_to(std::back_inserter(line), ",{}", row[k]);
    }
  }
  if (with_displacement_) fmt::format_to(std::back_inserter(line), ",{}", displacement);
  for (const SceneSink& sink : sinks_) fmt::format_to(std::back_inserter(line), ",{}", taken_by(sink, now));
  for (const double value : side_column_values(sources_, now.counters)) {
    fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  if (rotates_) {
    for (const double value : rotation_column_values(disks, run))
      fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  if (sources_.box.shear.acts()) {
    for (const double value : meter_.shear_row()) fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  if (!groups_.empty()) {
    for (const double value : groups_.row(disks)) fmt::format_to(std::back_inserter(line), ",{}", value);
  }
  file_.write(line + "\n");
  file_.flush();
  ++rows_;
  return row;
}

}  // namespace carom
