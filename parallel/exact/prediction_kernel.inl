// The kernel, compiled once for every instruction set; CAROM_PREDICTION_KERNELS names the version. Four neighbours at a
// time, in the compilers' own vector types: on a machine without them the compiler splits them.

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "parallel/exact/prediction_kernel.hpp"

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

constexpr std::uint32_t lanes = 4;

static_assert(offsetof(PathSegment, vy) == offsetof(PathSegment, x) + 3 * sizeof(double));
static_assert(max_batch % lanes == 0);

// x, y, vx, vy of a segment.
inline Doubles load_motion(const PathSegment& p) {
  Doubles v;
  __builtin_memcpy(&v, &p.x, sizeof v);
  return v;
}

inline Doubles all(double a) {
  return Doubles{a, a, a, a};
}

// a where truth, else 0.
inline Doubles where(Longs truth, Doubles a) {
  return __builtin_bit_cast(Doubles, truth & __builtin_bit_cast(Longs, a));
}

inline Doubles choose(Longs truth, Doubles a, Doubles b) {
  return __builtin_bit_cast(Doubles, (truth & __builtin_bit_cast(Longs, a)) | (~truth & __builtin_bit_cast(Longs, b)));
}

inline Doubles root(Doubles v) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_sqrtpd256(v));
#else
  return Doubles{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline Doubles larger(Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_maxpd256(a, b));
#else
  return choose(a > b, a, b);
#endif
}

inline Doubles smaller(Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_minpd256(a, b));
#else
  return choose(a < b, a, b);
#endif
}

// Bit k is set where lane k is true.
inline unsigned bits_of(Longs truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(__builtin_bit_cast(Doubles, truth)));
#else
  const Longs weighted = truth & Longs{1, 2, 4, 8};
  return static_cast<unsigned>(weighted[0] | weighted[1] | weighted[2] | weighted[3]);
#endif
}

// The constants of a prediction in every lane.
struct Lanes {
  Doubles start, x, y, vx, vy;
  Doubles g, half_g, radius, contact2;
  Doubles width, height, half_width, half_height;
  Doubles close2, slow2;
};

inline Doubles nearest(Doubles d, Doubles period, Doubles half) {
  return (d - where(d > half, period)) + where(d < -half, period);
}

// core's collision_time(), operation by operation: carried_to, relative, time_to_contact, touching_time. Differences
// may have the other sign, which changes no bit of the time. lasting: set where a contact lasts.
template <bool gravity, bool unequal_radii>
inline Doubles four_contacts(const Lanes& own, const DiskRecord& f0, const DiskRecord& f1, const DiskRecord& f2,
                             const DiskRecord& f3, Longs& lasting) {
  const Doubles m0 = load_motion(f0.path);
  const Doubles m1 = load_motion(f1.path);
  const Doubles m2 = load_motion(f2.path);
  const Doubles m3 = load_motion(f3.path);
  const Doubles xs01 = __builtin_shufflevector(m0, m1, 0, 4, 2, 6);  // x0 x1 vx0 vx1
  const Doubles ys01 = __builtin_shufflevector(m0, m1, 1, 5, 3, 7);
  const Doubles xs23 = __builtin_shufflevector(m2, m3, 0, 4, 2, 6);
  const Doubles ys23 = __builtin_shufflevector(m2, m3, 1, 5, 3, 7);
  const Doubles vx = __builtin_shufflevector(xs01, xs23, 2, 3, 6, 7);
  Doubles vy = __builtin_shufflevector(ys01, ys23, 2, 3, 6, 7);
  const Doubles start = Doubles{f0.path.start, f1.path.start, f2.path.start, f3.path.start};
  const Doubles both = larger(start, own.start);
  const Doubles s = both - start;
  const Doubles t = both - own.start;
  const Doubles x = __builtin_shufflevector(xs01, xs23, 0, 1, 4, 5) + vx * s;
  Doubles rise = vy * s;
  Doubles own_rise = own.vy * t;
  Doubles own_vy = own.vy;
  if constexpr (gravity) {
    rise = rise - own.half_g * (s * s);
    own_rise = own_rise - own.half_g * (t * t);
    vy = vy - own.g * s;
    own_vy = own_vy - own.g * t;
  }
  const Doubles y = __builtin_shufflevector(ys01, ys23, 0, 1, 4, 5) + rise;
  const Doubles dx = nearest(x - (own.x + own.vx * t), own.width, own.half_width);
  const Doubles dy = nearest(y - (own.y + own_rise), own.height, own.half_height);
  const Doubles dvx = vx - own.vx;
  const Doubles dvy = vy - own_vy;
  const Doubles approach = dx * dvx + dy * dvy;
  const Doubles cross = dx * dvy - dy * dvx;
  Doubles contact2 = own.contact2;
  if constexpr (unequal_radii) {
    const Doubles contact_distance = own.radius + Doubles{f0.radius, f1.radius, f2.radius, f3.radius};
    contact2 = contact_distance * contact_distance;
  }
  const Doubles discriminant = (dvx * dvx + dvy * dvy) * contact2 - cross * cross;
  const Doubles gap = (dx * dx + dy * dy) - contact2;
  lasting |= (gap * gap <= own.close2) & (approach * approach <= own.slow2);
  const Doubles until_contact = gap / (root(discriminant) - approach);
  const Longs touches = (approach < all(0.0)) & ~(discriminant < all(0.0));
  return choose(touches, both + where(until_contact > all(0.0), until_contact), all(never));
}

