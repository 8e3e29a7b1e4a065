// Compiled with -mavx2 on x86-64 (CMakeLists.txt); on other machines it calls the baseline.
#include "parallel/kicks/draw_kernels.hpp"

#if defined(__AVX2__)

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>

namespace carom {

namespace {

constexpr std::size_t lanes = 4;
constexpr int rounds = 10;
// Disks whose points are drawn together: they stay in the first-level cache. A multiple of the lanes.
constexpr std::size_t batch = 512;

inline __m256d all(double a) {
  return _mm256_set1_pd(a);
}
inline __m256i all(std::uint64_t a) {
  return _mm256_set1_epi64x(static_cast<long long>(a));
}

// Philox 4x32-10 (core/base/random.cpp) on four counters, each number in the lower half of a lane. The upper halves may
// hold anything: products leave them out.
class Philox {
 public:
  Philox(std::uint64_t seed, Stream stream, std::uint64_t step)
      : step_low_(all(step & 0xffffffffU)),
        step_high_(all(step >> 32)),
        stream_(static_cast<std::uint32_t>(stream) << 8U) {
    auto low = static_cast<std::uint32_t>(seed);
    auto high = static_cast<std::uint32_t>(seed >> 32);
    for (std::size_t k = 0; k < rounds; ++k) {
      key_low_[k] = all(std::uint64_t{low});
      key_high_[k] = all(std::uint64_t{high});
      low += 0x9E3779B9U;
      high += 0xBB67AE85U;
    }
  }

  // 52 random bits for each of two uniforms.
  struct Bits {
    __m256i a, b;
  };
  Bits operator()(__m256i id, std::uint32_t attempt) const {
    const __m256i multiplier0 = all(std::uint64_t{0xD2511F53U});
    const __m256i multiplier1 = all(std::uint64_t{0xCD9E8D57U});
    __m256i c0 = step_low_;
    __m256i c1 = step_high_;
    __m256i c2 = id;
    __m256i c3 = all(std::uint64_t{stream_ | (attempt & 0xffU)});
    for (std::size_t k = 0; k < rounds; ++k) {
      const __m256i product0 = _mm256_mul_epu32(multiplier0, c0);
      const __m256i product1 = _mm256_mul_epu32(multiplier1, c2);
      c0 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(product1, 32), c1), key_low_[k]);
      c2 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(product0, 32), c3), key_high_[k]);
      c1 = product1;
      c3 = product0;
    }
    return {joined(c0, c1), joined(c2, c3)};
  }

 private:
  // The upper 52 of the 64 bits of two halves.
  static __m256i joined(__m256i low, __m256i high) {
    return _mm256_srli_epi64(_mm256_blend_epi32(low, _mm256_slli_epi64(high, 32), 0xaa), 12);
  }

  __m256i step_low_, step_high_;
  std::uint32_t stream_;
  __m256i key_low_[rounds], key_high_[rounds];
};

// 2 u - 1 of the uniform u = (bits + 1/2) 2^-52: all these numbers are exact.
inline __m256d centred(__m256i bits) {
  const __m256d from_two = _mm256_castsi256_pd(_mm256_or_si256(bits, _mm256_castpd_si256(all(2.0))));
  return _mm256_add_pd(_mm256_sub_pd(from_two, all(3.0)), all(0x1p-52));
}

// deterministic_log of core/base/random.cpp, the same operations in the same order.
inline __m256d log_of(__m256d x) {
  // A fraction above that of sqrt(2), here 1.4142135623730951, carries into the exponent, and f is halved.
  constexpr std::uint64_t fraction = 0x000fffffffffffff;
  constexpr std::uint64_t of_root = 0x0006a09e667f3bcd;
  const __m256d one = all(1.0);
  const __m256i bits = _mm256_castpd_si256(x);
  const __m256i carried = _mm256_add_epi64(bits, all(fraction - of_root));
  const __m256i exponent = _mm256_andnot_si256(all(fraction), carried);
  const __m256d f = _mm256_castsi256_pd(_mm256_add_epi64(_mm256_sub_epi64(bits, exponent), _mm256_castpd_si256(one)));
  // The exponent in the lowest bits of 2^52.
  const __m256i biased = _mm256_or_si256(_mm256_srli_epi64(carried, 52), _mm256_castpd_si256(all(0x1p52)));
  const __m256d k = _mm256_sub_pd(_mm256_castsi256_pd(biased), all(0x1p52 + 1023.0));
  const __m256d s = _mm256_div_pd(_mm256_sub_pd(f, one), _mm256_add_pd(f, one));
  const __m256d s2 = _mm256_mul_pd(s, s);
  __m256d sum = all(0.0);
  for (int n = 23; n >= 3; n -= 2) sum = _mm256_mul_pd(_mm256_add_pd(sum, all(1.0 / n)), s2);
  const __m256d twice = _mm256_add_pd(s, s);
  const __m256d low = _mm256_add_pd(_mm256_mul_pd(twice, sum), _mm256_mul_pd(k, all(0x1.cf79abc9e3b3ap-40)));
  return _mm256_add_pd(_mm256_mul_pd(k, all(0x1.62e42fefa0000p-1)), _mm256_add_pd(twice, low));
}

