// The columns of a simulation's disks as Eigen arrays, without a copy.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/disks/disks.hpp"

namespace carom {

// In storage order, which any step may change; valid as long as the columns are (Simulation::state()). radius and mass
// are empty if all disks have common_radius and common_mass.
struct DiskMaps {
  using Column = Eigen::Map<const Eigen::ArrayXd>;
  using Ids = Eigen::Map<const Eigen::Array<DiskId, Eigen::Dynamic, 1>>;

  explicit DiskMaps(const Disks& d)
      : x(map(d.x)),
        y(map(d.y)),
        vx(map(d.vx)),
        vy(map(d.vy)),
        radius(map(d.radius)),
        mass(map(d.mass)),
        spin(map(d.spin)),
        id(d.id.data(), static_cast<Eigen::Index>(d.id.size())) {}

  Column x, y;    // length
  Column vx, vy;  // length / time
  Column radius, mass;
  Column spin;  // angular velocity, counter-clockwise; 1 / time; empty if disks are smooth
  Ids id;

 private:
  static Column map(const std::vector<double>& column) {
    return {column.data(), static_cast<Eigen::Index>(column.size())};
  }
};

}  // namespace carom
