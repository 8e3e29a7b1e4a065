// The lists of the exact method: who is in them, before and after disks were listed anew, and the kernel behind them.
#include "parallel/exact/exact_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "parallel/exact/nearby_kernel.hpp"
#include "tests/support/support.hpp"

namespace carom {
namespace {

Disks random_disks(test::Draws& draws, std::size_t n, double width, double height, bool mixed) {
  Disks d;
  d.common_radius = 0.5;
  for (std::size_t i = 0; i < n; ++i) {
    d.x.push_back(draws.in(0.0, width));
    d.y.push_back(draws.in(0.0, height));
    d.vx.push_back(0.0);
    d.vy.push_back(0.0);
    d.id.push_back(static_cast<DiskId>(i));
    if (mixed) d.radius.push_back(i % 9 == 0 ? draws.in(1.0, 2.0) : draws.in(0.05, 0.4));
  }
  return d;
}

double apart(double a, double b, double period, bool periodic) {
  const double d = std::abs(a - b);
  return periodic ? std::min(d, period - d) : d;
}

// Everybody whose places are within r_i + r_j + 2 roam of each other lists the other, once; places are where they
// were said to be, as far as a small part of the roam.
void expect_complete(const ExactLists& lists, const Disks& d, const std::vector<Vec2>& said, const Domain& box) {
  std::vector<Vec2> place;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    place.push_back(lists.place_of(i));
    const double tolerance = 1e-9 * (box.width + box.height);
    ASSERT_LE(apart(place[i].x, said[i].x, box.width, box.periodic_x()), tolerance);
    ASSERT_LE(apart(place[i].y, said[i].y, box.height, box.periodic_y()), tolerance);
  }
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    std::vector<std::uint32_t> listed;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { listed.push_back(j); });
    std::sort(listed.begin(), listed.end());
    ASSERT_EQ(std::adjacent_find(listed.begin(), listed.end()), listed.end()) << "disk " << i;
    ASSERT_FALSE(std::binary_search(listed.begin(), listed.end(), i));
    for (std::uint32_t j = 0; j < d.size(); ++j) {
      if (j == i) continue;
      const double dx = apart(place[i].x, place[j].x, box.width, box.periodic_x());
      const double dy = apart(place[i].y, place[j].y, box.height, box.periodic_y());
      const double reach = (d.radius_of(i) + d.radius_of(j) + 2.0 * lists.roam()) * (1.0 - 1e-12);
      if (dx * dx + dy * dy > reach * reach) continue;
      ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), j)) << i << " and " << j;
    }
  }
}

void expect_lists(std::size_t n, std::size_t disks_per_tile, bool mixed, bool periodic) {
  test::Draws draws(n + disks_per_tile);
  Domain box;
  box.width = 40.0;
  box.height = 25.0;
  if (periodic) box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, n, box.width, box.height, mixed);
  ExactLists lists;
  const Executor executor(2, 64);
  lists.build(d, box, disks_per_tile, 0.9, executor);
  EXPECT_EQ(lists.first_disk_of(0), 0U);
  EXPECT_EQ(lists.first_disk_of(lists.tiles()), n);
  std::vector<Vec2> place;
  for (std::size_t i = 0; i < n; ++i) place.push_back({d.x[i], d.y[i]});
  expect_complete(lists, d, place, box);
  FoundDisks found;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    const auto i = static_cast<std::uint32_t>(draws.bits() % n);
    place[i] = {draws.in(0.0, box.width), draws.in(0.0, box.height)};
    ASSERT_TRUE(lists.list_anew(i, place[i], d, ListsPart{}, found));
  }
  expect_complete(lists, d, place, box);
}

TEST(ExactLists, HoldEverybodyNear) {
  for (const bool mixed : {false, true}) {
    for (const bool periodic : {false, true}) {
      expect_lists(30, 0, mixed, periodic);
      expect_lists(400, 0, mixed, periodic);
      for (const std::size_t disks_per_tile : {1U, 10U, 100U}) expect_lists(400, disks_per_tile, mixed, periodic);
    }
  }
}

// A disk whose surroundings reach beyond the part is not listed anew, and nothing changes.
TEST(ExactLists, KeepToTheirPart) {
  test::Draws draws(5);
  Domain box;
  box.width = box.height = 60.0;
  box.sides.fill(SideKind::periodic);
  Disks d = random_disks(draws, 2000, 60.0, 60.0, false);
  ExactLists lists;
  const Executor executor(1);
  lists.build(d, box, 100, 0.9, executor);
  const std::uint32_t half = lists.tiles() / 2;
  const ListsPart part = lists.part_of_tiles(0, half);
  FoundDisks found;
  int refused = 0;
  int listed = 0;
  for (std::uint32_t i = part.first_disk; i < part.last_disk; ++i) {
    std::vector<std::uint32_t> before;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { before.push_back(j); });
    if (lists.list_anew(i, {d.x[i], d.y[i]}, d, part, found)) {
      ++listed;
      EXPECT_TRUE(
          std::all_of(found.disks().begin(), found.disks().end(), [&](std::uint32_t j) { return part.holds(j); }));
      continue;
    }
    ++refused;
    std::vector<std::uint32_t> after;
    lists.for_each_neighbour(i, [&](std::uint32_t j) { after.push_back(j); });
    EXPECT_EQ(before, after);
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(listed, refused);
}

TEST(NearbyKernel, AllVersionsFindTheSame) {
  test::Draws draws(8);
  const Disks d = random_disks(draws, 203, 10.0, 8.0, true);
  std::vector<Spot> spot;
  std::vector<std::uint32_t> next;
  for (std::size_t i = 0; i < d.size(); ++i) {
    spot.push_back({static_cast<std::uint32_t>(draws.bits()), static_cast<std::uint32_t>(draws.bits())});
    next.push_back(draws.bits() % 4 == 0 ? 7U : unchained);
  }
  std::size_t found = 0;
  for (std::uint32_t round = 0; round < 300; ++round) {
    NearbyFrame frame;
    frame.self = static_cast<std::uint32_t>(draws.bits() % d.size());
    frame.spot = spot[frame.self];
    frame.unit_x = 0x1p-32F * 10.0F;
    frame.unit_y = 0x1p-32F * 8.0F;
    frame.reach = static_cast<float>(draws.in(0.2, 3.0));
    frame.common_radius = 0.5F;
    frame.per_length = 0.7;
    const NearbyColumns columns{spot.data(), round % 2 == 0 ? d.radius.data() : nullptr,
                                round % 5 < 2 ? next.data() : nullptr, static_cast<std::uint32_t>(d.size())};
    std::vector<DiskRun> runs;
    std::size_t room = nearby_room;
    for (std::uint32_t k = 0; k < round % 4; ++k) {
      const auto first = static_cast<std::uint32_t>(draws.bits() % d.size());
      runs.push_back({first, first + static_cast<std::uint32_t>(draws.bits() % (d.size() + 1 - first))});
      room += runs.back().last - runs.back().first;
    }
    std::vector<std::uint32_t> a(room);
    std::vector<std::uint32_t> b(room);
    a.resize(nearby_baseline(frame, columns, runs.data(), runs.size(), a.data()));
    b.resize(choose_nearby_kernel()(frame, columns, runs.data(), runs.size(), b.data()));
    ASSERT_EQ(a, b);
    found += a.size();
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace carom
