#include "io/series.hpp"

#include <fmt/format.h>

#include "core/invariants.hpp"

namespace carom {

namespace {

constexpr const char* heading =
    "t,disks,kinetic,potential,total,px,py,collisions,wall_collisions,pressure,collision_rate,max_overlap,removed,"
    "emitted,waiting,force_left,force_right,force_bottom,force_top\n";

}  // namespace

SeriesWriter::SeriesWriter(const std::string& path, const Scene& scene)
    : file_(path), box_(scene.box), gravity_(scene.physics.gravity) {
  file_.write(heading);
}

SeriesWriter::SeriesWriter(const std::string& path, const Scene& scene, const SeriesMark& from)
    : file_(path, from.file.bytes),
      box_(scene.box),
      gravity_(scene.physics.gravity),
      rows_(from.file.frames),
      counted_until_(from.counted_until),
      before_(from.before) {}

SeriesMark SeriesWriter::mark() {
  file_.sync();
  return {{file_.name(), rows_, file_.bytes()}, counted_until_, before_};
}

void SeriesWriter::write(const Disks& disks, double time, const State& now) {
  const Counters& c = now.counters;
  const double elapsed = now.time - counted_until_;
  const Energy energy = energy_of(disks, gravity_);
  const Momentum momentum = momentum_of(disks);
  const auto collisions = static_cast<double>(c.collisions - before_.collisions);
  const double disk_time = elapsed * static_cast<double>(disks.size());
  // {} writes the shortest text that reads back as the same double.
  std::string row = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", time, disks.size(), energy.kinetic,
                                energy.potential, energy.total(), momentum.x, momentum.y, c.collisions,
                                c.wall_collisions, pressure(energy, c.virial - before_.virial, elapsed, box_),
                                disk_time > 0.0 ? 2.0 * collisions / disk_time : 0.0, max_overlap(disks, box_),
                                c.removed, c.emitted, c.waiting);
  for (int side = 0; side < 4; ++side) {
    const double force = elapsed > 0.0 ? (c.wall_impulse[side] - before_.wall_impulse[side]) / elapsed : 0.0;
    fmt::format_to(std::back_inserter(row), ",{}", force);
  }
  row += '\n';
  file_.write(row);
  file_.flush();
  ++rows_;
  before_ = c;
  counted_until_ = now.time;
}

}  // namespace carom
