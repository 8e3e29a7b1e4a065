#include "parallel/stepping/find_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/cells/nearby_runs.hpp"
#include "parallel/stepping/search_across.inl"
#include "parallel/stepping/search_kernel.hpp"

namespace carom {

namespace {

// Disks in a block of the search: small enough for several threads to share, large enough for the overhead of a buffer.
constexpr std::size_t search_block = 8192;
// Disks in a block of the search between size classes: a large disk may have thousands of small ones around it.
constexpr std::size_t cross_block = 64;
// Strays in a block.
constexpr std::size_t stray_block = 256;

template <bool sheared>
void test_run(const SearchInput& in, std::size_t i, std::uint32_t first, std::uint32_t last, std::vector<Pair>& pairs) {
  for (std::uint32_t j = first; j < last; ++j) {
    if (touch<sheared>(in, i, j)) [[unlikely]]
      pairs.push_back({static_cast<std::uint32_t>(i), j});
  }
}

// The distance by which disk i has left its cell, the larger of both axes; length, negative inside.
double excursion(const SearchInput& in, const GridLevel& level, std::size_t i) {
  const std::uint32_t row = (in.key[i] - level.first_key) / level.stride;
  const std::uint32_t column = (in.key[i] - level.first_key) % level.stride;
  const Vec2 off = nearest_image({std::clamp(in.x[i], 0.0, in.box.width) - (column + 0.5) * level.cell_width,
                                  std::clamp(in.y[i], 0.0, in.box.height) - (row + 0.5) * level.cell_height},
                                 in.box);
  return std::max(std::abs(off.x) - 0.5 * level.cell_width, std::abs(off.y) - 0.5 * level.cell_height);
}

// Tests a disk of the uppermost row of a sheared box against the images of the lowest row, which are displaced.
void search_above_top(const SearchInput& in, const GridLevel& level, std::size_t i, std::vector<Pair>& pairs) {
  const double reach = 2.0 * level.largest_radius + 2.0 * level.margin;
  double x = in.x[i] - in.box.shear.offset;
  while (x < 0.0) x += in.box.width;
  while (x >= in.box.width) x -= in.box.width;
  const Span span = span_around(x, reach, in.box.width, level.columns_per_length, level.columns, true);
  const std::uint32_t straight = std::min(span.count, level.columns - span.first);
  const std::uint32_t key = level.first_key;
  test_run<true>(in, i, in.start[key + span.first], in.start[key + span.first + straight], pairs);
  if (straight < span.count) test_run<true>(in, i, in.start[key], in.start[key + span.count - straight], pairs);
}

// Searches disks near periodic sides, with nearest images, against the cells to the right and in the row above, which
// may be at the other end of the box. Adjacent cells are taken as one run (a row ends with an empty cell), since the
// end of each run costs a branch that is hard to predict.
template <bool sheared>
void search_border(const SearchInput& in, const GridLevel& level, std::uint32_t row, std::size_t begin, std::size_t end,
                   std::vector<Pair>& pairs) {
  const bool across = in.box.periodic_x() && level.columns > 1;
  const std::uint32_t last = level.columns - 1;
  const auto test_cells = [&](std::size_t i, std::uint32_t from, std::uint32_t to) {
    test_run<sheared>(in, i, in.start[from], in.start[to + 1], pairs);
  };
  const std::uint32_t row_key = level.first_key + row * level.stride;
  const std::uint32_t above = row + 1 < level.rows ? row + 1 : 0;
  const bool has_above = level.rows > 1 && (above > 0 || in.box.periodic_y()) && level.has_row(above);
  const std::uint32_t above_key = level.first_key + above * level.stride;
  const bool displaced_above = sheared && row + 1 == level.rows;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t column = in.key[i] - row_key;
    const std::uint32_t next = displaced_above && level.rows == 1 ? row_key + level.columns : in.key[i] + 2;
    test_run<sheared>(in, i, static_cast<std::uint32_t>(i + 1), in.start[next], pairs);
    if (displaced_above && level.rows == 1) continue;  // all disks have been tested
    if (across && column == last) test_cells(i, row_key, row_key);
    if (!has_above) continue;
    if (displaced_above) {
      search_above_top(in, level, i, pairs);
      continue;
    }
    test_cells(i, above_key + column - (column > 0 ? 1 : 0), above_key + column + 1);
    if (across && column == 0) test_cells(i, above_key + last, above_key + last);
    if (across && column == last) test_cells(i, above_key, above_key);
  }
}

// The part of a block that lies in one row. The outermost rows and columns at periodic sides are searched with nearest
// images, all others by the interior kernel without: a disk there is within the margin of its cell, and a cell is a
// contact distance and two margins wide, so that it is further than a contact distance from every periodic border.
template <bool sheared>
void search_row(const SearchInput& in, const GridLevel& level, InteriorKernel interior, std::uint32_t row,
                std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
  const bool border_row = in.box.periodic_y() && (row == 0 || row + 1 == level.rows);
  std::size_t low = begin;
  std::size_t high = end;
  if (border_row || (in.box.periodic_x() && level.columns < 5)) {
    low = high = end;
  } else if (in.box.periodic_x()) {
    const std::uint32_t row_key = level.first_key + row * level.stride;
    low = std::clamp<std::size_t>(in.start[row_key + 1], begin, end);
    high = std::clamp<std::size_t>(in.start[row_key + level.columns - 1], low, end);
  }
  search_border<sheared>(in, level, row, begin, low, pairs);
  interior(in, level, low, high, pairs);
  search_border<sheared>(in, level, row, high, end, pairs);
}

template <bool sheared>
void search_level(const SearchInput& in, const GridLevel& level, InteriorKernel interior, std::size_t begin,
                  std::size_t end, std::vector<Pair>& pairs) {
  while (begin < end) {
    const std::uint32_t row = (in.key[begin] - level.first_key) / level.stride;
    const std::size_t row_end = std::min<std::size_t>(end, in.start[level.first_key + (row + 1) * level.stride]);
    search_row<sheared>(in, level, interior, row, begin, row_end, pairs);
    begin = row_end;
  }
}

// Adds `blocks` empty buffers; returns the index of the first.
std::size_t more_buffers(FoundContacts& found, std::size_t blocks) {
  const std::size_t first = found.used;
  found.used += blocks;
  while (found.buffers.size() < found.used) {
    // Enough for the contacts of a dense fluid, so that later steps with more contacts need not allocate.
    found.buffers.emplace_back();
    found.buffers.back().reserve(search_block / 16);
  }
  for (std::size_t b = first; b < found.used; ++b) found.buffers[b].clear();
  return first;
}

// Pairs between two size classes, found by the disks of the one that has fewer.
template <bool sheared>
void search_between(const SearchInput& in, const GridLevel& large, const GridLevel& small, const Executor& executor,
                    FoundContacts& found) {
  const auto disks_of = [&](const GridLevel& level) {
    return in.start[level.start_key() + level.keys()] - in.start[level.start_key()];
  };
  const bool by_large = disks_of(large) <= disks_of(small);
  const GridLevel& from = by_large ? large : small;
  const GridLevel& to = by_large ? small : large;
  const AcrossSearch<sheared> search(in, to, by_large);
  const std::size_t begin = in.start[from.start_key()];
  const std::size_t first = more_buffers(found, executor.blocks(disks_of(from), cross_block));
  executor.for_ranges(disks_of(from), cross_block, [&](std::size_t b, std::size_t low, std::size_t high) {
    std::vector<Pair>& pairs = found.buffers[first + b];
    for (std::size_t i = begin + low; i < begin + high; ++i) search(i, pairs);
  });
}

const GridLevel& level_of(const SearchInput& in, const CellGrid& grid, std::size_t i) {
  std::size_t k = 0;
  while (k + 1 < grid.levels.size() && in.key[i] >= grid.levels[k + 1].start_key()) ++k;
  return grid.levels[k];
}

constexpr unsigned char is_loose = 2;

// Pairs of one stray or loose disk with all disks in cells. Each pair is found once: of two strays by the one stored
// first, of a stray and a loose disk by the loose one.
template <bool sheared>
void search_stray(const SearchInput& in, const CellGrid& grid, double furthest, std::size_t i,
                  const std::vector<unsigned char>& strayed, std::vector<Pair>& pairs) {
  const double r = in.radius == nullptr ? in.common_radius : in.radius[i];
  for (const GridLevel& level : grid.levels) {
    const double reach = r + level.largest_radius + std::max(level.margin, furthest);
    for_each_run_near(level, in.start, in.box, in.x[i], in.y[i], reach, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t j = first; j < last; ++j) {
        if (j == i || strayed[j] == is_loose || (strayed[j] == strayed[i] && j < i) || !touch<sheared>(in, i, j))
          continue;
        const auto a = static_cast<std::uint32_t>(i);
        pairs.push_back(a < j ? Pair{a, j} : Pair{j, a});
      }
    });
  }
}

