// The kernel of the look around against core's meeting_time(), bit by bit, in every version.
#include "parallel/exact/meeting_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/physics/boundary.hpp"
#include "tests/support/support.hpp"

namespace carom {
namespace {

struct MeetingCase {
  bool gravity, unequal_radii, periodic;
};

constexpr std::size_t at_hand = 40;

std::vector<Flight> random_flights(test::Draws& draws, const MeetingCase& c, double box) {
  std::vector<Flight> flight(at_hand);
  for (std::uint32_t k = 0; k < flight.size(); ++k) {
    Flight& f = flight[k];
    f.path = {draws.in(0.0, 1.0), draws.in(0.0, box), draws.in(0.0, box), draws.in(-2.0, 2.0), draws.in(-2.0, 2.0)};
    // Some at rest, some on one line, one that is gone.
    if (k % 7 == 3) f.path.vx = f.path.vy = 0.0;
    if (k % 5 == 1) f.path.y = flight[0].path.y;
    if (k == 13) f.path.x = f.path.y = std::numeric_limits<double>::quiet_NaN();
    f.radius = c.unequal_radii ? draws.in(0.05, 0.6) : 0.3;
    f.id = k;
  }
  return flight;
}

// The first meetings by the formula of core, one after the other.
FirstMeetings expected_meetings(const std::vector<Flight>& flight, std::uint32_t own, const std::vector<int>& offset,
                                const Domain& box, double g, const MeetingFrame& frame) {
  FirstMeetings first;
  for (std::size_t k = 0; k < offset.size(); ++k) {
    const auto j = static_cast<std::uint32_t>(static_cast<int>(own) + offset[k]);
    const Flight& a = flight[std::min(own, j)];
    const Flight& b = flight[std::max(own, j)];
    const double both = std::max(a.path.start, b.path.start);
    const Relative r = relative(carried_to(a.path, both, g), carried_to(b.path, both, g), box);
    const double reach = a.radius + b.radius;
    const double gap = r.distance2() - reach * reach;
    first.lasting |= gap * gap <= frame.close2 && r.approach() * r.approach() <= frame.slow2;
    const double t = both + time_to_contact(r, reach);
    if (!(t < never) || t > first.time) continue;
    if (t < first.time) first.bits = 0;
    first.time = t;
    first.bits |= 1U << k;
  }
  // What fills up a group of four is the disk itself.
  const double own_reach = 2.0 * flight[own].radius;
  first.lasting |= offset.size() % 4 != 0 && !std::isnan(flight[own].path.x) &&
                   std::pow(own_reach, 4) <= frame.close2 && frame.slow2 > 0.0;
  return first;
}

template <class Offset>
void expect_meetings(MeetingKernel<Offset> kernel, const MeetingFrame& frame, const std::vector<Flight>& flight,
                     std::uint32_t own, const std::vector<int>& offset, const FirstMeetings& expected) {
  std::array<Offset, most_neighbours> packed{};
  for (std::size_t k = 0; k < offset.size(); ++k) packed[k] = static_cast<Offset>(offset[k]);
  const FirstMeetings found = kernel(frame, &flight[own], packed.data(), static_cast<std::uint32_t>(offset.size()));
  ASSERT_EQ(found.time, expected.time);
  ASSERT_EQ(found.lasting, expected.lasting);
  if (expected.time < never) {
    ASSERT_EQ(found.bits, expected.bits);
  }
}

class MeetingKernelVersions : public testing::TestWithParam<MeetingCase> {};

TEST_P(MeetingKernelVersions, HaveTheBitsOfTheFormula) {
  const MeetingCase& c = GetParam();
  test::Draws draws(17);
  const double g = c.gravity ? 0.7 : 0.0;
  int met = 0;
  int lasting = 0;
  for (int round = 0; round < 400; ++round) {
    Domain box;
    box.width = 6.0;
    box.height = 5.0;
    if (c.periodic) box.sides.fill(SideKind::periodic);
    const std::vector<Flight> flight = random_flights(draws, c, 5.0);
    const auto own = static_cast<std::uint32_t>(draws.bits() % at_hand);
    std::vector<int> offset;
    const std::size_t count = draws.bits() % (most_neighbours + 1);
    while (offset.size() < count) {
      const int j = static_cast<int>(draws.bits() % at_hand);
      if (j != static_cast<int>(own)) offset.push_back(j - static_cast<int>(own));
    }
    MeetingFrame frame{g, 0.0, 0.0, HUGE_VAL, HUGE_VAL};
    if (c.periodic) {
      frame.width = box.width;
      frame.height = box.height;
      frame.half_width = 0.5 * box.width;
      frame.half_height = 0.5 * box.height;
    }
    frame.close2 = 0.3 * 0.3;
    frame.slow2 = 0.3 * 0.3;
    const FirstMeetings expected = expected_meetings(flight, own, offset, box, g, frame);
    met += expected.time < never ? 1 : 0;
    lasting += expected.lasting ? 1 : 0;
    for (const MeetingKernels& kernels :
         {choose_meeting_kernels(c.gravity, c.unequal_radii), meeting_kernels_baseline(c.gravity, c.unequal_radii)}) {
      expect_meetings(kernels.near, frame, flight, own, offset, expected);
      expect_meetings(kernels.far, frame, flight, own, offset, expected);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(lasting, 20);
  EXPECT_LT(lasting, 380);
}

INSTANTIATE_TEST_SUITE_P(All, MeetingKernelVersions,
                         testing::Values(MeetingCase{false, false, true}, MeetingCase{false, false, false},
                                         MeetingCase{false, true, true}, MeetingCase{true, false, true},
                                         MeetingCase{true, true, false}, MeetingCase{true, true, true}));

}  // namespace
}  // namespace carom
