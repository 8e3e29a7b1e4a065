#include "core/start/growth_step.hpp"

#include "core/reference/pair_search.hpp"

namespace carom {

GrowthTally grow_step(Disks& d, const Domain& box, const std::vector<double>& target) {
  const double length = std::max(box.width, box.height);
  const std::vector<double> before = d.radius;
  std::vector<double> after(d.size());
  GrowthTally tally;
  for (std::size_t i = 0; i < d.size(); ++i) {
    after[i] = std::min(target[d.id[i]], radius_within_sides(box, d.x[i], d.y[i], before[i]));
    tally.overlap = tally.overlap || !within_sides(box, d.x[i], d.y[i], before[i]);
    d.radius[i] = growth_reach(before[i], target[d.id[i]]);
    const RoomAtObstacles room = radius_within_obstacles(box, d.x[i], d.y[i], before[i], d.radius[i]);
    after[i] = std::min(after[i], room.radius);
    tally.overlap = tally.overlap || room.overlap;
  }
  for (const Pair& p : find_touching_pairs(d, box)) {
    const double distance2 = nearest_distance2({d.x[p.i2] - d.x[p.i1], d.y[p.i2] - d.y[p.i1]}, box);
    const double contact = before[p.i1] + before[p.i2];
    tally.overlap = tally.overlap || distance2 < contact * contact;
    const double usable = usable_gap(std::sqrt(distance2) - contact, length);
    const double lack1 = target[d.id[p.i1]] - before[p.i1];
    const double lack2 = target[d.id[p.i2]] - before[p.i2];
    if (lack1 > 0.0) after[p.i1] = std::min(after[p.i1], radius_within(before[p.i1], lack1, lack2, usable));
    if (lack2 > 0.0) after[p.i2] = std::min(after[p.i2], radius_within(before[p.i2], lack2, lack1, usable));
  }
  d.radius = after;
  for (std::size_t i = 0; i < d.size(); ++i) tally.add(before[i], after[i], target[d.id[i]]);
  return tally;
}

}  // namespace carom
