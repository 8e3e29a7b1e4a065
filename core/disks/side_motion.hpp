// The prescribed motion of a side of the box.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/sine.hpp"

namespace carom {

// Place, speed and acceleration of a side, all towards the inside of the box.
struct SidePlace {
  double inset = 0.0;         // from the edge of the box; length, >= 0 but for rounding
  double speed = 0.0;         // length / time
  double acceleration = 0.0;  // length / time^2
  bool operator==(const SidePlace&) const = default;

  // The place a time t later, at constant acceleration.
  SidePlace after(double t) const {
    return {inset + (speed * t + 0.5 * acceleration * (t * t)), speed + acceleration * t, acceleration};
  }
};

// Lengths and speeds count towards the inside of the box.
struct SideMotion {
  enum class Kind : std::uint8_t {
    none,
    steady,     // at constant speed
    parabolas,  // up and down in pieces, each half a period long: nearly a sine, its speed continuous
    sine,
  };
  Kind kind = Kind::none;
  double inset = 0.0;      // at time 0, or at the middle of the vibration; length, >= 0 but for rounding
  double speed = 0.0;      // of a steady motion; length / time
  double amplitude = 0.0;  // of a vibration; length. Its sign is the direction in which it begins, < 0: outwards
  double period = 0.0;     // time
  double furthest = 0.0;   // largest inset until the run's end; length
  bool operator==(const SideMotion&) const = default;

  bool moves() const { return kind != Kind::none; }
  bool vibrates() const { return kind == Kind::parabolas || kind == Kind::sine; }
  double half() const { return 0.5 * period; }

  double angular_frequency() const { return 6.28318530717958647693 / period; }

  // The number of the parabola at time t >= 0; where two of them meet, the later one. Other motions have one piece.
  double piece(double t) const {
    if (kind != Kind::parabolas) return 0.0;
    double k = std::floor(t / half());
    while (k > 0.0 && k * half() > t) k -= 1.0;
    while ((k + 1.0) * half() <= t) k += 1.0;
    return k;
  }
  // The end of the piece at time t; time.
  double piece_end(double t) const { return kind == Kind::parabolas ? (piece(t) + 1.0) * half() : HUGE_VAL; }

  // Does a parabola begin at time t? Windows end there.
  bool turns_at(double t) const { return kind == Kind::parabolas && piece(t) * half() == t; }

  SidePlace at(double t) const {
    if (kind == Kind::none) return {};
    if (kind == Kind::steady) return {inset + speed * t, speed, 0.0};
    if (kind == Kind::sine) return swung(sine_in_period(t, period), 0.0, amplitude * angular_frequency());
    const double k = piece(t);
    const double since = t - k * half();
    // The parabola 4 a t (h - t) / h^2, which reaches the amplitude a in the middle of the half period h; every second
    // one has the opposite sign.
    const bool turned = k - 2.0 * std::floor(0.5 * k) != 0.0;
    const double curvature = (turned ? -4.0 : 4.0) * amplitude / (half() * half());
    return {inset + curvature * (since * (half() - since)), curvature * (half() - 2.0 * since), -2.0 * curvature};
  }

  // The mean of its inset from one time to a later one, 0 <= from <= to.
  double mean_inset(double from, double to) const {
    const double middle = 0.5 * (from + to);
    if (!vibrates() || !(from < to)) return at(middle).inset;
    if (kind == Kind::parabolas) return inset + (way_of_parabolas(to) - way_of_parabolas(from)) / (to - from);
    // The integral of sin(w t) over a time 2 d about `middle` is 2 sin(w middle) sin(w d) / w.
    const double half_angle = 0.5 * angular_frequency() * (to - from);
    const double waves = sine_in_period(middle, period).sine * sine_in_period(to - from, 2.0 * period).sine;
    return inset + amplitude * waves / half_angle;
  }

  // The place of a sine a time t >= 0 after the place `from`.
  SidePlace swung(const SidePlace& from, double t) const {
    return swung(sine_in_period(t, period), from.inset - inset, from.speed);
  }

  // The largest and the least inset until t_end; length.
  double largest_inset(double t_end) const {
    return vibrates() ? inset + std::abs(amplitude) : std::fmax(inset, inset + speed * t_end);
  }
  double least_inset(double t_end) const {
    return vibrates() ? inset - std::abs(amplitude) : std::fmin(inset, inset + speed * t_end);
  }
  double largest_speed() const {
    if (kind == Kind::none) return 0.0;
    if (kind == Kind::sine) return std::abs(amplitude) * angular_frequency();
    return kind == Kind::parabolas ? 4.0 * std::abs(amplitude) / half() : std::abs(speed);
  }
  double largest_acceleration() const {
    if (kind == Kind::sine) return std::abs(amplitude) * angular_frequency() * angular_frequency();
    return kind == Kind::parabolas ? 8.0 * std::abs(amplitude) / (half() * half()) : 0.0;
  }

  // The first time until t_end at which the side is further in than `limit` (length), to rounding; HUGE_VAL: none.
  double first_time_beyond(double limit, double t_end) const {
    if (kind == Kind::none) return HUGE_VAL;
    if (at(0.0).inset > limit) return 0.0;
    // From `before` to `after` the side moves inwards all the time, and a vibration reaches its furthest first at
    // `after`.
    double before = vibrates() && amplitude < 0.0 ? half() : 0.0;
    double after = vibrates() ? before + 0.5 * half() : t_end;
    if (!(at(after).inset > limit)) return HUGE_VAL;
    for (double middle = 0.5 * (before + after); middle > before && middle < after; middle = 0.5 * (before + after)) {
      (at(middle).inset > limit ? after : before) = middle;
    }
    return after <= t_end ? after : HUGE_VAL;
  }

 private:
  // The integral of the displacement from the middle over the time from 0 to t, for parabolas; length time. The two
  // halves of a period cancel.
  double way_of_parabolas(double t) const {
    const double k = piece(t);
    const double since = t - k * half();
    const bool turned = k - 2.0 * std::floor(0.5 * k) != 0.0;
    const double of_piece = 4.0 * amplitude * (since * since) * (0.5 * half() - since / 3.0) / (half() * half());
    return turned ? 2.0 / 3.0 * amplitude * half() - of_piece : of_piece;
  }

  // A sine that was `away` from its middle and had speed `v`, after this phase angle.
  SidePlace swung(const SineCosine& angle, double away, double v) const {
    const double w = angular_frequency();
    const double there = away * angle.cosine + v / w * angle.sine;
    return {inset + there, v * angle.cosine - away * w * angle.sine, -(w * w) * there};
  }
};

}  // namespace carom
