#include "core/measure/bond_order.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "core/disks/cell_index.hpp"

namespace carom {

namespace {

constexpr std::size_t neighbours = 6;
constexpr double disks_per_cell = 3.0;

struct Neighbour {
  double distance2;
  DiskId id;
  Vec2 apart;
  bool operator<(const Neighbour& other) const { return std::tie(distance2, id) < std::tie(other.distance2, other.id); }
};

// Centres in cells of about three disks each. all: how many disks the box has, of which these may be those in a part;
// rows of cells without any of them take no memory.
class Centres {
 public:
  Centres(const Disks& d, const Domain& box, double all) : d_(d), box_(box) {
    const double edge = std::sqrt(disks_per_cell * box.width * box.height / all);
    columns_ = static_cast<std::ptrdiff_t>(std::max(1.0, std::floor(box.width / edge)));
    rows_ = static_cast<std::ptrdiff_t>(std::max(1.0, std::floor(box.height / edge)));
    cells_.resize(static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < d.size(); ++i) {
      std::vector<std::vector<std::size_t>>& row = cells_[static_cast<std::size_t>(row_of(d.y[i]))];
      row.resize(static_cast<std::size_t>(columns_));
      row[static_cast<std::size_t>(column_of(d.x[i]))].push_back(i);
    }
  }

  // The six nearest of disk i, and whatever else was looked at, nearest first: rings of cells until no disk further out
  // can be nearer than the sixth. As long as six are not even found, twice as many each time.
  void find(std::size_t i, std::vector<Neighbour>& found) const {
    for (std::ptrdiff_t reach = 1;; reach = found.size() < neighbours ? 2 * reach : reach + 1) {
      collect(i, reach, found);
      std::sort(found.begin(), found.end());
      const bool all = reach >= std::max(columns_, rows_);
      const double known = known_within(reach);
      if (all || (found.size() >= neighbours && found[neighbours - 1].distance2 <= known * known)) return;
    }
  }

 private:
  static bool has_all(std::ptrdiff_t reach, std::ptrdiff_t cells, bool periodic) {
    return (periodic ? 2 * reach + 1 : reach + 1) >= cells;
  }

  // How far away all disks are found in so many rings. An axis all of whose cells are in them is no bound: a box may be
  // thousands of columns long and one row high.
  double known_within(std::ptrdiff_t reach) const {
    const bool all_rows = has_all(reach, rows_, box_.periodic_y());
    if (box_.shear.acts() && all_rows) return HUGE_VAL;  // columns_near() then gives all columns
    const auto rings = static_cast<double>(reach);
    const double along_x = rings * box_.width / static_cast<double>(columns_);
    const double along_y = rings * box_.height / static_cast<double>(rows_);
    return std::min(has_all(reach, columns_, box_.periodic_x()) ? HUGE_VAL : along_x, all_rows ? HUGE_VAL : along_y);
  }

  std::ptrdiff_t column_of(double x) const {
    return cell_index(x / box_.width * static_cast<double>(columns_), columns_);
  }
  std::ptrdiff_t row_of(double y) const { return cell_index(y / box_.height * static_cast<double>(rows_), rows_); }

  // To the nearest image of disk j; in a sheared box that may be one several rows of images away, where disks are few.
  Vec2 apart(std::size_t i, std::size_t j) const {
    const Vec2 raw{d_.x[j] - d_.x[i], d_.y[j] - d_.y[i]};
    return box_.shear.acts() ? nearest_of_rows(raw) : nearest_image(raw, box_);
  }

  Vec2 nearest_of_rows(Vec2 raw) const {
    Vec2 nearest;
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](double row) {
      const double dy = raw.y + row * box_.height;
      if (!(dy * dy < least)) return false;
      const double dx = std::remainder(raw.x + row * box_.shear.offset, box_.width);
      if (dx * dx + dy * dy < least) nearest = {dx, dy};
      least = std::min(least, dx * dx + dy * dy);
      return true;
    };
    look(0.0);
    for (double row = 1.0;; row += 1.0) {
      const bool above = look(row), below = look(-row);
      if (!above && !below) return nearest;
    }
  }

  // Cells within reach along an axis, each once.
  struct Span {
    std::ptrdiff_t first, count;
  };
  static Span span(std::ptrdiff_t middle, std::ptrdiff_t reach, std::ptrdiff_t cells, bool periodic) {
    if (periodic) return 2 * reach + 1 >= cells ? Span{0, cells} : Span{middle - reach + cells, 2 * reach + 1};
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, middle - reach);
    return {first, std::min(cells - 1, middle + reach) - first + 1};
  }

