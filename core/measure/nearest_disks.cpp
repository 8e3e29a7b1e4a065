#include "core/measure/nearest_disks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr std::size_t disks_a_leaf = 16;
constexpr std::size_t most_at_once = 256;  // nodes
// A disk's nearest image is among so many to each side of it, as places are in the box or no further than a period
// beyond it; in a long box very many more are nearer than the sixth neighbour. Rows of images that shear moves differ
// from each other.
constexpr double images_a_side = 2.0;

double outside(double c, double low, double high) {
  return std::max(std::max(low - c, c - high), 0.0);
}

}  // namespace

NearestDisks::NearestDisks(const Disks& disks, const Domain& box, const BlockRunner& run) : box_(box) {
  std::size_t leaves = 1;
  while (leaves * disks_a_leaf < disks.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  nodes_.resize(2 * leaves - 1);
  centres_.reserve(disks.size());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    centres_.push_back({disks.x[i], disks.y[i], static_cast<std::uint32_t>(i), disks.id[i]});
  }
  // Level by level, until there are enough nodes for any number of threads.
  std::vector<Span> spans{{0, disks.size()}};
  while (spans.size() < std::min(leaves, most_at_once)) {
    std::vector<Span> halves(2 * spans.size());
    run(spans.size(), [&](std::size_t k) {
      const std::size_t middle = halve(spans.size() - 1 + k, spans[k]);
      halves[2 * k] = {spans[k].begin, middle};
      halves[2 * k + 1] = {middle, spans[k].end};
    });
    spans.swap(halves);
  }
  run(spans.size(), [&](std::size_t k) { divide(spans.size() - 1 + k, spans[k]); });
}

// Sets the bounding rectangle of the node's centres, and sorts them into its two halves. Returns where the second half
// begins.
std::size_t NearestDisks::halve(std::size_t node, Span span) {
  Node& n = nodes_[node];
  n = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (std::size_t k = span.begin; k < span.end; ++k) {
    const Centre& c = centres_[k];
    n.low = {std::min(n.low.x, c.x), std::min(n.low.y, c.y)};
    n.high = {std::max(n.high.x, c.x), std::max(n.high.y, c.y)};
  }
  const std::size_t middle = span.begin + (span.end - span.begin) / 2;
  if (node >= first_leaf_) return middle;
  const auto along = n.high.x - n.low.x > n.high.y - n.low.y ? &Centre::x : &Centre::y;
  const auto at = [&](std::size_t k) { return centres_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(span.begin), at(middle), at(span.end),
                   [along](const Centre& a, const Centre& b) { return a.*along < b.*along; });
  return middle;
}

void NearestDisks::divide(std::size_t node, Span span) {
  const std::size_t middle = halve(node, span);
  if (node >= first_leaf_) return;
  divide(2 * node + 1, {span.begin, middle});
  divide(2 * node + 2, {middle, span.end});
}

// The search for the neighbours of one disk, starting from each of its images in turn.
class NearestDisks::Search {
 public:
  Search(const NearestDisks& all, const Centre& own) : all_(all), own_(own) {
    found_.fill({HUGE_VAL, std::numeric_limits<DiskId>::max(), {}});
  }

  NearestNeighbours find() {
    const Domain& box = all_.box_;
    const Node& root = all_.nodes_[0];
    const double rows = box.shear.acts() ? HUGE_VAL : images_a_side;
    images(own_.y, box.periodic_y() ? box.height : 0.0, rows, root.low.y, root.high.y, [&](double y, double row) {
      double x = own_.x;
      if (box.shear.acts() && row != 0.0) x = wrap(x + row * box.shear.offset, box.width);
      images(x, box.periodic_x() ? box.width : 0.0, images_a_side, root.low.x, root.high.x, [&](double column, double) {
        look({column, y}, 0, 0, all_.centres_.size());
      });
    });
    return found_;
  }

 private:
  // Calls see(c + k period, k) for k = 0, 1, -1, 2 and so on to -last, until the image is further from [low, high] than
  // the sixth neighbour found.
  template <class See>
  void images(double c, double period, double last, double low, double high, See&& see) {
    see(c, 0.0);
    if (period == 0.0) return;
    for (double k = 1.0; k <= last; k += 1.0) {
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

  // Searches the disks [begin, end) of a node, the nearer half first.
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
      const Centre& c = all_.centres_[k];
      const double x = c.x - from.x, y = c.y - from.y;
      if (x * x + y * y <= reach2_) meet(c);
    }
  }

  // A disk may be met through several images, of which one is the nearest. In a flat sheared box it is met in very many
  // rows, and its nearest image is expensive to find; so it is first tested whether the disk is known already.
  void meet(const Centre& c) {
    if (c.disk == own_.disk) return;
    for (const Neighbour& n : found_) {
      if (n.id == c.id) return;
    }
    const Vec2 to = all_.apart(own_, c);
    const Neighbour met{to.x * to.x + to.y * to.y, c.id, to};
    if (!(met < found_.back())) return;
    found_.back() = met;
    for (std::size_t k = neighbours_of_bonds - 1; k > 0 && found_[k] < found_[k - 1]; --k)
      std::swap(found_[k], found_[k - 1]);
    // A little further, since positions of images are rounded.
    const double reach = std::sqrt(found_.back().distance2) + 0x1p-46 * (all_.box_.width + all_.box_.height);
    reach2_ = reach * reach;
  }

  const NearestDisks& all_;
  const Centre& own_;
  NearestNeighbours found_;
  double reach2_ = HUGE_VAL;  // disks further away are not needed; length^2
};

NearestNeighbours NearestDisks::of(std::size_t k) const {
  return Search(*this, centres_[k]).find();
}

// To the nearest image. With few disks in a sheared box, the image nearest among all neighbours may be several rows
// away.
Vec2 NearestDisks::apart(const Centre& from, const Centre& to) const {
  const Vec2 raw{to.x - from.x, to.y - from.y};
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
