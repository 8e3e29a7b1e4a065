#include "core/measure/density_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/exact_sum.hpp"

namespace carom {

namespace {

struct Slabs {
  double length = 0.0, width = 0.0;
  std::ptrdiff_t count = 0;
  bool periodic = false;

  std::ptrdiff_t at(double coordinate) const { return static_cast<std::ptrdiff_t>(std::floor(coordinate / width)); }
  std::size_t nearest(std::ptrdiff_t slab) const {
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(slab, 0, count - 1));
  }
  // The slab in the box that a slab beyond a side stands for; beyond a wall, the outermost slab.
  std::size_t home(std::ptrdiff_t slab) const {
    if (!periodic) return nearest(slab);
    return static_cast<std::size_t>(((slab % count) + count) % count);
  }
};

// Shares the area of a disk among the slabs. The sums are exact, so the order of the disks does not matter.
void share_out(const Slabs& slabs, double centre, double radius, std::vector<ExactSum>& covered) {
  const double area = std::numbers::pi * radius * radius;
  const std::ptrdiff_t first = slabs.at(centre - radius);
  const std::ptrdiff_t last = slabs.at(centre + radius);
  double below = 0.0;
  for (std::ptrdiff_t slab = first; slab <= last; ++slab) {
    const double top = slabs.width * static_cast<double>(slab + 1);
    const double next = slab == last ? 1.0 : share_below((top - centre) / radius);
    covered[slabs.home(slab)].add(area * (next - below));
    below = next;
  }
}

}  // namespace

double share_below(double h) {
  if (h <= -1.0) return 0.0;
  if (h >= 1.0) return 1.0;
  // The circular sector of angle 2 acos(-h), plus or minus a triangle.
  return (std::acos(-h) + h * std::sqrt(1.0 - h * h)) / std::numbers::pi;
}

DensityProfile empty_density(std::size_t slabs) {
  return {std::vector<Count>(slabs, 0), std::vector<double>(slabs, 0.0), 0};
}

void add_density(DensityProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x) {
  const double length = along_x ? box.width : box.height;
  const auto count = static_cast<std::ptrdiff_t>(profile.centres.size());
  const Slabs slabs{length, length / static_cast<double>(count), count, along_x ? box.periodic_x() : box.periodic_y()};
  std::vector<ExactSum> covered(profile.centres.size());
  disks.visit([&](const Disks& d) {
    const std::vector<double>& coordinate = along_x ? d.x : d.y;
    for (std::size_t i = 0; i < d.size(); ++i) {
      ++profile.centres[slabs.nearest(slabs.at(coordinate[i]))];
      share_out(slabs, coordinate[i], d.radius_of(i), covered);
    }
  });
  for (std::size_t k = 0; k < covered.size(); ++k) profile.covered[k] += covered[k].value();
  ++profile.samples;
}

void join(DensityProfile& profile, const DensityProfile& other) {
  for (std::size_t k = 0; k < profile.centres.size(); ++k) {
    profile.centres[k] += other.centres[k];
    profile.covered[k] += other.covered[k];
  }
  profile.samples += other.samples;
}

}  // namespace carom