// For each set of lanes, the bytes that put the numbers of those in it first.
constexpr auto packing = [] {
  std::array<std::array<std::uint8_t, 16>, 16> table{};
  for (unsigned bits = 0; bits < 16; ++bits) {
    std::size_t to = 0;
    for (unsigned lane = 0; lane < lanes; ++lane) {
      if ((bits >> lane & 1U) == 0) continue;
      for (unsigned byte = 0; byte < 4; ++byte) table[bits][to++] = static_cast<std::uint8_t>(4 * lane + byte);
    }
  }
  return table;
}();

// Points for a batch of disks, each uniform in the unit circle: disks whose point lay outside draw again. This is a
// loop of its own, as is the one that follows: the processor then has several fours to work on while it waits for one.
class Points {
 public:
  // The points of disks id[0] to id[n - 1], n <= batch.
  void draw(const Philox& philox, const DiskId* id, std::size_t n) {
    std::size_t outside = 0;
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) {
      const Four at = four_of(philox, load(id + i), 0);
      _mm256_store_pd(&a_[i], at.a);
      _mm256_store_pd(&b_[i], at.b);
      _mm256_store_pd(&q_[i], at.q);
      const __m128i number = _mm_add_epi32(_mm_set1_epi32(static_cast<int>(i)), _mm_setr_epi32(0, 1, 2, 3));
      outside += append(number, at.outside, &outside_[outside]);
    }
    std::array<std::uint32_t, 2 * lanes> rest{};
    for (std::size_t k = i; k < n; ++k) rest[k - i] = static_cast<std::uint32_t>(k);
    std::size_t left = draw_again(philox, id, 0, rest.data(), n - i);
    std::copy(rest.begin(), rest.begin() + left, &outside_[outside]);
    left += outside;
    for (std::uint32_t attempt = 1; left > 0; ++attempt) left = draw_again(philox, id, attempt, outside_.data(), left);
  }

  __m256d a(std::size_t i) const { return _mm256_load_pd(&a_[i]); }
  __m256d b(std::size_t i) const { return _mm256_load_pd(&b_[i]); }
  __m256d q(std::size_t i) const { return _mm256_load_pd(&q_[i]); }  // a a + b b

 private:
  struct Four {
    __m256d a, b, q;
    unsigned outside;  // a bit a lane
  };
  static Four four_of(const Philox& philox, __m128i id, std::uint32_t attempt) {
    const Philox::Bits bits = philox(_mm256_cvtepu32_epi64(id), attempt);
    const __m256d a = centred(bits.a);
    const __m256d b = centred(bits.b);
    const __m256d q = _mm256_add_pd(_mm256_mul_pd(a, a), _mm256_mul_pd(b, b));
    return {a, b, q, static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(q, all(1.0), _CMP_GE_OQ)))};
  }

  static __m128i load(const std::uint32_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }

  // Writes those of the four numbers that are in the set, and anything behind them; returns how many there are. There
  // is no branch, since it could not be predicted.
  static std::size_t append(__m128i number, unsigned set, std::uint32_t* to) {
    const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(packing[set].data()));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(number, order));
    return static_cast<std::size_t>(std::popcount(set));
  }

  // Draws again for the disks of a list, by fours; the last four are filled up with the last disk. Returns how many are
  // outside again; they are now the first ones of the list. The list has room for three more.
  std::size_t draw_again(const Philox& philox, const DiskId* id, std::uint32_t attempt, std::uint32_t* list,
                         std::size_t count) {
    if (count == 0) return 0;
    for (std::size_t k = 0; k + 1 < lanes; ++k) list[count + k] = list[count - 1];
    std::size_t outside = 0;
    for (std::size_t k = 0; k < count; k += lanes) {
      const __m128i number = load(list + k);
      const std::array<std::uint32_t, lanes> i{list[k], list[k + 1], list[k + 2], list[k + 3]};
      const Four at = four_of(philox, _mm_i32gather_epi32(reinterpret_cast<const int*>(id), number, 4), attempt);
      scatter(at.a, i, a_);
      scatter(at.b, i, b_);
      scatter(at.q, i, q_);
      const unsigned used = count - k >= lanes ? 15U : (1U << (count - k)) - 1U;
      outside += append(number, at.outside & used, list + outside);
    }
    return outside;
  }

  using Column = std::array<double, batch>;
  static void scatter(__m256d v, const std::array<std::uint32_t, lanes>& i, Column& column) {
    alignas(32) std::array<double, lanes> values;
    _mm256_store_pd(values.data(), v);
    for (std::size_t lane = 0; lane < lanes; ++lane) column[i[lane]] = values[lane];
  }

  alignas(32) Column a_, b_, q_;
  std::array<std::uint32_t, batch + 2 * lanes> outside_;  // disks without a point
};

