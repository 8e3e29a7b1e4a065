#include "core/scene/scene_ranges.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom {

bool in_range(Dimension dimension, double value) {
  const Magnitudes& m = magnitudes_of(dimension);
  const double size = std::abs(value);
  return size == 0.0 || (size >= m.least && size <= m.most);
}

std::string expected_range(Dimension dimension) {
  const Magnitudes& m = magnitudes_of(dimension);
  const bool vowel = m.noun.starts_with('a') || m.noun.starts_with('e');
  const std::string noun = fmt::format("{} {}", vowel ? "an" : "a", m.noun);
  if (m.least == 0.0) return fmt::format("expected {} of at most {}", noun, m.most);
  return fmt::format("expected {} from {} to {}", noun, m.least, m.most);
}

}  // namespace carom
