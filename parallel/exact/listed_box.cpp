#include "parallel/exact/listed_box.hpp"

namespace carom {

FixedPointPosition ListedBox::fixed_point(double x, double y) const {
  const auto units = [](double c, double its_unit, bool periodic) {
    const auto whole = static_cast<std::int64_t>(c / its_unit);
    return static_cast<std::uint32_t>(periodic ? whole : std::clamp(whole, std::int64_t{0}, std::int64_t{1} << 31));
  };
  return {units(x, unit.x, period.x > 0.0), units(y, unit.y, period.y > 0.0)};
}

}  // namespace carom
