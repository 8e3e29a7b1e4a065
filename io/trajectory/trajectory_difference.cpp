#include "io/trajectory/trajectory_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/input_message.hpp"
#include "core/base/same_bits.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

namespace {

// Times of frames are sums and products of steps: 0.3 may be 0.30000000000000004. Relative to the time: what is small
// depends on the scene's units, and a time of 0 is not rounded.
constexpr double time_slack = 1e-9;

// Does a difference of this size count? Called only for values of different bits; a difference that is not a number
// counts.
bool counts(const CompareRule& rule, double by) {
  return !rule.tolerance || !(by <= *rule.tolerance);
}

bool sees_all_frames(const CompareRule& rule) {
  return !rule.at && std::isinf(rule.from) && std::isinf(rule.to);
}

bool compares_all(const CompareRule& rule) {
  return std::find(rule.fields.begin(), rule.fields.end(), false) == rule.fields.end();
}

// Indices into compared_quantities.
constexpr std::size_t spin_at = 6, group_at = 7, image_x_at = 8, image_y_at = 9;

using Quantities = std::array<double, compared_quantities.size()>;

Quantities quantities_of(const TrajectoryFrame& frame, std::size_t i) {
  const Disks& d = frame.disks;
  const auto whole = [i](const auto& column) { return column.empty() ? 0.0 : static_cast<double>(column[i]); };
  return {d.x[i],
          d.y[i],
          d.vx[i],
          d.vy[i],
          d.radius_of(i),
          d.mass_of(i),
          d.spin_of(i),
          whole(frame.group),
          whole(frame.image_x),
          whole(frame.image_y)};
}

// The difference in rounds of two disks whose coordinates differ by `apart` = a - b: of two disks close to each other
// across a side coordinates differ by a period, and rounds by one in the opposite direction.
double rounds_between(double rounds, double apart, double period) {
  return std::abs(rounds + std::round((apart - nearest_image(apart, period)) / period));
}

double distance(const Domain& box, std::size_t quantity, const Quantities& a, const Quantities& b) {
  double d = a[quantity] - b[quantity];
  if (quantity == 0 && box.periodic_x()) d = nearest_image(d, box.width);
  if (quantity == 1 && box.periodic_y()) d = nearest_image(d, box.height);
  if (quantity == image_x_at && box.periodic_x()) return rounds_between(d, a[0] - b[0], box.width);
  if (quantity == image_y_at && box.periodic_y()) return rounds_between(d, a[1] - b[1], box.height);
  return std::abs(d);
}

// Does a difference of one disk count? For rounds, too, the tolerance is a length; groups are not numbers.
bool counts(const CompareRule& rule, const Domain& box, std::size_t quantity, double by) {
  if (quantity == group_at) return true;
  const double period = quantity == image_x_at ? box.width : quantity == image_y_at ? box.height : 1.0;
  return counts(rule, by * period);
}

// The frames of a file that match a rule, one after another.
class ChosenFrames {
 public:
  ChosenFrames(std::string path, const CompareRule& rule)
      : path_(std::move(path)), rule_(rule), reader_(open_trajectory(path_)) {}

  bool next() {
    const bool more = rule_.at ? next_nearest() : next_within();
    if (!more && count == 0) fail_without_frames();
    if (!more) return false;
    ++count;
    time = frame.time;
    return true;
  }

  TrajectoryFrame frame;
  double time = 0.0;  // of the last matching frame
  Count number = 0;   // of the frame in its file, from 1
  Count count = 0;    // of matching frames so far

 private:
  bool read(TrajectoryFrame& into) {
    if (!reader_->read(into)) return false;
    if (read_++ == 0) first_ = into.time;
    last_ = into.time;
    return true;
  }

  bool next_within() {
    while (read(frame)) {
      number = read_;
      const double slack = time_slack * std::abs(frame.time);
      if (frame.time > rule_.to + slack) return false;
      if (frame.time >= rule_.from - slack) return true;
    }
    return false;
  }

  bool next_nearest() {
    if (count > 0) return false;
    double nearest = std::numeric_limits<double>::infinity();
    for (TrajectoryFrame read_now; read(read_now);) {
      const double off = std::abs(read_now.time - *rule_.at);
      if (off >= nearest) break;
      nearest = off;
      number = read_;
      std::swap(frame, read_now);
    }
    const double slack = time_slack * std::abs(*rule_.at);
    return read_ > 0 && *rule_.at >= first_ - slack && *rule_.at <= last_ + slack;
  }

  [[noreturn]] void fail_without_frames() const {
    if (read_ == 0) fail_input(path_, "holds no frames", "expected a trajectory");
    const std::string wanted =
        rule_.at ? fmt::format("at t = {:g}", *rule_.at) : fmt::format("from t = {:g} to {:g}", rule_.from, rule_.to);
    fail_input(path_, fmt::format("has no frame {}", wanted),
               fmt::format("expected {} within t = {:g} to {:g}", rule_.at ? "--at" : "--times", first_, last_));
  }

  std::string path_;
  const CompareRule& rule_;
  std::unique_ptr<TrajectoryReader> reader_;
  Count read_ = 0;
  double first_ = 0.0, last_ = 0.0;
};

class Comparison {
 public:
  Comparison(const CompareRule& rule, TrajectoryDifference& result) : rule_(rule), result_(result) {}

  bool saw_disks() const { return saw_disks_; }
  bool saw_spins() const { return saw_spins_; }
  bool lacks_rounds() const { return lacks_rounds_; }

