#include "core/disks/disks.hpp"

#include <algorithm>
#include <numeric>

namespace carom {

void append(Disks& d, const Disk& disk) {
  const std::size_t n = d.size();
  if (n == 0 && d.radius.empty() && d.mass.empty() && d.common_radius == 0.0) {
    d.common_radius = disk.radius;
    d.common_mass = disk.mass;
  }
  if (d.radius.empty() && disk.radius != d.common_radius) d.radius.assign(n, d.common_radius);
  if (d.mass.empty() && disk.mass != d.common_mass) d.mass.assign(n, d.common_mass);
  const bool own_radius = !d.radius.empty() || disk.radius != d.common_radius;
  const bool own_mass = !d.mass.empty() || disk.mass != d.common_mass;
  d.x.push_back(disk.x);
  d.y.push_back(disk.y);
  d.vx.push_back(disk.vx);
  d.vy.push_back(disk.vy);
  d.id.push_back(disk.id);
  if (own_radius) d.radius.push_back(disk.radius);
  if (own_mass) d.mass.push_back(disk.mass);
  if (d.spins()) d.spin.push_back(disk.spin);
}

namespace {

template <class T>
void close_up(std::vector<T>& column, const std::vector<unsigned char>& gone) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (gone[i] == 0) column[kept++] = column[i];
  }
  column.resize(kept);
}

}  // namespace

std::size_t remove_marked(Disks& d, const std::vector<unsigned char>& gone) {
  const std::size_t before = d.size();
  close_up(d.x, gone);
  close_up(d.y, gone);
  close_up(d.vx, gone);
  close_up(d.vy, gone);
  close_up(d.id, gone);
  close_up(d.radius, gone);
  close_up(d.mass, gone);
  close_up(d.spin, gone);
  return before - d.size();
}

void take_out(Disks& d, std::size_t i) {
  const auto close = [i](auto& column) {
    if (column.empty()) return;
    column[i] = column.back();
    column.pop_back();
  };
  close(d.x);
  close(d.y);
  close(d.vx);
  close(d.vy);
  close(d.id);
  close(d.radius);
  close(d.mass);
  close(d.spin);
}

double largest_radius(const Disks& d) {
  if (d.empty()) return 0.0;
  return d.radius.empty() ? d.common_radius : *std::max_element(d.radius.begin(), d.radius.end());
}

double smallest_radius(const Disks& d) {
  if (d.empty()) return 0.0;
  return d.radius.empty() ? d.common_radius : *std::min_element(d.radius.begin(), d.radius.end());
}

std::vector<std::size_t> by_id(const Disks& d) {
  std::vector<std::size_t> order;
  if (d.empty()) return order;
  // Mostly nearly all ids up to the largest are there: every disk then knows its place, but for those that are not.
  const std::size_t ids = std::size_t{*std::max_element(d.id.begin(), d.id.end())} + 1;
  if (ids < 4 * d.size()) {
    constexpr auto absent = static_cast<std::size_t>(-1);
    order.assign(ids, absent);
    for (std::size_t i = 0; i < d.size(); ++i) order[d.id[i]] = i;
    std::erase(order, absent);
    if (order.size() == d.size()) return order;  // else an id stands twice, as in a damaged file
  }
  order.resize(d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(d.id.begin(), d.id.end())) {
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return d.id[a] < d.id[b]; });
  }
  return order;
}

}  // namespace carom
