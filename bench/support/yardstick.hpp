// The program with which the speed of the exact method is compared: an event-driven simulation as in textbooks
// (Rapaport, The Art of Molecular Dynamics Simulation, ch. 14). It has one binary heap of all predicted events, which a
// counter for each disk invalidates lazily; cells with lists and cell-crossing events; a separate time for every disk;
// neither threads nor windows. Equal disks of mass 1 in a periodic box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <stdexcept>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom::bench {

class Yardstick {
 public:
  // Disks keep their order of storage. Throws if the scene needs features that are missing here.
  Yardstick(const Disks& disks, const Domain& box) : width_(box.width), height_(box.height) {
    const bool equal = disks.radius.empty() && disks.mass.empty();
    const double diameter = 2.0 * disks.common_radius;
    columns_ = static_cast<std::uint32_t>(std::floor(width_ / diameter));
    rows_ = static_cast<std::uint32_t>(std::floor(height_ / diameter));
    if (!equal || !box.periodic_x() || !box.periodic_y() || columns_ < 4 || rows_ < 4) {
      throw std::invalid_argument("the yardstick wants equal disks in a periodic box of four diameters or more");
    }
    diameter2_ = diameter * diameter;
    cell_width_ = width_ / columns_;
    cell_height_ = height_ / rows_;
    first_.assign(static_cast<std::size_t>(columns_) * rows_, none);
    for (std::size_t k = 0; k < disks.size(); ++k) {
      balls_.push_back({disks.x[k], disks.y[k], disks.vx[k], disks.vy[k], 0.0, 0, 0, 0, none, none});
    }
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      Ball& b = balls_[i];
      b.column = std::min(static_cast<std::uint32_t>(b.x / cell_width_), columns_ - 1);
      b.row = std::min(static_cast<std::uint32_t>(b.y / cell_height_), rows_ - 1);
      enter_cell(i);
    }
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      predict_crossing(i);
      for (int row = -1; row <= 1; ++row) {
        for (int column = -1; column <= 1; ++column) predict_with_cell(i, column, row, i);
      }
    }
  }

  // Processes the events up to time t.
  void run_until(double t) {
    while (!events_.empty() && events_.top().time <= t) handle_next();
    time_ = t;
  }

  // Processes events until `count` further collisions have occurred.
  void run_collisions(Count count) {
    const Count until = collisions_ + count;
    while (collisions_ < until && !events_.empty()) handle_next();
  }

  Count collisions() const { return collisions_; }
  double time() const { return time_; }

  // Writes positions and velocities at time() into the columns of `disks`, in their order of storage.
  void write_to(Disks& disks) const {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      Ball b = balls_[i];
      move_to(b, time_);
      disks.x[i] = b.x;
      disks.y[i] = b.y;
      disks.vx[i] = b.vx;
      disks.vy[i] = b.vy;
    }
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  // Stands for a partner: the disk crosses a border of its cell.
  static constexpr std::uint32_t to_left = none - 4, to_right = none - 3, to_bottom = none - 2, to_top = none - 1;

  struct Ball {
    double x, y, vx, vy;
    double time;                   // the time at which the disk is at x, y
    std::uint32_t count;           // number of its collisions: an event with another count is invalid
    std::uint32_t column, row;     // its cell
    std::uint32_t next, previous;  // in the list of the cell
  };

  struct Event {
    double time;
    std::uint32_t i, j;
    std::uint32_t count_i, count_j;
  };
  struct Later {
    bool operator()(const Event& a, const Event& b) const { return a.time > b.time; }
  };

  static void move_to(Ball& b, double t) {
    b.x += b.vx * (t - b.time);
    b.y += b.vy * (t - b.time);
    b.time = t;
  }

  std::uint32_t& first_of(const Ball& b) { return first_[static_cast<std::size_t>(b.row) * columns_ + b.column]; }

  void enter_cell(std::uint32_t i) {
    Ball& b = balls_[i];
    std::uint32_t& first = first_of(b);
    b.next = first;
    b.previous = none;
    if (first != none) balls_[first].previous = i;
    first = i;
  }

  void leave_cell(std::uint32_t i) {
    const Ball& b = balls_[i];
    (b.previous != none ? balls_[b.previous].next : first_of(b)) = b.next;
    if (b.next != none) balls_[b.next].previous = b.previous;
  }

  void handle_next() {
    const Event e = events_.top();
    events_.pop();
    if (balls_[e.i].count != e.count_i) return;
    const bool crossing = e.j >= to_left;
    if (!crossing && balls_[e.j].count != e.count_j) return;
    time_ = e.time;
    if (crossing) {
      cross(e.i, e.j);
    } else {
      collide(e.i, e.j);
    }
  }

  void collide(std::uint32_t i, std::uint32_t j) {
    Ball& a = balls_[i];
    Ball& b = balls_[j];
    move_to(a, time_);
    move_to(b, time_);
    const double dx = nearest_image(b.x - a.x, width_);
    const double dy = nearest_image(b.y - a.y, height_);
    const double exchanged = ((b.vx - a.vx) * dx + (b.vy - a.vy) * dy) / (dx * dx + dy * dy);
    a.vx += exchanged * dx;
    a.vy += exchanged * dy;
    b.vx -= exchanged * dx;
    b.vy -= exchanged * dy;
    ++a.count;
    ++b.count;
    ++collisions_;
    for (const std::uint32_t k : {i, j}) {
      predict_crossing(k);
      for (int row = -1; row <= 1; ++row) {
        for (int column = -1; column <= 1; ++column) predict_with_cell(k, column, row, none);
      }
    }
  }

  // Moves the disk into the next cell; beyond that are three cells whose disks have not yet been tested against this
  // one.
  void cross(std::uint32_t i, std::uint32_t border) {
    leave_cell(i);
    Ball& b = balls_[i];
    move_to(b, time_);
    const int step_x = border == to_left ? -1 : border == to_right ? 1 : 0;
    const int step_y = border == to_bottom ? -1 : border == to_top ? 1 : 0;
    if (step_x < 0 && b.column == 0) b.x += width_;
    if (step_x > 0 && b.column == columns_ - 1) b.x -= width_;
    if (step_y < 0 && b.row == 0) b.y += height_;
    if (step_y > 0 && b.row == rows_ - 1) b.y -= height_;
    b.column = next_to(b.column, step_x, columns_);
    b.row = next_to(b.row, step_y, rows_);
    enter_cell(i);
    predict_crossing(i);
    for (int k = -1; k <= 1; ++k) {
      if (step_x != 0) predict_with_cell(i, step_x, k, none);
      if (step_y != 0) predict_with_cell(i, k, step_y, none);
    }
  }

  static std::uint32_t next_to(std::uint32_t k, int step, std::uint32_t count) {
    if (step < 0) return k == 0 ? count - 1 : k - 1;
    if (step > 0) return k + 1 == count ? 0 : k + 1;
    return k;
  }

  void predict_crossing(std::uint32_t i) {
    const Ball& b = balls_[i];
    const double ahead_x = b.vx > 0.0 ? (b.column + 1) * cell_width_ - b.x : b.x - b.column * cell_width_;
    const double ahead_y = b.vy > 0.0 ? (b.row + 1) * cell_height_ - b.y : b.y - b.row * cell_height_;
    const double t_x = b.vx != 0.0 ? std::max(ahead_x, 0.0) / std::abs(b.vx) : HUGE_VAL;
    const double t_y = b.vy != 0.0 ? std::max(ahead_y, 0.0) / std::abs(b.vy) : HUGE_VAL;
    if (t_x == HUGE_VAL && t_y == HUGE_VAL) return;
    const std::uint32_t border = t_x < t_y ? (b.vx > 0.0 ? to_right : to_left) : (b.vy > 0.0 ? to_top : to_bottom);
    events_.push({b.time + std::min(t_x, t_y), i, border, b.count, 0});
  }

  // Predicts with the disks of a cell next to i's own whose number is below `end`.
  void predict_with_cell(std::uint32_t i, int column_step, int row_step, std::uint32_t end) {
    const Ball& a = balls_[i];
    const std::size_t row = next_to(a.row, row_step, rows_);
    for (std::uint32_t j = first_[row * columns_ + next_to(a.column, column_step, columns_)]; j != none;
         j = balls_[j].next) {
      if (j != i && j < end) predict_pair(i, j);
    }
  }

  // Disk i is at the present time. The form of the quadratic's root avoids cancellation.
  void predict_pair(std::uint32_t i, std::uint32_t j) {
    const Ball& a = balls_[i];
    Ball b = balls_[j];
    move_to(b, a.time);
    const double dvx = b.vx - a.vx;
    const double dvy = b.vy - a.vy;
    const double dx = nearest_image(b.x - a.x, width_);
    const double dy = nearest_image(b.y - a.y, height_);
    const double approach = dx * dvx + dy * dvy;
    if (approach >= 0.0) return;
    const double gap2 = dx * dx + dy * dy - diameter2_;
    const double discriminant = approach * approach - (dvx * dvx + dvy * dvy) * gap2;
    if (discriminant < 0.0) return;
    const double t = std::max(0.0, gap2 / (std::sqrt(discriminant) - approach));
    events_.push({a.time + t, i, j, a.count, b.count});
  }

  double width_, height_, diameter2_ = 0.0;
  std::uint32_t columns_ = 0, rows_ = 0;
  double cell_width_ = 0.0, cell_height_ = 0.0;
  double time_ = 0.0;
  Count collisions_ = 0;
  std::vector<Ball> balls_;
  std::vector<std::uint32_t> first_;  // the first disk in the list of each cell
  std::priority_queue<Event, std::vector<Event>, Later> events_;
};

}  // namespace carom::bench
