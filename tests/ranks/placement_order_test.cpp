// The order in which ranks place disks at random: it is that of a single machine, which sorts all disks.
#include "parallel/slabs/placement_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/ranks/local_ranks.hpp"

namespace carom {
namespace {

Scene scene_of(const std::vector<std::string>& radii) {
  std::string groups;
  for (const std::string& radius : radii) {
    groups += "[[disks]]\ncount = 150\nmass = 1.0\npositions = \"random\"\nradius = " + radius + "\n";
  }
  return parse_scene("[box]\nwidth = 90.0\nheight = 90.0\n" + groups + "[run]\nt_end = 1.0\n", "scene", "");
}

std::vector<DiskId> sorted_ids(const Disks& d) {
  std::vector<DiskId> ids(d.id.begin(), d.id.end());
  std::stable_sort(ids.begin(), ids.end(), [&](DiskId a, DiskId b) { return d.radius_of(a) > d.radius_of(b); });
  return ids;
}

TEST(PlacementOrder, IsThatOfAllDisksSorted) {
  const std::vector<std::vector<std::string>> cases{
      {"0.5"},
      {"0.5", "0.25", "0.5"},
      {"{ uniform = [0.1, 0.9] }", "0.4"},
  };
  for (std::size_t c = 0; c < cases.size(); ++c) {
    SCOPED_TRACE(c);
    const Scene scene = scene_of(cases[c]);
    const Disks disks = initial_state(scene).disks;
    const std::vector<DiskId> expected = sorted_ids(disks);
    for (const int count : {1, 2, 3, 4}) {
      for (const std::size_t most : {std::size_t{1}, std::size_t{37}, std::size_t{1000}}) {
        std::mutex mutex;
        run_on_local_ranks(count, [&](Ranks& ranks) {
          const StartDisks start(scene, ranks);
          PlacementOrder order(start, ranks);
          std::vector<DiskId> ids;
          for (SizeClass next = order.next_class(); next.disks > 0; next = order.next_class()) {
            const std::size_t end = ids.size() + next.disks;
            while (ids.size() < end) {
              const std::vector<DiskToPlace> some = order.next(next, most);
              ASSERT_FALSE(some.empty());
              ASSERT_LE(some.size(), most);
              for (const DiskToPlace& disk : some) {
                EXPECT_EQ(disk.radius, disks.radius_of(disk.id));
                EXPECT_LE(disk.radius, next.largest);
                EXPECT_GE(disk.radius, next.smallest);
                ids.push_back(disk.id);
              }
            }
            EXPECT_EQ(ids.size(), end);
            EXPECT_GT(next.smallest, 0.5 * next.largest);
          }
          const std::lock_guard lock(mutex);
          EXPECT_EQ(ids, expected);
        });
      }
    }
  }
}

}  // namespace
}  // namespace carom
