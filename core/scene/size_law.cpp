#include "core/scene/size_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

// Chooses a value with a probability in proportion to its weight, by u uniform in (0, 1).
double choose(const SizeLaw& law, double u) {
  double all = 0.0;
  for (const double weight : law.weights) all += weight;
  double rest = u * all;
  std::size_t chosen = 0;
  for (std::size_t k = 0; k < law.weights.size(); ++k) {
    if (law.weights[k] == 0.0) continue;
    chosen = k;  // the last value with a weight, in case rounding leaves a remainder
    rest -= law.weights[k];
    if (rest < 0.0) break;
  }
  return law.values[chosen];
}

double draw(const SizeLaw& law, std::uint64_t seed, Stream stream, DiskId id, Count k) {
  switch (law.kind) {
    case SizeLaw::Kind::list:
      return law.values[k];
    case SizeLaw::Kind::uniform:
      // Rounding of high - low may carry the sum past high.
      return std::min(law.high, law.low + (law.high - law.low) * uniforms(seed, stream, id, 0).a);
    case SizeLaw::Kind::normal:
      return law.value + law.deviation * bounded_normal(seed, stream, id);
    case SizeLaw::Kind::lognormal:
      return law.value * deterministic_exp(law.deviation * bounded_normal(seed, stream, id));
    case SizeLaw::Kind::choice:
      return choose(law, uniforms(seed, stream, id, 0).a);
    case SizeLaw::Kind::constant:
    case SizeLaw::Kind::from_other:
      break;
  }
  return law.value;
}

}  // namespace

DiskSize draw_size(const SizeLaw& radius, const SizeLaw& mass, std::uint64_t seed, Stream radius_stream,
                   Stream mass_stream, DiskId id, Count k) {
  DiskSize size;
  if (radius.kind == SizeLaw::Kind::from_other) {
    size.mass = draw(mass, seed, mass_stream, id, k);
    size.radius = std::sqrt(size.mass / (std::numbers::pi * radius.density));
    return size;
  }
  size.radius = draw(radius, seed, radius_stream, id, k);
  size.mass = mass.kind == SizeLaw::Kind::from_other ? std::numbers::pi * mass.density * (size.radius * size.radius)
                                                     : draw(mass, seed, mass_stream, id, k);
  return size;
}

SizeRange size_range(const SizeLaw& law) {
  switch (law.kind) {
    case SizeLaw::Kind::uniform:
      return {law.low, law.high};
    case SizeLaw::Kind::normal:
      return {law.value - most_deviations * law.deviation, law.value + most_deviations * law.deviation};
    case SizeLaw::Kind::lognormal: {
      const double factor = deterministic_exp(most_deviations * law.deviation);
      return {law.value / factor, law.value * factor};
    }
    case SizeLaw::Kind::list:
    case SizeLaw::Kind::choice: {
      if (law.values.empty()) return {};
      const auto [low, high] = std::minmax_element(law.values.begin(), law.values.end());
      return {*low, *high};
    }
    case SizeLaw::Kind::constant:
    case SizeLaw::Kind::from_other:
      break;
  }
  return {law.value, law.value};
}

bool same_for_all(const SizeLaw& radius, const SizeLaw& mass) {
  const auto fixed = [](const SizeLaw& law) {
    return law.kind == SizeLaw::Kind::constant || law.kind == SizeLaw::Kind::from_other;
  };
  return fixed(radius) && fixed(mass);
}

SizeSummary summarise_sizes(const DiskGroup& group, std::uint64_t seed, DiskId first_id) {
  SizeSummary sum;
  if (group.count == 0) return sum;
  const auto size_at = [&](Count k) {
    return draw_size(group.radius, group.mass, seed, Stream::radius, Stream::mass, first_id + static_cast<DiskId>(k),
                     k);
  };
  sum.smallest = sum.largest = size_at(0);
  if (same_for_all(group.radius, group.mass)) {
    const double r = sum.smallest.radius, count = static_cast<double>(group.count);
    sum.radius_squared = count * (r * r);
    sum.mass = count * sum.smallest.mass;
    sum.inverse_mass = count / sum.smallest.mass;
    return sum;
  }
  for (Count k = 0; k < group.count; ++k) {
    const DiskSize size = size_at(k);
    sum.smallest.radius = std::min(sum.smallest.radius, size.radius);
    sum.largest.radius = std::max(sum.largest.radius, size.radius);
    sum.smallest.mass = std::min(sum.smallest.mass, size.mass);
    sum.largest.mass = std::max(sum.largest.mass, size.mass);
    sum.radius_squared += size.radius * size.radius;
    sum.mass += size.mass;
    sum.inverse_mass += 1.0 / size.mass;
  }
  return sum;
}

// Each law is monotonic.
std::pair<DiskSize, DiskSize> ends_of_sizes(const SizeLaw& radius, const SizeLaw& mass) {
  const auto end_of = [](SizeLaw law, bool high) {
    if (law.kind == SizeLaw::Kind::from_other) return law;
    const SizeRange range = size_range(law);
    law.kind = SizeLaw::Kind::constant;
    law.value = high ? range.high : range.low;
    return law;
  };
  const auto size = [&](bool high) {
    return draw_size(end_of(radius, high), end_of(mass, high), 0, Stream::radius, Stream::mass, 0, 0);
  };
  return {size(false), size(true)};
}

}  // namespace carom
