#include "core/disks/disk_source.hpp"

#include <vector>

namespace carom {

namespace {

template <class T>
std::vector<T> some_of(const std::vector<T>& column, std::size_t begin, std::size_t end) {
  if (column.empty()) return {};
  return {column.begin() + static_cast<std::ptrdiff_t>(begin), column.begin() + static_cast<std::ptrdiff_t>(end)};
}

}  // namespace

Disks HeldDisks::read(std::size_t begin, std::size_t end) {
  const Disks& d = disks_;
  const auto some = [&](const auto& column) { return some_of(column, begin, end); };
  return {some(d.x),    some(d.y),       some(d.vx),    some(d.vy),   some(d.id), some(d.radius),
          some(d.mass), d.common_radius, d.common_mass, some(d.spin), d.inertia};
}

}  // namespace carom
