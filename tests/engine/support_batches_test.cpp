// Supports in batches of four: each support is in one batch, those of a batch share no disk, and those of a disk keep
// their order; and the kernels for batches have the bits of relaxing the supports one by one.
#include "parallel/stepping/support_batches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/base/kernel_set.hpp"
#include "core/physics/support_solver.hpp"
#include "parallel/stepping/sweep_kernel.hpp"

namespace carom {
namespace {

// Patches with n contacts each, which share no disk: patch q has the disks [q n, (q + 1) n), and in_patch(k) gives the
// disks of its contact k, counted from 0.
struct Contacts {
  std::size_t disks = 0;
  std::vector<Pair> pairs;
  Patches patches;

  template <class InPatch>
  Contacts(std::size_t count, std::size_t disks_each, std::size_t contacts_each, InPatch&& in_patch)
      : disks(count * disks_each) {
    patches.start = {0};
    for (std::size_t q = 0; q < count; ++q) {
      for (std::size_t k = 0; k < contacts_each; ++k) {
        const Pair p = in_patch(k);
        const auto first = static_cast<std::uint32_t>(q * disks_each);
        pairs.push_back({first + p.i1, first + p.i2});
      }
      patches.start.push_back(static_cast<std::uint32_t>(pairs.size()));
    }
  }
};

template <class IsSupport>
void fill_batches(SupportBatches& batches, const Contacts& c, IsSupport&& is_support) {
  begin_batches(batches, c.patches, c.disks);
  for (std::size_t q = 0; q < c.patches.count(); ++q) {
    place_in_batches(
        batches, c.patches, q, [&](std::size_t at) { return c.pairs[at]; }, is_support);
  }
  lay_out_batches(batches);
  for (std::size_t q = 0; q < c.patches.count(); ++q) {
    clear_batches(batches, c.patches, q, SupportBatches::spare(c.disks, q));
  }
}

template <class IsSupport>
SupportBatches batches_of(const Contacts& c, IsSupport&& is_support) {
  SupportBatches batches;
  fill_batches(batches, c, is_support);
  return batches;
}

// Contacts between random disks of a patch; one in eight is with a wall.
Contacts random_contacts(std::size_t patches, std::size_t disks, std::size_t contacts) {
  std::mt19937 random(11);
  return {patches, disks, contacts, [&](std::size_t) {
            const auto i = static_cast<std::uint32_t>(random() % disks);
            const auto j = static_cast<std::uint32_t>(random() % disks);
            return random() % 8 == 0 ? Pair{i, i} : Pair{i, j};
          }};
}

TEST(SupportBatches, KeepEachDisksOrderAndShareNoDisk) {
  const std::vector<std::pair<std::size_t, std::size_t>> sizes{{500, 900}, {40, 300}, {3, 20}, {1, 5}, {10, 0}};
  for (const auto& [disks, contacts] : sizes) {
    const Contacts c = random_contacts(3, disks, contacts);
    const auto is_support = [](std::size_t at) { return at % 7 != 3; };
    const SupportBatches batches = batches_of(c, is_support);
    std::vector<std::set<std::uint32_t>> in_batch(batches.batch.size());
    std::vector<std::int64_t> latest(c.disks, -1);  // batch of each disk's previous support
    std::set<std::uint32_t> slots;
    for (std::size_t q = 0; q < c.patches.count(); ++q) {
      for (std::uint32_t at = c.patches.start[q]; at < c.patches.start[q + 1]; ++at) {
        const std::uint32_t slot = batches.slot[at];
        ASSERT_EQ(slot != no_slot, is_support(at));
        if (slot == no_slot) continue;
        ASSERT_TRUE(slots.insert(slot).second) << "two supports in slot " << slot;
        const auto b = static_cast<std::uint32_t>(slot / batch_lanes);
        ASSERT_GE(b, batches.first[q]);
        ASSERT_LT(b, batches.first[q + 1]);
        for (const std::uint32_t i : std::set{c.pairs[at].i1, c.pairs[at].i2}) {
          ASSERT_TRUE(in_batch[b].insert(i).second) << "disk " << i << " is twice in batch " << b;
          ASSERT_GT(b, latest[i]);
          latest[i] = b;
        }
      }
    }
  }
}

// The batches of a patch must not depend on how other patches, or earlier steps, used the same disks.
TEST(SupportBatches, OfAPatchDoNotDependOnOthers) {
  const auto all = [](std::size_t) { return true; };
  const Contacts one = random_contacts(1, 20, 60);
  Contacts twice = one;
  for (std::size_t k = 0; k < 60; ++k) twice.pairs.push_back(one.pairs[k]);
  twice.patches.start.push_back(120);
  const SupportBatches alone = batches_of(one, all);
  SupportBatches again = alone;
  fill_batches(again, one, all);
  EXPECT_EQ(again.slot, alone.slot);
  SupportBatches both;
  for (int step = 0; step < 2; ++step) {
    fill_batches(both, twice, all);
    ASSERT_EQ(both.batch.size(), 2 * alone.batch.size());
    for (std::size_t k = 0; k < 60; ++k) {
      EXPECT_EQ(both.slot[k], alone.slot[k]);
      EXPECT_EQ(both.slot[60 + k], alone.slots() + alone.slot[k]);
    }
  }
}

TEST(SupportBatches, GiveBackWhatWasPut) {
  SupportBatches batches;
  batches.batch.resize(2);
  put_support(batches, 6, {0.6, -0.8, 2.0, 3.0, 4.0, 5.0, 7, 9});
  const Support s = support_in(batches, 6);
  EXPECT_EQ(s.nx, 0.6);
  EXPECT_EQ(s.ny, -0.8);
  EXPECT_EQ(s.inverse1, 2.0);
  EXPECT_EQ(s.inverse2, 3.0);
  EXPECT_EQ(s.wall_speed, 4.0);
  EXPECT_EQ(s.effective, 5.0);
  EXPECT_EQ(s.i1, 7U);
  EXPECT_EQ(s.i2, 9U);
}

// If each disk has few of many contacts, hardly any lane is left empty; along a chain only one lane of each batch is
// used.
TEST(SupportBatches, AreFullWhereContactsAllowIt) {
  const auto all = [](std::size_t) { return true; };
  EXPECT_LE(batches_of(random_contacts(1, 2000, 4000), all).batch.size(), 1020U);
  const auto chain = [](std::size_t k) {
    return Pair{static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k + 1)};
  };
  EXPECT_EQ(batches_of({1, 101, 100, chain}, all).batch.size(), 100U);
  // Ten such chains side by side can share batches, like the rows of a lattice.
  const auto rows = [](std::size_t k) {
    const auto i = static_cast<std::uint32_t>(k / 100 * 101 + k % 100);
    return Pair{i, i + 1};
  };
  EXPECT_EQ(batches_of({1, 1010, 1000, rows}, all).batch.size(), 300U);
}

struct Supports {
  Contacts contacts = random_contacts(2, 60, 201);
  std::vector<Support> serial;  // for each contact
  SupportBatches batches;
  SupportSet of_serial, of_batches;
};

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Unequal masses, some negative impulses as momentum may leave them, and moving walls.
Supports random_supports() {
  Supports s;
  std::mt19937 random(5);
  s.batches = batches_of(s.contacts, [](std::size_t) { return true; });
  const std::size_t n = s.contacts.pairs.size();
  for (auto column : {&SupportSet::impulse, &SupportSet::last, &SupportSet::before, &SupportSet::ahead,
                      &SupportSet::contact_distance}) {
    const double rest = column == &SupportSet::contact_distance ? 1.0 : 0.0;
    (s.of_serial.*column).assign(n, rest);
    (s.of_batches.*column).assign(s.batches.slots(), rest);
  }
  std::vector<double> inverse(s.contacts.disks);
  for (double& of_disk : inverse) of_disk = 1.0 / between(random, 0.1, 10.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Pair p = s.contacts.pairs[k];
    const double angle = between(random, 0.0, 7.0);
    const bool wall = p.i1 == p.i2;
    s.serial.push_back({std::cos(angle), std::sin(angle), inverse[p.i1], wall ? 0.0 : inverse[p.i2],
                        wall ? between(random, -1.0, 1.0) : 0.0, 1.0 / (inverse[p.i1] + (wall ? 0.0 : inverse[p.i2])),
                        p.i1, p.i2});
    const std::uint32_t slot = s.batches.slot[k];
    put_support(s.batches, slot, s.serial[k]);
    s.of_serial.impulse[k] = s.of_batches.impulse[slot] = between(random, -0.3, 1.0);
    s.of_serial.last[k] = s.of_batches.last[slot] = between(random, -0.3, 1.0);
    s.of_serial.contact_distance[k] = s.of_batches.contact_distance[slot] = between(random, 0.5, 2.0);
  }
  s.of_batches.v.resize(SupportBatches::spare(s.contacts.disks, s.contacts.patches.count()));
  s.of_serial.v.resize(s.contacts.disks);
  s.of_batches.last_v.resize(s.contacts.disks);
  s.of_serial.last_v.resize(s.contacts.disks);
  for (std::size_t i = 0; i < s.contacts.disks; ++i) {
    s.of_serial.v[i] = s.of_batches.v[i] = {between(random, -2.0, 2.0), between(random, -2.0, 2.0)};
  }
  return s;
}

SweepInput input_of(Supports& s) {
  SupportSet& set = s.of_batches;
  return {s.batches.batch.data(), set.impulse.data(),          set.last.data(),  set.before.data(),
          set.ahead.data(),       set.contact_distance.data(), &set.v.data()->x, &set.last_v.data()->x};
}

template <Watch watch>
void expect_same_bits(const SweepKernels& kernels) {
  Supports s = random_supports();
  const SweepInput in = input_of(s);
  CycleFigures serial, serial_back;  // of the forward sweeps, and of the backward ones
  CycleFigures batches, batches_back;
  const bool watched = watch != Watch::nothing;
  const std::size_t n = s.serial.size();
  std::vector<std::uint16_t> touching(s.contacts.disks, 1);
  touching[3] = touching[44] = 0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (std::size_t k = 0; k < n; ++k) relax_forward<watch>(s.of_serial, k, s.serial[k], serial);
    for (std::size_t k = n; k-- > 0;) relax_back<watch>(s.of_serial, k, s.serial[k], serial_back);
    kernels.relax(in, Sweep::forward, watch, 0, s.batches.batch.size(), watched ? &batches : nullptr);
    kernels.relax(in, Sweep::back, watch, 0, s.batches.batch.size(), watched ? &batches_back : nullptr);
    extrapolate_impulses(s.of_serial, 0, n, 0.4 * cycle);
    kernels.extrapolate(in, 0, s.batches.batch.size(), 0.4 * cycle);
    for (std::size_t i = 0; i < s.contacts.disks; ++i) {
      if (touching[i] != 0) extrapolate_velocity(s.of_serial.v[i], s.of_serial.last_v[i], 0.4 * cycle);
    }
    kernels.extrapolate_velocities(in, touching.data(), 0, s.contacts.disks, 0.4 * cycle);
  }
  EXPECT_EQ(serial.largest, batches.largest);
  EXPECT_EQ(serial_back.largest, batches_back.largest);
  EXPECT_EQ(serial_back.strain, batches_back.strain);
  EXPECT_EQ(serial.largest > 0.0, watched);
  EXPECT_EQ(serial_back.largest > 0.0, watched);
  for (std::size_t i = 0; i < s.contacts.disks; ++i) {
    EXPECT_EQ(s.of_serial.v[i], s.of_batches.v[i]) << i;
    EXPECT_EQ(s.of_serial.last_v[i], s.of_batches.last_v[i]) << i;
  }
  for (std::size_t i = s.contacts.disks; i < s.of_batches.v.size(); ++i) EXPECT_EQ(s.of_batches.v[i], Vec2{}) << i;
  for (auto column : {&SupportSet::impulse, &SupportSet::last, &SupportSet::before, &SupportSet::ahead}) {
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_EQ((s.of_serial.*column)[k], (s.of_batches.*column)[s.batches.slot[k]]) << k;
    }
    // Sums are taken over all slots, so unused ones must be 0.
    const std::set<std::uint32_t> taken(s.batches.slot.begin(), s.batches.slot.end());
    EXPECT_LT(taken.size(), s.batches.slots());
    for (std::uint32_t slot = 0; slot < s.batches.slots(); ++slot) {
      if (taken.count(slot) > 0) continue;
      EXPECT_EQ((s.of_batches.*column)[slot], 0.0) << "unused slot " << slot;
    }
  }
}

