// Disks on bent paths, under gravity and in the frame of the flow in a sheared box: the prediction kernel must notice
// if one leaves the surroundings for which its list is valid, and if it goes around a periodic box to another image of
// its listed position.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "parallel/exact/prediction_kernel.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

constexpr double radius = 0.3;
constexpr double unit = 0x1p-29;  // unit of listed positions; length
constexpr double period = 8.0;

// A disk in flight that touches its only neighbour after a while. Its listed position is near its path.
struct Throw {
  std::vector<DiskRecord> record;
  ListRow row;
  PredictionConstants constants;
  double until = 0.0;
  double down = 0.0, left = 0.0;
};

// Its position after a time s, in the frame of listed positions.
Vec2 place_after(const Throw& thrown, double s) {
  const PathSegment& p = thrown.record[0].path;
  const double x = p.x + (p.vx - 0.5 * thrown.left * s) * s;
  const double y = p.y + (p.vy - 0.5 * thrown.down * s) * s;
  const FlowFrame& flow = thrown.constants.flow;
  return {flow.acts ? flow.carried_back(x, y, p.start + s) : x, y};
}

Throw drawn_throw(test::Draws& draws, const Gravity& g, const FlowFrame& flow) {
  Throw t;
  t.down = g.down;
  t.left = g.left;
  t.until = draws.in(0.5, 1.5);
  t.record.resize(2);
  PathSegment& own = t.record[0].path;
  own = {draws.in(0.0, 1.0), draws.in(3.0, 5.0), draws.in(3.0, 5.0), draws.in(-1.0, 1.0), draws.in(-1.0, 1.0)};
  // The disk may rise far and have come back by then.
  own.vx += g.left * draws.in(0.0, 0.6) * t.until;
  own.vy += g.down * draws.in(0.0, 0.6) * t.until;
  t.record[1].path = {own.start, own.x + t.until + 2.0 * radius, own.y, own.vx - 1.0, own.vy};
  t.record[0].radius = t.record[1].radius = radius;
  PredictionConstants& f = t.constants;
  f.down = in_all_lanes(g.down);
  f.half_down = in_all_lanes(0.5 * g.down);
  f.left = in_all_lanes(g.left);
  f.half_left = in_all_lanes(0.5 * g.left);
  f.eighth_gravity = 0.125 * g.size;
  f.half_gravity = {0.5 * g.left, 0.5 * g.down};
  f.flow = flow;
  f.contact2 = in_all_lanes(4.0 * radius * radius);
  f.listed_unit = {unit, unit};
  f.stay = draws.in(0.1, 1.0);
  f.stay2 = f.stay * f.stay;
  const Vec2 near = place_after(t, draws.in(0.0, t.until));
  const auto listed = [&](double c) {
    return static_cast<std::uint32_t>(std::clamp(c + draws.in(-1.0, 1.0) * f.stay, 0.0, 7.9) / unit);
  };
  t.row.count = 1;
  t.row.listed_at = {listed(near.x), listed(near.y)};
  std::fill_n(t.row.offset, prediction_lanes, std::int16_t{1});
  return t;
}

// The largest squared distance from the listed position on the way.
double farthest2(const Throw& t) {
  double farthest = 0.0;
  for (int k = 0; k <= 64; ++k) {
    const Vec2 at = place_after(t, t.until * k / 64);
    const double dx = at.x - t.row.listed_at.x * unit, dy = at.y - t.row.listed_at.y * unit;
    const double across = dx - t.constants.period.x * std::round(dx / period);
    const double height = dy - t.constants.period.y * std::round(dy / period);
    farthest = std::max(farthest, across * across + height * height);
  }
  return farthest;
}

enum class Way { inside, round };

// The kernel may report that a disk leaves its list although it does not, but less often than it reports that one
// stays.
void expect_seen_on_the_whole_way(Bend bend, const std::vector<Throw>& throws, Way way = Way::inside) {
  for (const PredictionKernels& kernels :
       {choose_prediction_kernels(bend, false), prediction_kernels_baseline(bend, false)}) {
    std::vector<RowKernel> with_images{kernels.near, kernels.near_newest};
    if (way == Way::inside) with_images.insert(with_images.end(), {kernels.inside, kernels.inside_newest});
    for (const RowKernel kernel : with_images) {
      int stays = 0;
      int thinks_it_leaves = 0;
      for (const Throw& t : throws) {
        const FirstContact found = kernel(t.constants, t.record.data(), t.row);
        ASSERT_NEAR(found.time, t.record[0].path.start + t.until, 1e-9);
        const double farthest = farthest2(t);
        if (!found.leaves_list()) {
          ++stays;
          EXPECT_LE(farthest, t.constants.stay2 * (1.0 + 1e-12));
        } else if (farthest < t.constants.stay2) {
          ++thinks_it_leaves;
        }
      }
      EXPECT_GT(stays, 100);
      EXPECT_LT(thinks_it_leaves, stays);
    }
  }
}

TEST(BentPaths, AreSeenToLeaveTheListUnderGravity) {
  for (const Gravity& direction :
       {Gravity(0.7), Gravity(-0.7), Gravity(0.5, -0.4), Gravity(-0.3, -0.6), Gravity(0.6, 0.0)}) {
    test::Draws draws(37);
    std::vector<Throw> throws;
    for (int round = 0; round < 3000; ++round) {
      const double strength = draws.in(0.0, 5.0);
      throws.push_back(drawn_throw(draws, {strength * direction.left, strength * direction.down}, {}));
    }
    expect_seen_on_the_whole_way(bend_of(direction, Domain{}), throws);
  }
}

// Half of the disks come to another image of where they started, and their paths end there.
std::vector<Throw> throws_round_the_box(const Gravity& direction) {
  test::Draws draws(39);
  std::vector<Throw> throws;
  for (int round = 0; round < 3000; ++round) {
    const double strength = draws.in(0.0, 1.0);
    Throw t = drawn_throw(draws, {strength * direction.left, strength * direction.down}, {});
    PredictionConstants& f = t.constants;
    f.period = {period, period};
    f.periods_per_length = {1.0 / period, 1.0 / period};
    f.period_x = f.period_y = in_all_lanes(period);
    f.periods_per_x = f.periods_per_y = in_all_lanes(1.0 / period);
    f.to_other_image = period - 2.0 * f.stay;
    f.to_other_image2 = f.to_other_image * f.to_other_image;
    if (round % 2 == 0) {
      const double faster = (round % 4 == 0 ? period : -period) / t.until;
      for (DiskRecord& disk : t.record) (round % 8 < 4 ? disk.path.vx : disk.path.vy) += faster;
    }
    throws.push_back(t);
  }
  return throws;
}

TEST(BentPaths, AreSeenToLeaveTheListRoundTheBox) {
  for (const Gravity& direction : {Gravity(0.7), Gravity(-0.3, -0.6)}) {
    const Bend bend = bend_of(direction, Domain{});
    expect_seen_on_the_whole_way(bend, throws_round_the_box(direction), Way::round);
  }
}

TEST(BentPaths, AreSeenToLeaveTheListInAFlow) {
  test::Draws draws(38);
  std::vector<Throw> throws;
  for (int round = 0; round < 3000; ++round) {
    FlowFrame flow;
    flow.acts = true;
    flow.rate = draws.in(-2.0, 2.0);
    flow.middle = 4.0;
    flow.tilt = draws.in(-0.5, 0.5);
    throws.push_back(drawn_throw(draws, 0.0, flow));
  }
  expect_seen_on_the_whole_way(Bend::flow, throws);
}

}  // namespace
}  // namespace carom
