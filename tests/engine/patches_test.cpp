// Patches: every contact is run once, the contacts of each disk in the order of the list, and no disk is in two patches
// at a time.
#include "parallel/stepping/patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "parallel/stepping/id_order.hpp"

namespace carom {
namespace {

struct Contacts {
  Disks disks;
  std::vector<Pair> pairs;
  std::vector<std::uint16_t> in_contact;
};

// Disks at random places in a box of these sides, and contacts between random disks that are near each other, some of
// one disk with a wall, and a few across the whole box, as periodic sides and large disks make them.
Contacts random_contacts(std::size_t disks, std::size_t contacts, double width, double height) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Contacts c;
  for (std::size_t i = 0; i < disks; ++i) {
    c.disks.x.push_back(width * unit(random));
    c.disks.y.push_back(height * unit(random));
    c.disks.id.push_back(static_cast<DiskId>(i));
  }
  c.in_contact.assign(disks, 0);
  const double spacing = std::max(std::sqrt(width * height / static_cast<double>(disks)),
                                  std::max(width, height) / static_cast<double>(disks));
  while (c.pairs.size() < contacts) {
    const auto i = static_cast<std::uint32_t>(random() % disks);
    const auto j = static_cast<std::uint32_t>(random() % disks);
    const bool far = c.pairs.size() % 300 == 0;
    if (!far && std::hypot(c.disks.x[i] - c.disks.x[j], c.disks.y[i] - c.disks.y[j]) > 1.5 * spacing) continue;
    c.pairs.push_back({i, j});
    c.in_contact[i] = c.in_contact[j] = 1;
  }
  return c;
}

// The contacts of each disk must run in the order of the list.
void expect_order_kept(const Contacts& c, const Patches& patches, const Executor& executor, bool backwards) {
  std::vector<std::vector<std::uint32_t>> expected(c.disks.size());
  std::vector<std::vector<std::uint32_t>> seen(c.disks.size());
  const auto note = [&](auto& lists, std::uint32_t k) {
    lists[c.pairs[k].i1].push_back(k);
    if (c.pairs[k].i2 != c.pairs[k].i1) lists[c.pairs[k].i2].push_back(k);
  };
  const auto n = static_cast<std::uint32_t>(c.pairs.size());
  for (std::uint32_t k = 0; k < n; ++k) note(expected, backwards ? n - 1 - k : k);
  // Patches of a phase share no disk; otherwise this would be a race, which the thread sanitizer reports.
  run_patches(patches, backwards, executor, [&](std::size_t q) {
    const std::uint32_t begin = patches.start[q];
    const std::uint32_t end = patches.start[q + 1];
    for (std::uint32_t at = begin; at < end; ++at) note(seen, patches.order[backwards ? end - 1 - (at - begin) : at]);
  });
  EXPECT_EQ(expected, seen);
}

std::uint32_t in_last_phase(const Patches& patches) {
  const std::uint32_t last = patches.first[patch_phases] - 1;
  return patches.start[last + 1] - patches.start[last];
}

void expect_phases_disjoint(const Contacts& c, const Patches& patches) {
  for (std::uint32_t phase = 0; phase < patch_phases; ++phase) {
    std::vector<std::uint32_t> owner(c.disks.size(), 0);
    for (std::uint32_t q = patches.first[phase]; q < patches.first[phase + 1]; ++q) {
      for (std::uint32_t at = patches.start[q]; at < patches.start[q + 1]; ++at) {
        const Pair& p = c.pairs[patches.order[at]];
        for (const std::uint32_t i : {p.i1, p.i2}) {
          ASSERT_TRUE(owner[i] == 0 || owner[i] == q + 1) << "disk " << i << " in two patches of phase " << phase;
          owner[i] = q + 1;
        }
      }
    }
  }
}

void check(const Contacts& c, int threads, std::size_t divisor, bool cut) {
  const Executor executor(threads, divisor);
  Patches patches;
  for (int again = 0; again < 2; ++again) {  // the second time its scratch memory has been used
    build_patches(patches, c.disks, c.in_contact, c.pairs.size(), executor, [&](std::size_t k) { return c.pairs[k]; });
    ASSERT_EQ(patches.order.size(), c.pairs.size());
    EXPECT_EQ(patches.count() > 1, cut);
    expect_phases_disjoint(c, patches);
    expect_order_kept(c, patches, executor, false);
    expect_order_kept(c, patches, executor, true);
  }
  if (cut) {
    EXPECT_LT(in_last_phase(patches), c.pairs.size() / 4);
  }
}

TEST(LongPatches, KeepTheOrderOfEachDisk) {
  for (const int threads : {1, 2, 5}) {
    check(random_contacts(6000, 9000, 100.0, 80.0), threads, 4, true);
    check(random_contacts(6000, 9000, 3000.0, 40.0), threads, 4, true);
    check(random_contacts(6000, 9000, 10.0, 4000.0), threads, 4, true);
  }
}

TEST(Patches, FewContactsAreNotCut) {
  check(random_contacts(100, 90, 10.0, 10.0), 3, 1, false);
  check(random_contacts(100, 0, 10.0, 10.0), 3, 1, false);
}

TEST(Patches, DisksOnOneLineOrPoint) {
  check(random_contacts(3000, 4000, 100.0, 0.0), 2, 16, true);
  Contacts c = random_contacts(300, 900, 1.0, 1.0);
  c.disks.x.assign(300, 0.5);
  c.disks.y.assign(300, 0.5);
  check(c, 2, 64, true);  // all contacts are in one patch of the first layout
}

TEST(IdOrder, IsThatOfAPlainSort) {
  std::mt19937 random(3);
  for (const DiskId ids : {1U, 2U, 40U, 5000U, 0xffffff00U}) {
    for (const std::size_t n : {0U, 1U, 100U, 5000U}) {
      for (const int threads : {1, 3}) {
        IdOrder pairs;
        for (std::size_t k = 0; k < n; ++k) {
          pairs.found.push_back({id_key(static_cast<DiskId>(random() % ids), static_cast<DiskId>(random())), 0, 0});
        }
        std::vector<std::uint64_t> expected;
        for (const IdPair& p : pairs.found) expected.push_back(p.key);
        std::sort(expected.begin(), expected.end());
        sort_by_ids(pairs, ids / 2 + 1, Executor(threads));  // half of the ids exceed the number stated
        std::vector<std::uint64_t> sorted;
        for (const IdPair& p : pairs.sorted) sorted.push_back(p.key);
        EXPECT_EQ(expected, sorted);
      }
    }
  }
}

}  // namespace
}  // namespace carom
