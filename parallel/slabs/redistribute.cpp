#include "parallel/slabs/redistribute.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/disks/disk_columns.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/slabs/disk_pieces.hpp"
#include "parallel/slabs/load_memory.hpp"

namespace carom {

namespace {

// The number of rows by which slabs are cut: so large that one row does not matter for any slab.
constexpr std::size_t rows = 4096;
// Disks that all ranks together send to all at a time, and the least number from each.
constexpr std::size_t disks_of_all_a_piece = std::size_t{1} << 16;
constexpr std::size_t least_a_piece = 256;
// Disks that come to rank 0 from each rank at a time.
constexpr std::size_t disks_a_piece = std::size_t{1} << 14;

struct Migrant {
  MovingDisk moving;
  int to;
};

// The disks that are in another rank's slab; those for ranks that are not neighbours go down. far: is there any such
// disk?
ForNeighbours leaving(const Ranks& ranks, const SlabCut& cut, const Disks& d, bool& far) {
  ForNeighbours list;
  for (std::uint32_t i = 0; i < d.size(); ++i) {
    if (cut.is_between_bounds(ranks.rank(), d.y[i])) continue;
    const int to = cut.rank_at(d.y[i]);
    if (to == ranks.rank()) continue;
    (to == ranks.above() ? list.above : list.below).push_back(i);
    far = far || (to != ranks.above() && to != ranks.below());
  }
  return list;
}

// most: the largest number on any rank.
void send_through_all(Ranks& ranks, const SlabCut& cut, const std::vector<std::uint32_t>& list, std::size_t most,
                      DiskColumns columns, State& state) {
  const std::size_t piece = std::max(least_a_piece, disks_of_all_a_piece / static_cast<std::size_t>(ranks.count()));
  DiskHoles holes;
  for (std::size_t begin = 0; begin < most; begin += piece) {
    std::vector<Migrant> some;
    const std::size_t end = std::min(list.size(), begin + piece);
    for (std::size_t k = begin; k < end; ++k) {
      some.push_back({moving_disk(state, list[k]), cut.rank_at(state.disks.y[list[k]])});
    }
    Bytes message;
    put_all(message, some);
    const std::vector<Bytes> of_all = ranks.gather(message);
    if (begin < end) holes.add(std::span(list).subspan(begin, end - begin));
    for (const Bytes& of_one : of_all) {
      for (const Migrant& m : MessageReader(of_one).get_all<Migrant>()) {
        if (m.to == ranks.rank()) holes.take_in(m.moving, columns, state);
      }
    }
  }
  holes.close(state.disks);
}

void send_to_neighbours(Ranks& ranks, const ForNeighbours& list, std::size_t most, DiskColumns columns, State& state) {
  const std::size_t staying = state.disks.size() - list.below.size() - list.above.size();
  DiskHoles holes;
  exchange_disks(
      ranks, state, list, most,
      [&](std::size_t below, std::size_t above) { reserve_amply(state.disks, staying + below + above, columns); },
      [&](std::span<const std::uint32_t> sent) { holes.add(sent); },
      [&](const MovingDisk& disk, bool) { holes.take_in(disk, columns, state); });
  holes.close(state.disks);
}

}  // namespace

SlabCut cut_by_rows_of_all(Ranks& ranks, const Domain& box, const Disks& own) {
  std::vector<std::int64_t> disks_of_row(rows, 0);
  for (const double y : own.y) {
    const double row = std::clamp(y / box.height * static_cast<double>(rows), 0.0, static_cast<double>(rows - 1));
    ++disks_of_row[static_cast<std::size_t>(row)];
  }
  ranks.sum(disks_of_row);
  return cut_by_rows(box, disks_of_row, ranks.count());
}

void redistribute(Ranks& ranks, const SlabCut& cut, DiskColumns columns, State& state) {
  bool far = false;
  ForNeighbours list = leaving(ranks, cut, state.disks, far);
  std::array<double, 2> all{far ? 1.0 : 0.0, static_cast<double>(list.below.size() + list.above.size())};
  ranks.maximum(all);
  const auto most = static_cast<std::size_t>(all[1]);
  if (all[0] == 0.0) return send_to_neighbours(ranks, list, most, columns, state);
  list.below.insert(list.below.end(), list.above.begin(), list.above.end());
  send_through_all(ranks, cut, list.below, most, columns, state);
}

// A radius or a mass that differs from the others' becomes a column on every rank, whichever has the newcomer.
void take_newcomers(const SlabCut& cut, int rank, const Disks& newcomers, bool are_first, DiskColumns& columns,
                    Disks& own) {
  if (are_first && !newcomers.empty() && !columns.radius && !columns.mass) {
    own.common_radius = newcomers.radius_of(0);
    own.common_mass = newcomers.mass_of(0);
  }
  for (std::size_t k = 0; k < newcomers.size(); ++k) {
    const Disk disk = disk_at(newcomers, k);
    make_columns_for(disk, columns, own);
    if (cut.rank_at(disk.y) == rank) push_back(own, disk, columns);
  }
}

void collect_on_first(Ranks& ranks, DiskColumns columns, State& state) {
  Disks& d = state.disks;
  auto most = static_cast<double>(d.size());
  ranks.maximum({&most, 1});
  const std::size_t own = d.size();
  for (std::size_t begin = 0; begin < static_cast<std::size_t>(most); begin += disks_a_piece) {
    std::vector<MovingDisk> piece;
    if (ranks.rank() > 0) {
      for (std::size_t i = begin; i < std::min(own, begin + disks_a_piece); ++i) piece.push_back(moving_disk(state, i));
    }
    Bytes message;
    put_all(message, piece);
    for (const Bytes& given : ranks.collect(message)) {
      for (const MovingDisk& moving : MessageReader(given).get_all<MovingDisk>()) take_in(state, moving, columns);
    }
  }
  if (ranks.rank() > 0) truncate(d, 0);
  state.loads = collect_loads(ranks, state.loads);
}

}  // namespace carom
