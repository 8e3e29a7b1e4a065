// Finds the points near a point among a few thousand, in cells that fit into a core's cache.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/disks/cell_index.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// A hash table of cells that are at least as long as the reach: the neighbours of a point within reach lie in nine
// cells.
class BatchCells {
 public:
  // Prepares the cells for up to `most` members, with numbers below `most`.
  void fit(const Domain& box, double reach, std::size_t most) {
    const double columns = std::max(1.0, std::floor(box.width / reach));
    const double rows = std::max(1.0, std::floor(box.height / reach));
    per_x_ = columns / box.width;
    per_y_ = rows / box.height;
    columns_ = static_cast<std::int64_t>(columns);
    rows_ = static_cast<std::int64_t>(rows);
    std::size_t slots = 64;
    while (slots < 2 * most) slots *= 2;
    head_.assign(slots, none);
    next_.assign(most, none);
  }

  void clear() { std::fill(head_.begin(), head_.end(), none); }

  void insert(std::uint32_t k, Vec2 point) {
    std::uint32_t& head = head_[slot(column_of(point.x), row_of(point.y))];
    next_[k] = head;
    head = k;
  }

  void move(std::uint32_t k, Vec2 from, Vec2 to) {
    std::uint32_t* link = &head_[slot(column_of(from.x), row_of(from.y))];
    while (*link != k) link = &next_[*link];
    *link = next_[k];
    insert(k, to);
  }

  // Is use(k) true for any member k that may be within reach of the point? May call use for a member more than once, in
  // any order.
  template <class Use>
  bool any_near(Vec2 point, Use use) const {
    for (std::int64_t r = -1; r <= 1; ++r) {
      for (std::int64_t c = -1; c <= 1; ++c) {
        const std::size_t at = slot(turned(column_of(point.x) + c, columns_), turned(row_of(point.y) + r, rows_));
        for (std::uint32_t k = head_[at]; k != none; k = next_[k]) {
          if (use(k)) return true;
        }
      }
    }
    return false;
  }

  template <class Use>
  void for_near(Vec2 point, Use use) const {
    any_near(point, [&](std::uint32_t k) {
      use(k);
      return false;
    });
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;  // ends a list

  std::int64_t column_of(double x) const { return cell_index(x * per_x_, columns_); }
  std::int64_t row_of(double y) const { return cell_index(y * per_y_, rows_); }
  // The cell, wrapped across the period. Between walls that is not a neighbour; testing its members does no harm.
  static std::int64_t turned(std::int64_t cell, std::int64_t cells) {
    return cell < 0 ? cells - 1 : cell >= cells ? 0 : cell;
  }
  // Neighbours in a row are next to each other; a prime factor spreads the rows.
  std::size_t slot(std::int64_t column, std::int64_t row) const {
    const auto hash = static_cast<std::uint64_t>(row) * 0x9e3779b1ULL + static_cast<std::uint64_t>(column);
    return static_cast<std::size_t>(hash) & (head_.size() - 1);
  }

  std::int64_t columns_ = 1, rows_ = 1;
  double per_x_ = 0.0, per_y_ = 0.0;
  std::vector<std::uint32_t> head_, next_;
};

}  // namespace carom
