// When a falling disk touches something round: never later than it would overlap it.
#include "core/physics/obstacle_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// A disk that lies on something round and slides so slowly that gravity holds it there, v^2 < g_n r, would follow the
// circle; on its parabola it overlaps at once. So it touches again at once: the way that rounding leaves is what it may
// go.
TEST(FallPast, TouchesAtOnceWhereGravityPressesItOnSomethingRound) {
  const Gravity g(0.06);
  for (int k = 0; k < 2000; ++k) {
    const double angle = 0.3 + 0.0012 * k;  // from the horizontal
    const double contact = 0.2794163464055573 * (1.0 + 1e-3 * k);
    const double along = (k % 2 == 0 ? 0.9 : -0.5) * std::sqrt(0.06 * std::sin(angle) * contact);
    const FallPast fall{contact * std::cos(angle),
                        contact * std::sin(angle),
                        -along * std::sin(angle),
                        along * std::cos(angle),
                        g,
                        contact};
    const double t = std::min(time_to_contact_falling(fall, 10.0), 0.1);
    for (const double share : {0.25, 0.5, 1.0}) {
      EXPECT_GT(fall.gap2(share * t), -1e-12 * contact * contact) << "case " << k << ", time " << share * t;
    }
  }
}

}  // namespace
}  // namespace carom
