#include "parallel/exact_lists.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/boundary.hpp"
#include "core/huge_pages.hpp"

namespace carom {

namespace {

// Disks whose lists share a vector: enough that vectors are few, few enough to share out among threads.
constexpr std::size_t disks_per_block = 4096;
// Up to so many disks everybody is in everybody's list: nothing to keep in order, and windows of few disks are long.
constexpr std::size_t everybody_below = 40;
// Twice the roam and a diameter reach this many spacings: about eleven neighbours. Longer lists are looked through more
// often, shorter ones made more often.
constexpr double reach_in_spacings = 1.9;
// In very dense systems the roam is at least this share of a mean diameter.
constexpr double least_roam = 0.08;
// Disks a block when some are listed anew.
constexpr std::size_t anew_per_block = 64;
// Columns of cells in a band: 2^5.
constexpr unsigned band_shift = 5;
// Share of the roam that gravity may bend a path by before exit_time is asked again.
constexpr double bend_share = 0.1;

}  // namespace

void ExactLists::choose_roam(const Disks& d) {
  const double n = static_cast<double>(d.size());
  if (d.size() <= everybody_below) {
    roam_ = HUGE_VAL;
    return;
  }
  double radius = d.common_radius;
  if (!d.radius.empty()) {
    radius = 0.0;
    for (const double r : d.radius) radius += r;
    radius /= n;
  }
  const double spacing = std::sqrt(box_.width * box_.height / n);
  roam_ = std::max(0.5 * (reach_in_spacings * spacing - 2.0 * radius), least_roam * 2.0 * radius);
}

void ExactLists::build(Disks& d, const Domain& box, const Executor& executor) {
  box_ = box;
  choose_roam(d);
  const std::size_t n = d.size();
  moved_.clear();
  largest_radius_ = largest_radius(d);
  if (!everybody()) {
    const double largest = largest_radius_;
    std::vector<std::size_t> count(class_of_radius(smallest_radius(d), largest) + 1, 0);
    if (count.size() == 1) count[0] = n;
    if (count.size() > 1) {
      for (const double r : d.radius) ++count[class_of_radius(r, largest)];
    }
    // About a disk a cell: lists reach over several cells, and empty ones cost as much to visit as others.
    for (std::size_t& c : count) c = c / 2 + 1;
    make_grid(box, largest, count, grid_, band_shift);
    sort_into_cells(d, grid_, executor, cells_);
    head_.assign(grid_.keys, none);
  }
  if (rows_.capacity() < n) resize_in_huge_pages(rows_, n);
  rows_.resize(n);
  block_shift_ = static_cast<unsigned>(std::bit_width(executor.grain(disks_per_block)) - 1);
  const std::size_t block = std::size_t{1} << block_shift_;
  wide_.resize((n + block - 1) >> block_shift_);
  executor.run(wide_.size(), [&](std::size_t b) {
    wide_[b].clear();
    list_block(d, b * block, std::min(n, (b + 1) * block));
  });
}

void ExactLists::list_block(const Disks& d, std::size_t begin, std::size_t end) {
  thread_local std::vector<std::uint32_t> found;
  for (std::size_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    Row& row = rows_[i];
    row.x = d.x[i];
    row.y = d.y[i];
    row.more = none;
    row.count = 0;
    found.clear();
    find_neighbours(
        d, i,
        [&](std::uint32_t j) {
          return Vec2{d.x[j], d.y[j]};
        },
        found);
    for (const std::uint32_t j : found) insert(i, j);
    row.sides = static_cast<std::uint8_t>(find_sides(d, i));
  }
}

template <class PlaceOf>
void ExactLists::find_neighbours(const Disks& d, std::uint32_t i, PlaceOf&& place_of,
                                 std::vector<std::uint32_t>& found) const {
  const Vec2 p{rows_[i].x, rows_[i].y};
  const double own = d.radius_of(i) + 2.0 * roam_;
  const double width = box_.periodic_x() ? box_.width : 0.0;
  const double height = box_.periodic_y() ? box_.height : 0.0;
  const double half_width = box_.periodic_x() ? 0.5 * width : HUGE_VAL;
  const double half_height = box_.periodic_y() ? 0.5 * height : HUGE_VAL;
  const double* const radius = d.radius.empty() ? nullptr : d.radius.data();
  // No branch depends on a place: which neighbours are near is as good as random.
  const auto is_near = [&](std::uint32_t j) {
    const Vec2 q = place_of(j);
    double dx = std::abs(q.x - p.x);
    double dy = std::abs(q.y - p.y);
    dx -= dx > half_width ? width : 0.0;
    dy -= dy > half_height ? height : 0.0;
    const double reach = own + (radius != nullptr ? radius[j] : d.common_radius);
    return static_cast<unsigned>(dx * dx + dy * dy <= reach * reach) & static_cast<unsigned>(j != i);
  };
  const auto run = [&](std::uint32_t first, std::uint32_t last) {
    std::size_t n = found.size();
    found.resize(n + (last - first));
    for (std::uint32_t j = first; j < last; ++j) {
      found[n] = j;
      n += is_near(j);
    }
    found.resize(n);
  };
  visit_runs_near(p.x, p.y, own, run, [&](std::uint32_t j) {
    if (is_near(j) != 0) found.push_back(j);
  });
}

unsigned ExactLists::find_sides(const Disks& d, std::uint32_t i) const {
  unsigned sides = 0;
  for (const Side side : all_sides) {
    if (box_.side(side) == SideKind::periodic) continue;
    const double gap = -reach_beyond(side, rows_[i].x, rows_[i].y, d.radius_of(i), box_);
    if (gap <= roam_) sides |= 1U << static_cast<unsigned>(side);
  }
  return sides;
}

double ExactLists::exit_time(std::uint32_t i, const PathSegment& path, double from, double until, double g) const {
  if (everybody()) return never;
  const PathSegment p = carried_to(path, from, g);
  double dx = p.x - rows_[i].x;
  double dy = p.y - rows_[i].y;
  if (box_.periodic_x()) dx = nearest_image(dx, box_.width);
  if (box_.periodic_y()) dy = nearest_image(dy, box_.height);
  double room = roam_ * (1.0 - 1e-9);
  double ahead = never;
  if (g > 0.0) {
    // The straight path, less what gravity can bend it by in the time looked ahead.
    ahead = std::max(std::sqrt(2.0 * bend_share * roam_ / g), until - from);
    room -= 0.5 * g * ahead * ahead;
    if (!(room > 0.0)) return from;
  }
  const double c = room * room - (dx * dx + dy * dy);
  if (!(c > 0.0)) return from;
  const double a = p.vx * p.vx + p.vy * p.vy;
  if (a == 0.0) return from + ahead;
  const double b = dx * p.vx + dy * p.vy;
  const double root = std::sqrt(b * b + a * c);
  const double t = b > 0.0 ? c / (b + root) : (root - b) / a;
  return from + std::min(t, ahead);
}

// A straight path whose ends are in a circle is in it; gravity bends it by g t^2 / 8 at most.
bool ExactLists::stays(std::uint32_t i, const PathSegment& path, double from, double until, double g) const {
  if (everybody()) return true;
  const double bend = 0.125 * g * (until - from) * (until - from);
  const double room = roam_ * (1.0 - 1e-9) - bend;
  const auto inside = [&](double t) {
    const double s = t - path.start;
    double dx = path.x + path.vx * s - rows_[i].x;
    double dy = path.y + (path.vy - 0.5 * g * s) * s - rows_[i].y;
    if (box_.periodic_x()) dx = nearest_image(dx, box_.width);
    if (box_.periodic_y()) dy = nearest_image(dy, box_.height);
    return dx * dx + dy * dy < room * room;
  };
  // A straight path begins inside anyway; a bent one has to begin further inside.
  return room > 0.0 && inside(until) && (g == 0.0 || inside(from));
}

// Listed disks are within reach + 4 roam of each other, carried back to the window's start by two flights more; less
// than half a period in all, the nearest image is the right one.
double ExactLists::safe_speed2(double length, double g) const {
  double period = HUGE_VAL;
  if (box_.periodic_x()) period = std::min(period, box_.width);
  if (box_.periodic_y()) period = std::min(period, box_.height);
  if (period == HUGE_VAL) return HUGE_VAL;
  const double flight = 0.5 * (0.49 * period - 2.0 * largest_radius_ - 4.0 * roam_) - g * length * length;
  return flight > 0.0 ? (flight / length) * (flight / length) : -1.0;
}

std::uint32_t ExactLists::key_of_place(const Disks& d, std::uint32_t i) const {
  const std::size_t level =
      d.radius.empty() || grid_.levels.size() == 1 ? 0 : class_of_radius(d.radius[i], grid_.levels[0].largest_radius);
  return key_of(grid_.levels[level], rows_[i].x, rows_[i].y);
}

// Looks at all of the list, so that the compiler can take several at a time.
bool ExactLists::lists(std::uint32_t i, std::uint32_t j) const {
  unsigned seen = 0;
  see_neighbours(i, [&](const std::uint32_t* near, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) seen |= static_cast<unsigned>(near[k] == j);
  });
  return seen != 0;
}

