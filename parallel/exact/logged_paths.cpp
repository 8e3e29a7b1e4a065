#include "parallel/exact/logged_paths.hpp"

#include <algorithm>
#include <cstdint>

#include "core/physics/exact_path.hpp"

namespace carom {

namespace {

// For each disk, the last segment that has begun by time s of the window; a worker's log has a disk's segments in
// order. spin: set for rough disks whose segments are logged.
std::vector<PathSegment> paths_at(const WindowState& window, const SliceScheduler& scheduler, double s,
                                  std::vector<unsigned char>& gone, std::vector<double>& spin) {
  std::vector<PathSegment> path(window.record.size());
  for (std::size_t i = 0; i < path.size(); ++i) path[i] = window.record[i].path;
  gone.assign(path.size(), 0);
  std::vector<unsigned char> logged(path.size(), 0);
  scheduler.read_logs([&](const std::vector<LoggedSegment>& log, const std::vector<double>& spins) {
    for (std::size_t k = 0; k < log.size(); ++k) {
      const LoggedSegment& segment = log[k];
      const std::uint32_t i = segment.disk;
      if (segment.path.start > s || (logged[i] != 0 && segment.path.start < path[i].start)) continue;
      path[i] = segment.path;
      if (!spins.empty()) spin[i] = spins[k];
      gone[i] = segment.partner == LoggedSegment::gone ? 1 : 0;
      logged[i] = 1;
    }
  });
  return path;
}

}  // namespace

void move_along_paths(const WindowState& window, const SliceScheduler& scheduler, double s, const Domain& box,
                      const std::vector<unsigned char>& left_out, Disks& disks) {
  std::vector<unsigned char> gone;
  const std::vector<PathSegment> path = paths_at(window, scheduler, s, gone, disks.spin);
  for (std::size_t i = 0; i < path.size(); ++i) {
    PathSegment p = carried_to(path[i], s, window.rules.gravity);
    wrap_with_work(p, 0.0, box);
    put(p, disks, i);
  }
  for (std::size_t i = 0; i < left_out.size(); ++i) gone[i] |= left_out[i];
  remove_marked(disks, gone);
}

// Each of the two disks of a collision has a segment that begins with it.
std::vector<DiskContact> contacts_of_window(const SliceScheduler& scheduler, const std::vector<DiskId>& id,
                                            double start, const std::function<bool(std::uint32_t)>& counts) {
  std::vector<DiskContact> met;
  scheduler.read_logs([&](const std::vector<LoggedSegment>& log, const std::vector<double>& /*spins*/) {
    for (const LoggedSegment& segment : log) {
      if (!segment.with_disk() || id[segment.disk] > id[segment.partner] || !counts(segment.disk)) continue;
      met.push_back({id[segment.disk], id[segment.partner], start + segment.path.start});
    }
  });
  return met;
}

double fastest_of_window(const SliceScheduler& scheduler, const std::function<bool(std::uint32_t)>& counts) {
  double fastest = 0.0;
  scheduler.read_logs([&](const std::vector<LoggedSegment>& log, const std::vector<double>& /*spins*/) {
    for (const LoggedSegment& segment : log) {
      if (counts(segment.disk)) fastest = std::max(fastest, speed_at_start(segment.path));
    }
  });
  return fastest;
}

}  // namespace carom
