#include "parallel/exact_scan.hpp"

#include <algorithm>

namespace carom {

NextEvent ExactScan::earliest(std::uint32_t i, double from) const {
  const Flight* const flight = field_->flight.data();
  const PathSegment& path = flight[i].path;
  const bool far = flies_far(path);
  ApproachFrame own = frame(path, from);
  own.own_reach = flight[i].radius + field_->slack;
  NextEvent best = earliest_at_sides(i, path, far);
  lists_->see_neighbours(i, [&](const std::uint32_t* near, std::uint32_t n) {
    const auto path_of = [&](std::uint32_t k) -> const PathSegment& { return flight[near[k]].path; };
    if (far) {
      for (std::uint32_t k = 0; k < n; ++k) meet(i, path, near[k], path_of(k), best);
      return;
    }
    double least[ApproachBatch::size];
    const std::uint32_t candidates = approaching_flights_(own, flight, near, n, least);
    meet_candidates(i, path, from, candidates, least, near, path_of, best);
  });
  return best;
}

// The exact formula; `best` becomes this meeting if it comes first.
void ExactScan::meet(std::uint32_t i, const PathSegment& path, std::uint32_t j, const PathSegment& seen,
                     NextEvent& best) const {
  const Flight& own = field_->flight[i];
  const Flight& other = field_->flight[j];
  const ExactRules& rules = field_->rules;
  const bool in_order = own.id < other.id;
  const double reach = own.radius + other.radius;
  const PathSegment& first = in_order ? path : seen;
  const PathSegment& second = in_order ? seen : path;
  const double t = meeting_time(first, second, reach, rules.box, rules.gravity, field_->horizon);
  if (t == never) return;
  const NextEvent e{t, in_order ? own.id : other.id, in_order ? other.id : own.id, j, 0};
  if (e.before(best)) best = e;
}

ApproachFrame ExactScan::frame(const PathSegment& path, double from) const {
  const ExactRules& rules = field_->rules;
  const PathSegment p = carried_to(path, from, rules.gravity);
  const double blur = 0.1 * field_->slack;
  ApproachFrame f{from, p.x, p.y, p.vx, p.vy, rules.gravity, 0.0, 0.0, HUGE_VAL, HUGE_VAL, blur * blur};
  if (rules.box.periodic_x()) {
    f.width = rules.box.width;
    f.half_width = 0.5 * f.width;
  }
  if (rules.box.periodic_y()) {
    f.height = rules.box.height;
    f.half_height = 0.5 * f.height;
  }
  return f;
}

NextEvent ExactScan::earliest_at_sides(std::uint32_t i, const PathSegment& path, bool far) const {
  const Flight& own = field_->flight[i];
  const Domain& box = field_->rules.box;
  const double g = field_->rules.gravity;
  NextEvent best;
  const auto look = [&](Side side) {
    const NextEvent e{side_time(path, side, own.radius, box, g, field_->horizon), own.id, wall_partner(side), i, 0};
    if (e.time < never && e.before(best)) best = e;
  };
  const unsigned near = lists_->sides_near(i);
  if (near != 0) {
    for (const Side side : all_sides) {
      if ((near >> static_cast<unsigned>(side) & 1U) != 0) look(side);
    }
  }
  if (!far) return best;
  // Crossing events can only happen to a disk that flies far within the window.
  const double span = (field_->horizon - path.start) * (1.0 + 1e-9);
  if (box.periodic_x() && std::abs(path.vx) * span >= longest_flight * box.width) {
    look(path.vx > 0.0 ? Side::right : Side::left);
  }
  if (box.periodic_y() && (std::abs(path.vy) + g * span) * span >= longest_flight * box.height) {
    look(path.vy > 0.0 ? Side::top : Side::bottom);
  }
  return best;
}

}  // namespace carom
