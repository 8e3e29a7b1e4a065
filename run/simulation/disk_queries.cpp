#include "run/simulation/disk_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/input_message.hpp"

namespace carom {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double longest_ray = 1e6;  // in lengths of the box

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

// Shifts any coordinate into [0, period) by whole periods.
double into_period(double c, double period) {
  const double inside = c - period * std::floor(c / period);
  return inside >= 0.0 && inside < period ? inside : 0.0;
}

Vec2 into_box(Vec2 place, const Domain& box) {
  if (box.periodic_x()) place.x = into_period(place.x, box.width);
  if (box.periodic_y()) place.y = into_period(place.y, box.height);
  return place;
}

// Does [low, high] contain c, possibly shifted by a period?
bool holds(double low, double high, double c, double period, bool periodic) {
  if (c >= low && c <= high) return true;
  if (!periodic) return false;
  if (high - low >= period) return true;
  const double shifted = low + into_period(c - low, period);
  return shifted <= high;
}

// Calls see(id, centre, radius) for every disk whose centre is within half_width and half_height of a place in the box,
// including nearest images, and for every fixed disk that reaches into that rectangle; possibly for others too, and for
// some twice. The centre is the one in the box.
template <class See>
void see_near(const QueryScene& scene, Vec2 place, double half_width, double half_height, See&& see) {
  const Disks& d = scene.disks;
  scene.near(place, half_width, half_height, [&](std::size_t i) {
    see(d.id[i], Vec2{d.x[i], d.y[i]}, d.radius_of(i));
  });
  if (scene.fixed == nullptr) return;
  // A rectangle larger than the box in both directions contains nothing else.
  const double across = std::min(half_width, scene.box.width), up = std::min(half_height, scene.box.height);
  scene.fixed->visit({place.x - across, place.y - up}, {place.x + across, place.y + up}, [&](std::uint32_t k, Vec2) {
    const Obstacle& o = (*scene.fixed)[k];
    see(o.id, Vec2{o.x, o.y}, o.radius);
  });
}

// The distance along a unit direction from the origin at which a line enters a disk around `centre`; 0 if it begins
// inside; infinite if it misses the disk.
double entry(Vec2 centre, double radius, Vec2 direction) {
  const double along = centre.x * direction.x + centre.y * direction.y;
  const double c = centre.x * centre.x + centre.y * centre.y - radius * radius;
  if (c <= 0.0) return 0.0;
  const double across = centre.x * direction.y - centre.y * direction.x;
  const double half_chord2 = radius * radius - across * across;
  if (along <= 0.0 || half_chord2 < 0.0) return infinite;
  return c / (along + std::sqrt(half_chord2));
}

// The distance along a unit direction from the origin at which a line crosses the segment from `to` to `to + along`;
// infinite if it does not. The two segments at a corner overlap by a rounding, so no line passes between them.
double crossing(Vec2 to, Vec2 along, Vec2 direction) {
  constexpr double rounding = 1e-12;  // relative to the segment
  const double sine = direction.x * along.y - direction.y * along.x;
  if (sine == 0.0) return infinite;
  const double t = (to.x * along.y - to.y * along.x) / sine;
  const double share = (to.x * direction.y - to.y * direction.x) / sine;
  return t >= 0.0 && share >= -rounding && share <= 1.0 + rounding ? t : infinite;
}

// The length of a ray up to the sides that are not periodic.
double clipped(const Domain& box, Vec2 from, Vec2 direction, double length) {
  const auto clip = [&](double at, double speed, double size, bool periodic) {
    if (periodic || speed == 0.0) return;
    length = std::min(length, ((speed > 0.0 ? size : 0.0) - at) / speed);
  };
  clip(from.x, direction.x, box.width, box.periodic_x());
  clip(from.y, direction.y, box.height, box.periodic_y());
  return std::max(length, 0.0);
}

// A ray is followed piece by piece, so that few disks are near a piece, and nearest images are the right ones.
double piece_length(const QueryScene& scene) {
  const double box_size = std::min(scene.box.width, scene.box.height);
  if (scene.count() == 0) return box_size;
  const double spacing = std::sqrt(scene.box.width * scene.box.height / static_cast<double>(scene.count()));
  return std::min(0.25 * box_size, std::max(4.0 * spacing, 1e-3 * box_size));
}

// The first disk that a piece of this length meets, of two the one with the smaller id; its distance is from the
// piece's start.
std::optional<RayHit> first_in_piece(const QueryScene& scene, Vec2 start, Vec2 direction, double length,
                                     double largest) {
  const double half = 0.5 * length;
  const Vec2 middle = into_box({start.x + half * direction.x, start.y + half * direction.y}, scene.box);
  std::optional<RayHit> first;
  const auto look = [&](DiskId id, Vec2 centre, double radius) {
    const Vec2 to = nearest_image({centre.x - middle.x, centre.y - middle.y}, scene.box);
    const double t = entry({to.x + half * direction.x, to.y + half * direction.y}, radius, direction);
    if (t > length) return;
    if (!first || t < first->distance || (t == first->distance && id < first->id)) first = RayHit{id, t};
  };
  see_near(scene, middle, half * std::abs(direction.x) + largest, half * std::abs(direction.y) + largest, look);
  if (scene.walls == nullptr) return first;
  const double across = half * std::abs(direction.x), up = half * std::abs(direction.y);
  const auto cross = [&](std::uint32_t k, Vec2 shift) {
    const Obstacle& o = (*scene.walls)[k];
    const Vec2 to{(o.x + shift.x - middle.x) + half * direction.x, (o.y + shift.y - middle.y) + half * direction.y};
    const double t = crossing(to, {o.dx, o.dy}, direction);
    if (t > length || (first && t > first->distance)) return;
    if (first && t == first->distance && (first->what == RayMet::disk || o.id >= first->id)) return;
    first = RayHit{o.id, t, {}, o.kind == ObstacleKind::sink ? RayMet::sink : RayMet::wall};
  };
  scene.walls->visit({middle.x - across, middle.y - up}, {middle.x + across, middle.y + up}, cross);
  return first;
}

}  // namespace

