// Brownian velocities drawn by vectors: the bits of core's formula, disk by disk.
#include "parallel/stepping/brownian_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/physics/advance.hpp"

namespace carom {
namespace {

constexpr std::uint64_t seed = 0x123456789abcdef0;
constexpr double diffusion = 0.3;
constexpr double dt = 0.01;

struct Velocities {
  std::vector<double> vx, vy;
  double speed2 = 0.0;  // largest of those drawn
};

// Ids in no order, and old velocities that must not show unless they are added to.
std::vector<DiskId> ids_of(std::size_t n) {
  std::vector<DiskId> id(n);
  for (std::size_t i = 0; i < n; ++i) id[i] = static_cast<DiskId>(i * 2654435761U);
  return id;
}
Velocities before(std::size_t n) {
  return {std::vector<double>(n, 1.5), std::vector<double>(n, -0.25)};
}

Velocities expected(const std::vector<DiskId>& id, std::uint64_t step, bool accumulate, std::size_t begin,
                    std::size_t end) {
  Velocities v = before(id.size());
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 drawn = brownian_velocity(seed, id[i], step, diffusion, dt);
    v.vx[i] = accumulate ? v.vx[i] + drawn.x : drawn.x;
    v.vy[i] = accumulate ? v.vy[i] + drawn.y : drawn.y;
    v.speed2 = std::max(v.speed2, v.vx[i] * v.vx[i] + v.vy[i] * v.vy[i]);
  }
  return v;
}

// ctest runs this test twice, once with CAROM_KERNELS=baseline.
TEST(BrownianKernel, DrawsTheBitsOfTheFormula) {
  const std::vector<DiskId> id = ids_of(20'003);
  for (const std::uint64_t step : {std::uint64_t{0}, std::uint64_t{7}, (std::uint64_t{5} << 32U) + 3}) {
    for (const bool accumulate : {false, true}) {
      for (const auto& [begin, end] : {std::pair{0UL, id.size()}, {1UL, 4UL}, {17UL, 17UL}, {3UL, 9'001UL}}) {
        Velocities v = before(id.size());
        v.speed2 = choose_brownian_kernel()(
            {v.vx.data(), v.vy.data(), id.data(), seed, step, brownian_speed(diffusion, dt), accumulate}, begin, end);
        const Velocities want = expected(id, step, accumulate, begin, end);
        EXPECT_EQ(v.vx, want.vx) << step << ' ' << begin;
        EXPECT_EQ(v.vy, want.vy) << step << ' ' << begin;
        EXPECT_EQ(v.speed2, want.speed2) << step << ' ' << begin;
      }
    }
  }
}

}  // namespace
}  // namespace carom
