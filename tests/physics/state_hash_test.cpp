// The hash of a state: what it depends on, what it does not depend on, and its value.
#include "core/disks/state_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

Disks some_disks(double shift = 0.0) {
  return test::disks_of(
      {{1.0 + shift, 2.0, 0.5, -0.25, 1.0, 1.0}, {4.0, 5.0, 0.0, 1.0, 1.0, 1.0}, {8.0, 1.0, 3.0, 0.1, 1.0, 1.0}});
}

TEST(StateHash, DoesNotDependOnStorageOrder) {
  const Disks disks = some_disks();
  Disks turned;
  for (std::size_t i : {2U, 0U, 1U}) append(turned, disk_at(disks, i));
  EXPECT_EQ(state_hash(disks), state_hash(turned));
}

TEST(StateHash, DependsOnEveryColumn) {
  const std::uint64_t hash = state_hash(some_disks());
  EXPECT_NE(hash, state_hash(some_disks(0x1p-52)));
  for (int column = 0; column < 4; ++column) {
    Disks disks = some_disks();
    double& value = (column == 0 ? disks.x : column == 1 ? disks.y : column == 2 ? disks.vx : disks.vy)[1];
    value = std::nextafter(value, 10.0);
    EXPECT_NE(hash, state_hash(disks)) << column;
  }
  Disks renamed = some_disks();
  renamed.id[2] = 7;
  EXPECT_NE(hash, state_hash(renamed));
  Disks exchanged = some_disks();
  std::swap(exchanged.id[0], exchanged.id[1]);
  EXPECT_NE(hash, state_hash(exchanged));
  Disks fewer = some_disks();
  remove_marked(fewer, {0, 0, 1});
  EXPECT_NE(hash, state_hash(fewer));
}

// The spins of rough disks count; smooth disks have no such column.
TEST(StateHash, DependsOnSpins) {
  Disks disks = some_disks();
  const std::uint64_t smooth = state_hash(disks);
  disks.inertia = 0.5;
  disks.spin = {0.0, 1.0, -2.0};
  const std::uint64_t hash = state_hash(disks);
  EXPECT_NE(hash, smooth);
  disks.spin[1] = std::nextafter(1.0, 2.0);
  EXPECT_NE(hash, state_hash(disks));
  disks.spin = {-2.0, 1.0, 0.0};
  EXPECT_NE(hash, state_hash(disks));
}

// Bit patterns count, so the two zeros differ: an engine that gives the other zero is not the same.
TEST(StateHash, MinusZeroDiffers) {
  Disks disks = some_disks();
  const std::uint64_t hash = state_hash(disks);
  disks.vx[1] = -0.0;
  EXPECT_NE(hash, state_hash(disks));
}

// The values are fixed, since summaries and golden tests of other machines and versions contain them.
TEST(StateHash, Pinned) {
  EXPECT_EQ(hash_text(state_hash(some_disks())), "b7b6147734996984");
  EXPECT_EQ(hash_text(state_hash({})), "e220a8397b1dcdaf");  // the first output of splitmix64 from 0
  EXPECT_EQ(hash_text(0x0123456789abcdefULL), "0123456789abcdef");
  EXPECT_EQ(hash_text(0), "0000000000000000");
}

}  // namespace
}  // namespace carom