  // Both frames have their disks in order of id.
  void compare(const TrajectoryFrame& a, const TrajectoryFrame& b, Count number) {
    saw_disks_ = saw_disks_ || !a.disks.empty() || !b.disks.empty();
    saw_spins_ = saw_spins_ || !a.disks.spin.empty() || !b.disks.spin.empty();
    has_rounds_ = !a.image_x.empty() && !b.image_x.empty();
    lacks_rounds_ = lacks_rounds_ || (!has_rounds_ && !a.disks.empty() && !b.disks.empty());
    place_ = {};
    place_.frame = number;
    place_.time = a.time;
    box_ = &a.box;
    const double apart = std::abs(a.time - b.time);
    if (!same_bits(a.time, b.time) && counts(rule_, apart)) note({number, a.time, 0, "time", a.time, b.time, apart});
    if (compares_all(rule_)) compare_boxes(a, b);
    std::size_t i = 0, j = 0;
    while (i < a.disks.size() || j < b.disks.size()) {
      const bool a_left = i < a.disks.size(), b_left = j < b.disks.size();
      if (a_left && b_left && a.disks.id[i] == b.disks.id[j]) {
        compare_disk(a, i++, b, j++);
        continue;
      }
      const bool only_in_a = a_left && (!b_left || a.disks.id[i] < b.disks.id[j]);
      const double all_a = static_cast<double>(a.disks.size()), all_b = static_cast<double>(b.disks.size());
      note({number, a.time, only_in_a ? a.disks.id[i++] : b.disks.id[j++], "disks", all_a, all_b,
            std::abs(all_a - all_b)});
    }
  }

 private:
  void note(const Difference& found) {
    if (!result_.first) result_.first = found;
  }

  // The same disks in another box are another state.
  void compare_boxes(const TrajectoryFrame& a, const TrajectoryFrame& b) {
    const auto see = [&](const char* quantity, double of_a, double of_b) {
      const double by = std::abs(of_a - of_b);
      if (!same_bits(of_a, of_b) && counts(rule_, by)) note({place_.frame, a.time, 0, quantity, of_a, of_b, by});
    };
    see("width", a.box.width, b.box.width);
    see("height", a.box.height, b.box.height);
    const auto see_sides = [&](const char* quantity, bool of_a, bool of_b) {
      if (of_a != of_b) note({place_.frame, a.time, 0, quantity, of_a ? 1.0 : 0.0, of_b ? 1.0 : 0.0, 1.0});
    };
    see_sides("periodic_x", a.box.periodic_x(), b.box.periodic_x());
    see_sides("periodic_y", a.box.periodic_y(), b.box.periodic_y());
  }

  bool compares(std::size_t quantity) const {
    if (!rule_.fields[quantity]) return false;
    if (quantity < image_x_at) return true;
    return has_rounds_ && (sees_all_frames(rule_) || !compares_all(rule_));
  }

  void compare_disk(const TrajectoryFrame& a, std::size_t i, const TrajectoryFrame& b, std::size_t j) {
    const Quantities values_a = quantities_of(a, i);
    const Quantities values_b = quantities_of(b, j);
    Difference place = place_;
    place.id = a.disks.id[i];
    for (std::size_t q = 0; q < values_a.size(); ++q) {
      if (!compares(q)) continue;
      const double by = distance(*box_, q, values_a, values_b);
      if (q < image_x_at ? same_bits(values_a[q], values_b[q]) : by == 0.0) continue;
      place.quantity = compared_quantities[q];
      place.a = values_a[q];
      place.b = values_b[q];
      place.by = by;
      if (counts(rule_, *box_, q, by)) note(place);
      auto& largest = result_.largest[q];
      if (!largest || place.by > largest->by || std::isnan(place.by)) largest = place;
    }
  }

  const CompareRule& rule_;
  TrajectoryDifference& result_;
  Difference place_;
  const Domain* box_ = nullptr;
  bool saw_disks_ = false, saw_spins_ = false;
  bool has_rounds_ = false, lacks_rounds_ = false;
};

// Is the quantity requested by its name? If all fields are compared, quantities that neither file has do not matter.
bool asks_for(const CompareRule& rule, std::size_t quantity) {
  return rule.fields[quantity] && !compares_all(rule);
}

}  // namespace

TrajectoryDifference compare_trajectories(const std::string& path_a, const std::string& path_b,
                                          const CompareRule& rule) {
  ChosenFrames a(path_a, rule), b(path_b, rule);
  TrajectoryDifference result;
  Comparison comparison(rule, result);
  while (true) {
    const bool more_a = a.next(), more_b = b.next();
    if (more_a && more_b) comparison.compare(a.frame, b.frame, a.number);
    if (!more_a && !more_b) break;
  }
  const auto fail_fields = [&](const char* what) {
    fail_input(fmt::format("{} and {}", path_a, path_b), what, "expected other --fields");
  };
  if (asks_for(rule, spin_at) && comparison.saw_disks() && !comparison.saw_spins()) {
    fail_fields("neither has spins, so that they cannot be compared");
  }
  if ((asks_for(rule, image_x_at) || asks_for(rule, image_y_at)) && comparison.lacks_rounds()) {
    fail_fields("not both have images (rounds across periodic sides), so that these cannot be compared");
  }
  result.frames_a = a.count;
  result.frames_b = b.count;
  if (a.count != b.count && !result.first) {
    const double all_a = static_cast<double>(a.count), all_b = static_cast<double>(b.count);
    const ChosenFrames& longer = a.count > b.count ? a : b;
    result.first =
        Difference{std::min(a.count, b.count) + 1, longer.time, 0, "frames", all_a, all_b, std::abs(all_a - all_b)};
  }
  return result;
}

}  // namespace carom