template <bool gravity, bool unequal_radii, class Offset>
FirstContacts first_contacts(const PredictionConstants& f, const DiskRecord* record, const Offset* offset,
                             std::uint32_t count) {
  const PathSegment& p = record->path;
  const double contact_distance = record->radius + record->radius;
  const Lanes own{all(p.start),
                  all(p.x),
                  all(p.y),
                  all(p.vx),
                  all(p.vy),
                  all(f.gravity),
                  all(0.5 * f.gravity),
                  all(record->radius),
                  all(contact_distance * contact_distance),
                  all(f.width),
                  all(f.height),
                  all(f.half_width),
                  all(f.half_height),
                  all(f.close2),
                  all(f.slow2)};
  Doubles time[max_batch / lanes];
  Doubles least = all(never);
  Longs lasting{};
  const std::uint32_t fours = (count + lanes - 1) / lanes;
  for (std::uint32_t k = 0; k < fours; ++k) {
    const Offset* const n = offset + std::size_t{k} * lanes;
    time[k] =
        four_contacts<gravity, unequal_radii>(own, record[n[0]], record[n[1]], record[n[2]], record[n[3]], lasting);
    least = smaller(time[k], least);
  }
  FirstContacts first;
  first.lasting = bits_of(lasting) != 0;
  const double least01 = least[0] < least[1] ? least[0] : least[1];
  const double least23 = least[2] < least[3] ? least[2] : least[3];
  first.time = least01 < least23 ? least01 : least23;
  for (std::uint32_t k = 0; k < fours; ++k) first.bits |= bits_of(time[k] == all(first.time)) << (k * lanes);
  return first;
}

}  // namespace

PredictionKernels CAROM_PREDICTION_KERNELS(bool gravity, bool unequal_radii) {
  const auto both = [](auto has_gravity, auto has_radii) {
    constexpr bool g = decltype(has_gravity)::value;
    constexpr bool r = decltype(has_radii)::value;
    return PredictionKernels{first_contacts<g, r, std::int16_t>, first_contacts<g, r, std::int32_t>};
  };
  if (gravity && unequal_radii) return both(std::true_type{}, std::true_type{});
  if (gravity) return both(std::true_type{}, std::false_type{});
  if (unequal_radii) return both(std::false_type{}, std::true_type{});
  return both(std::false_type{}, std::false_type{});
}

}  // namespace carom
