#include "tests/fuzz_scenes/closest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"

namespace carom::fuzz {

namespace {

// The distance of (x, y) from the images of the segment from 0 to (dx, dy), which may be a point.
double distance(double x, double y, double dx, double dy, const Domain& box) {
  double least = HUGE_VAL;
  const int px = box.periodic_x() ? 2 : 0;
  const int py = box.periodic_y() ? 2 : 0;
  const double length2 = dx * dx + dy * dy;
  for (int kx = -px; kx <= px; ++kx) {
    for (int ky = -py; ky <= py; ++ky) {
      const double ax = x - kx * box.width;
      const double ay = y - ky * box.height;
      const double share = length2 > 0.0 ? std::clamp((ax * dx + ay * dy) / length2, 0.0, 1.0) : 0.0;
      least = std::min(least, std::hypot(ax - share * dx, ay - share * dy));
    }
  }
  return least;
}

// The squared distance of the nearest images of two places in the box.
double distance2(double dx, double dy, const Domain& box) {
  if (!box.shear.acts()) {
    if (box.periodic_x() && std::abs(dx) > 0.5 * box.width) dx = box.width - std::abs(dx);
    if (box.periodic_y() && std::abs(dy) > 0.5 * box.height) dy = box.height - std::abs(dy);
    return dx * dx + dy * dy;
  }
  double least = HUGE_VAL;
  for (int ky = -1; ky <= 1; ++ky) {
    const double x = std::remainder(dx + ky * box.shear.offset, box.width);
    const double y = dy + ky * box.height;
    least = std::min(least, x * x + y * y);
  }
  return least;
}

class Search {
 public:
  Search(const Disks& disks, const Scene& scene, double time)
      : disks_(disks), box_(box_at(scene.box, time)), unit_(disks.empty() ? 1.0 : smallest_radius(disks)) {}

  void see_pairs() {
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      for (std::size_t j = i + 1; j < disks_.size(); ++j) {
        const double reach = disks_.radius_of(i) + disks_.radius_of(j);
        const double apart2 = distance2(disks_.x[i] - disks_.x[j], disks_.y[i] - disks_.y[j], box_);
        if (apart2 >= reach * reach) continue;
        see(std::sqrt(apart2) - reach,
            [&] { return fmt::format("disks {} and {} overlap", disks_.id[i], disks_.id[j]); });
      }
    }
  }

  void see_sides() {
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const double gaps[] = {disks_.x[i], box_.width - disks_.x[i], disks_.y[i], box_.height - disks_.y[i]};
      for (const Side side : all_sides) {
        if (box_.side(side) == SideKind::periodic) continue;
        const auto k = static_cast<std::size_t>(side);
        see(gaps[k] - box_.place(side).inset - disks_.radius_of(i),
            [&] { return fmt::format("disk {} is beyond side {}", disks_.id[i], k); });
      }
    }
  }

  void see_obstacle(const Obstacle& o, std::size_t k) {
    for (std::size_t i = 0; i < disks_.size(); ++i) {
      const double apart = distance(disks_.x[i] - o.x, disks_.y[i] - o.y, o.dx, o.dy, box_);
      see(apart - o.radius - disks_.radius_of(i),
          [&] { return fmt::format("disk {} is in obstacle {}", disks_.id[i], k); });
    }
  }

  Closest result() const { return closest_; }
  const Domain& box() const { return box_; }

 private:
  template <class Say>
  void see(double gap, Say&& say) {
    if (!(gap / unit_ < closest_.gap)) return;
    closest_.gap = gap / unit_;
    if (gap < 0.0) closest_.what = say();
  }

  const Disks& disks_;
  Domain box_;
  double unit_;
  Closest closest_;
};

}  // namespace

Closest closest_of(const Disks& disks, const std::vector<Obstacle>& obstacles, const Scene& scene, double time) {
  Search search(disks, scene, time);
  search.see_pairs();
  search.see_sides();
  const std::vector<WallMotion> motions = motions_of(scene);
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    search.see_obstacle(at_time(obstacles[k], motions, time, search.box()), k);
  }
  return search.result();
}

}  // namespace carom::fuzz