// The deviates of up to four disks from their points; returns their x^2 + y^2. count < lanes: only the first are
// read and written, the other lanes are 0.
__m256d set_deviates(const NormalDraws& in, std::size_t i, const Points& points, std::size_t k, std::size_t count) {
  const __m256d q = points.q(k);
  const __m256d scale = _mm256_sqrt_pd(_mm256_div_pd(_mm256_mul_pd(all(-2.0), log_of(q)), q));
  __m256d x = _mm256_mul_pd(all(in.scale), _mm256_mul_pd(points.a(k), scale));
  __m256d y = _mm256_mul_pd(all(in.scale), _mm256_mul_pd(points.b(k), scale));
  const __m256i used = _mm256_cmpgt_epi64(all(std::uint64_t{count}), _mm256_setr_epi64x(0, 1, 2, 3));
  if (in.accumulate) {
    x = _mm256_add_pd(_mm256_maskload_pd(in.x + i, used), x);
    y = _mm256_add_pd(_mm256_maskload_pd(in.y + i, used), y);
  }
  if (count >= lanes) {
    _mm256_storeu_pd(in.x + i, x);
    _mm256_storeu_pd(in.y + i, y);
  } else {
    _mm256_maskstore_pd(in.x + i, used, x);
    _mm256_maskstore_pd(in.y + i, used, y);
  }
  const __m256d largest2 = _mm256_add_pd(_mm256_mul_pd(x, x), _mm256_mul_pd(y, y));
  return _mm256_and_pd(largest2, _mm256_castsi256_pd(used));
}

}  // namespace

double draw_normals_avx2(const NormalDraws& in, std::size_t begin, std::size_t end) {
  const Philox philox(in.seed, in.stream, in.step);
  __m256d largest2 = all(0.0);
  Points points;
  for (; begin < end; begin += batch) {
    const std::size_t n = std::min(batch, end - begin);
    points.draw(philox, in.id + begin, n);
    for (std::size_t k = 0; k < n; k += lanes) {
      largest2 = _mm256_max_pd(largest2, set_deviates(in, begin + k, points, k, n - k));
    }
  }
  alignas(32) std::array<double, lanes> largest;
  _mm256_store_pd(largest.data(), largest2);
  return *std::max_element(largest.begin(), largest.end());
}

void draw_uniforms_avx2(const UniformDraws& in, std::size_t count) {
  const Philox philox(in.seed, in.stream, in.step);
  const auto draw = [&](__m128i id) {
    const __m256d twice = _mm256_add_pd(centred(philox(_mm256_cvtepu32_epi64(id), 0).a), all(1.0));  // exactly
    return _mm256_mul_pd(all(0.5), twice);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    _mm256_storeu_pd(in.u + i, draw(_mm_loadu_si128(reinterpret_cast<const __m128i*>(in.id + i))));
  }
  if (i == count) return;
  alignas(16) std::array<DiskId, lanes> id{};
  alignas(32) std::array<double, lanes> u;
  std::copy(in.id + i, in.id + count, id.begin());
  _mm256_store_pd(u.data(), draw(_mm_load_si128(reinterpret_cast<const __m128i*>(id.data()))));
  std::copy_n(u.begin(), count - i, in.u + i);
}

}  // namespace carom

#else

namespace carom {

double draw_normals_avx2(const NormalDraws& in, std::size_t begin, std::size_t end) {
  return draw_normals_baseline(in, begin, end);
}

void draw_uniforms_avx2(const UniformDraws& in, std::size_t count) {
  draw_uniforms_baseline(in, count);
}

}  // namespace carom

#endif
