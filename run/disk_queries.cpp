#include "run/disk_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/input_message.hpp"

namespace carom {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double longest_ray = 1e6;  // boxes

void check_finite(const char* what, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) fail_input(what, fmt::format("is {}", number), "expected finite numbers");
  }
}

void check_inside(const char* what, const Domain& box, Vec2 place) {
  check_finite(what, {place.x, place.y});
  if (place.x >= 0.0 && place.x <= box.width && place.y >= 0.0 && place.y <= box.height) return;
  fail_input(what, fmt::format("({}, {}) lies outside the box", place.x, place.y),
             fmt::format("expected a place within {} x {}", box.width, box.height));
}

// Any coordinate, brought into [0, period) by whole periods.
double into_period(double c, double period) {
  const double inside = c - period * std::floor(c / period);
  return inside >= 0.0 && inside < period ? inside : 0.0;
}

Vec2 into_box(Vec2 place, const Domain& box) {
  if (box.periodic_x()) place.x = into_period(place.x, box.width);
  if (box.periodic_y()) place.y = into_period(place.y, box.height);
  return place;
}

// Does [low, high], perhaps shifted by a period, hold c?
bool holds(double low, double high, double c, double period, bool periodic) {
  if (c >= low && c <= high) return true;
  if (!periodic) return false;
  if (high - low >= period) return true;
  const double shifted = low + into_period(c - low, period);
  return shifted <= high;
}

Vec2 from_to(Vec2 from, const Disks& d, std::size_t i, const Domain& box) {
  return nearest_image({d.x[i] - from.x, d.y[i] - from.y}, box);
}

// How far along a unit direction from the origin a line enters a disk around `centre`; 0 if it begins inside; infinite
// where it does not meet it.
double entry(Vec2 centre, double radius, Vec2 direction) {
  const double along = centre.x * direction.x + centre.y * direction.y;
  const double c = centre.x * centre.x + centre.y * centre.y - radius * radius;
  if (c <= 0.0) return 0.0;
  const double across = centre.x * direction.y - centre.y * direction.x;
  const double half_chord2 = radius * radius - across * across;
  if (along <= 0.0 || half_chord2 < 0.0) return infinite;
  return c / (along + std::sqrt(half_chord2));
}

// The length of a ray inside the sides that are not periodic.
double clipped(const Domain& box, Vec2 from, Vec2 direction, double length) {
  const auto clip = [&](double at, double speed, double size, bool periodic) {
    if (periodic || speed == 0.0) return;
    length = std::min(length, ((speed > 0.0 ? size : 0.0) - at) / speed);
  };
  clip(from.x, direction.x, box.width, box.periodic_x());
  clip(from.y, direction.y, box.height, box.periodic_y());
  return std::max(length, 0.0);
}

// A ray is looked at piece by piece, so that the disks near a piece are few and nearest images are the right ones.
double piece_length(const Disks& disks, const Domain& box) {
  const double box_size = std::min(box.width, box.height);
  if (disks.empty()) return box_size;
  const double spacing = std::sqrt(box.width * box.height / static_cast<double>(disks.size()));
  return std::min(0.25 * box_size, std::max(4.0 * spacing, 1e-3 * box_size));
}

// The first disk, the smaller id of two, that a piece of this length meets; its distance is from the piece's start.
std::optional<RayHit> first_in_piece(const Disks& disks, const Domain& box, const VisitNear& near, Vec2 start,
                                     Vec2 direction, double length, double largest) {
  const double half = 0.5 * length;
  const Vec2 centre = into_box({start.x + half * direction.x, start.y + half * direction.y}, box);
  std::optional<RayHit> first;
  const auto look = [&](std::size_t i) {
    const Vec2 to = from_to(centre, disks, i, box);
    const double t = entry({to.x + half * direction.x, to.y + half * direction.y}, disks.radius_of(i), direction);
    if (t > length) return;
    if (!first || t < first->distance || (t == first->distance && disks.id[i] < first->id)) {
      first = RayHit{disks.id[i], t, {}};
    }
  };
  near(centre, half * std::abs(direction.x) + largest, half * std::abs(direction.y) + largest, look);
  return first;
}

}  // namespace