void ExactLists::insert(std::uint32_t i, std::uint32_t j) {
  Row& row = rows_[i];
  const std::int64_t offset = std::int64_t{j} - std::int64_t{i};
  if (row.count < chunk && offset == static_cast<std::int16_t>(offset)) {
    row.offset[row.count++] = static_cast<std::int16_t>(offset);
    return;
  }
  std::vector<WideRow>& wide = wide_[i >> block_shift_];
  if (row.more == none || wide[row.more].count == std::size(wide[row.more].near)) {
    wide.push_back({{}, 0, row.more});
    row.more = static_cast<std::uint32_t>(wide.size() - 1);
  }
  WideRow& last = wide[row.more];
  last.near[last.count++] = j;
}

void ExactLists::replace_list(std::uint32_t i, std::span<const std::uint32_t> found) {
  rows_[i].count = 0;
  rows_[i].more = none;
  for (const std::uint32_t j : found) {
    if (!lists(i, j)) insert(i, j);
    if (!lists(j, i)) insert(j, i);
  }
}

void ExactLists::list_anew(std::span<const std::uint32_t> which, std::span<const Vec2> places, const Disks& d,
                           const Executor& executor) {
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::uint32_t i = which[k];
    rows_[i].x = places[k].x;
    rows_[i].y = places[k].y;
    rows_[i].sides = static_cast<std::uint8_t>(find_sides(d, i));
    const std::uint32_t key = key_of_place(d, i);
    moved_.push_back({i, head_[key]});
    head_[key] = static_cast<std::uint32_t>(moved_.size() - 1);
  }
  const std::size_t blocks = executor.blocks(which.size(), anew_per_block);
  if (found_.size() < blocks) found_.resize(blocks);
  // Each block's finds, one list after the other, each before its length.
  executor.for_ranges(which.size(), anew_per_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& found = found_[b];
    found.clear();
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t first = found.size();
      find_neighbours(
          d, which[k],
          [&](std::uint32_t j) {
            return Vec2{rows_[j].x, rows_[j].y};
          },
          found);
      found.push_back(static_cast<std::uint32_t>(found.size() - first));
    }
  });
  const std::size_t grain = executor.grain(anew_per_block);
  for (std::size_t b = 0; b < blocks; ++b) {
    std::size_t end = found_[b].size();
    for (std::size_t k = std::min(which.size(), (b + 1) * grain); k-- > b * grain;) {
      const std::size_t count = found_[b][--end];
      end -= count;
      replace_list(which[k], {found_[b].data() + end, count});
    }
  }
}

}  // namespace carom
