// Random numbers drawn by vector kernels have the bits of core's formula for single disks.
#include "parallel/kicks/draw_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.hpp"

namespace carom {
namespace {

constexpr std::uint64_t seed = 0x123456789abcdef0;

struct Deviates {
  std::vector<double> x, y;
  double largest2 = 0.0;  // of the x^2 + y^2 drawn
};

// Ids in no order. Columns start with old numbers, which must be overwritten or added to as told.
std::vector<DiskId> ids_of(std::size_t n) {
  std::vector<DiskId> id(n);
  for (std::size_t i = 0; i < n; ++i) id[i] = static_cast<DiskId>(i * 2654435761U);
  return id;
}
Deviates before(std::size_t n) {
  return {std::vector<double>(n, 1.5), std::vector<double>(n, -0.25)};
}

struct Draw {
  Stream stream;
  std::uint64_t step;
  double scale;
  bool accumulate;
};

Deviates expected(const std::vector<DiskId>& id, const Draw& draw, std::size_t begin, std::size_t end) {
  Deviates v = before(id.size());
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 r = normals(seed, draw.stream, id[i], draw.step);
    v.x[i] = draw.accumulate ? v.x[i] + draw.scale * r.x : draw.scale * r.x;
    v.y[i] = draw.accumulate ? v.y[i] + draw.scale * r.y : draw.scale * r.y;
    v.largest2 = std::max(v.largest2, v.x[i] * v.x[i] + v.y[i] * v.y[i]);
  }
  return v;
}

// ctest runs this test twice, once with CAROM_KERNELS=baseline.
TEST(DrawKernels, DrawTheBitsOfTheDeviates) {
  const std::vector<DiskId> id = ids_of(20'003);
  for (const Draw& draw :
       {Draw{Stream::brownian, 0, 7.75, false}, Draw{Stream::brownian, 7, 0.3, true},
        Draw{Stream::thermostat, 7, 1.0, false}, Draw{Stream::thermostat, (std::uint64_t{5} << 32U) + 3, 0.1, true}}) {
    for (const auto& [begin, end] : {std::pair{0UL, id.size()}, {1UL, 4UL}, {17UL, 17UL}, {3UL, 9'001UL}}) {
      Deviates v = before(id.size());
      v.largest2 = choose_draw_kernels().normals(
          {v.x.data(), v.y.data(), id.data(), seed, draw.stream, draw.step, draw.scale, draw.accumulate}, begin, end);
      const Deviates want = expected(id, draw, begin, end);
      EXPECT_EQ(v.x, want.x) << draw.step << ' ' << begin;
      EXPECT_EQ(v.y, want.y) << draw.step << ' ' << begin;
      EXPECT_EQ(v.largest2, want.largest2) << draw.step << ' ' << begin;
    }
  }
}

TEST(DrawKernels, DrawTheBitsOfTheUniforms) {
  const std::vector<DiskId> id = ids_of(1'003);
  for (const std::uint64_t step : {std::uint64_t{0}, std::uint64_t{7}, (std::uint64_t{5} << 32U) + 3}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{7}, id.size()}) {
      std::vector<double> u(id.size(), -1.0);
      choose_draw_kernels().uniforms({u.data(), id.data(), seed, Stream::thermostat_choice, step}, count);
      for (std::size_t i = 0; i < id.size(); ++i) {
        EXPECT_EQ(u[i], i < count ? uniforms(seed, Stream::thermostat_choice, id[i], step).a : -1.0)
            << step << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace carom
