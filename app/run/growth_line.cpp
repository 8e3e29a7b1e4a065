#include "app/run/growth_line.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/cli/status_line.hpp"
#include "core/base/short_number.hpp"

namespace carom {

std::function<void(const GrowthProgress&)> growth_line(bool wanted) {
  if (!wanted) return {};
  return [line = std::make_shared<StatusLine>(true)](const GrowthProgress& p) {
    if (p.final_packing_fraction == 0.0 || !line->due()) return;  // disks are placed at random, which is quick
    line->show(fmt::format("growing: packing fraction {:.5f} of {:g}  {} steps  {} collisions", p.packing_fraction,
                           p.final_packing_fraction, p.steps, short_number(static_cast<double>(p.collisions))));
  };
}

}  // namespace carom