// Loose disks with each other.
template <bool sheared>
void search_loose(const SearchInput& in, const std::vector<std::uint32_t>& loose, std::vector<Pair>& pairs) {
  for (std::size_t k = 1; k < loose.size(); ++k) {
    for (std::size_t m = 0; m < k; ++m) {
      if (touch<sheared>(in, loose[m], loose[k])) pairs.push_back({loose[m], loose[k]});
    }
  }
}

// The pairs of strays found by the search by rows may be incomplete: they are removed, and each stray is searched for
// by itself.
template <bool sheared>
void search_strays(const SearchInput& in, const CellList& cells, const Executor& executor, FoundContacts& found) {
  const CoarsePositions& coarse = cells.coarse;
  found.strays.clear();
  for (std::size_t b = 0; b < coarse.blocks; ++b) {
    found.strays.insert(found.strays.end(), coarse.strays[b].begin(), coarse.strays[b].end());
  }
  found.furthest = 0.0;
  if (found.strays.empty() && coarse.loose.empty()) return;
  found.strayed.resize(in.n, 0);
  for (const std::uint32_t i : coarse.loose) found.strayed[i] = is_loose;
  std::erase_if(found.strays, [&](std::uint32_t i) { return found.strayed[i] != 0; });
  double& furthest = found.furthest;
  for (const std::uint32_t i : found.strays) {
    found.strayed[i] = 1;
    furthest = std::max(furthest, excursion(in, level_of(in, cells.grid, i), i));
  }
  found.strays.insert(found.strays.end(), coarse.loose.begin(), coarse.loose.end());
  executor.run_alike(found.used, [&](std::size_t b) {
    std::erase_if(found.buffers[b], [&](const Pair& p) { return (found.strayed[p.i1] | found.strayed[p.i2]) != 0; });
  });
  const std::size_t first = more_buffers(found, executor.blocks(found.strays.size(), stray_block));
  executor.for_ranges(found.strays.size(), stray_block, [&](std::size_t b, std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      search_stray<sheared>(in, cells.grid, furthest, found.strays[k], found.strayed, found.buffers[first + b]);
    }
  });
  if (!coarse.loose.empty()) search_loose<sheared>(in, coarse.loose, found.buffers[more_buffers(found, 1)]);
  for (const std::uint32_t i : found.strays) found.strayed[i] = 0;
}

