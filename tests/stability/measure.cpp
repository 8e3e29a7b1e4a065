#include "tests/stability/measure.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/obstacle_cells.hpp"

namespace carom::stability {

namespace {

bool is_outside(const Disks& d, const Domain& box, std::size_t i) {
  const bool inside = d.x[i] >= 0.0 && d.x[i] <= box.width && d.y[i] >= 0.0 && d.y[i] <= box.height;
  return !inside || !std::isfinite(d.vx[i] + d.vy[i]);
}

double ratio(double end, double start) {
  return start != 0.0 ? end / start : end;
}

// The number of pairs of disks whose order from left to right has changed since the start.
double passed(const Disks& start, const Disks& end) {
  const std::vector<std::size_t> a = by_id(start);
  const std::vector<std::size_t> b = by_id(end);
  double count = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    for (std::size_t j = i + 1; j < std::min(a.size(), b.size()); ++j) {
      const double before = start.x[a[j]] - start.x[a[i]];
      const double after = end.x[b[j]] - end.x[b[i]];
      count += before * after < 0.0 ? 1.0 : 0.0;
    }
  }
  return count;
}

double largest(const Disks& d, const std::function<double(std::size_t)>& value) {
  double most = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) most = std::max(most, value(i));
  return most;
}

double lean(const Disks& start, const Disks& end) {
  const std::vector<std::size_t> a = by_id(start);
  const std::vector<std::size_t> b = by_id(end);
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    most = std::max(most, std::abs(end.x[b[i]] - start.x[a[i]]));
  }
  return most;
}

double rate(const Measured& run) {
  const double disk_time = static_cast<double>(run.end.disks.size()) * run.end.time;
  return disk_time > 0.0 ? 2.0 * static_cast<double>(run.end.counters.collisions) / disk_time : 0.0;
}

// "x12": the coordinate of disk 12.
std::optional<double> coordinate(const std::string& what, const Disks& d) {
  const std::size_t digits = what.find_first_of("0123456789");
  if (digits == std::string::npos) return std::nullopt;
  const std::string name = what.substr(0, digits);
  const auto* const column = name == "x"    ? &d.x
                             : name == "y"  ? &d.y
                             : name == "vx" ? &d.vx
                             : name == "vy" ? &d.vy
                                            : nullptr;
  std::size_t id = 0;
  std::from_chars(what.data() + digits, what.data() + what.size(), id);
  if (column == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d.id[i] == id) return (*column)[i];
  }
  return std::nullopt;
}

}  // namespace

void Worst::look(const Scene& scene, const State& start, const State& now) {
  const double g = scene.physics.gravity.down;
  const Energy before = energy_of(start.disks, g);
  const Energy after = energy_of(now.disks, g);
  overlap = std::max(overlap, max_overlap(now.disks, scene.box));
  Domain box = box_at(scene.box, now.time);
  const auto obstacles = place_obstacles(now.obstacles, box, motions_of(scene));
  wall_overlap = std::max(wall_overlap, carom::wall_overlap(now.disks, box));
  double work = now.counters.wall_work;  // and moving sides
  for (const double of_side : now.counters.side_energy) work += of_side;
  const double kept = ratio(after.total() - work, before.total()) - (before.total() != 0.0 ? 1.0 : 0.0);
  const double drift =
      work == 0.0 ? kept : kept * before.total() / after.total();  // relative to the energy to which it has grown
  energy_drift = std::max(energy_drift, std::abs(drift));
  energy_gain = std::max(energy_gain, drift);
  momentum = std::max(momentum, momentum_drift(momentum_of(start.disks), momentum_of(now.disks)));
  Count lost = 0;
  for (std::size_t i = 0; i < now.disks.size(); ++i) lost += is_outside(now.disks, scene.box, i) ? 1U : 0U;
  outside = std::max(outside, lost);
}

double measure(const std::string& what, const Measured& run) {
  using Figure = std::function<double()>;
  const Disks& d = run.end.disks;
  const Counters& c = run.end.counters;
  const double g = run.scene.physics.gravity.down;
  const std::map<std::string, Figure> figures{
      {"time", [&] { return run.end.time; }},
      {"advance", [&] { return run.end.time / (static_cast<double>(c.steps) * run.scene.run.dt); }},
      {"collisions", [&] { return static_cast<double>(c.collisions); }},
      {"events", [&] { return static_cast<double>(c.collisions + c.wall_collisions); }},
      {"rate", [&] { return rate(run); }},
      {"energy_drift", [&] { return run.worst.energy_drift; }},
      {"energy_gain", [&] { return run.worst.energy_gain; }},
      {"energy", [&] { return ratio(energy_of(d, g).total(), energy_of(run.start.disks, g).total()); }},
      {"kinetic", [&] { return ratio(energy_of(d, g).kinetic, energy_of(run.start.disks, g).kinetic); }},
      {"unrest", [&] { return ratio(energy_of(d, g).kinetic, energy_of(run.start.disks, g).total()); }},
      {"kinetic_now", [&] { return energy_of(d, g).kinetic; }},
      {"momentum", [&] { return run.worst.momentum; }},
      {"overlap", [&] { return run.worst.overlap; }},
      {"wall_overlap", [&] { return run.worst.wall_overlap; }},
      {"outside", [&] { return static_cast<double>(run.worst.outside); }},
      {"passed", [&] { return passed(run.start.disks, d); }},
      {"fastest", [&] { return largest(d, [&](std::size_t i) { return std::hypot(d.vx[i], d.vy[i]); }); }},
      {"disks", [&] { return static_cast<double>(d.size()); }},
      {"lean", [&] { return lean(run.start.disks, d); }},
  };
  if (const auto it = figures.find(what); it != figures.end()) return it->second();
  if (const std::optional<double> value = coordinate(what, d)) return *value;
  throw InputError("the suite cannot measure \"" + what + "\"");
}

}  // namespace carom::stability
