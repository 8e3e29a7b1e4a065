#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/gnuplot.hpp"

namespace carom {

namespace {

VelocityRecord::Curve* find_curve(VelocityRecord& record, DiskId id) {
  for (auto& curve : record.curves) {
    if (curve.id == id) return &curve;
  }
  return nullptr;
}

// Disks not seen before, lowest ids first, until there are ten. Ids only grow, so the order stays ascending.
void adopt_newcomers(VelocityRecord& record, const Disks& disks) {
  for (const std::size_t i : by_id(disks)) {
    if (record.curves.size() == most_velocity_curves) return;
    if (record.curves.empty() || disks.id[i] > record.curves.back().id)
      record.curves.push_back({disks.id[i], {}, {}, {}});
  }
}

std::string heading(const std::string& title, const char* subject) {
  return title.empty() ? subject : fmt::format("{}: {}", title, subject);
}

}  // namespace

void record(VelocityRecord& record, const Disks& disks, double time) {
  record.end = time;
  if (record.curves.size() < most_velocity_curves) adopt_newcomers(record, disks);
  if (record.curves.empty()) return;
  const DiskId last = record.curves.back().id;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (disks.id[i] > last) continue;
    if (auto* const curve = find_curve(record, disks.id[i])) {
      curve->t.push_back(time);
      curve->vx.push_back(disks.vx[i]);
      curve->vy.push_back(disks.vy[i]);
    }
  }
}

bool plot_velocity(const std::string& path, const std::string& title, const VelocityRecord& record) {
  Figure figure{heading(title, "velocities"), "time t", record.end, {{"vx", {}}, {"vy", {}}}};
  for (const auto& curve : record.curves) {
    const std::string name = fmt::format("disk {}", curve.id);
    figure.panels[0].lines.push_back({name, curve.t, curve.vx});
    figure.panels[1].lines.push_back({name, curve.t, curve.vy});
  }
  return draw_svg(figure, path);
}

bool plot_energy(const std::string& path, const std::string& title, const EnergyRecord& record) {
  // From zero: without it the axis would zoom into rounding errors of a total that is constant.
  Panel panel{"energy", {}, true, true};
  panel.lines.push_back({"total", record.t, record.total});
  panel.lines.push_back({"kinetic", record.t, record.kinetic});
  const bool has_potential =
      std::any_of(record.potential.begin(), record.potential.end(), [](double u) { return u != 0.0; });
  if (has_potential) panel.lines.push_back({"potential", record.t, record.potential});
  return draw_svg({heading(title, "energy"), "time t", record.t.empty() ? 0.0 : record.t.back(), {panel}}, path);
}

}  // namespace carom
