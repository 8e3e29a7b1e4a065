// The 2014 simulator in a few lines with its faults, as docs/original.md describes it (formulas (12) to (24), faults F1
// to F17). Tests of a fault run it to show that their assertion fails there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/physics/advance.hpp"
#include "core/scene/scene.hpp"

namespace carom::test::original {

struct Options {
  bool swap = false;    // (16) for any masses (F4)
  bool copies = true;   // pairs work on copies taken at detection, the last write wins (F3)
  bool bounces = true;  // false: only moves and boundary
};

// Cell of a corner, 1 to 5 along each side, counted from the left and from the top; nothing for a corner outside or on
// the left or top edge (F7, F13).
inline int cell_of(double x, double y, const Domain& box) {
  const double column = std::ceil(x / (box.width / 5.0));
  const double row = std::ceil((box.height - y) / (box.height / 5.0));
  if (!(column >= 1.0 && column <= 5.0 && row >= 1.0 && row <= 5.0)) return -1;
  return static_cast<int>(5.0 * (row - 1.0) + column - 1.0);
}

// Overlapping pairs as the cells give them: a pair once for each cell it shares (F14), none for cells between the
// corners (F6), no images (F10).
inline std::vector<std::pair<std::size_t, std::size_t>> pairs(const Disks& d, const Domain& box) {
  std::vector<std::vector<std::size_t>> members(25);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double r = d.radius_of(i);
    for (int corner = 0; corner < 4; ++corner) {
      const int cell = cell_of(d.x[i] + (corner % 2 == 0 ? -r : r), d.y[i] + (corner / 2 == 0 ? -r : r), box);
      if (cell < 0) continue;
      auto& list = members[static_cast<std::size_t>(cell)];
      if (list.empty() || list.back() != i) list.push_back(i);
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const auto& list : members) {
    for (std::size_t a = 0; a < list.size(); ++a) {
      for (std::size_t b = a + 1; b < list.size(); ++b) {
        const double dx = d.x[list[b]] - d.x[list[a]];
        const double dy = d.y[list[b]] - d.y[list[a]];
        const double reach = d.radius_of(list[a]) + d.radius_of(list[b]);
        if (std::sqrt(dx * dx + dy * dy) < reach) found.emplace_back(list[a], list[b]);
      }
    }
  }
  return found;
}

// The positive root of (12); 0 / 0 without relative motion (F9).
inline double back_up_time(const Disks& d, std::size_t i, std::size_t j) {
  const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
  const double dvx = d.vx[j] - d.vx[i], dvy = d.vy[j] - d.vy[i];
  const double reach = d.radius_of(i) + d.radius_of(j);
  const double a = dvx * dvx + dvy * dvy;
  const double b = dx * dvx + dy * dvy;
  const double c = dx * dx + dy * dy - reach * reach;
  return (b + std::sqrt(b * b - a * c)) / a;
}

// (17)-(19) with (23) or (16), whether the pair approaches or not (F8). from: where velocities are read.
inline void reverse(const Disks& from, Disks& d, std::size_t i, std::size_t j, double e, bool swap) {
  const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
  const double distance = std::sqrt(dx * dx + dy * dy);
  const double nx = dx / distance, ny = dy / distance;
  const double n1 = from.vx[i] * nx + from.vy[i] * ny, t1 = -from.vx[i] * ny + from.vy[i] * nx;
  const double n2 = from.vx[j] * nx + from.vy[j] * ny, t2 = -from.vx[j] * ny + from.vy[j] * nx;
  const double ratio = d.mass_of(j) / d.mass_of(i);
  const double w2 = swap ? n1 : (n1 * (1.0 + e) + n2 * (ratio - e)) / (1.0 + ratio);
  const double w1 = swap ? n2 : n1 + ratio * (n2 - w2);
  d.vx[i] = w1 * nx - t1 * ny, d.vy[i] = w1 * ny + t1 * nx;
  d.vx[j] = w2 * nx - t2 * ny, d.vy[j] = w2 * ny + t2 * nx;
}

inline void move(Disks& d, double t, const Gravity& g) {
  for (std::size_t i = 0; i < d.size(); ++i) drift<true>(d.x[i], d.y[i], d.vx[i], d.vy[i], t, g);
}

// Walls turn the velocity of whatever touches and leave it where it is (F11); periodic sides shift a disk when its edge
// crosses (F12).
inline void boundary(Disks& d, const Domain& box) {
  const auto side = [&](double& c, double& v, double r, double length, bool periodic, Side first) {
    const bool low = c - r <= 0.0;
    const bool high = c + r >= length;
    if (!low && !high) return;
    if (periodic) {
      c += low ? length : -length;
    } else {
      v = -box.restitution(first) * v;
    }
  };
  for (std::size_t i = 0; i < d.size(); ++i) {
    side(d.x[i], d.vx[i], d.radius_of(i), box.width, box.periodic_x(), Side::left);
    side(d.y[i], d.vy[i], d.radius_of(i), box.height, box.periodic_y(), Side::bottom);
  }
}

// One frame of Main. Returns by how much time advanced.
inline double frame(Disks& d, const Scene& scene, const Options& options = {}) {
  double advanced = scene.run.dt;
  move(d, scene.run.dt, scene.physics.gravity);
  const auto found = options.bounces ? pairs(d, scene.box) : decltype(pairs(d, scene.box)){};
  if (!found.empty()) {
    double back = back_up_time(d, found[0].first, found[0].second);
    for (const auto& [i, j] : found) back = std::max(back, back_up_time(d, i, j));
    move(d, -back, scene.physics.gravity);
    advanced -= back;
    const Disks copies = d;
    for (const auto& [i, j] : found) {
      reverse(options.copies ? copies : d, d, i, j, scene.physics.restitution, options.swap);
    }
  }
  boundary(d, scene.box);
  return advanced;
}

}  // namespace carom::test::original
