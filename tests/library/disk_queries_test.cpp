// Queries compared with a search over all disks and all their images.
#include "run/simulation/disk_queries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

struct Gas {
  std::string method, sides;
  int disks;
  int fixed = 0;
  std::string walls{};
};

constexpr const char* fixed_disks = "\nradius = 0.4\npositions = \"random\"\nfixed = true\n";

Simulation gas(const Gas& g) {
  const std::string text =
      "[box]\npacking_fraction = " + std::string(g.disks > 1 ? "0.2" : "0.02") + "\naspect = 1.5\n" + g.sides +
      "[[disks]]\ncount = " + std::to_string(g.disks) +
      "\nvelocities = { uniform = 2.0 }\nradius = { uniform = [0.05, 0.5] }\nmass = 1.0\npositions = \"random\"\n" +
      (g.fixed == 0 ? "" : "[[disks]]\ncount = " + std::to_string(g.fixed) + fixed_disks) + g.walls +
      "[run]\ndt = 0.005\nt_end = 10.0\nmethod = \"" + g.method + "\"\n";
  return Simulation(parse_scene(text, "gas.toml", ""), choose_engine("parallel", 1));
}

// Calls look() for the images within one period, including those of fixed disks.
template <class Look>
void for_each_image(const Simulation& s, int around, const Look& look) {
  Disks d = s.disks();
  for (const Obstacle& o : s.state().obstacles) append(d, {o.x, o.y, 0.0, 0.0, o.radius, 1.0, o.id});
  const Domain& box = s.scene().box;
  const int nx = box.periodic_x() ? around : 0, ny = box.periodic_y() ? around : 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (int kx = -nx; kx <= nx; ++kx) {
      for (int ky = -ny; ky <= ny; ++ky)
        look(d.id[i], Vec2{d.x[i] + kx * box.width, d.y[i] + ky * box.height}, d.radius_of(i));
    }
  }
}

// The entry point from the plain quadratic formula.
double plain_entry(Vec2 centre, double radius, Vec2 from, Vec2 unit) {
  const double x = from.x - centre.x, y = from.y - centre.y;
  const double b = x * unit.x + y * unit.y, c = x * x + y * y - radius * radius;
  if (c <= 0.0) return 0.0;
  if (b >= 0.0 || b * b < c) return std::numeric_limits<double>::infinity();
  return -b - std::sqrt(b * b - c);
}

void check_all(const Simulation& s, test::Draws& draw) {
  const Domain& box = s.scene().box;
  for (int k = 0; k < 20; ++k) {
    const Vec2 place{draw.in(0.0, box.width), draw.in(0.0, box.height)};
    const Vec2 size{draw.in(0.0, 0.4 * box.width), draw.in(0.0, 0.4 * box.height)};
    const Vec2 low{place.x - 0.5 * size.x, place.y - 0.5 * size.y}, high{low.x + size.x, low.y + size.y};
    std::vector<DiskId> inside;
    NearDisk nearest{0, 1e9};
    const double angle = draw.in(0.0, 6.28);
    const Vec2 unit{std::cos(angle), std::sin(angle)};
    const double length = 0.9 * std::max(box.width, box.height);
    RayHit hit{0, 1e9, {}};
    for_each_image(s, 2, [&](DiskId id, Vec2 at, double radius) {
      if (at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y) inside.push_back(id);
      const double distance = std::hypot(at.x - place.x, at.y - place.y);
      if (distance < nearest.distance) nearest = {id, distance};
      const double t = plain_entry(at, radius, place, unit);
      if (t < hit.distance) hit = {id, t, {}};
    });
    EXPECT_THAT(s.disks_in(low, high), testing::UnorderedElementsAreArray(inside));
    const std::optional<NearDisk> found = s.nearest(place);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->id, nearest.id);
    EXPECT_NEAR(found->distance, nearest.distance, 1e-9);
    const std::optional<RayHit> met = s.cast_ray(place, {3.0 * unit.x, 3.0 * unit.y}, length);
    const bool outside = hit.distance > length;  // walls end the line, and all disks are inside
    ASSERT_EQ(met.has_value(), !outside);
    if (outside) continue;
    EXPECT_EQ(met->id, hit.id);
    EXPECT_NEAR(met->distance, hit.distance, 1e-9);
  }
}

TEST(DiskQueries, AgreeWithAllDisksAndImages) {
  const std::string around = "left = \"periodic\"\nright = \"periodic\"\n";
  const std::string both = around + "bottom = \"periodic\"\ntop = \"periodic\"\n";
  test::Draws draw(3);
  for (const std::string method : {"exact", "pairwise"}) {
    for (const std::string& sides : {std::string(), around, both}) {
      for (const int disks : {1, 30, 300}) {
        Simulation s = gas({method, sides, disks, disks == 1 ? 0 : disks / 3});
        ASSERT_EQ(s.state().obstacles.size(), disks == 1 ? 0U : static_cast<unsigned>(disks / 3));
        check_all(s, draw);
        for (int part = 0; part < 3; ++part) {
          s.step(3);
          check_all(s, draw);
          s.set_velocity(0, {1.0, 2.0});
          if (part == 1) s.remove(0);
          if (s.state().disks.empty()) break;
          check_all(s, draw);
        }
      }
    }
  }
}

