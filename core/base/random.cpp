#include "core/base/random.hpp"

#include <Random123/philox.h>

#include <bit>
#include <cmath>

namespace carom {

namespace {

// Counter layout: 64 bits of step, 32 of disk id, 24 of stream and 8 of attempt. The key is the seed.
r123::Philox4x32::ctr_type philox(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t step,
                                  std::uint32_t attempt) {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(step >> 32),
                                            id, (static_cast<std::uint32_t>(stream) << 8) | (attempt & 0xffU)}};
  const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  return r123::Philox4x32()(counter, key);
}

// 52 random bits, centred in their interval: never 0, never 1, exact in a double.
double to_uniform(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t bits = ((static_cast<std::uint64_t>(high) << 32) | low) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace

TwoUniforms uniforms(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t step, std::uint32_t attempt) {
  const auto r = philox(seed, stream, id, step, attempt);
  return {to_uniform(r[0], r[1]), to_uniform(r[2], r[3])};
}

double deterministic_log(double x) {
  // x = 2^k f with f in [sqrt(1/2), sqrt(2)); log f = 2 atanh(s), s = (f - 1)/(f + 1), |s| < 0.1716: the odd series
  // in s converges by a factor 34 a term, so 12 terms reach 1e-19.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<int>((bits >> 52) & 0x7ffU) - 1023;
  double f = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (f > 1.4142135623730951) {
    f *= 0.5;
    ++exponent;
  }
  const double s = (f - 1.0) / (f + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int n = 23; n >= 3; n -= 2) sum = (sum + 1.0 / n) * s2;
  // ln 2 in two parts: the product of the first with any exponent is exact.
  constexpr double ln2_high = 0x1.62e42fefa0000p-1;
  constexpr double ln2_low = 0x1.cf79abc9e3b3ap-40;
  const double k = exponent;
  return k * ln2_high + (2.0 * s + (2.0 * s * sum + k * ln2_low));
}

double deterministic_exp(double x) {
  // x = k ln 2 + r with |r| < 0.347; the series of e^r, whose term r^14 / 14! is below 5e-18.
  constexpr double ln2_high = 0x1.62e42fefa0000p-1;
  constexpr double ln2_low = 0x1.cf79abc9e3b3ap-40;
  constexpr double per_ln2 = 1.4426950408889634;
  const double k = std::floor(x * per_ln2 + 0.5);
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0;
  for (int n = 13; n >= 1; --n) sum = 1.0 + r * sum / n;
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + static_cast<int>(k)) << 52);
}

double bounded_normal(std::uint64_t seed, Stream stream, DiskId id) {
  for (std::uint64_t draw = 0;; ++draw) {
    const double deviate = normals(seed, stream, id, draw).x;
    if (std::abs(deviate) <= most_deviations) return deviate;
  }
}

Vec2 normals(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t step) {
  // A point uniform in the unit disk; each attempt succeeds with probability pi / 4, so 256 of them fail with 1e-171.
  for (std::uint32_t attempt = 0;; ++attempt) {
    const TwoUniforms u = uniforms(seed, stream, id, step, attempt);
    const double a = 2.0 * u.a - 1.0;
    const double b = 2.0 * u.b - 1.0;
    const double q = a * a + b * b;
    if (q >= 1.0 || q == 0.0) continue;
    const double scale = std::sqrt(-2.0 * deterministic_log(q) / q);
    return {a * scale, b * scale};
  }
}

}  // namespace carom
