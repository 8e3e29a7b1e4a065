#include "tests/fuzz_scenes/random_disks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/types.hpp"

namespace carom::fuzz {

namespace {

constexpr double pi = std::numbers::pi;

struct Sizes {
  std::string text;
  double smallest = 0.0, largest = 0.0;  // radius
  double lightest = 0.0, heaviest = 0.0;
  double area = 0.0;  // mean area of a disk
};

struct Range {
  double low = 0.0, high = 0.0;
  std::string text() const {
    return low == high ? fmt::format("{}", low) : fmt::format("{{ uniform = [{}, {}] }}", low, high);
  }
};

// A single number, or a range whose ends have one of these ratios.
Range random_range(Dice& dice, double high, std::initializer_list<double> ratios) {
  const double top = rounded(high);
  const double ratio = dice.chance(0.5) ? 1.0 : dice.pick(ratios);
  return {ratio == 1.0 ? top : rounded(top / ratio), top};
}

// Radii from a distribution, all of them at most `largest`. Normal and lognormal sizes are cut off at four standard
// deviations.
Sizes random_distribution(Dice& dice, const Units& units, const Range& mass, double largest) {
  Sizes sizes{"", 0.0, largest, mass.low, mass.high, 0.0};
  const double middle = rounded(largest * dice.in(0.3, 0.5));
  if (dice.chance(0.4)) {
    const double small = rounded(largest * dice.in(0.1, 0.9));
    sizes.text = fmt::format("radius = {{ choice = [{}, {}], weights = [{}, 1] }}\n", small, middle, 1 + dice.below(5));
    sizes.smallest = std::min(small, middle);
  } else if (dice.chance(0.5)) {
    const double deviation = rounded(middle * dice.in(0.001, 0.2));
    sizes.text = fmt::format("radius = {{ normal = [{}, {}] }}\n", middle, deviation);
    sizes.smallest = middle - 4.0 * deviation;
  } else {
    const double sigma = rounded(dice.in(0.001, 0.17));  // exp(4 * 0.17) = 2
    sizes.text = fmt::format("radius = {{ lognormal = [{}, {}] }}\n", middle, sigma);
    sizes.smallest = middle * std::exp(-4.0 * sigma);
  }
  sizes.area = pi * 0.3 * largest * largest;
  const double density = rounded(units.mass / (pi * largest * largest));
  if (!dice.chance(0.3)) {
    sizes.text += fmt::format("mass = {}\n", mass.text());
    return sizes;
  }
  sizes.text += fmt::format("mass = {{ from_radius = {} }}\n", density);
  sizes.lightest = pi * density * sizes.smallest * sizes.smallest;
  sizes.heaviest = pi * density * largest * largest;
  return sizes;
}

Sizes random_laws(Dice& dice, const Units& units, double largest) {
  const Range mass = random_range(dice, units.mass * dice.in(0.5, 2.0), {1.0001, 3.0, 40.0, 1e4, 1e8});
  if (dice.chance(0.1)) {  // the radius follows from the mass
    const double density = rounded(mass.high / (pi * largest * largest) * 1.001);
    const double high = std::sqrt(mass.high / (pi * density));
    const double low = std::sqrt(mass.low / (pi * density));
    return {fmt::format("radius = {{ from_mass = {} }}\nmass = {}\n", density, mass.text()),
            low,
            high,
            mass.low,
            mass.high,
            0.5 * pi * (low * low + high * high)};
  }
  if (dice.chance(0.1)) return random_distribution(dice, units, mass, largest);
  const Range radius = random_range(dice, largest * dice.in(0.5, 0.999), {1.0001, 1.4, 5.0, 10.0});
  const double area = pi * (radius.low * radius.low + radius.low * radius.high + radius.high * radius.high) / 3.0;
  if (dice.chance(0.25)) {  // the mass follows from the radius
    const double density = rounded(units.mass / (pi * radius.high * radius.high));
    return {fmt::format("radius = {}\nmass = {{ from_radius = {} }}\n", radius.text(), density),
            radius.low,
            radius.high,
            pi * density * radius.low * radius.low,
            pi * density * radius.high * radius.high,
            area};
  }
  return {fmt::format("radius = {}\nmass = {}\n", radius.text(), mass.text()),
          radius.low,
          radius.high,
          mass.low,
          mass.high,
          area};
}

std::string random_velocities(Dice& dice, const Units& units, std::size_t disks, double mass) {
  if (dice.chance(0.1)) return "";
  if (disks > 1 && dice.chance(0.5)) {
    return fmt::format("velocities = {{ maxwell = {} }}\n",
                       rounded(mass * units.speed * units.speed * dice.in(0.2, 2.0)));
  }
  return fmt::format("velocities = {{ uniform = {} }}\n", rounded(units.speed * dice.in(0.5, 2.0)));
}

std::string pairs_text(const std::vector<Vec2>& pairs) {
  std::string text;
  for (const Vec2& p : pairs) text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", p.x, p.y);
  return "[" + text + "]";
}

std::string numbers_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{}{}", text.empty() ? "" : ", ", x);
  return "[" + text + "]";
}

// Adds a group without lists to the crowd.
void add_group(Crowd& crowd, Dice& dice, const Units& units, std::size_t count, const char* positions, double largest) {
  const Sizes sizes = random_laws(dice, units, largest);
  const double mass = dice.chance(0.9) ? sizes.lightest : sizes.heaviest;
  const std::string name = dice.chance(0.2) ? fmt::format("name = \"group-{}\"\n", crowd.disks) : "";
  crowd.text += fmt::format("[[disks]]\n{}count = {}\npositions = \"{}\"\n{}{}", name, count, positions,
                            random_velocities(dice, units, count, mass), sizes.text);
  if (dice.chance(0.1)) {
    crowd.text +=
        fmt::format("drift = [{}, {}]\n", rounded(units.speed * dice.in(-1.0, 1.0)), rounded(0.3 * units.speed));
  }
  if (std::string_view(positions) != "growth") crowd.text += region_mark;
  crowd.smallest = crowd.disks == 0 ? sizes.smallest : std::min(crowd.smallest, sizes.smallest);
  crowd.largest = std::max(crowd.largest, sizes.largest);
  crowd.heaviest = std::max(crowd.heaviest, sizes.heaviest);
  crowd.area += static_cast<double>(count) * sizes.area;
  crowd.disks += count;
}

// One group on a lattice, or several at random.
void add_gas(Crowd& crowd, Dice& dice, const Units& units, std::size_t disks) {
  if (dice.chance(0.35)) {
    const bool square = dice.chance(0.5);
    add_group(crowd, dice, units, disks, square ? "square" : "hexagonal", units.length);
    const double equal = crowd.area / (static_cast<double>(disks) * pi * crowd.largest * crowd.largest);
    crowd.packing_fraction = equal * dice.in(0.1, square ? 0.74 : 0.86);
    return;
  }
  const std::size_t groups = std::min<std::size_t>(disks, 1 + dice.below(3));
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t count = g + 1 < groups ? 1 + dice.below(disks / groups) : disks / groups;
    const double largest = units.length * (g == 0 ? 1.0 : dice.in(0.1, 1.0));
    add_group(crowd, dice, units, count, "random", largest);
  }
  crowd.packing_fraction = dice.chance(0.1) ? dice.decades(-5, -1) : dice.in(0.1, 0.47);
}

