#include "core/start/lattice_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/start/circle_lattice.hpp"
#include "core/start/placement.hpp"
#include "core/start/start_region.hpp"

namespace carom {

namespace {

// The box that a lattice fills: the whole box, or a region's rectangle, periodic if it spans a periodic side.
struct LatticeRoom {
  Domain box;
  Vec2 origin;
};
LatticeRoom lattice_room(const Domain& box, const std::optional<StartRegion>& region) {
  if (!region) return {box, {}};
  LatticeRoom room{{region->high.x - region->low.x, region->high.y - region->low.y}, region->low};
  const SideKind across = spans_x(*region, box) ? SideKind::periodic : SideKind::wall;
  const SideKind up = spans_y(*region, box) ? SideKind::periodic : SideKind::wall;
  room.box.sides = {across, across, up, up};
  return room;
}

// Fixed disks may be wider than the box; on a lattice their sites would then be outside it. slack: a region filled in
// decimals by one row of disks may be narrower by this; length.
bool holds_disk(const Domain& box, double radius, double slack) {
  return (box.periodic_x() || box.width + slack >= 2.0 * radius) &&
         (box.periodic_y() || box.height + slack >= 2.0 * radius);
}

// The place nearest to c where the disk is between sides at 0 and length; the middle if length is the disk's diameter
// except for rounding.
double within_sides(double c, double radius, double length) {
  return radius < length - radius ? std::clamp(c, radius, length - radius) : 0.5 * length;
}

// A region that a row of disks fills may be narrower than the row by rounding of decimals far from the corner, by at
// most this slack. Its lattice is then extended by that, and `at` keeps the disks within the region.
Domain widened(Domain box, double slack) {
  if (!box.periodic_x()) box.width += slack;
  if (!box.periodic_y()) box.height += slack;
  return box;
}

std::optional<Lattice> lattice_in(const Domain& box, bool square, Count count, double diameter) {
  return square ? square_lattice(box, count, diameter) : hexagonal_lattice(box, count, diameter);
}

[[noreturn]] void fail_lattice(const Scene& scene, std::size_t group, double radius, const std::string& room,
                               Count capacity) {
  const DiskGroup& g = scene.groups[group];
  fail_input(place_in_group(scene, group, "positions"),
             fmt::format("{} disks of radius up to {} do not fit on a {} lattice in {}", g.count, radius,
                         g.positions.kind == PositionLaw::Kind::square ? "square" : "hexagonal", room),
             fmt::format("expected at most {}", capacity));
}

}  // namespace

LatticePlaces::LatticePlaces(const Scene& scene, std::size_t group, double radius)
    : radius_(radius), count_(scene.groups[group].count) {
  const PositionLaw& law = scene.groups[group].positions;
  const bool square = law.kind == PositionLaw::Kind::square;
  const std::optional<StartRegion>& region = law.region;
  if (region && region->circle) {
    fill_circle(scene, group);
    return;
  }
  const auto [box, origin] = lattice_room(scene.box, region);
  box_ = box;
  origin_ = origin;
  const std::string room = fmt::format("the {} of {} x {}", region ? "region" : "box", box.width, box.height);
  const double slack = place_slack(scene.box, radius);
  if (!holds_disk(box, radius, slack)) fail_lattice(scene, group, radius, room, 0);
  std::optional<Lattice> lattice = lattice_in(box, square, count_, 2.0 * radius);
  const Domain most = region ? widened(box, slack) : box;
  if (!lattice) lattice = lattice_in(most, square, count_, 2.0 * radius);
  if (!lattice) {
    fail_lattice(scene, group, radius, room,
                 square ? square_capacity(most, 2.0 * radius) : hexagonal_capacity(most, 2.0 * radius));
  }
  lattice_ = *lattice;
}

void LatticePlaces::fill_circle(const Scene& scene, std::size_t group) {
  const PositionLaw& law = scene.groups[group].positions;
  const StartRegion& region = *law.region;
  // A disk that fills the circle in decimals may be wider by rounding.
  const double reach = std::max(0.0, region.radius - radius_);
  const CircleLattice lattice{law.kind == PositionLaw::Kind::hexagonal, reach, 2.0 * radius_};
  sites_ = circle_sites(lattice, count_);
  origin_ = region.centre;
  if (!sites_.empty()) return;
  fail_lattice(scene, group, radius_, fmt::format("the circle of radius {}", region.radius), circle_capacity(lattice));
}

Vec2 LatticePlaces::at(Count k) const {
  if (!sites_.empty()) return {origin_.x + sites_[k].x, origin_.y + sites_[k].y};
  Vec2 site = lattice_site(lattice_, k, count_);
  // Rounding must not move the outermost disks of a full lattice into a side.
  if (!box_.periodic_x()) site.x = within_sides(site.x, radius_, box_.width);
  if (!box_.periodic_y()) site.y = within_sides(site.y, radius_, box_.height);
  return {origin_.x + site.x, origin_.y + site.y};
}

}  // namespace carom
