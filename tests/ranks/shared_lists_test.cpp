// Lists of the state of all ranks that reach rank 0 in many pieces: ids in several ranges, ranks with a common radius
// or mass, a rank without disks, and contacts at the ends of ranges.
#include "parallel/slabs/shared_lists.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <tuple>
#include <vector>

#include "parallel/ranks/local_ranks.hpp"

namespace carom {
namespace {

constexpr int count = 4;
constexpr DiskId ids = 2 * ids_a_piece + 7001;
static_assert(ids / 2 > (std::size_t{1} << 16) / count, "the disks of a rank make more than one piece");

// Every eighth disk is gone; half of the others are on rank 1, and none is on rank 3.
int owner_of(DiskId id) {
  if (id % 8 == 5) return -1;
  return id % 2 == 0 ? 1 : id % 3 == 0 ? 0 : 2;
}

// Rank 0 has a common radius and a common mass, rank 2 a common radius and a column of masses, rank 1 columns of both.
double radius_of(DiskId id) {
  return owner_of(id) == 2 ? 0.25 : 0.5 + 1e-6 * id;
}
double mass_of(DiskId id) {
  return owner_of(id) == 0 ? 3.0 : 1.0 + 1e-6 * id;
}

std::vector<ContactLoad> loads_of(int rank) {
  constexpr auto edge = static_cast<DiskId>(ids_a_piece);
  if (rank == 0) return {{0, 9, 1.0}, {edge - 1, edge, 2.0}, {edge - 1, edge + 8, 3.0}, {2 * edge - 1, ids - 1, 4.0}};
  if (rank == 1) return {{edge - 1, edge, 2.0}, {edge, edge + 1, 5.0}, {2 * edge, 2 * edge + 1, 6.0}};
  if (rank == 2) return {{2 * edge - 1, ids - 1, 4.0}, {ids - 2, ids - 1, 7.0}};
  return {};
}

// Lists by id are right only for the rank's own disks.
State part_of(int rank) {
  State state;
  state.next_id = ids;
  state.disks.common_radius = 0.25;
  state.disks.common_mass = 3.0;
  for (DiskId id = 0; id < ids; ++id) {
    const bool own = owner_of(id) == rank;
    state.last_contact.push_back(own ? 2.0 * id : -1.0);
    state.thermal_hits.push_back(own ? 3 * id : 0);
    if (!own) continue;
    push_back(state.disks, {1.0 * id, 2.0, 3.0, -1.0 * id, radius_of(id), mass_of(id), id},
              {.radius = rank != 2, .mass = rank != 0});
  }
  state.loads = loads_of(rank);
  return state;
}

template <class Value>
std::vector<Value> entries_of(SharedLists& lists, StateList list) {
  std::vector<Value> all;
  for (std::size_t k = 0; k < lists.pieces(list); ++k) {
    const Bytes piece = lists.piece(list, k);
    const std::size_t before = all.size();
    all.resize(before + piece.size() / sizeof(Value));
    if (!piece.empty()) std::memcpy(&all[before], piece.data(), piece.size());
  }
  return all;
}

std::vector<std::tuple<DiskId, DiskId, double>> tuples_of(const std::vector<ContactLoad>& loads) {
  std::vector<std::tuple<DiskId, DiskId, double>> tuples;
  for (const ContactLoad& load : loads) tuples.emplace_back(load.id1, load.id2, load.force);
  return tuples;
}

// Every disk occurs once, with its entries of all lists at the same place.
void expect_disks(SharedLists& lists, bool first) {
  const auto id = entries_of<DiskId>(lists, StateList::id);
  const auto x = entries_of<double>(lists, StateList::x), vy = entries_of<double>(lists, StateList::vy);
  const auto radius = entries_of<double>(lists, StateList::radius), mass = entries_of<double>(lists, StateList::mass);
  if (!first) return;
  std::vector<int> times(ids, 0);
  ASSERT_EQ(id.size(), lists.entries(StateList::id));
  for (const std::size_t size : {x.size(), vy.size(), radius.size(), mass.size()}) ASSERT_EQ(size, id.size());
  for (std::size_t k = 0; k < id.size(); ++k) {
    ++times.at(id[k]);
    ASSERT_EQ(x[k], 1.0 * id[k]);
    ASSERT_EQ(vy[k], -1.0 * id[k]);
    ASSERT_EQ(radius[k], radius_of(id[k]));
    ASSERT_EQ(mass[k], mass_of(id[k]));
  }
  for (DiskId k = 0; k < ids; ++k) ASSERT_EQ(times[k], owner_of(k) >= 0 ? 1 : 0) << k;
}

// Values by id are those of the rank that has the disk; for ids without a disk they are those of rank 0.
void expect_by_id(SharedLists& lists, bool first) {
  const auto last_contact = entries_of<double>(lists, StateList::last_contact);
  const auto thermal_hits = entries_of<std::uint32_t>(lists, StateList::thermal_hits);
  if (!first) return;
  ASSERT_EQ(last_contact.size(), ids);
  ASSERT_EQ(thermal_hits.size(), ids);
  for (DiskId id = 0; id < ids; ++id) {
    ASSERT_EQ(last_contact[id], owner_of(id) >= 0 ? 2.0 * id : -1.0) << id;
    ASSERT_EQ(thermal_hits[id], owner_of(id) >= 0 ? 3 * id : 0) << id;
  }
}

TEST(SharedLists, HaveAllEntriesOfAllRanks) {
  run_on_local_ranks(count, [](Ranks& ranks) {
    const State own = part_of(ranks.rank());
    SharedLists lists(ranks, own);
    const bool first = ranks.rank() == 0;
    EXPECT_GT(lists.pieces(StateList::x), 1U);
    EXPECT_EQ(lists.pieces(StateList::last_contact), 3U);
    expect_disks(lists, first);
    expect_by_id(lists, first);
    const auto loads = entries_of<ContactLoad>(lists, StateList::loads);
    if (!first) return;
    constexpr auto edge = static_cast<DiskId>(ids_a_piece);
    EXPECT_EQ(tuples_of(loads), tuples_of({{0, 9, 1.0},
                                           {edge - 1, edge, 2.0},
                                           {edge - 1, edge + 8, 3.0},
                                           {edge, edge + 1, 5.0},
                                           {2 * edge - 1, ids - 1, 4.0},
                                           {2 * edge, 2 * edge + 1, 6.0},
                                           {ids - 2, ids - 1, 7.0}}))
        << "loads across a border must occur once";
  });
}

}  // namespace
}  // namespace carom
