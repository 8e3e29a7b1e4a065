#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/types.hpp"
#include "tests/fuzz_scenes/random_restitution.hpp"
#include "tests/fuzz_scenes/wide_draft.hpp"

namespace carom::fuzz {

namespace {

Vec2 anywhere(Dice& dice, const WideDraft& draft) {
  const double x = draft.width * dice.unit();
  return {x, draft.height * dice.unit()};
}

// A place mostly within the box, otherwise on a side or in a corner.
Vec2 place_of_obstacle(Dice& dice, const WideDraft& draft) {
  Vec2 place = anywhere(dice, draft);
  if (dice.chance(0.25)) place.x = dice.pick({0.0, draft.width, 0.5 * draft.width});
  if (dice.chance(0.25)) place.y = dice.pick({0.0, draft.height, 0.5 * draft.height});
  return place;
}

// A wall from one side to the other, straight or nearly so.
std::vector<Vec2> wall_through(Dice& dice, const WideDraft& draft) {
  const bool along_x = dice.chance(0.5);
  const double from = dice.chance(0.2) ? dice.pick({0.0, 0.5, 1.0}) : dice.unit();
  const double to = dice.chance(0.5) ? from : std::clamp(from + dice.in(-0.3, 0.3), 0.0, 1.0);
  const double end = dice.chance(0.5) ? 1.0 : dice.in(0.5, 1.0);
  if (along_x) return {{0.0, draft.height * from}, {draft.width * end, draft.height * to}};
  return {{draft.width * from, 0.0}, {draft.width * to, draft.height * end}};
}

std::vector<Vec2> zigzag(Dice& dice, const WideDraft& draft) {
  std::vector<Vec2> points;
  const std::size_t count = 3 + dice.below(5);
  const bool along_x = dice.chance(0.5);
  for (std::size_t k = 0; k < count; ++k) {
    const double along = static_cast<double>(k) / static_cast<double>(count - 1);
    const double across = dice.unit();
    points.push_back(along_x ? Vec2{draft.width * along, draft.height * across}
                             : Vec2{draft.width * across, draft.height * along});
  }
  return points;
}

// Walls around a part of the box, closed or with one side missing.
std::vector<Vec2> room(Dice& dice, const WideDraft& draft) {
  const double x = draft.width * dice.in(0.0, 0.4), x1 = draft.width * dice.in(0.6, 1.0);
  const double y = draft.height * dice.in(0.0, 0.4), y1 = draft.height * dice.in(0.6, 1.0);
  std::vector<Vec2> points{{x, y}, {x1, y}, {x1, y1}, {x, y1}};
  if (dice.chance(0.5)) points.push_back({x, y});
  return points;
}

std::vector<Vec2> wall_points(Dice& dice, const WideDraft& draft) {
  const double u = dice.unit();
  if (u < 0.35) return wall_through(dice, draft);
  if (u < 0.55) return zigzag(dice, draft);
  if (u < 0.65) return room(dice, draft);
  const Vec2 from = anywhere(dice, draft);
  if (u < 0.85) return {from, anywhere(dice, draft)};
  const double length = draft.radius * dice.pick({0.01, 1.0, 3.0});
  return {from,
          {std::clamp(from.x + length * dice.in(-1.0, 1.0), 0.0, draft.width),
           std::clamp(from.y + length * dice.in(-1.0, 1.0), 0.0, draft.height)}};
}

struct Room {
  double low = 0.0, high = 0.0;
};

// How far the wall may move along an axis; without limit across periodic sides.
Room room_of(const std::vector<Vec2>& points, double Vec2::*axis, double size, bool periodic) {
  if (periodic) return {-size, size};
  const auto [least, most] = std::minmax_element(points.begin(), points.end(),
                                                 [&](const Vec2& a, const Vec2& b) { return a.*axis < b.*axis; });
  return {-((*least).*axis), size - (*most).*axis};
}

std::string motion_line(Dice& dice, const WideDraft& draft, const std::vector<Vec2>& points) {
  if (draft.diffusion > 0.0 || !dice.chance(0.4)) return "";
  const Room x = room_of(points, &Vec2::x, draft.width, draft.periodic_x);
  const Room y = room_of(points, &Vec2::y, draft.height, draft.periodic_y);
  const double speed = draft.fastest() * dice.decades(-2, 1);
  if (dice.chance(0.5)) {
    const double ax = dice.chance(0.3) ? 0.0 : std::min(-x.low, x.high) * dice.decades(-3, 0) * 0.09;
    const double ay = dice.chance(0.3) ? 0.0 : std::min(-y.low, y.high) * dice.decades(-3, 0) * 0.09;
    const double size = std::max(ax, ay);
    if (!(size > 0.0)) return "";
    return fmt::format("motion = {{ vibrate = [{}, {}], period = {}, shape = \"{}\" }}\n", rounded(ax), rounded(-ay),
                       rounded(6.0 * size / speed), dice.chance(0.5) ? "sine" : "parabola");
  }
  const auto within = [&](double v, const Room& free, bool periodic) {
    if (periodic || !(draft.t_end > 0.0)) return v;
    return std::clamp(v, 0.95 * free.low / draft.t_end, 0.95 * free.high / draft.t_end);
  };
  const double vx = rounded(within(speed * dice.in(-1.0, 1.0), x, draft.periodic_x));
  const double vy = rounded(within(speed * dice.in(-1.0, 1.0), y, draft.periodic_y));
  return vx != 0.0 || vy != 0.0 ? fmt::format("motion = {{ velocity = [{}, {}] }}\n", vx, vy) : "";
}

}  // namespace

std::string wide_walls_text(Dice& dice, const WideDraft& draft) {
  if (!dice.chance(0.4)) return "";
  std::string text;
  for (std::size_t k = 1 + dice.below(3); k > 0; --k) {
    const std::vector<Vec2> points = wall_points(dice, draft);
    text += "[[walls]]\npoints = [";
    for (const Vec2& p : points) text += fmt::format("[{}, {}], ", p.x, p.y);
    text += "]\n";
    if (!draft.for_oracle && draft.diffusion == 0.0 && dice.chance(0.1)) {
      text += "kind = \"sink\"\n";
    } else if (dice.chance(0.3)) {
      text += fmt::format("restitution = {}\n", random_restitution(dice));
    }
    text += motion_line(dice, draft, points);
  }
  return text;
}

std::string wide_obstacles_text(Dice& dice, const WideDraft& draft) {
  if (!dice.chance(0.4)) return "";
  std::string places, radii;
  const std::size_t count = dice.chance(0.8) ? 1 + dice.below(6) : 20 + dice.below(60);
  double left = 0.25 * draft.width * draft.height;  // area left for obstacles
  for (std::size_t k = 0; k < count; ++k) {
    const double largest = std::min(0.7 * draft.narrow(), std::sqrt(left / 3.2));
    const double r = rounded(dice.chance(0.3) ? largest * dice.in(0.3, 1.0) : largest * dice.decades(-4, -1));
    left -= 3.15 * r * r;
    const Vec2 place = place_of_obstacle(dice, draft);
    places += fmt::format("[{}, {}], ", place.x, place.y);
    radii += fmt::format("{}, ", r);
    if (left < 0.01 * draft.width * draft.height) {
      return fmt::format("[[disks]]\nfixed = true\ncount = {}\npositions = [{}]\nradius = [{}]\n", k + 1, places,
                         radii);
    }
  }
  return fmt::format("[[disks]]\nfixed = true\ncount = {}\npositions = [{}]\nradius = [{}]\n", count, places, radii);
}

}  // namespace carom::fuzz
