#include "core/measure/structure_factor.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

// Disks processed together: the powers for one disk are a chain of dependent products.
constexpr std::size_t disks_at_once = 8;

// The coordinates of disks in periods, in their order.
struct SharesOfPeriod {
  std::array<double, disks_at_once> share{};
  std::size_t count = 0;
  bool full() const { return count == disks_at_once; }
  void add(double next) { share[count++] = next; }
};

// Sums of exp(i k x) over the disks, wave number by wave number.
class Waves {
 public:
  explicit Waves(std::size_t count) : real_(count, 0.0), imaginary_(count, 0.0) {}

  // Takes the powers of one exponential for each disk: a sine and a cosine for each wave number would cost many times
  // more. Empties the shares.
  void take(SharesOfPeriod& of) {
    std::array<double, disks_at_once> c{}, s{}, re{}, im{};  // 0 where there is no disk
    for (std::size_t k = 0; k < of.count; ++k) {
      const double phase = 2.0 * std::numbers::pi * of.share[k];
      c[k] = std::cos(phase);
      s[k] = std::sin(phase);
      re[k] = 1.0;
    }
    for (std::size_t n = 0; n < real_.size(); ++n) {
      double real = real_[n], imaginary = imaginary_[n];
      for (std::size_t k = 0; k < disks_at_once; ++k) {
        const double next = re[k] * c[k] - im[k] * s[k];
        im[k] = re[k] * s[k] + im[k] * c[k];
        re[k] = next;
      }
      for (std::size_t k = 0; k < disks_at_once; ++k) {
        real += re[k];
        imaginary += im[k];
      }
      real_[n] = real;
      imaginary_[n] = imaginary;
    }
    of.count = 0;
  }

  // Along x in a sheared box: exp(i n a) exp(i m b), with the phase a of the wave vector (2 pi / width) (1, -offset /
  // height), which follows the flow, and the phase b of (0, 2 pi / height), which turns the wave back to the axis.
  void add_sheared(double x, double y, const Domain& box) {
    const double share = box.shear.offset / box.width;
    const double up = y / box.height;
    const double a = 2.0 * std::numbers::pi * (x / box.width - share * up), b = 2.0 * std::numbers::pi * up;
    const Vec2 along{std::cos(a), std::sin(a)}, back{std::cos(b), std::sin(b)};
    Vec2 wave{1.0, 0.0};
    double m = 0.0;
    for (std::size_t n = 0; n < real_.size(); ++n) {
      wave = {wave.x * along.x - wave.y * along.y, wave.x * along.y + wave.y * along.x};
      // The offset is at most half a width, so m changes by at most 1.
      const double next = std::floor(static_cast<double>(n + 1) * share + 0.5);
      if (next != m) {
        const double side = next > m ? back.y : -back.y;
        wave = {wave.x * back.x - wave.y * side, wave.x * side + wave.y * back.x};
        m = next;
      }
      real_[n] += wave.x;
      imaginary_[n] += wave.y;
    }
  }

  void add_to(std::vector<double>& sums, Count disks) const {
    for (std::size_t n = 0; n < sums.size(); ++n) {
      sums[n] += (real_[n] * real_[n] + imaginary_[n] * imaginary_[n]) / static_cast<double>(disks);
    }
  }

 private:
  std::vector<double> real_, imaginary_;
};

}  // namespace

void add_structure(StructureFactor& structure, const DisksInPieces& disks, const Domain& box) {
  if (disks.size() == 0) return;
  Waves x(structure.along_x.size()), y(structure.along_y.size());
  SharesOfPeriod of_width, of_height;
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      box.shear.acts() ? x.add_sheared(d.x[i], d.y[i], box) : of_width.add(d.x[i] / box.width);
      of_height.add(d.y[i] / box.height);
      if (of_width.full()) x.take(of_width);
      if (of_height.full()) y.take(of_height);
    }
  });
  x.take(of_width);
  y.take(of_height);
  x.add_to(structure.along_x, disks.size());
  y.add_to(structure.along_y, disks.size());
  ++structure.samples;
}

}  // namespace carom
