// Contacts resolved in order over several ranks: each value is that of the serial order, forwards and backwards.
#include "parallel/slabs/border_rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "parallel/ranks/local_ranks.hpp"
#include "parallel/stepping/disk_values.hpp"

namespace carom {
namespace {

// Disks on a square lattice, each in contact with its four nearest and two diagonal neighbours; each slab has some of
// the rows.
struct Lattice {
  int columns, rows;
  bool periodic;  // the last row touches the first
  std::vector<DiskId> id;

  int place(int column, int row) const { return row * columns + column; }
  int row_of(int at) const { return at / columns; }
  int rank_of(int at, int ranks) const { return row_of(at) * ranks / rows; }

  // In order of ids, with the smaller id first.
  std::vector<std::pair<int, int>> contacts() const {
    std::vector<std::pair<int, int>> pairs;
    const auto add = [&](int a, int column, int row) {
      if (column >= columns || (row >= rows && !periodic)) return;
      const int b = place(column, row % rows);
      pairs.emplace_back(std::minmax(a, b, [&](int p, int q) { return id_of(p) < id_of(q); }));
    };
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        add(place(column, row), column + 1, row);
        add(place(column, row), column, row + 1);
        add(place(column, row), column + 1, row + 1);
      }
    }
    std::sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
      return std::pair(id_of(a.first), id_of(a.second)) < std::pair(id_of(b.first), id_of(b.second));
    });
    return pairs;
  }

 private:
  DiskId id_of(int at) const { return id[static_cast<std::size_t>(at)]; }
};

Lattice with_random_ids(int columns, int rows, bool periodic, unsigned seed) {
  Lattice lattice{columns, rows, periodic, std::vector<DiskId>(static_cast<std::size_t>(columns * rows))};
  std::iota(lattice.id.begin(), lattice.id.end(), 0U);
  std::mt19937 random(seed);
  std::shuffle(lattice.id.begin(), lattice.id.end(), random);
  return lattice;
}

// A contact changes its disks in a way whose result depends on the order.
void meet(Vec2& a, Vec2& b) {
  const Vec2 before = a;
  a = {0.3 * a.x + 0.6 * b.y, 0.9 * b.x - 0.1 * a.y};
  b = {0.7 * b.x - 0.2 * before.x, 0.5 * before.y + 0.4 * b.y};
}

Vec2 first_value(DiskId id) {
  return {1.0 + 0.001 * id, 2.0 - 0.003 * id};
}

constexpr bool directions[] = {false, true, false, false, true, true, false};

std::vector<Vec2> serially(const Lattice& lattice) {
  std::vector<Vec2> v(lattice.id.size());
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = first_value(lattice.id[k]);
  std::vector<std::pair<int, int>> contacts = lattice.contacts();
  for (const bool backwards : directions) {
    if (backwards) std::reverse(contacts.begin(), contacts.end());
    for (const auto& [a, b] : contacts) meet(v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)]);
    if (backwards) std::reverse(contacts.begin(), contacts.end());
  }
  return v;
}

// The disks and contacts of a rank.
struct Part {
  Disks disks;
  GhostDisks ghosts;
  std::map<int, std::uint32_t> at;  // storage indices by place
  std::vector<Pair> contacts, crossing;

  Part(const Lattice& lattice, const Ranks& ranks) {
    const auto disk = [&](int place) {
      return Disk{
          static_cast<double>(place % lattice.columns), static_cast<double>(lattice.row_of(place)), 0.0, 0.0, 0.5, 1.0,
          lattice.id[static_cast<std::size_t>(place)]};
    };
    const auto is_own = [&](int place) { return lattice.rank_of(place, ranks.count()) == ranks.rank(); };
    for (int place = 0; place < lattice.columns * lattice.rows; ++place) {
      if (!is_own(place)) continue;
      at[place] = static_cast<std::uint32_t>(disks.size());
      push_back(disks, disk(place), {});
    }
    ghosts.begin(disks.size());
    for (const auto& [a, b] : lattice.contacts()) {
      if (!is_own(a) && !is_own(b)) continue;
      const int other = is_own(a) ? b : a;
      if (!is_own(other) && at.find(other) == at.end()) {
        const bool is_below = lattice.rank_of(other, ranks.count()) == ranks.below();
        at[other] = static_cast<std::uint32_t>(disks.size());
        ghosts.add({disk(other)}, is_below ? lower_border : upper_border, {}, disks);
      }
      contacts.push_back({at[a], at[b]});
      if (!is_own(other)) crossing.push_back({at[is_own(a) ? a : b], at[other]});
    }
  }
};

