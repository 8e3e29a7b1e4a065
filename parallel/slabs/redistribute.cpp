#include "parallel/slabs/redistribute.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "parallel/ranks/message.hpp"
#include "parallel/slabs/load_memory.hpp"

namespace carom {

namespace {

// Rows by which slabs are cut: no slab has so many that one row matters.
constexpr std::size_t rows = 4096;
// Disks that a rank sends to all at a time.
constexpr std::size_t disks_a_piece = std::size_t{1} << 14;

struct Migrant {
  MovingDisk moving;
  int to;
};

// A piece of each rank's list, on all of them.
std::vector<Bytes> gather_piece(Ranks& ranks, const std::vector<Migrant>& all, std::size_t begin) {
  const auto from = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), begin));
  const auto to = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), begin + disks_a_piece));
  Bytes piece;
  put_all(piece, std::vector<Migrant>(from, to));
  return ranks.gather(piece);
}

void take_own(Ranks& ranks, const Bytes& message, DiskColumns columns, State& state) {
  for (const Migrant& m : MessageReader(message).get_all<Migrant>()) {
    if (m.to == ranks.rank()) take_in(state, m.moving, columns);
  }
}

void send_through_all(Ranks& ranks, const std::vector<Migrant>& leaving, DiskColumns columns, State& state) {
  auto most = static_cast<double>(leaving.size());
  ranks.maximum({&most, 1});
  for (std::size_t begin = 0; begin < static_cast<std::size_t>(most); begin += disks_a_piece) {
    for (const Bytes& piece : gather_piece(ranks, leaving, begin)) take_own(ranks, piece, columns, state);
  }
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
  Disks& d = state.disks;
  std::vector<Migrant> leaving;
  std::vector<unsigned char> gone(d.size(), 0);
  bool far = false;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const int to = cut.rank_at(d.y[i]);
    if (to == ranks.rank()) continue;
    leaving.push_back({moving_disk(state, i), to});
    far = far || (to != ranks.above() && to != ranks.below());
    gone[i] = 1;
  }
  if (!leaving.empty()) remove_marked(d, gone);
  if (ranks.any(far)) return send_through_all(ranks, leaving, columns, state);
  std::vector<Migrant> down;
  std::vector<Migrant> up;
  for (const Migrant& m : leaving) (m.to == ranks.above() ? up : down).push_back(m);
  Bytes to_below;
  Bytes to_above;
  put_all(to_below, down);
  put_all(to_above, up);
  const auto [below, above] = ranks.exchange(to_below, to_above);
  take_own(ranks, below, columns, state);
  take_own(ranks, above, columns, state);
}

// A radius or a mass that the others do not share becomes a column on every rank, whichever has the newcomer.
void take_newcomers(const SlabCut& cut, int rank, const Disks& newcomers, bool are_first, DiskColumns& columns,
                    Disks& own) {
  if (are_first && !newcomers.empty() && !columns.radius && !columns.mass) {
    own.common_radius = newcomers.radius_of(0);
    own.common_mass = newcomers.mass_of(0);
  }
  for (std::size_t k = 0; k < newcomers.size(); ++k) {
    const Disk disk = disk_at(newcomers, k);
    if (!columns.radius && disk.radius != own.common_radius) own.radius.assign(own.size(), own.common_radius);
    if (!columns.mass && disk.mass != own.common_mass) own.mass.assign(own.size(), own.common_mass);
    columns.radius = columns.radius || disk.radius != own.common_radius;
    columns.mass = columns.mass || disk.mass != own.common_mass;
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
