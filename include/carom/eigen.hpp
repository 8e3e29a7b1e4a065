// Disks of a Carom world as Eigen matrices and maps. Needs Eigen 3.3 or later; the other headers of Carom do not.
#ifndef CAROM_EIGEN_HPP
#define CAROM_EIGEN_HPP

#include <Eigen/Core>
#include <carom/carom.hpp>
#include <cstddef>
#include <span>

namespace carom {
inline namespace handle {

// In order of id: 2 x n matrices with a column (x, y) or (vx, vy) for each of the n disks, and a vector of n radii.
// Units: length, length / time. Throw Error.
inline Eigen::Matrix2Xd positions(const World& world) {
  Eigen::Matrix2Xd xy(2, static_cast<Eigen::Index>(world.size()));
  world.positions({xy.data(), static_cast<std::size_t>(xy.size())});
  return xy;
}
inline Eigen::Matrix2Xd velocities(const World& world) {
  Eigen::Matrix2Xd xy(2, static_cast<Eigen::Index>(world.size()));
  world.velocities({xy.data(), static_cast<std::size_t>(xy.size())});
  return xy;
}
inline Eigen::VectorXd radii(const World& world) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(world.size()));
  world.radii({r.data(), static_cast<std::size_t>(r.size())});
  return r;
}

// One field of each disk of an array, without a copy: column(disks, &carom_disk::vx). Valid as long as the array.
using DiskColumn = Eigen::Map<const Eigen::ArrayXd, Eigen::Unaligned, Eigen::InnerStride<>>;
inline DiskColumn column(std::span<const carom_disk> disks, double carom_disk::*number) {
  static_assert(sizeof(carom_disk) % sizeof(double) == 0);
  const double* const first = disks.empty() ? nullptr : &(disks.front().*number);
  return {first, static_cast<Eigen::Index>(disks.size()), Eigen::InnerStride<>(sizeof(carom_disk) / sizeof(double))};
}

}  // namespace handle
}  // namespace carom

#endif
