#include "core/start/voxel_list.hpp"

#include <cmath>
#include <utility>

#include "core/disks/cell_index.hpp"
#include "core/start/start_region.hpp"

namespace carom {

namespace {

// A list may be halved if it has at most so many voxels for each disk; it then has at most four times as many.
constexpr std::size_t halved_per_disk = 1;
constexpr std::size_t halved_at_least = 4096;

// Margin, in contact distances, so that rounding does not remove free places.
constexpr double contact_margin = 1e-9;

// Does the contact circle of one of these disks contain the whole voxel? middle: relative to the point to which `near`
// refers.
bool ruled_out(const std::vector<PlacementGrid::Near>& near, Vec2 middle, double half_x, double half_y) {
  return std::any_of(near.begin(), near.end(), [&](const PlacementGrid::Near& disk) {
    const double x = std::abs(disk.dx - middle.x) + half_x;
    const double y = std::abs(disk.dy - middle.y) + half_y;
    return x * x + y * y < disk.contact * disk.contact * (1.0 - contact_margin);
  });
}

}  // namespace

VoxelList::VoxelList(const Domain& box, double smallest, std::size_t disks, std::size_t columns, std::size_t rows,
                     std::vector<Voxel> open, const StartRegion* region)
    : box_(box),
      region_(region),
      smallest_(smallest),
      disks_(disks),
      columns_(columns),
      rows_(rows),
      size_x_(box.width / static_cast<double>(columns)),
      size_y_(box.height / static_cast<double>(rows)),
      list_(std::move(open)),
      all_(list_.size()) {}

Vec2 VoxelList::point(TwoUniforms in_voxel, double which) const {
  const Voxel voxel = list_[entry_of(which) - before_];
  return {(voxel.column + in_voxel.a) * size_x_, (voxel.row + in_voxel.b) * size_y_};
}

bool VoxelList::holds(Vec2 point) const {
  const std::uint64_t column = cell_index(point.x / size_x_, columns_);
  const std::uint64_t row = cell_index(point.y / size_y_, rows_);
  return std::any_of(list_.begin(), list_.end(), [&](Voxel v) { return v.column == column && v.row == row; });
}

// Only as long as 32 bits can count columns and rows, and memory suffices.
bool VoxelList::halved() const {
  constexpr std::uint64_t most = std::uint64_t{1} << 31;
  return columns_ <= most && rows_ <= most && all_ <= std::max(halved_per_disk * disks_, halved_at_least);
}

// Is the whole voxel outside the room that walls, sinks and the region leave to a centre?
bool VoxelList::outside(double x, double y, double half_x, double half_y) const {
  const auto beyond = [&](double c, double half, double length) {
    const double room = smallest_ * (1.0 - contact_margin);
    return c + half < room || c - half > length - room;
  };
  if (region_ != nullptr &&
      !may_hold_centre(*region_, box_, {x - half_x, y - half_y}, {x + half_x, y + half_y}, smallest_)) {
    return true;
  }
  return (!box_.periodic_x() && beyond(x, half_x, box_.width)) ||
         (!box_.periodic_y() && beyond(y, half_y, box_.height));
}

std::vector<Voxel> VoxelList::survivors(const PlacementGrid& grid, std::size_t begin, std::size_t end) const {
  const std::uint32_t parts = halved() ? 2 : 1;
  const double half_x = 0.5 * size_x_ / parts;
  const double half_y = 0.5 * size_y_ / parts;
  const double spread = 0.5 * tile_ * std::hypot(size_x_, size_y_);
  std::vector<Voxel> left;
  std::vector<PlacementGrid::Near> near;
  Vec2 anchor;  // the middle of the present tile
  for (std::size_t k = begin; k < end; ++k) {
    const Voxel voxel = list_[k];
    if (k == begin || voxel.column / tile_ != list_[k - 1].column / tile_ ||
        voxel.row / tile_ != list_[k - 1].row / tile_) {
      anchor = {(voxel.column / tile_ + 0.5) * tile_ * size_x_, (voxel.row / tile_ + 0.5) * tile_ * size_y_};
      grid.find_near(anchor.x, anchor.y, smallest_, spread, near);
    }
    for (std::uint32_t up = 0; up < parts; ++up) {
      for (std::uint32_t across = 0; across < parts; ++across) {
        const Voxel part{voxel.column * parts + across, voxel.row * parts + up};
        const Vec2 middle{(2.0 * part.column + 1.0) * half_x, (2.0 * part.row + 1.0) * half_y};
        if (outside(middle.x, middle.y, half_x, half_y)) continue;
        if (!ruled_out(near, {middle.x - anchor.x, middle.y - anchor.y}, half_x, half_y)) left.push_back(part);
      }
    }
  }
  return left;
}

std::size_t VoxelList::put(std::size_t first, const std::vector<Voxel>& survivors) {
  std::copy(survivors.begin(), survivors.end(), list_.begin() + static_cast<std::ptrdiff_t>(first));
  return first + survivors.size();
}

void VoxelList::replace(std::vector<Voxel> survivors) {
  const std::uint32_t parts = halved() ? 2 : 1;
  tile_ *= parts;
  columns_ *= parts;
  rows_ *= parts;
  size_x_ = box_.width / static_cast<double>(columns_);
  size_y_ = box_.height / static_cast<double>(rows_);
  list_ = std::move(survivors);
  be_part(0, list_.size());
}

}  // namespace carom