VisitNear visit_all(const Disks& disks) {
  return [&disks](Vec2, double, double, const Visit& visit) {
    for (std::size_t i = 0; i < disks.size(); ++i) visit(i);
  };
}

std::vector<DiskId> disks_in(const QueryScene& scene, Vec2 low, Vec2 high) {
  check_finite("rectangle", {low.x, low.y, high.x, high.y});
  if (!(low.x <= high.x && low.y <= high.y)) {
    fail_input("rectangle", fmt::format("({}, {}) to ({}, {})", low.x, low.y, high.x, high.y),
               "expected the lower corner first");
  }
  const Domain& box = scene.box;
  // Without periodic sides nothing is outside the box.
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
  see_near(scene, centre, std::min(0.5 * (to.x - from.x), box.width), std::min(0.5 * (to.y - from.y), box.height),
           [&](DiskId id, Vec2 at, double) {
             if (holds(low.x, high.x, at.x, box.width, box.periodic_x()) &&
                 holds(low.y, high.y, at.y, box.height, box.periodic_y())) {
               ids.push_back(id);
             }
           });
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::optional<NearDisk> nearest_disk(const QueryScene& scene, Vec2 place) {
  const Domain& box = scene.box;
  check_inside("place", box, place);
  if (scene.count() == 0) return std::nullopt;
  std::optional<NearDisk> best;
  const auto look = [&](DiskId id, Vec2 centre, double) {
    const double distance = std::sqrt(nearest_distance2({centre.x - place.x, centre.y - place.y}, box));
    if (best && (distance > best->distance || (distance == best->distance && id >= best->id))) return;
    best = NearDisk{id, distance};
  };
  // All disks within the reach are found, so the search ends once the nearest one is within it. A larger reach covers
  // the whole box.
  double reach = std::sqrt(box.width * box.height / static_cast<double>(scene.count()));
  for (;; reach *= 2.0) {
    see_near(scene, into_box(place, box), reach, reach, look);
    if ((best && best->distance <= reach) || (reach > box.width && reach > box.height)) return best;
  }
}

std::optional<RayHit> cast_ray(const QueryScene& scene, Vec2 from, Vec2 direction, double length) {
  const Domain& box = scene.box;
  check_inside("ray", box, from);
  check_finite("ray", {direction.x, direction.y, length});
  const double speed = std::hypot(direction.x, direction.y);
  if (!(speed > 0.0) || !std::isfinite(speed)) fail_input("ray", "has no direction", "expected one that is not (0, 0)");
  if (length < 0.0) fail_input("ray", fmt::format("is {} long", length), "expected a length of 0 or more");
  const Vec2 unit{direction.x / speed, direction.y / speed};
  const double whole = clipped(box, from, unit, length);
  const double size = std::min(box.width, box.height);
  if (whole > longest_ray * size) {
    fail_input("ray", fmt::format("is {} long", whole), fmt::format("expected at most {}", longest_ray * size));
  }
  const double piece = piece_length(scene);
  const double largest = largest_radius(scene.disks);
  for (double done = 0.0; done <= whole; done += piece) {
    const Vec2 start{from.x + done * unit.x, from.y + done * unit.y};
    auto hit = first_in_piece(scene, start, unit, std::min(piece, whole - done), largest);
    if (!hit) continue;
    hit->place = into_box({start.x + hit->distance * unit.x, start.y + hit->distance * unit.y}, box);
    hit->distance += done;
    return hit;
  }
  return std::nullopt;
}

}  // namespace carom