  // Columns within reach of disk i in a row of cells, counted as in `up`: where that is a row of images of a sheared
  // box, of the places whose images are near; where all rows are in `up`, each once, all columns.
  Span columns_near(std::size_t i, std::ptrdiff_t reach, const Span& up, std::ptrdiff_t row) const {
    if (!box_.shear.acts()) return span(column_of(d_.x[i]), reach, columns_, box_.periodic_x());
    if (up.count == rows_) return {0, columns_};
    const double above = row < rows_ ? -1.0 : row >= 2 * rows_ ? 1.0 : 0.0;  // boxes; the own one begins at row rows_
    const double x = wrap(d_.x[i] - above * box_.shear.offset, box_.width);
    return span(column_of(x), reach, columns_, true);
  }

  void collect(std::size_t i, std::ptrdiff_t reach, std::vector<Neighbour>& found) const {
    found.clear();
    const Span up = span(row_of(d_.y[i]), reach, rows_, box_.periodic_y());
    for (std::ptrdiff_t r = 0; r < up.count; ++r) {
      const auto& row = cells_[static_cast<std::size_t>((up.first + r) % rows_)];
      if (row.empty()) continue;
      const Span across = columns_near(i, reach, up, up.first + r);
      for (std::ptrdiff_t c = 0; c < across.count; ++c) {
        for (const std::size_t j : row[static_cast<std::size_t>((across.first + c) % columns_)]) {
          if (j == i) continue;
          const Vec2 to = apart(i, j);
          found.push_back({to.x * to.x + to.y * to.y, d_.id[j], to});
        }
      }
    }
  }

  const Disks& d_;
  const Domain& box_;
  std::ptrdiff_t columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::vector<std::size_t>>> cells_;  // row by row, column by column
};

Vec2 product(Vec2 a, Vec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

// exp(6 i angle) by powers of exp(i angle), which is the direction itself.
Vec2 sixfold(const Neighbour& n) {
  const double r = std::sqrt(n.distance2);
  if (r == 0.0) return {};
  const Vec2 z{n.apart.x / r, n.apart.y / r};
  const Vec2 cube = product(z, product(z, z));
  return product(cube, cube);
}

// From a disk's nearest neighbours; six of them count.
Vec2 order_of(const std::vector<Neighbour>& nearest) {
  Vec2 order{};
  for (std::size_t k = 0; k < neighbours; ++k) {
    const Vec2 bond = sixfold(nearest[k]);
    order.x += bond.x / neighbours;
    order.y += bond.y / neighbours;
  }
  return order;
}

}  // namespace

std::vector<Vec2> bond_orders(const Disks& d, const Domain& box, const BlockRunner& run) {
  if (d.size() < least_of_bonds) return {};
  return *bond_orders_of_first(d, d.size(), box, HUGE_VAL, d.size(), run);
}

std::optional<std::vector<Vec2>> bond_orders_of_first(const Disks& d, std::size_t first, const Domain& box,
                                                      double known, Count all, const BlockRunner& run) {
  constexpr std::size_t block = 4096;  // disks
  const Centres centres(d, box, static_cast<double>(all));
  std::vector<Vec2> orders(first);
  std::atomic<bool> all_known = true;
  run((first + block - 1) / block, [&](std::size_t b) {
    std::vector<Neighbour> found;
    for (std::size_t i = b * block; i < std::min(first, (b + 1) * block) && all_known; ++i) {
      centres.find(i, found);
      if (found.size() < neighbours || found[neighbours - 1].distance2 > known * known) {
        all_known = false;
        return;
      }
      orders[i] = order_of(found);
    }
  });
  if (!all_known) return std::nullopt;
  return orders;
}

Disks with_orders(Disks d, const std::vector<Vec2>& orders) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < d.size(); ++i) {
    d.vx[i] = orders.empty() ? nothing : orders[i].x;
    d.vy[i] = orders.empty() ? nothing : orders[i].y;
  }
  return d;
}

BondOrder bond_order(const DisksInPieces& orders) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (orders.size() < least_of_bonds) return {nothing, nothing};
  Vec2 all;
  double local = 0.0;
  orders.visit([&](const Disks& psi) {
    for (const std::size_t i : by_id(psi)) {
      local += std::sqrt(psi.vx[i] * psi.vx[i] + psi.vy[i] * psi.vy[i]);
      all.x += psi.vx[i];
      all.y += psi.vy[i];
    }
  });
  const auto n = static_cast<double>(orders.size());
  return {local / n, std::sqrt(all.x * all.x + all.y * all.y) / n};
}

}  // namespace carom