void expect_same_bits_with(const SweepKernels& kernels) {
  expect_same_bits<Watch::nothing>(kernels);
  expect_same_bits<Watch::largest>(kernels);
  expect_same_bits<Watch::all>(kernels);
}

TEST(SweepKernels, HaveTheBitsOfOneSupportAfterTheOther) {
  expect_same_bits_with(sweep_kernels_baseline());
  if (choose_kernel_set(nullptr) == KernelSet::avx2) expect_same_bits_with(sweep_kernels_avx2());
}

// A velocity that is not a number stays within the disks that touch: neither other walls nor spare disks may pass it
// on.
TEST(SweepKernels, KeepWhatIsNoNumberAmongTheDisksThatTouch) {
  const auto check = [](const SweepKernels& kernels) {
    const auto at_walls = [](std::size_t k) {
      return Pair{static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k)};
    };
    Supports s{{1, 6, 6, at_walls}, {}, {}, {}, {}};
    s.batches = batches_of(s.contacts, [](std::size_t) { return true; });
    for (const std::uint32_t slot : s.batches.slot) {
      put_support(s.batches, slot, {0.0, -1.0, 1.0, 0.0, 0.0, 1.0, slot, slot});
    }
    for (auto column : {&SupportSet::impulse, &SupportSet::last, &SupportSet::before, &SupportSet::ahead}) {
      (s.of_batches.*column).assign(s.batches.slots(), 0.0);
    }
    s.of_batches.contact_distance.assign(s.batches.slots(), 1.0);
    s.of_batches.v.assign(SupportBatches::spare(s.contacts.disks, 1), {0.0, 0.0});
    s.of_batches.last_v.resize(6);
    for (std::size_t i = 0; i < 6; ++i) s.of_batches.v[i] = {0.5, -1.0};
    s.of_batches.v[2].y = -std::numeric_limits<double>::infinity();
    Vec2 serial = s.of_batches.v[2];
    double impulse = 0.0;
    for (int twice = 0; twice < 2; ++twice) {
      relax(&serial, {0.0, -1.0, 1.0, 0.0, 0.0, 1.0, 0, 0}, impulse);
      kernels.relax(input_of(s), Sweep::forward, Watch::nothing, 0, s.batches.batch.size(), nullptr);
    }
    for (const std::size_t i : {0U, 1U, 3U, 4U, 5U}) EXPECT_EQ(s.of_batches.v[i], (Vec2{0.5, 0.0})) << i;
    EXPECT_EQ(s.of_batches.v[6], Vec2{});
    EXPECT_EQ(s.of_batches.impulse[s.batches.slot[2]], impulse);
    EXPECT_EQ(std::isnan(s.of_batches.v[2].y), std::isnan(serial.y));
  };
  check(sweep_kernels_baseline());
  if (choose_kernel_set(nullptr) == KernelSet::avx2) check(sweep_kernels_avx2());
}

}  // namespace
}  // namespace carom