void add_giants(Crowd& crowd, Dice& dice, const Units& units) {
  add_group(crowd, dice, units, 1 + dice.below(3), "random", units.length);
  const Units dust{units.length, units.mass * dice.pick({1.0, 1e-3, 1e-6}), units.speed};
  const std::size_t grains = 40 + dice.below(200);
  add_group(crowd, dice, dust, grains, "random", units.length * dice.pick({0.1, 0.03, 0.003}));
  crowd.packing_fraction = dice.in(0.05, 0.4);
}

// Disks that exactly touch each other, or walls, or both.
struct Shape {
  std::vector<Vec2> places;
  std::vector<double> radii;
  double width = 0.0, height = 0.0;  // size of the part used, from the corner of the box
};

Shape block_of(double r, std::size_t columns, std::size_t rows) {
  Shape shape;
  for (std::size_t k = 0; k < columns * rows; ++k) {
    const auto column = static_cast<double>(k % columns);
    const auto row = static_cast<double>(k / columns);
    shape.places.push_back({r + 2.0 * r * column, r + 2.0 * r * row});
  }
  shape.width = 2.0 * r * static_cast<double>(columns);
  shape.height = 2.0 * r * static_cast<double>(rows);
  return shape;
}

Shape heap_of(double r, std::size_t rows) {
  Shape shape;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto up = static_cast<double>(row);
    for (std::size_t k = 0; k + row < rows; ++k) {
      shape.places.push_back({r + r * up + 2.0 * r * static_cast<double>(k), r + r * std::sqrt(3.0) * up});
    }
  }
  shape.width = shape.height = 2.0 * r * static_cast<double>(rows);
  return shape;
}