template <bool sheared>
void find_pairs(const SearchInput& in, const CellList& cells, const Executor& executor, FoundContacts& found) {
  const InteriorKernel interior = choose_interior_kernel();
  const std::vector<GridLevel>& levels = cells.grid.levels;
  found.used = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const GridLevel& level = levels[k];
    const std::size_t begin = in.start[level.start_key()];
    const std::size_t n = in.start[level.start_key() + level.keys()] - begin;
    const std::size_t first = more_buffers(found, executor.blocks(n, search_block));
    executor.for_ranges(n, search_block, [&](std::size_t b, std::size_t from, std::size_t to) {
      search_level<sheared>(in, level, interior, begin + from, begin + to, found.buffers[first + b]);
    });
    for (std::size_t s = k + 1; s < levels.size(); ++s) search_between<sheared>(in, level, levels[s], executor, found);
  }
  search_strays<sheared>(in, cells, executor, found);
}

SearchInput input_of(const Disks& d, const Domain& box, const CellList& cells) {
  const CoarsePositions& coarse = cells.coarse;
  return {d.x.data(),
          d.y.data(),
          d.radius.empty() ? nullptr : d.radius.data(),
          d.common_radius,
          coarse.position.data(),
          coarse.radius.empty() ? nullptr : coarse.radius.data(),
          coarse.long_runs,
          cells.sorted.key.data(),
          cells.sorted.start.data(),
          d.size(),
          box,
          box.periodic_x() ? box.width : HUGE_VAL,
          box.periodic_y() ? box.height : HUGE_VAL};
}

}  // namespace

double furthest_excursion(const Disks& d, const Domain& box, const CellList& cells) {
  const SearchInput in = input_of(d, box, cells);
  const std::vector<std::uint32_t>& all_loose = cells.coarse.loose;
  double furthest = 0.0;
  auto loose = all_loose.begin();
  for (const GridLevel& level : cells.grid.levels) {
    const LevelRange range = range_of(level, cells.sorted);
    for (std::size_t i = range.first; i < range.last; ++i) {
      while (loose != all_loose.end() && *loose < i) ++loose;
      if (loose != all_loose.end() && *loose == i) continue;
      furthest = std::max(furthest, excursion(in, level, i));
    }
  }
  return furthest;
}

std::size_t find_contacts(const Disks& d, const Domain& box, const CellList& cells, const Executor& executor,
                          FoundContacts& found) {
  const SearchInput in = input_of(d, box, cells);
  if (box.shear.acts()) {
    find_pairs<true>(in, cells, executor, found);
  } else {
    find_pairs<false>(in, cells, executor, found);
  }
  return found.strays.size();
}

}  // namespace carom
