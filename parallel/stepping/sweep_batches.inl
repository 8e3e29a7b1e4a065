// The kernels over batches of supports, compiled once for every instruction set. Operation by operation as relax,
// relax_forward, relax_back, extrapolate_impulses and extrapolate_velocity (core/physics/support_solver.hpp).
#pragma once

#include "parallel/stepping/four_doubles.inl"
#include "parallel/stepping/sweep_kernel.hpp"

namespace carom {

namespace {

static_assert(lanes == batch_lanes);

inline Doubles choose(Longs truth, Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_ia32_blendvpd256(b, a, __builtin_bit_cast(Doubles, truth));
#else
  return __builtin_bit_cast(Doubles, (truth & as_longs(a)) | (~truth & as_longs(b)));
#endif
}

// b if either is NaN.
inline Doubles larger(Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_maxpd256(a, b));
#else
  return choose(a > b, a, b);
#endif
}

inline Doubles magnitude(Doubles a) {
  constexpr long long but_sign = 0x7fffffffffffffff;
  return __builtin_bit_cast(Doubles, as_longs(a) & Longs{but_sign, but_sign, but_sign, but_sign});
}

// Velocities of four disks.
struct Velocities4 {
  Doubles x, y;
};

inline Velocities4 gather(const double* v, const std::uint32_t* at) {
#if defined(__AVX__)
  const auto of = [&](std::size_t k) { return _mm_loadu_pd(v + at[k]); };
  const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(of(0)), of(2), 1);
  const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(of(1)), of(3), 1);
  return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
#else
  return {Doubles{v[at[0]], v[at[1]], v[at[2]], v[at[3]]},
          Doubles{v[at[0] + 1U], v[at[1] + 1U], v[at[2] + 1U], v[at[3] + 1U]}};
#endif
}

inline void scatter(double* v, const std::uint32_t* at, const Velocities4& values) {
#if defined(__AVX__)
  const __m256d even = _mm256_unpacklo_pd(values.x, values.y);
  const __m256d odd = _mm256_unpackhi_pd(values.x, values.y);
  _mm_storeu_pd(v + at[0], _mm256_castpd256_pd128(even));
  _mm_storeu_pd(v + at[1], _mm256_castpd256_pd128(odd));
  _mm_storeu_pd(v + at[2], _mm256_extractf128_pd(even, 1));
  _mm_storeu_pd(v + at[3], _mm256_extractf128_pd(odd, 1));
#else
  for (std::size_t k = 0; k < lanes; ++k) {
    v[at[k]] = values.x[k];
    v[at[k] + 1U] = values.y[k];
  }
#endif
}

// relax of a batch.
inline Doubles relax(const SupportBatch& b, double* v, double* impulses) {
  Velocities4 first = gather(v, b.v1);
  Velocities4 second = gather(v, b.v2);
  const Doubles nx = load(b.nx);
  const Doubles ny = load(b.ny);
  const Doubles inverse1 = load(b.inverse1);
  const Doubles inverse2 = load(b.inverse2);
  const Doubles first_along = first.x * nx + first.y * ny;
  const Doubles second_along = choose(inverse2 == all(0.0), -load(b.wall_speed), second.x * nx + second.y * ny);
  const Doubles impulse = load(impulses);
  const Doubles now = larger(impulse - load(b.effective) * (second_along - first_along), all(0.0));
  const Doubles change = now - impulse;
  store(impulses, now);
  first.x -= change * (nx * inverse1);
  first.y -= change * (ny * inverse1);
  second.x += change * (nx * inverse2);
  second.y += change * (ny * inverse2);
  // The first disk is written last: at a wall both are the same disk.
  scatter(v, b.v2, second);
  scatter(v, b.v1, first);
  return change;
}

inline double largest_of(Doubles v, double least) {
  double largest = least;
  for (std::size_t k = 0; k < lanes; ++k) largest = v[k] > largest ? v[k] : largest;
  return largest;
}

template <Sweep sweep, Watch watch>
void sweep_in_range(const SweepInput& input, std::size_t begin, std::size_t end, CycleFigures* figures) {
  const SweepInput in = input;  // by itself, so that no store can change it
  Doubles largest = all(0.0);
  Doubles strain = all(0.0);
  for (std::size_t n = begin; n < end; ++n) {
    const std::size_t at = sweep == Sweep::forward ? n : begin + (end - 1 - n);
    const SupportBatch& b = in.batch[at];
    const std::size_t k = lanes * at;
    if constexpr (sweep == Sweep::forward && watch == Watch::all) store(in.before + k, load(in.impulse + k));
    const Doubles changed = relax(b, in.v, in.impulse + k);
    if constexpr (watch != Watch::nothing) largest = larger(magnitude(changed) / load(b.effective), largest);
    if constexpr (sweep == Sweep::back && watch == Watch::all) {
      const Doubles impulse = load(in.impulse + k);
      const Doubles change = impulse - load(in.before + k);
      const Doubles by_mass = change / load(b.effective);
      strain = larger(magnitude(by_mass) / load(in.contact_distance + k), strain);
      store(in.before + k, change * by_mass);
      store(in.ahead + k, (impulse - load(in.last + k)) * by_mass);
    }
  }
  if constexpr (watch == Watch::nothing) return;
  figures->largest = largest_of(largest, figures->largest);
  figures->strain = largest_of(strain, figures->strain);
}

template <Sweep sweep>
void sweep_watched(const SweepInput& in, Watch watch, std::size_t begin, std::size_t end, CycleFigures* figures) {
  switch (watch) {
    case Watch::nothing:
      return sweep_in_range<sweep, Watch::nothing>(in, begin, end, figures);
    case Watch::largest:
      return sweep_in_range<sweep, Watch::largest>(in, begin, end, figures);
    case Watch::all:
      return sweep_in_range<sweep, Watch::all>(in, begin, end, figures);
  }
}

void relax_batches(const SweepInput& in, Sweep sweep, Watch watch, std::size_t begin, std::size_t end,
                   CycleFigures* figures) {
  if (sweep == Sweep::forward) return sweep_watched<Sweep::forward>(in, watch, begin, end, figures);
  sweep_watched<Sweep::back>(in, watch, begin, end, figures);
}

void extrapolate_batches(const SweepInput& input, std::size_t begin, std::size_t end, double momentum) {
  const SweepInput in = input;
  const Doubles share = all(momentum);
  for (std::size_t k = lanes * begin; k < lanes * end; k += lanes) {
    const Doubles impulse = load(in.impulse + k);
    if (momentum != 0.0) store(in.impulse + k, impulse + share * (impulse - load(in.last + k)));
    store(in.last + k, impulse);
  }
}

void extrapolate_velocities(const SweepInput& input, const std::uint16_t* contacts, std::size_t begin, std::size_t end,
                            double momentum) {
  using Two = double __attribute__((vector_size(16)));
  double* const v = input.v;
  double* const last = input.last_v;
  const Two share{momentum, momentum};
  for (std::size_t i = begin; i < end; ++i) {
    if (contacts[i] == 0) continue;
    Two now;
    Two before;
    __builtin_memcpy(&now, v + 2 * i, sizeof now);
    __builtin_memcpy(&before, last + 2 * i, sizeof before);
    __builtin_memcpy(last + 2 * i, &now, sizeof now);
    if (momentum == 0.0) continue;
    now = now + share * (now - before);
    __builtin_memcpy(v + 2 * i, &now, sizeof now);
  }
}

}  // namespace

}  // namespace carom