// Unequal disks in a row, with centres at one height.
Shape chain_of(Dice& dice, double r, std::size_t disks) {
  Shape shape;
  for (std::size_t k = 0; k < disks; ++k) {
    shape.radii.push_back(r * dice.pick({1.0, 0.5, 0.25, 0.125, 0.3}));
    shape.width += k == 0 ? shape.radii[0] : shape.radii[k] + shape.radii[k - 1];
    shape.places.push_back({shape.width, r});
  }
  shape.width += shape.radii.back();
  shape.height = 2.0 * r;
  return shape;
}

// Disks in the corners of a box and along its walls.
Shape wallflowers_of(Dice& dice, double r) {
  Shape shape;
  shape.width = shape.height = 16.0 * r;
  const double far = shape.width - r;
  shape.places = {{r, r}, {far, far}, {r, far}, {far, r}, {r, 6.0 * r}, {8.0 * r, r}, {far, 8.0 * r}, {6.0 * r, far}};
  shape.places.resize(1 + dice.below(shape.places.size()));
  return shape;
}

// Positions and radii are whole multiples of half a radius: many events come at the same time, and passing disks touch.
Shape grid_of(Dice& dice, double r) {
  Shape shape;
  const std::size_t columns = 12 + dice.below(13);  // in half radii
  const std::size_t rows = 12 + dice.below(13);
  shape.width = 0.5 * r * static_cast<double>(columns);
  shape.height = 0.5 * r * static_cast<double>(rows);
  const auto is_free = [&](Vec2 place, double radius) {
    if (place.x + radius > shape.width || place.y + radius > shape.height) return false;
    for (std::size_t k = 0; k < shape.places.size(); ++k) {
      const double dx = place.x - shape.places[k].x, dy = place.y - shape.places[k].y;
      const double contact = radius + shape.radii[k];
      if (dx * dx + dy * dy < contact * contact * (1.0 - 1e-12)) return false;
    }
    return true;
  };
  const double share_of_small = dice.pick({0.0, 0.2});
  const std::size_t tries = 2 + dice.below(60);
  for (std::size_t k = 0; k < tries || shape.places.empty(); ++k) {
    const double radius = dice.chance(share_of_small) ? 0.5 * r : r;
    const Vec2 place{radius + 0.5 * r * static_cast<double>(dice.below(columns)),
                     radius + 0.5 * r * static_cast<double>(dice.below(rows))};
    if (!is_free(place, radius)) continue;
    shape.places.push_back(place);
    shape.radii.push_back(radius);
  }
  if (share_of_small == 0.0) shape.radii.clear();
  return shape;
}

Shape random_shape(Dice& dice, double r) {
  switch (dice.below(8)) {
    case 0:
      return block_of(r, 2 + dice.below(11), 1);
    case 1:
      return block_of(r, 1, 2 + dice.below(20));
    case 2: {
      const std::size_t columns = 2 + dice.below(5);
      return block_of(r, columns, 2 + dice.below(4));
    }
    case 3:
      return heap_of(r, 2 + dice.below(5));
    case 4:
      return chain_of(dice, r, 2 + dice.below(11));
    case 5:
      return wallflowers_of(dice, r);
    default:
      return grid_of(dice, r);
  }
}

