// Finding who is near a point among a few thousand, in cells that fit into a core's cache.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/disks/domain.hpp"

namespace carom {

// Cells of at least the reach, in a table of hashed cells: a point's neighbours within reach lie in nine of them.
class BatchCells {
 public:
  // For up to `most` members with numbers below it.
  void fit(const Domain& box, double reach, std::size_t most) {
    columns_ = std::max(1.0, std::floor(box.width / reach));
    rows_ = std::max(1.0, std::floor(box.height / reach));
    per_x_ = columns_ / box.width;
    per_y_ = rows_ / box.height;
    std::size_t slots = 64;
    while (slots < 2 * most) slots *= 2;
    head_.assign(slots, nobody);
    next_.assign(most, nobody);
  }

  void clear() { std::fill(head_.begin(), head_.end(), nobody); }

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

  // Is use(k) true for one who may be within reach of the point? Some are asked about more than once, in any order.
  template <class Use>
  bool any_near(Vec2 point, Use use) const {
    for (double r = -1.0; r <= 1.0; r += 1.0) {
      for (double c = -1.0; c <= 1.0; c += 1.0) {
        const std::size_t at = slot(turned(column_of(point.x) + c, columns_), turned(row_of(point.y) + r, rows_));
        for (std::uint32_t k = head_[at]; k != nobody; k = next_[k]) {
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
  static constexpr std::uint32_t nobody = 0xffffffffU;

  double column_of(double x) const { return std::min(std::floor(x * per_x_), columns_ - 1.0); }
  double row_of(double y) const { return std::min(std::floor(y * per_y_), rows_ - 1.0); }
  // Around the box; where sides are walls, that asks about some in vain.
  static double turned(double cell, double cells) { return cell < 0.0 ? cells - 1.0 : cell >= cells ? 0.0 : cell; }
  // Neighbours in a row keep together; a prime spreads the rows.
  std::size_t slot(double column, double row) const {
    const auto hash = static_cast<std::uint64_t>(row) * 0x9e3779b1ULL + static_cast<std::uint64_t>(column);
    return static_cast<std::size_t>(hash) & (head_.size() - 1);
  }

  double columns_ = 1.0, rows_ = 1.0;
  double per_x_ = 0.0, per_y_ = 0.0;
  std::vector<std::uint32_t> head_, next_;
};

}  // namespace carom
