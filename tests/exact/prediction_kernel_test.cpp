// The prediction kernel against core's formulas, bit by bit, in every version.
#include "parallel/exact/prediction_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/physics/boundary.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

struct KernelCase {
  bool gravity, unequal_radii, periodic;
};

constexpr std::size_t disks = 40;

std::vector<DiskRecord> random_records(test::Draws& draws, const KernelCase& c, double box) {
  std::vector<DiskRecord> record(disks);
  for (std::uint32_t k = 0; k < record.size(); ++k) {
    DiskRecord& f = record[k];
    f.path = {draws.in(0.0, 1.0), draws.in(0.0, box), draws.in(0.0, box), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
    // Some at rest, some on one line, one that is gone.
    if (k % 7 == 3) f.path.vx = f.path.vy = 0.0;
    if (k % 5 == 1) f.path.y = record[0].path.y;
    if (k == 13) f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    f.radius = c.unequal_radii ? draws.in(0.05, 0.6) : 0.3;
    f.id = k;
  }
  return record;
}

// The first contacts by the formula of core, one after the other.
FirstContacts expected_contacts(const std::vector<DiskRecord>& record, std::uint32_t own,
                                const std::vector<int>& offset, const Domain& box, double g,
                                const PredictionConstants& constants) {
  FirstContacts first;
  for (std::size_t k = 0; k < offset.size(); ++k) {
    const auto j = static_cast<std::uint32_t>(static_cast<int>(own) + offset[k]);
    const DiskRecord& a = record[std::min(own, j)];
    const DiskRecord& b = record[std::max(own, j)];
    const double both = std::max(a.path.start, b.path.start);
    const Relative r = relative(carried_to(a.path, both, g), carried_to(b.path, both, g), box);
    const double contact_distance = a.radius + b.radius;
    const double gap = r.distance2() - contact_distance * contact_distance;
    first.lasting |= gap * gap <= constants.close2 && r.approach() * r.approach() <= constants.slow2;
    const double t = both + time_to_contact(r, contact_distance);
    if (!(t < never) || t > first.time) continue;
    if (t < first.time) first.bits = 0;
    first.time = t;
    first.bits |= 1U << k;
  }
  // What fills up a group of four is the disk itself.
  const double own_contact = 2.0 * record[own].radius;
  first.lasting |= offset.size() % 4 != 0 && !std::isnan(record[own].path.x) &&
                   std::pow(own_contact, 4) <= constants.close2 && constants.slow2 > 0.0;
  return first;
}

template <class Offset>
void expect_contacts(PredictionKernel<Offset> kernel, const PredictionConstants& constants,
                     const std::vector<DiskRecord>& record, std::uint32_t own, const std::vector<int>& offset,
                     const FirstContacts& expected) {
  std::array<Offset, max_batch> packed{};
  for (std::size_t k = 0; k < offset.size(); ++k) packed[k] = static_cast<Offset>(offset[k]);
  const FirstContacts found = kernel(constants, &record[own], packed.data(), static_cast<std::uint32_t>(offset.size()));
  ASSERT_EQ(found.time, expected.time);
  ASSERT_EQ(found.lasting, expected.lasting);
  if (expected.time < never) {
    ASSERT_EQ(found.bits, expected.bits);
  }
}

class PredictionKernelVersions : public testing::TestWithParam<KernelCase> {};

TEST_P(PredictionKernelVersions, HaveTheBitsOfTheFormula) {
  const KernelCase& c = GetParam();
  test::Draws draws(17);
  const double g = c.gravity ? 0.7 : 0.0;
  int met = 0;
  int lasting = 0;
  for (int round = 0; round < 400; ++round) {
    Domain box;
    box.width = 6.0;
    box.height = 5.0;
    if (c.periodic) box.sides.fill(SideKind::periodic);
    const std::vector<DiskRecord> record = random_records(draws, c, 5.0);
    const auto own = static_cast<std::uint32_t>(draws.bits() % disks);
    std::vector<int> offset;
    const std::size_t count = draws.bits() % (max_batch + 1);
    while (offset.size() < count) {
      const int j = static_cast<int>(draws.bits() % disks);
      if (j != static_cast<int>(own)) offset.push_back(j - static_cast<int>(own));
    }
    PredictionConstants constants{g, 0.0, 0.0, HUGE_VAL, HUGE_VAL};
    if (c.periodic) {
      constants.width = box.width;
      constants.height = box.height;
      constants.half_width = 0.5 * box.width;
      constants.half_height = 0.5 * box.height;
    }
    constants.close2 = 0.3 * 0.3;
    constants.slow2 = 0.3 * 0.3;
    const FirstContacts expected = expected_contacts(record, own, offset, box, g, constants);
    met += expected.time < never ? 1 : 0;
    lasting += expected.lasting ? 1 : 0;
    for (const PredictionKernels& kernels : {choose_prediction_kernels(c.gravity, c.unequal_radii),
                                             prediction_kernels_baseline(c.gravity, c.unequal_radii)}) {
      expect_contacts(kernels.near, constants, record, own, offset, expected);
      expect_contacts(kernels.far, constants, record, own, offset, expected);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(lasting, 20);
  EXPECT_LT(lasting, 380);
}

INSTANTIATE_TEST_SUITE_P(All, PredictionKernelVersions,
                         testing::Values(KernelCase{false, false, true}, KernelCase{false, false, false},
                                         KernelCase{false, true, true}, KernelCase{true, false, true},
                                         KernelCase{true, true, false}, KernelCase{true, true, true}));

}  // namespace
}  // namespace carom
