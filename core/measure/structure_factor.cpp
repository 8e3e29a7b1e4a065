#include "core/measure/structure_factor.hpp"

#include <cmath>
#include <numbers>

namespace carom {

namespace {

// Powers of one exponential a disk, as sines and cosines of each wave number would cost many times more.
void add_axis(std::vector<double>& sums, const std::vector<double>& place, const std::vector<std::size_t>& order,
              double period) {
  std::vector<double> real(sums.size(), 0.0), imaginary(sums.size(), 0.0);
  for (const std::size_t i : order) {
    const double phase = 2.0 * std::numbers::pi * (place[i] / period);
    const double c = std::cos(phase), s = std::sin(phase);
    double re = 1.0, im = 0.0;
    for (std::size_t n = 0; n < sums.size(); ++n) {
      const double next = re * c - im * s;
      im = re * s + im * c;
      re = next;
      real[n] += re;
      imaginary[n] += im;
    }
  }
  const auto disks = static_cast<double>(order.size());
  for (std::size_t n = 0; n < sums.size(); ++n) {
    sums[n] += (real[n] * real[n] + imaginary[n] * imaginary[n]) / disks;
  }
}

}  // namespace

void add_structure(StructureFactor& structure, const Disks& d, const Domain& box) {
  if (d.empty()) return;
  const std::vector<std::size_t> order = by_id(d);
  add_axis(structure.along_x, d.x, order, box.width);
  add_axis(structure.along_y, d.y, order, box.height);
  ++structure.samples;
}

}  // namespace carom