// Rays among inner walls, including polylines with sharp corners and sinks, compared with a search over every disk and
// every image of every segment.
TEST(DiskQueries, RaysEndAtInnerWalls) {
  const std::string around = "left = \"periodic\"\nright = \"periodic\"\n";
  const std::string both = around + "bottom = \"periodic\"\ntop = \"periodic\"\n";
  const std::string walls =
      "[[walls]]\npoints = [[1, 1], [4, 2], [1.5, 1.2], [2, 5]]\n[[walls]]\nkind = \"sink\"\nfrom = [6, 0.5]\n"
      "to = [7, 5]\n[[walls]]\nfrom = [0, 3]\nto = [0.5, 0]\n";
  test::Draws draw(5);
  int met_walls = 0;
  for (const std::string& sides : {std::string(), around, both}) {
    Simulation s = gas({"pairwise", sides, 40, 5, walls});
    const Domain& box = s.scene().box;
    for (int k = 0; k < 400; ++k) {
      const Vec2 place{draw.in(0.0, box.width), draw.in(0.0, box.height)};
      const double angle = draw.in(0.0, 6.28), length = 0.9 * std::max(box.width, box.height);
      const Vec2 unit{std::cos(angle), std::sin(angle)};
      RayHit hit{0, 1e9};
      for_each_image(s, 2, [&](DiskId id, Vec2 at, double radius) {
        const double t = plain_entry(at, radius, place, unit);
        if (t < hit.distance) hit = {id, t};
      });
      for (const Obstacle& o : s.state().obstacles) {
        for (int image = 0; image < 25 && o.is_segment(); ++image) {
          const int kx = image % 5 - 2, ky = image / 5 - 2;
          if ((kx != 0 && !box.periodic_x()) || (ky != 0 && !box.periodic_y())) continue;
          const double x = o.x + kx * box.width - place.x, y = o.y + ky * box.height - place.y;
          const double side = unit.x * y - unit.y * x, other = unit.x * (y + o.dy) - unit.y * (x + o.dx);
          if (side * other > 0.0) continue;  // both ends are on the same side of the ray
          const double share = side / (side - other);
          const double t = (x + share * o.dx) * unit.x + (y + share * o.dy) * unit.y;
          if (t >= 0.0 && t < hit.distance) {
            hit = {o.id, t, {}, o.kind == ObstacleKind::sink ? RayMet::sink : RayMet::wall};
          }
        }
      }
      const std::optional<RayHit> met = s.cast_ray(place, unit, length);
      ASSERT_EQ(met.has_value(), hit.distance <= length) << k;
      if (!met) continue;
      EXPECT_NEAR(met->distance, hit.distance, 1e-9);
      EXPECT_EQ(met->what, hit.what);
      EXPECT_EQ(met->id, hit.id);
      met_walls += hit.what != RayMet::disk ? 1 : 0;
    }
  }
  EXPECT_GT(met_walls, 100);
}

TEST(DiskQueries, OfFixedDisksAlone) {
  Simulation s = gas({"pairwise", "left = \"periodic\"\nright = \"periodic\"\n", 2, 5});
  s.remove(0);
  s.remove(1);
  test::Draws draw(4);
  check_all(s, draw);
}

// Of two disks that a ray meets at the same distance the one with the smaller id is returned, however they are stored.
TEST(DiskQueries, OfTwoAtOneDistanceTheSmallerId) {
  for (const bool swapped : {false, true}) {
    const std::string places = swapped ? "[[12.0, 4.75], [12.0, 5.25]]" : "[[12.0, 5.25], [12.0, 4.75]]";
    Simulation s(parse_scene("[box]\nwidth = 20.0\nheight = 10.0\n[[disks]]\ncount = 2\npositions = " + places +
                                 "\nradius = 0.25\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 1.0\n",
                             "two", ""),
                 choose_engine("parallel", 1));
    EXPECT_EQ(s.cast_ray({2.0, 5.0}, {1.0, 0.0}, 15.0)->id, 0U);
    EXPECT_EQ(s.nearest({2.0, 5.0})->id, 0U);
  }
}

TEST(DiskQueries, OfNoDiskAtAll) {
  Simulation s = gas({"exact", "", 1});
  s.remove(0);
  EXPECT_FALSE(s.nearest({0.1, 0.1}));
  EXPECT_FALSE(s.cast_ray({0.1, 0.1}, {1.0, 0.0}, 10.0));
  EXPECT_TRUE(s.disks_in({0.0, 0.0}, {100.0, 100.0}).empty());
  s.step(3);
}

TEST(DiskQueries, RefuseWhatIsNoPlaceOrLine) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Simulation s = gas({"exact", "left = \"periodic\"\nright = \"periodic\"\n", 30});
  EXPECT_THROW(s.nearest({nan, 0.0}), InputError);
  EXPECT_THROW(s.nearest({-1.0, 0.0}), InputError);
  EXPECT_THROW(s.disks_in({1.0, 1.0}, {0.0, 2.0}), InputError);
  EXPECT_THROW(s.disks_in({nan, 1.0}, {0.0, 2.0}), InputError);
  EXPECT_THROW(s.cast_ray({1.0, 1.0}, {0.0, 0.0}, 1.0), InputError);
  EXPECT_THROW(s.cast_ray({1.0, 1.0}, {1.0, 0.0}, infinity), InputError);
  EXPECT_THROW(s.cast_ray({1.0, 1.0}, {1.0, 0.0}, 1e12), InputError);
  EXPECT_THROW(s.cast_ray({1.0, 1.0}, {1.0, 0.0}, -1.0), InputError) << "a negative length must not reverse the ray";
  EXPECT_THROW(s.cast_ray({nan, 1.0}, {1.0, 0.0}, 1.0), InputError);
  EXPECT_NO_THROW(s.cast_ray({1.0, 1.0}, {0.0, 1.0}, 1e12));  // it ends at the wall
}

}  // namespace
}  // namespace carom
