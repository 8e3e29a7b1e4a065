// The prediction kernel compared with core's formulas bit by bit, in every version.
#include "parallel/exact/prediction_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/physics/boundary.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

struct KernelCase {
  Gravity gravity;
  bool unequal_radii, periodic;
};

constexpr std::size_t disks = 40;
constexpr double common_radius = 0.3;
constexpr double slow_approach = 0.02, blur = 0.001;

std::vector<DiskRecord> random_records(test::Draws& draws, const KernelCase& c, double box) {
  std::vector<DiskRecord> record(disks);
  for (std::uint32_t k = 0; k < record.size(); ++k) {
    DiskRecord& f = record[k];
    f.path = {draws.in(0.0, 1.0), draws.in(0.0, box), draws.in(0.0, box), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
    // Some disks are at rest, some are on one line, and one is gone.
    if (k % 7 == 3) f.path.vx = f.path.vy = 0.0;
    if (k % 5 == 1) f.path.y = record[0].path.y;
    if (k == 13) f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    f.radius = c.unequal_radii ? draws.in(0.05, 0.6) : common_radius;
    f.id = k;
  }
  return record;
}

struct Expected {
  double time = never;
  std::size_t neighbour = 0;
  bool ambiguous = false;
};

// Does rounding decide whether they touch? That is so if they overlap and are slow relative to each other, or pass each
// other at about their contact distance.
bool is_in_doubt(const Relative& r, double contact_distance) {
  const double cross = r.dx * r.dvy - r.dy * r.dvx;
  const double contact2 = contact_distance * contact_distance;
  const double discriminant = r.speed2() * contact2 - cross * cross;
  const double gap2 = std::min(r.distance2() - contact2, -blur * contact_distance);
  return std::abs(discriminant) + r.speed2() * gap2 <= slow_approach * slow_approach;
}

// The first contact by core's formula, with one neighbour after the other: with the nearest image, or with any image
// that is met before the horizon.
Expected expected_contact(const std::vector<DiskRecord>& record, std::uint32_t own, const std::vector<int>& offset,
                          const Domain& box, const Gravity& g, double horizon = 0.0) {
  Expected first;
  bool tie = false;
  for (std::size_t k = 0; k < offset.size(); ++k) {
    const auto j = static_cast<std::uint32_t>(static_cast<int>(own) + offset[k]);
    const DiskRecord& a = record[std::min(own, j)];
    const DiskRecord& b = record[std::max(own, j)];
    const double both = std::max(a.path.start, b.path.start);
    const PathSegment p = carried_to(a.path, both, g), q = carried_to(b.path, both, g);
    const Relative r = box.shear.acts() ? relative_in_shear(p, q, box) : relative(p, q, box);
    first.ambiguous |= is_in_doubt(r, a.radius + b.radius);
    const double t = horizon > 0.0 ? collision_time(a.path, b.path, a.radius + b.radius, box, g, horizon)
                                   : both + time_to_contact(r, a.radius + b.radius);
    if (!(t < never) || t > first.time) continue;
    if (t == first.time) {
      tie = true;
      continue;
    }
    tie = false;
    first.time = t;
    first.neighbour = k;
  }
  first.ambiguous |= tie;
  return first;
}

std::vector<int> padded(std::vector<int> offset) {
  while (offset.size() % prediction_lanes != 0) offset.push_back(offset[0]);
  return offset;
}

void expect_contact(const FirstContact& found, const std::vector<int>& offset, const Expected& expected,
                    int& false_alarms) {
  if (expected.ambiguous) {
    ASSERT_TRUE(found.is_ambiguous());
  }
  false_alarms += found.is_ambiguous() && !expected.ambiguous ? 1 : 0;
  if (found.is_ambiguous()) return;
  ASSERT_EQ(found.time, expected.time);
  if (expected.time < never) {
    ASSERT_EQ(padded(offset)[found.neighbour & ~FirstContact::leaving_bit], offset[expected.neighbour]);
  }
}

void expect_in_row(RowKernel kernel, const PredictionConstants& constants, const std::vector<DiskRecord>& record,
                   std::uint32_t own, const std::vector<int>& offset, FixedPointPosition listed_at,
                   const Expected& expected, int& false_alarms) {
  ListRow row;
  row.count = static_cast<std::uint8_t>(offset.size());
  row.listed_at = listed_at;
  std::ranges::copy(padded(offset), row.offset);
  const FirstContact found = kernel(constants, &record[own], row);
  expect_contact(found, offset, expected, false_alarms);
  // For bent paths see bent_paths_test.
  if (!(found.time < never) || constants.down.lane[0] != 0.0 || constants.left.lane[0] != 0.0) return;
  const PathSegment& p = record[own].path;
  const double way_x = p.vx * (found.time - p.start), way_y = p.vy * (found.time - p.start);
  double dx = p.x + way_x - listed_at.x * constants.listed_unit.x;
  double dy = p.y + way_y - listed_at.y * constants.listed_unit.y;
  dx -= constants.period.x * std::nearbyint(dx * constants.periods_per_length.x);
  dy -= constants.period.y * std::nearbyint(dy * constants.periods_per_length.y);
  const bool may_go_round = constants.to_other_image2 - (way_x * way_x + way_y * way_y) < 0.0;
  ASSERT_EQ(found.leaves_list(), constants.stay2 - (dx * dx + dy * dy) < 0.0 || may_go_round);
}

void expect_in_wide_row(WideRowKernel kernel, const PredictionConstants& constants,
                        const std::vector<DiskRecord>& record, std::uint32_t own, const std::vector<int>& offset,
                        const Expected& expected, int& false_alarms) {
  const FirstContact found =
      kernel(constants, &record[own], padded(offset).data(), static_cast<std::uint32_t>(offset.size()));
  expect_contact(found, offset, expected, false_alarms);
}

PredictionConstants constants_of(const Gravity& g) {
  PredictionConstants f;
  f.down = in_all_lanes(g.down);
  f.half_down = in_all_lanes(0.5 * g.down);
  f.left = in_all_lanes(g.left);
  f.half_left = in_all_lanes(0.5 * g.left);
  const double contact_distance = 2.0 * common_radius;
  f.contact = in_all_lanes(contact_distance);
  f.contact2 = in_all_lanes(contact_distance * contact_distance);
  f.slow_approach2 = in_all_lanes(slow_approach * slow_approach);
  f.blur = in_all_lanes(-blur);
  f.blur2 = in_all_lanes(-blur * contact_distance);
  return f;
}

std::vector<int> random_offsets(test::Draws& draws, std::uint32_t own) {
  std::vector<int> offset;
  const std::size_t count = draws.bits() % 13;
  while (offset.size() < count) {
    const int o = static_cast<int>(draws.bits() % disks) - static_cast<int>(own);
    if (o != 0 && std::find(offset.begin(), offset.end(), o) == offset.end()) offset.push_back(o);
  }
  return offset;
}

class PredictionKernelVersions : public testing::TestWithParam<KernelCase> {};

TEST_P(PredictionKernelVersions, HaveTheBitsOfTheFormula) {
  const KernelCase& c = GetParam();
  test::Draws draws(17);
  const Gravity& g = c.gravity;
  int met = 0;
  int ambiguous = 0;
  int false_alarms = 0;
  for (int round = 0; round < 600; ++round) {
    Domain box;
    box.width = 6.0;
    box.height = 5.0;
    if (c.periodic) box.sides.fill(SideKind::periodic);
    std::vector<DiskRecord> record = random_records(draws, c, 5.0);
    const auto own = static_cast<std::uint32_t>(draws.bits() % disks);
    const bool newest = round % 2 == 0;
    if (newest) record[own].path.start = 1.0;
    const std::vector<int> offset = random_offsets(draws, own);
    // Two neighbours that are touched at the same time.
    if (round % 5 == 0 && offset.size() > 1) {
      record[own + static_cast<std::uint32_t>(offset[0])] = record[own + static_cast<std::uint32_t>(offset.back())];
    }
    PredictionConstants constants = constants_of(g);
    if (c.periodic) {
      constants.period_x = in_all_lanes(box.width);
      constants.period_y = in_all_lanes(box.height);
      constants.periods_per_x = in_all_lanes(1.0 / box.width);
      constants.periods_per_y = in_all_lanes(1.0 / box.height);
    }
    constants.listed_unit = {0x1p-31 * box.width, 0x1p-31 * box.height};
    if (c.periodic) {
      constants.listed_unit = {0x1p-32 * box.width, 0x1p-32 * box.height};
      constants.period = {box.width, box.height};
      constants.periods_per_length = {1.0 / box.width, 1.0 / box.height};
    }
    const double listed_x = draws.in(0.0, c.periodic ? 0x1p32 : 0x1p31);
    const double listed_y = draws.in(0.0, c.periodic ? 0x1p32 : 0x1p31);
    const FixedPointPosition listed_at{static_cast<std::uint32_t>(listed_x), static_cast<std::uint32_t>(listed_y)};
    constants.stay2 = draws.in(0.0, 10.0);
    if (c.periodic) constants.to_other_image2 = 2.0 * constants.stay2;
    const Expected expected = expected_contact(record, own, offset, box, g);
    met += expected.time < never && !expected.ambiguous ? 1 : 0;
    ambiguous += expected.ambiguous ? 1 : 0;
    for (const PredictionKernels& kernels : {choose_prediction_kernels(bend_of(g, box), c.unequal_radii),
                                             prediction_kernels_baseline(bend_of(g, box), c.unequal_radii)}) {
      const auto expect = [&](RowKernel kernel) {
        expect_in_row(kernel, constants, record, own, offset, listed_at, expected, false_alarms);
      };
      expect(kernels.near);
      expect_in_wide_row(kernels.far, constants, record, own, offset, expected, false_alarms);
      if (newest) expect(kernels.near_newest);
      if (c.periodic) continue;
      expect(kernels.inside);
      if (newest) expect(kernels.inside_newest);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(ambiguous, 20);
  EXPECT_LT(ambiguous, 500);
  // A tie of two contacts that come after another one may be a false alarm.
  EXPECT_LT(false_alarms, 20);
}

// Neighbours anywhere in the box, some of them exactly half a period away, and flights of up to a quarter of a period.
TEST_P(PredictionKernelVersions, HaveTheBitsOfTheFormulaWithImagesBeyondTheNearest) {
  const KernelCase& c = GetParam();
  if (!c.periodic) return;
  test::Draws draws(29);
  const Gravity& g = c.gravity;
  int behind = 0;
  int false_alarms = 0;
  int ambiguous = 0;
  for (int round = 0; round < 600; ++round) {
    Domain box;
    box.width = 6.0;
    box.height = 5.0;
    box.sides.fill(SideKind::periodic);
    if (round % 3 == 1)
      box.sides[static_cast<std::size_t>(Side::left)] = box.sides[static_cast<std::size_t>(Side::right)] =
          SideKind::wall;
    std::vector<DiskRecord> record = random_records(draws, c, 5.0);
    const auto own = static_cast<std::uint32_t>(draws.bits() % disks);
    for (std::uint32_t k = own % 3; k < disks; k += 9)
      record[k].path.x = record[own].path.x < 3.0 ? record[own].path.x + 3.0 : record[own].path.x - 3.0;
    const std::vector<int> offset = random_offsets(draws, own);
    const double horizon = draws.in(0.5, 4.0);
    PredictionConstants constants = constants_of(g);
    constants.horizon = in_all_lanes(horizon);
    if (box.periodic_x()) constants.image_x = in_all_lanes(box.width);
    constants.image_y = in_all_lanes(box.height);
    const Expected nearest = expected_contact(record, own, offset, box, g);
    const Expected expected = expected_contact(record, own, offset, box, g, horizon);
    behind += !expected.ambiguous && expected.time < nearest.time ? 1 : 0;
    ambiguous += expected.ambiguous ? 1 : 0;
    const auto expect = [&](FirstContact found) {
      if (!found.is_ambiguous() && found.time > horizon) found.time = never;
      expect_contact(found, offset, expected, false_alarms);
    };
    for (const PredictionKernels& kernels : {choose_prediction_kernels(bend_of(g, box), c.unequal_radii),
                                             prediction_kernels_baseline(bend_of(g, box), c.unequal_radii)}) {
      ListRow row;
      row.count = static_cast<std::uint8_t>(offset.size());
      std::ranges::copy(padded(offset), row.offset);
      expect(kernels.near_any_image(constants, &record[own], row));
      expect(kernels.far_any_image(constants, &record[own], padded(offset).data(), row.count));
    }
  }
  EXPECT_GT(behind, 20);
  EXPECT_LT(ambiguous, 300);
  EXPECT_LT(false_alarms, 60);
}

// Neighbours anywhere in a sheared box, whose images above and below move. Images beyond the nearest ones are
// ambiguous.
TEST_P(PredictionKernelVersions, HaveTheBitsOfTheFormulaInAShear) {
  const KernelCase& c = GetParam();
  if (!c.periodic || c.gravity.acts()) return;
  test::Draws draws(31);
  int across = 0;
  int false_alarms = 0;
  int ambiguous = 0;
  for (int round = 0; round < 2000; ++round) {
    Domain box;
    box.width = 12.0;
    box.height = 10.0;
    box.sides.fill(SideKind::periodic);
    const double rate = draws.in(-0.5, 0.5);
    box.shear = {rate, rate * box.height, draws.in(-6.0, 6.0)};
    std::vector<DiskRecord> record = random_records(draws, c, 10.0);
    // Half of the disks are near the bottom or the top.
    for (std::uint32_t k = 0; k < disks; k += 2) record[k].path.y = 0.2 * record[k].path.y + (k % 4 == 0 ? 0.0 : 8.0);
    const auto own = static_cast<std::uint32_t>(draws.bits() % disks);
    const std::vector<int> offset = random_offsets(draws, own);
    const double horizon = draws.in(1.0, 2.0);
    PredictionConstants constants = constants_of(c.gravity);
    constants.horizon = in_all_lanes(horizon);
    constants.image_x = in_all_lanes(box.width);
    constants.image_y = in_all_lanes(box.height);
    constants.offset = in_all_lanes(box.shear.offset);
    constants.jump = in_all_lanes(box.shear.jump);
    const Expected expected = expected_contact(record, own, offset, box, c.gravity, horizon);
    ambiguous += expected.ambiguous ? 1 : 0;
    if (!expected.ambiguous && expected.time < never) {
      const double y = record[own + static_cast<std::uint32_t>(offset[expected.neighbour])].path.y;
      across += std::abs(y - record[own].path.y) > 7.0 ? 1 : 0;
    }
    const auto expect = [&](FirstContact found) {
      if (!found.is_ambiguous() && found.time > horizon) found.time = never;
      expect_contact(found, offset, expected, false_alarms);
    };
    for (const PredictionKernels& kernels : {choose_prediction_kernels(Bend::flow, c.unequal_radii),
                                             prediction_kernels_baseline(Bend::flow, c.unequal_radii)}) {
      ListRow row;
      row.count = static_cast<std::uint8_t>(offset.size());
      std::ranges::copy(padded(offset), row.offset);
      expect(kernels.near_sheared(constants, &record[own], row));
      expect(kernels.far_sheared(constants, &record[own], padded(offset).data(), row.count));
    }
  }
  EXPECT_GT(across, 40);
  EXPECT_LT(ambiguous, 1000);
  EXPECT_LT(false_alarms, 400);
}

INSTANTIATE_TEST_SUITE_P(All, PredictionKernelVersions,
                         testing::Values(KernelCase{0.0, false, true}, KernelCase{0.0, false, false},
                                         KernelCase{0.0, true, true}, KernelCase{0.7, false, true},
                                         KernelCase{0.7, true, false}, KernelCase{0.7, true, true},
                                         KernelCase{{0.5, -0.4}, false, true}, KernelCase{{-0.6, 0.0}, true, true},
                                         KernelCase{{0.3, 0.6}, true, false}));

}  // namespace
}  // namespace carom
