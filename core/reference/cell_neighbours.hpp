// The cells beside a cell along one side of the box.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace carom {

// The cells c - 1, c, c + 1 along one side, each once. Cells beyond a periodic side are those at its other end; beyond
// any other side there are none.
class CellNeighbours {
 public:
  CellNeighbours(std::size_t c, std::size_t cells, bool periodic) {
    add(c);
    if (c > 0 || periodic) add(c > 0 ? c - 1 : cells - 1);
    if (c + 1 < cells || periodic) add(c + 1 < cells ? c + 1 : 0);
  }

  const std::size_t* begin() const { return cell_.data(); }
  const std::size_t* end() const { return cell_.data() + count_; }

 private:
  void add(std::size_t c) {
    if (std::find(begin(), end(), c) == end()) cell_[count_++] = c;
  }

  std::array<std::size_t, 3> cell_{};
  std::size_t count_ = 0;
};

}  // namespace carom
