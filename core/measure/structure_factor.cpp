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

// Likewise along x in a sheared box: exp(i n a) with the phase a of k = (2 pi / width) (1, -offset / height), which
// goes with the flow, times exp(i m b) with that of k = (0, 2 pi / height), which brings the wave back to the axis.
void add_sheared_axis(std::vector<double>& sums, const Disks& d, const std::vector<std::size_t>& order,
                      const Domain& box) {
  const double share = box.shear.offset / box.width;
  std::vector<double> real(sums.size(), 0.0), imaginary(sums.size(), 0.0);
  for (const std::size_t i : order) {
    const double up = d.y[i] / box.height;
    const double a = 2.0 * std::numbers::pi * (d.x[i] / box.width - share * up), b = 2.0 * std::numbers::pi * up;
    const Vec2 along{std::cos(a), std::sin(a)}, back{std::cos(b), std::sin(b)};
    Vec2 wave{1.0, 0.0};
    double m = 0.0;
    for (std::size_t n = 0; n < sums.size(); ++n) {
      wave = {wave.x * along.x - wave.y * along.y, wave.x * along.y + wave.y * along.x};
      // The offset is at most half a width: m follows by at most 1.
      const double next = std::floor(static_cast<double>(n + 1) * share + 0.5);
      if (next != m) {
        const double side = next > m ? back.y : -back.y;
        wave = {wave.x * back.x - wave.y * side, wave.x * side + wave.y * back.x};
        m = next;
      }
      real[n] += wave.x;
      imaginary[n] += wave.y;
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
  if (box.shear.acts()) {
    add_sheared_axis(structure.along_x, d, order, box);
  } else {
    add_axis(structure.along_x, d.x, order, box.width);
  }
  add_axis(structure.along_y, d.y, order, box.height);
  ++structure.samples;
}

}  // namespace carom