// Returns the number of rounds across borders.
std::uint32_t expect_serial_values(const Lattice& lattice, int count, int threads) {
  const std::vector<Vec2> expected = serially(lattice);
  std::uint32_t rounds_of_all = 0;
  run_on_local_ranks(count, [&](Ranks& ranks) {
    Part part(lattice, ranks);
    const Executor executor(threads, 256);
    BorderRounds rounds(ranks);
    Patches patches;
    rounds.begin(part.crossing, part.disks, part.ghosts);
    rounds.build(patches, part.disks, std::vector<std::uint16_t>(part.disks.size(), 1), part.contacts.size(), executor,
                 [&](std::size_t k) { return part.contacts[k]; });
    std::vector<Vec2> v;
    for (std::size_t i = 0; i < part.disks.size(); ++i) {
      v.push_back(part.ghosts.is_ghost(static_cast<std::uint32_t>(i)) ? Vec2{} : first_value(part.disks.id[i]));
    }
    std::vector<std::int64_t> counted(patches.count(), 0);
    for (const bool backwards : directions) {
      const auto run_patch = [&](std::size_t q) {
        const std::uint32_t size = patches.start[q + 1] - patches.start[q];
        for (std::uint32_t k = 0; k < size; ++k) {
          const Pair p = part.contacts[patches.order[patches.start[q] + (backwards ? size - 1 - k : k)]];
          meet(v[p.i1], v[p.i2]);
        }
        counted[q] += rounds.counts(q) ? size : 0;
      };
      run_patches(patches, backwards, executor, run_patch,
                  [&](std::uint32_t phase, bool back) { rounds.before(phase, back, Velocities{v.data()}); });
    }
    rounds.refresh(Velocities{v.data()});
    for (const auto& [place, i] : part.at) EXPECT_EQ(v[i], expected[static_cast<std::size_t>(place)]) << place;
    auto all = std::accumulate(counted.begin(), counted.end(), std::int64_t{0});
    ranks.sum({&all, 1});
    EXPECT_EQ(static_cast<std::size_t>(all), std::size(directions) * lattice.contacts().size());
    if (ranks.rank() == 0) rounds_of_all = rounds.rounds();
  });
  return rounds_of_all;
}

TEST(BorderRounds, MakeOfEachDiskWhatTheSerialOrderDoes) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    for (const int ranks : {2, 3, 4, 5}) {
      for (const bool periodic : {false, true}) {
        // With slabs of a single row each disk has contacts across two borders.
        const int rows = seed % 3 == 0 ? ranks : 4 * ranks;
        const Lattice lattice = with_random_ids(24, rows, periodic, seed);
        const std::uint32_t rounds = expect_serial_values(lattice, ranks, 1 + static_cast<int>(seed % 2));
        EXPECT_GE(rounds, 1U);
        EXPECT_LE(rounds, 24U);
      }
    }
  }
}

// If ids ascend row by row each border waits for the one below; if they ascend column by column the contacts of a
// border wait for each other.
TEST(BorderRounds, AreAsManyAsContactsWait) {
  Lattice lattice{20, 12, false, {}};
  lattice.id.resize(240);
  std::iota(lattice.id.begin(), lattice.id.end(), 0U);
  EXPECT_EQ(expect_serial_values(lattice, 2, 2), 1U);
  EXPECT_EQ(expect_serial_values(lattice, 4, 1), 3U);
  for (std::size_t k = 0; k < 240; ++k) lattice.id[k] = static_cast<DiskId>(k % 20 * 12 + k / 20);
  EXPECT_EQ(expect_serial_values(lattice, 2, 2), 39U);
}

TEST(BorderRounds, AreNoneWhereNothingIsAcrossBorders) {
  Lattice lattice = with_random_ids(10, 1, false, 1);
  EXPECT_EQ(expect_serial_values(lattice, 3, 1), 0U);
}

}  // namespace
}  // namespace carom