std::vector<Vec2> listed_velocities(Dice& dice, const Units& units, std::size_t disks) {
  std::vector<Vec2> list(disks);
  const auto speed = [&] { return rounded(units.speed * dice.in(-1.0, 1.0)); };
  switch (dice.below(5)) {
    case 0: {  // one disk flies, the others are at rest
      const std::size_t first = dice.below(disks);
      list[first] = {speed(), dice.chance(0.5) ? 0.0 : speed()};
      break;
    }
    case 1:  // all have the same velocity: contacts without approach
      list.assign(disks, {speed(), speed()});
      break;
    case 2:
      for (Vec2& v : list) v = {speed(), speed()};
      break;
    case 3: {  // velocities on a grid, too
      const auto step = [&] { return units.speed * dice.pick({-1.0, -0.5, 0.0, 0.5, 1.0}); };
      for (Vec2& v : list) v = {step(), step()};
      break;
    }
    default:  // all are at rest
      break;
  }
  return list;
}

void add_touching(Crowd& crowd, Dice& dice, const Units& units) {
  const double r = units.length * dice.pick({1.0, 0.5, 0.25, 0.3});
  Shape shape = random_shape(dice, r);
  const std::size_t n = shape.places.size();
  const double room_x = r * dice.pick({0.0, 2.0, 4.0, 20.0, 0.001});
  const double room_y = r * (dice.chance(0.9) ? dice.pick({2.0, 4.0, 20.0}) : 0.0);
  crowd.width = std::max(4.0 * r, shape.width + room_x);
  crowd.height = std::max(4.0 * r, shape.height + room_y);
  if (dice.chance(0.3)) {  // away from the walls
    for (Vec2& p : shape.places)
      p = {p.x + 0.5 * (crowd.width - shape.width), p.y + 0.5 * (crowd.height - shape.height)};
  }
  std::vector<double> masses(n);
  for (double& m : masses) m = rounded(units.mass * (dice.chance(0.2) ? dice.decades(-6, 0) : 1.0));
  const std::vector<Vec2> velocities = listed_velocities(dice, units, n);
  crowd.at_rest = std::all_of(velocities.begin(), velocities.end(), [](const Vec2& v) { return v == Vec2{}; });
  const bool equal = dice.chance(0.5);
  crowd.text = fmt::format("[[disks]]\ncount = {}\npositions = {}\nvelocities = {}\nradius = {}\nmass = {}\n", n,
                           pairs_text(shape.places), pairs_text(velocities),
                           shape.radii.empty() ? fmt::format("{}", r) : numbers_text(shape.radii),
                           equal ? fmt::format("{}", masses[0]) : numbers_text(masses));
  crowd.disks = n;
  crowd.largest = r;
  crowd.smallest = shape.radii.empty() ? r : *std::min_element(shape.radii.begin(), shape.radii.end());
  crowd.heaviest = *std::max_element(masses.begin(), masses.end());
  crowd.area = static_cast<double>(n) * pi * r * r;
}

}  // namespace

std::string random_sizes(Dice& dice, const Units& units, double largest) {
  return random_laws(dice, units, largest).text;
}

Crowd random_gas(Dice& dice, std::size_t disks, const Units& units) {
  Crowd crowd;
  add_gas(crowd, dice, units, disks);
  return crowd;
}

Crowd random_crowd(Dice& dice, Cast cast, const Units& units) {
  Crowd crowd;
  switch (cast) {
    case Cast::gas:
      add_gas(crowd, dice, units, 10 + dice.below(200));
      break;
    case Cast::few:
      add_gas(crowd, dice, units, 1 + dice.below(8));
      crowd.packing_fraction = std::min(crowd.packing_fraction, dice.decades(-4, 0));
      break;
    case Cast::touching:
      add_touching(crowd, dice, units);
      break;
    case Cast::giants:
      add_giants(crowd, dice, units);
      break;
    case Cast::grown:
      add_group(crowd, dice, units, 5 + dice.below(50), "growth", units.length);
      crowd.packing_fraction = dice.in(0.2, 0.75);
      break;
    case Cast::crowd:
      add_gas(crowd, dice, units, 600 + dice.below(1800));
      break;
    case Cast::pile: {
      const char* const positions = dice.pick({"random", "square", "hexagonal"});
      add_group(crowd, dice, units, 5 + dice.below(60), positions, units.length);
      crowd.packing_fraction =
          dice.in(0.1, 0.45) * crowd.area / (static_cast<double>(crowd.disks) * pi * crowd.largest * crowd.largest);
      break;
    }
    case Cast::none:
      crowd.largest = crowd.smallest = units.length;
      crowd.heaviest = units.mass;
      break;
  }
  return crowd;
}

}  // namespace carom::fuzz
