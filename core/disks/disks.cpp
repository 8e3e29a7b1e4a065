#include "core/disks/disks.hpp"

#include <algorithm>
#include <numeric>

#include "core/disks/disk_columns.hpp"

namespace carom {

void append(Disks& d, const Disk& disk) {
  if (d.empty() && d.radius.empty() && d.mass.empty() && d.common_radius == 0.0) {
    d.common_radius = disk.radius;
    d.common_mass = disk.mass;
  }
  DiskColumns columns = columns_of(d);
  make_columns_for(disk, columns, d);
  push_back(d, disk, columns);
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
  for_each_column(d, [&](auto& column) { close_up(column, gone); });
  return before - d.size();
}

void take_out(Disks& d, std::size_t i) {
  for_each_column(d, [i](auto& column) {
    if (column.empty()) return;
    column[i] = column.back();
    column.pop_back();
  });
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
  // Usually nearly all ids up to the largest exist. Then a table by id, from which absent ids are erased, is the order.
  const std::size_t ids = std::size_t{*std::max_element(d.id.begin(), d.id.end())} + 1;
  if (ids < 4 * d.size()) {
    constexpr auto absent = static_cast<std::size_t>(-1);
    order.assign(ids, absent);
    for (std::size_t i = 0; i < d.size(); ++i) order[d.id[i]] = i;
    std::erase(order, absent);
    if (order.size() == d.size()) return order;  // shorter only if an id occurs twice, as in a damaged file
  }
  order.resize(d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(d.id.begin(), d.id.end())) {
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return d.id[a] < d.id[b]; });
  }
  return order;
}

}  // namespace carom
