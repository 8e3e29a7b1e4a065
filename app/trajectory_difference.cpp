#include "app/trajectory_difference.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#include "io/trajectory_reader.hpp"

namespace carom {

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::array<double, 6> quantities_of(const Disks& d, std::size_t i) {
  return {d.x[i], d.y[i], d.vx[i], d.vy[i], d.radius_of(i), d.mass_of(i)};
}

void note(TrajectoryDifference& result, const Difference& found) {
  if (!result.first) result.first = found;
}

void compare_disk(const Disks& a, std::size_t i, const Disks& b, std::size_t j, Difference place,
                  TrajectoryDifference& result) {
  const auto values_a = quantities_of(a, i);
  const auto values_b = quantities_of(b, j);
  place.id = a.id[i];
  for (std::size_t q = 0; q < values_a.size(); ++q) {
    if (same_bits(values_a[q], values_b[q])) continue;
    place.quantity = compared_quantities[q];
    place.a = values_a[q];
    place.b = values_b[q];
    note(result, place);
    auto& largest = result.largest[q];
    if (!largest || std::abs(place.a - place.b) > std::abs(largest->a - largest->b)) largest = place;
  }
}

// Both frames list their disks in order of id.
void compare_frame(const TrajectoryFrame& a, const TrajectoryFrame& b, Count frame, TrajectoryDifference& result) {
  Difference place;
  place.frame = frame;
  place.time = a.time;
  if (!same_bits(a.time, b.time)) note(result, {frame, a.time, 0, "time", a.time, b.time});
  std::size_t i = 0, j = 0;
  while (i < a.disks.size() && j < b.disks.size()) {
    if (a.disks.id[i] == b.disks.id[j]) {
      compare_disk(a.disks, i++, b.disks, j++, place, result);
      continue;
    }
    const bool only_in_a = a.disks.id[i] < b.disks.id[j];
    note(result, {frame, a.time, only_in_a ? a.disks.id[i++] : b.disks.id[j++], "disks",
                  static_cast<double>(a.disks.size()), static_cast<double>(b.disks.size())});
  }
  if (i < a.disks.size() || j < b.disks.size()) {
    note(result, {frame, a.time, i < a.disks.size() ? a.disks.id[i] : b.disks.id[j], "disks",
                  static_cast<double>(a.disks.size()), static_cast<double>(b.disks.size())});
  }
}

}  // namespace

TrajectoryDifference compare_trajectories(const std::string& path_a, const std::string& path_b) {
  const auto reader_a = open_trajectory(path_a), reader_b = open_trajectory(path_b);
  TrajectoryFrame a, b;
  TrajectoryDifference result;
  while (true) {
    const bool more_a = reader_a->read(a), more_b = reader_b->read(b);
    if (more_a) ++result.frames_a;
    if (more_b) ++result.frames_b;
    if (!more_a && !more_b) break;
    if (more_a && more_b) compare_frame(a, b, result.frames_a, result);
  }
  if (result.frames_a != result.frames_b) {
    note(result, {std::min(result.frames_a, result.frames_b) + 1, a.time, 0, "frames",
                  static_cast<double>(result.frames_a), static_cast<double>(result.frames_b)});
  }
  return result;
}

}  // namespace carom
