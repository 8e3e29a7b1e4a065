// While a disk stays listed it is near its listed position on its whole path, straight, or bent by gravity or in the
// frame of a shear, and does not return to it around a periodic box; and disks that may touch meanwhile list each
// other. Otherwise contacts would be lost in a dilute system, whose disks fly further than their lists reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

constexpr std::size_t disks = 200;
constexpr double width = 40.0, height = 30.0, middle = 0.5 * height;
constexpr int paths_a_disk = 20;

// The lists of a dilute gas.
struct Listed {
  Listed(const Domain& in_box, double start) : box(in_box) {
    test::Draws draws(17);
    d.common_radius = 0.5;
    for (std::size_t i = 0; i < disks; ++i) {
      d.x.push_back(draws.in(0.0, width));
      d.y.push_back(draws.in(0.0, height));
      d.id.push_back(static_cast<DiskId>(i));
    }
    d.vx.resize(disks);
    d.vy.resize(disks);
    lists.follow_flow(box, start, 0.0);
    lists.build(d, box, {EngineMode::single_queue, 0, 0, 1.0, false}, Executor(1));
  }

  Domain box;
  Disks d;
  NeighbourLists lists;
};

Domain periodic_box() {
  Domain box;
  box.width = width;
  box.height = height;
  box.sides.fill(SideKind::periodic);
  return box;
}

double nearest(double d, double period) {
  return d - period * std::round(d / period);
}

// The position of a disk in the frame of the lists. tilt: of that frame; 0 without shear.
Vec2 in_frame(Vec2 at, double tilt) {
  return {at.x - tilt * (at.y - middle), at.y};
}
Vec2 from_frame(Vec2 at, double tilt) {
  return {at.x + tilt * (at.y - middle), at.y};
}

// Paths that start and end near the largest distance that a disk may have from its listed position. The functions that
// say how long it stays listed are compared with the path, which is sampled in steps.
class PathsNearTheEdge {
 public:
  PathsNearTheEdge(const Domain& box, double start, const Gravity& g) : listed_(box, start), gravity_(g), draws_(4) {}

  void expect_inside() {
    for (std::uint32_t i = 0; i < disks; ++i) {
      for (int k = 0; k < paths_a_disk && !testing::Test::HasFailure(); ++k) see_path(i);
    }
    EXPECT_GT(stayed_, disks * paths_a_disk / 20);
    EXPECT_GT(left_, disks * paths_a_disk / 20);
  }

 private:
  double tilt_at(double t) const {
    const Domain& box = listed_.box;
    return box.shear.acts() ? box.shear.offset / height + box.shear.rate * t : 0.0;
  }

  // A path from one place in the frame at time 0 to another at time t.
  PathSegment path_between(Vec2 first, Vec2 last, double t) const {
    const Vec2 a = from_frame(first, tilt_at(0.0)), b = from_frame(last, tilt_at(t));
    return {0.0, a.x, a.y, (b.x - a.x) / t + 0.5 * gravity_.left * t, (b.y - a.y) / t + 0.5 * gravity_.down * t};
  }

  double distance_at(std::uint32_t i, const PathSegment& path, double t) const {
    const PathSegment p = carried_to(path, t, gravity_);
    const Vec2 at = in_frame({p.x, p.y}, tilt_at(t)), from = listed_.lists.listed_position(i);
    return std::hypot(nearest(at.x - from.x, width), nearest(at.y - from.y, height));
  }

  void expect_inside_until(std::uint32_t i, const PathSegment& path, double from, double until, const char* said_by) {
    constexpr int looks = 32;
    const double skin = listed_.lists.skin();
    for (int k = 0; k <= looks; ++k) {
      const double t = from + (until - from) * k / looks;
      ASSERT_LE(distance_at(i, path, t), skin * (1.0 + 1e-9)) << said_by << " until " << until << ", at " << t;
    }
  }