VisitNear visit_all(const Disks& disks) {
  return [&disks](Vec2, double, double, const Visit& visit) {
    for (std::size_t i = 0; i < disks.size(); ++i) visit(i);
  };
}

std::vector<DiskId> disks_in(const Disks& disks, const Domain& box, const VisitNear& near, Vec2 low, Vec2 high) {
  check_finite("rectangle", {low.x, low.y, high.x, high.y});
  if (!(low.x <= high.x && low.y <= high.y)) {
    fail_input("rectangle", fmt::format("({}, {}) to ({}, {})", low.x, low.y, high.x, high.y),
               "expected the lower corner first");
  }
  // Without periodic sides nothing lies outside the box.
  const auto cut = [](double& from, double& to, double size, bool periodic) {
    if (periodic) return;
    from = std::clamp(from, 0.0, size);
    to = std::clamp(to, 0.0, size);
  };
  Vec2 from = low, to = high;
  cut(from.x, to.x, box.width, box.periodic_x());
  cut(from.y, to.y, box.height, box.periodic_y());
  const Vec2 centre = into_box({0.5 * (from.x + to.x), 0.5 * (from.y + to.y)}, box);
  std::vector<DiskId> ids;
  near(centre, std::min(0.5 * (to.x - from.x), box.width), std::min(0.5 * (to.y - from.y), box.height),
       [&](std::size_t i) {
         if (holds(low.x, high.x, disks.x[i], box.width, box.periodic_x()) &&
             holds(low.y, high.y, disks.y[i], box.height, box.periodic_y())) {
           ids.push_back(disks.id[i]);
         }
       });
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::optional<NearDisk> nearest_disk(const Disks& disks, const Domain& box, const VisitNear& near, Vec2 place) {
  check_inside("place", box, place);
  if (disks.empty()) return std::nullopt;
  std::optional<NearDisk> best;
  const auto look = [&](std::size_t i) {
    const double distance = std::sqrt(nearest_distance2({disks.x[i] - place.x, disks.y[i] - place.y}, box));
    if (best && (distance > best->distance || (distance == best->distance && disks.id[i] >= best->id))) return;
    best = NearDisk{disks.id[i], distance};
  };
  // What lies within the reach is all seen; so the search is over once the best is. A larger reach sees the whole box.
  double reach = std::sqrt(box.width * box.height / static_cast<double>(disks.size()));
  for (;; reach *= 2.0) {
    near(into_box(place, box), reach, reach, look);
    if ((best && best->distance <= reach) || (reach > box.width && reach > box.height)) return best;
  }
}

std::optional<RayHit> cast_ray(const Disks& disks, const Domain& box, const VisitNear& near, Vec2 from, Vec2 direction,
                               double length) {
  check_inside("ray", box, from);
  check_finite("ray", {direction.x, direction.y, length});
  const double speed = std::hypot(direction.x, direction.y);
  if (!(speed > 0.0) || !std::isfinite(speed)) fail_input("ray", "has no direction", "expected one that is not (0, 0)");
  const Vec2 unit{direction.x / speed, direction.y / speed};
  const double whole = clipped(box, from, unit, std::max(length, 0.0));
  const double size = std::min(box.width, box.height);
  if (whole > longest_ray * size) {
    fail_input("ray", fmt::format("is {} long", whole), fmt::format("expected at most {}", longest_ray * size));
  }
  const double piece = piece_length(disks, box);
  const double largest = largest_radius(disks);
  for (double done = 0.0; done <= whole; done += piece) {
    const Vec2 start{from.x + done * unit.x, from.y + done * unit.y};
    auto hit = first_in_piece(disks, box, near, start, unit, std::min(piece, whole - done), largest);
    if (!hit) continue;
    hit->place = into_box({start.x + hit->distance * unit.x, start.y + hit->distance * unit.y}, box);
    hit->distance += done;
    return hit;
  }
  return std::nullopt;
}

}  // namespace carom
