#include "core/measure/nearest_disks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace carom {

namespace {

constexpr std::size_t disks_a_leaf = 16;

double outside(double c, double low, double high) {
  return std::max(std::max(low - c, c - high), 0.0);
}

}  // namespace

NearestDisks::NearestDisks(const Disks& disks, const Domain& box) : disks_(disks), box_(box), order_(disks.size()) {
  std::size_t leaves = 1;
  while (leaves * disks_a_leaf < disks.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  nodes_.resize(2 * leaves - 1);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  divide(0, 0, disks.size());
  places_.reserve(disks.size());
  for (const std::size_t i : order_) places_.push_back({disks.x[i], disks.y[i]});
}

// Disks [begin, end) of the order are those of the node.
void NearestDisks::divide(std::size_t node, std::size_t begin, std::size_t end) {
  Node& n = nodes_[node];
  n = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (std::size_t k = begin; k < end; ++k) {
    const double x = disks_.x[order_[k]], y = disks_.y[order_[k]];
    n.low = {std::min(n.low.x, x), std::min(n.low.y, y)};
    n.high = {std::max(n.high.x, x), std::max(n.high.y, y)};
  }
  if (node >= first_leaf_) return;
  const auto& along = n.high.x - n.low.x > n.high.y - n.low.y ? disks_.x : disks_.y;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) { return along[a] < along[b]; });
  divide(2 * node + 1, begin, middle);
  divide(2 * node + 2, middle, end);
}

// One disk's, from one image of it after the other.
class NearestDisks::Search {
 public:
  Search(const NearestDisks& all, std::size_t i) : all_(all), i_(i) {
    found_.fill({HUGE_VAL, std::numeric_limits<DiskId>::max(), {}});
  }

  NearestNeighbours find() {
    const Domain& box = all_.box_;
    const Node& root = all_.nodes_[0];
    images(all_.disks_.y[i_], box.periodic_y() ? box.height : 0.0, root.low.y, root.high.y, [&](double y, double row) {
      double x = all_.disks_.x[i_];
      if (box.shear.acts() && row != 0.0) x = wrap(x + row * box.shear.offset, box.width);
      images(x, box.periodic_x() ? box.width : 0.0, root.low.x, root.high.x, [&](double column, double) {
        look({column, y}, 0, 0, all_.order_.size());
      });
    });
    return found_;
  }

 private:
  // Calls see(c + k period, k) for k = 0, 1, -1, 2 and so on, up to those further than the sixth neighbour from all
  // that lies between low and high.
  template <class See>
  void images(double c, double period, double low, double high, See&& see) {
    see(c, 0.0);
    if (period == 0.0) return;
    for (double k = 1.0;; k += 1.0) {
      bool near = false;
      for (const double image : {k, -k}) {
        const double place = c + image * period;
        const double gap = outside(place, low, high);
        if (gap * gap > reach2_) continue;
        near = true;
        see(place, image);
      }
      if (!near) return;
    }
  }

  double distance2(Vec2 from, const Node& n) const {
    const double x = outside(from.x, n.low.x, n.high.x), y = outside(from.y, n.low.y, n.high.y);
    return x * x + y * y;
  }

  // At the disks [begin, end) of a node, the nearer half first.
  void look(Vec2 from, std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= all_.first_leaf_) return look_at_leaf(from, begin, end);
    const std::size_t middle = begin + (end - begin) / 2, before = 2 * node + 1, after = before + 1;
    const double to_before = distance2(from, all_.nodes_[before]), to_after = distance2(from, all_.nodes_[after]);
    if (to_before <= to_after && to_before <= reach2_) look(from, before, begin, middle);
    if (to_after <= reach2_) look(from, after, middle, end);
    if (to_before > to_after && to_before <= reach2_) look(from, before, begin, middle);
  }

  void look_at_leaf(Vec2 from, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const double x = all_.places_[k].x - from.x, y = all_.places_[k].y - from.y;
      if (x * x + y * y <= reach2_) meet(all_.order_[k]);
    }
  }

  // A disk may be met at several of its images: one of them is the nearest.
  void meet(std::size_t j) {
    if (j == i_) return;
    const Vec2 to = all_.apart(i_, j);
    const Neighbour met{to.x * to.x + to.y * to.y, all_.disks_.id[j], to};
    if (!(met < found_.back())) return;
    for (const Neighbour& n : found_) {
      if (n.id == met.id) return;
    }
    found_.back() = met;
    for (std::size_t k = neighbours_of_bonds - 1; k > 0 && found_[k] < found_[k - 1]; --k)
      std::swap(found_[k], found_[k - 1]);
    // A little further, as places of images are rounded.
    const double reach = std::sqrt(found_.back().distance2) + 0x1p-46 * (all_.box_.width + all_.box_.height);
    reach2_ = reach * reach;
  }

  const NearestDisks& all_;
  std::size_t i_;
  NearestNeighbours found_;
  double reach2_ = HUGE_VAL;  // nothing further away is asked for; length^2
};

NearestNeighbours NearestDisks::of(std::size_t i) const {
  return Search(*this, i).find();
}

// To the nearest image of disk j; in a sheared box that may be one several rows of images away, where disks are few.
Vec2 NearestDisks::apart(std::size_t i, std::size_t j) const {
  const Vec2 raw{disks_.x[j] - disks_.x[i], disks_.y[j] - disks_.y[i]};
  return box_.shear.acts() ? nearest_of_rows(raw) : nearest_image(raw, box_);
}

Vec2 NearestDisks::nearest_of_rows(Vec2 raw) const {
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

}  // namespace carom