  void see_path(std::uint32_t i) {
    const RelistDistance& relist = listed_.lists.relist_distance_elsewhere();
    const Vec2 centre = listed_.lists.listed_position(i);
    const double angle = draws_.in(0.0, 6.28);
    const auto edge = [&](double at) {
      const double r = relist.length * draws_.in(0.8, 1.0);
      return Vec2{centre.x + r * std::cos(at), centre.y + r * std::sin(at)};
    };
    const double t = draws_.in(0.05, 2.0);
    const Vec2 first = edge(angle);
    Vec2 last = edge(angle + draws_.in(-1.0, 1.0));
    // In some cases the path goes around the box.
    if (draws_.in(0.0, 1.0) < 0.1) last.x += draws_.in(-1.0, 1.0) < 0.0 ? -width : width;
    if (draws_.in(0.0, 1.0) < 0.1) last.y += draws_.in(-1.0, 1.0) < 0.0 ? -height : height;
    const PathSegment path = path_between(first, last, t);
    const bool straight = !gravity_.acts() && !listed_.box.shear.acts();
    if (straight ? listed_.lists.stays_listed(i, path, 0.0, t, relist)
                 : listed_.lists.stays_listed_bent(i, path, 0.0, t, gravity_, relist)) {
      ++stayed_;
      expect_inside_until(i, path, 0.0, t, "stays_listed");
    } else {
      ++left_;
    }
    for (const double ahead : {0.0, t}) {
      const double until = listed_.lists.earliest_relist_time(i, path, 0.0, ahead, gravity_, relist);
      expect_inside_until(i, path, 0.0, std::min(until, 4.0 * t), "earliest_relist_time");
    }
  }

  Listed listed_;
  Gravity gravity_;
  test::Draws draws_;
  std::size_t stayed_ = 0, left_ = 0;
};

TEST(ListedPaths, StayNearWhereTheyAreStraight) {
  PathsNearTheEdge(periodic_box(), 0.0, Gravity()).expect_inside();
}

TEST(ListedPaths, StayNearWhereTheyFall) {
  for (const Gravity& g : {Gravity(0.0, 0.3), Gravity(0.0, 3.0), Gravity(-1.0, 0.5)}) {
    PathsNearTheEdge(periodic_box(), 0.0, g).expect_inside();
  }
}

TEST(ListedPaths, StayNearInTheFrameOfAShear) {
  for (const double rate : {0.1, 1.0, -1.0}) {
    Domain box = periodic_box();
    box.shear = {rate, rate * height, 0.0};
    const double start = 1.3;
    box.move_images(start);
    PathsNearTheEdge(box, start, Gravity()).expect_inside();
  }
}

// The largest factor by which the distance of two touching disks may grow in the frame before the lists are strained.
double most_stretch(double tilt, double strain) {
  double most = 0.0;
  for (double by = -strain; by <= strain; by += strain / 16.0) {
    for (double angle = 0.0; angle < 3.15; angle += 0.01) {
      most = std::max(most, std::hypot(std::cos(angle) - (tilt + by) * std::sin(angle), std::sin(angle)));
    }
  }
  return most;
}

TEST(ListedPaths, DisksThatMayTouchInAShearListEachOther) {
  std::size_t pairs = 0, beyond = 0;
  for (const double start : {0.0, 0.31, 0.6}) {
    Domain box = periodic_box();
    box.shear = {1.0, height, 0.0};
    box.move_images(start);
    const Listed listed(box, start);
    const NeighbourLists& lists = listed.lists;
    const double straight = 2.0 * listed.d.common_radius + 2.0 * lists.skin();
    const double reach =
        straight + (most_stretch(box.shear.offset / height, 0.25) - 1.0) * 2.0 * listed.d.common_radius;
    for (std::uint32_t i = 0; i < disks; ++i) {
      std::vector<std::uint32_t> near;
      lists.for_each_neighbour(i, [&](std::uint32_t j) { near.push_back(j); });
      for (std::uint32_t j = 0; j < disks; ++j) {
        const Vec2 a = lists.listed_position(i), b = lists.listed_position(j);
        const double distance = std::hypot(nearest(a.x - b.x, width), nearest(a.y - b.y, height));
        if (j == i || distance > reach * (1.0 - 1e-6)) continue;
        ++pairs;
        beyond += distance > straight ? 1 : 0;
        EXPECT_NE(std::find(near.begin(), near.end(), j), near.end()) << i << " and " << j << " at " << start;
      }
    }
  }
  EXPECT_GT(pairs, 3000U);
  EXPECT_GT(beyond, 20U);
}

}  // namespace
}  // namespace carom
