#include "parallel/exact/box_cut.hpp"

#include <algorithm>

namespace carom {

namespace {

// Steps along the side in which disks are counted.
constexpr std::size_t steps = 8192;

}  // namespace

double PartWork::at(double c) const {
  for (std::size_t part = 0; part < work.size(); ++part) {
    if (cut.owns(part, c)) return work[part];
  }
  return 1.0;
}

BoxCut cut_box(const Disks& disks, const Domain& box, std::size_t parts, double halo, const PartWork& before) {
  BoxCut cut;
  cut.along_x = box.width > box.height;
  cut.side = cut.along_x ? box.width : box.height;
  cut.periodic = cut.along_x ? box.periodic_x() : box.periodic_y();
  cut.halo = halo;
  std::vector<std::size_t> count(steps, 0);
  const double steps_a_length = static_cast<double>(steps) / cut.side;
  for (const double c : cut.coordinates(disks)) {
    ++count[static_cast<std::size_t>(std::clamp(c * steps_a_length, 0.0, static_cast<double>(steps - 1)))];
  }
  std::vector<double> work(steps);
  double all = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    work[k] = static_cast<double>(count[k]) * before.at((static_cast<double>(k) + 0.5) / steps_a_length);
    all += work[k];
  }
  cut.line.push_back(0.0);
  double done = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    const double end = static_cast<double>(k + 1) / steps_a_length;
    done += work[k];
    const bool is_full = done * static_cast<double>(parts) >= all * static_cast<double>(cut.line.size());
    const bool is_wide = end - cut.line.back() >= halo && cut.side - end >= halo;
    if (is_full && is_wide && cut.line.size() < parts) cut.line.push_back(end);
  }
  cut.line.push_back(cut.side);
  return cut;
}

}  // namespace carom
