// The prediction kernel, compiled once for every instruction set; CAROM_PREDICTION_KERNELS names the version. It
// processes four neighbours at a time.

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <atomic>
#include <cstddef>
#include <limits>

#include "parallel/exact/prediction_kernel.hpp"
#include "parallel/exact/prediction_lanes.inl"

namespace carom {

namespace {

struct Own {
  Doubles start, x, y, vx, vy, radius;
};

// The images of its neighbours that a disk may meet along a period.
enum class Images {
  none,     // no border is between them: the disks themselves
  nearest,  // the nearest ones
  beyond,   // the nearest ones, and those beyond them
  sheared,  // the nearest ones of a sheared box
};

// Positions and velocities of four disks.
struct Motions {
  Doubles x, y, vx, vy;
};

// The motions after a time s in free flight.
template <Bend bend>
[[gnu::always_inline]] inline void carry(const PredictionConstants& f, Doubles s, Motions& m) {
  Doubles shift = m.vx * s;
  Doubles rise = m.vy * s;
  if constexpr (bend == Bend::down || bend == Bend::tilted) {
    rise = rise - load(f.half_down) * (s * s);
    m.vy = m.vy - load(f.down) * s;
  }
  if constexpr (bend == Bend::tilted) {
    shift = shift - load(f.half_left) * (s * s);
    m.vx = m.vx - load(f.left) * s;
  }
  m.x = m.x + shift;
  m.y = m.y + rise;
}

// Four pairs: positions and velocities of the second disks relative to the first ones.
struct Pairs {
  Doubles dx, dy, dvx, dvy;
  Doubles contact_distance, contact2;  // contact_distance is used only for images beyond the nearest one
  Doubles blur2;                       // PredictionConstants::blur2
};

inline Doubles magnitude(const PredictionConstants& f, Doubles v) {
  return number(bits(v) & bits(load(f.magnitude_bits)));
}

// The time until disks that are (dx, dy) apart touch; not a number if they do not. Sets doubt to the size of the
// discriminant less the most by which rounding may shift it; if the disks overlap by more than rounding, to (dr.dv)^2.
// If it is hardly more than 0, rounding decides whether the disks touch.
[[gnu::always_inline]] inline Doubles until_contact(const PredictionConstants& f, const Pairs& r, Doubles dx,
                                                    Doubles dy, Doubles& doubt) {
  const Doubles approach = dx * r.dvx + dy * r.dvy;
  const Doubles cross = dx * r.dvy - dy * r.dvx;
  const Doubles speed2 = r.dvx * r.dvx + r.dvy * r.dvy;
  const Doubles discriminant = speed2 * r.contact2 - cross * cross;
  const Doubles gap2 = (dx * dx + dy * dy) - r.contact2;
  doubt = magnitude(f, discriminant) + speed2 * smaller(gap2, r.blur2);
  // Not a number if the paths miss.
  const Doubles until_meeting = root(discriminant) - approach;
  const Doubles until = larger(gap2, load(f.zero)) / until_meeting;
  // Chosen by the sign bit of the approach: when the difference of +0 and -0 matters, the pair is in doubt anyway.
  return choose_by_sign(approach, until, load(f.magnitude_bits));
}

// core's nearest_image, for distances that may be half a period.
inline Doubles nearest_of_any(const PredictionConstants& f, Doubles d, const LaneConstant& period) {
  const Doubles beyond = choose(d > load(f.zero), d - load(period), d + load(period));
  return choose(magnitude(f, d) > all(0.5) * load(period), beyond, d);
}

// core's relative_in_shear, with the same operations. both: the time at which both disks are on their paths.
[[gnu::always_inline]] inline void take_sheared_images(const PredictionConstants& f, Doubles both, Pairs& r) {
  const Doubles half = all(0.5) * load(f.image_y);
  const Longs below = r.dy > half;
  const Longs above = r.dy < -half;
  const auto by_row = [&](Doubles a, Doubles b, Doubles c) __attribute__((always_inline)) {
    return choose(above, a, choose(below, b, c));
  };
  const Doubles offset = load(f.offset) + load(f.jump) * both;
  const Doubles in_row = nearest_of_any(f, by_row(r.dx + offset, r.dx - offset, r.dx), f.image_x);
  r.dx = nearest_of_any(f, choose(above | below, in_row, r.dx), f.image_x);
  r.dy = by_row(r.dy + load(f.image_y), r.dy - load(f.image_y), r.dy);
  r.dvx = by_row(r.dvx + load(f.jump), r.dvx - load(f.jump), r.dvx);
}

// May the image behind the nearest one be met within `span`? d, dv: distance of the nearest image along an axis with
// this period, and its velocity.
[[gnu::always_inline]] inline Longs meets_image_behind(const PredictionConstants& f, const Pairs& r, Doubles span,
                                                       Doubles d, Doubles dv, const LaneConstant& period) {
  const Doubles reach = r.contact_distance * load(f.margin);
  return magnitude(f, dv) * span * load(f.margin) + reach >= load(period) - magnitude(f, d);
}

// core's time_to_far_contact, with the same operations: the least of `nearest`, the time until the nearest images
// touch, and the times until images beyond them touch that may be met within `span`.
[[gnu::always_inline]] inline Doubles until_any_image(const PredictionConstants& f, const Pairs& r, Doubles span,
                                                      Doubles nearest, Doubles& least) {
  const Longs far_x = meets_image_behind(f, r, span, r.dx, r.dvx, f.image_x);
  const Longs far_y = meets_image_behind(f, r, span, r.dy, r.dvy, f.image_y);
  if (!any_true(far_x | far_y)) return nearest;
  Doubles first = smaller(nearest, load(f.never));
  const auto see = [&](Doubles dx, Doubles dy, Longs is_met) __attribute__((always_inline)) {
    Doubles doubt;
    const Doubles until = until_contact(f, r, dx, dy, doubt);
    least = smaller(choose(is_met, doubt, load(f.never)), least);
    first = smaller(choose(is_met, until, load(f.never)), first);
  };
  const auto behind = [&](Doubles d, const LaneConstant& period) __attribute__((always_inline)) {
    return choose(d > load(f.zero), d - load(period), d + load(period));
  };
  const Doubles x = behind(r.dx, f.image_x);
  const Doubles y = behind(r.dy, f.image_y);
  see(x, r.dy, far_x);
  see(x, y, far_x & far_y);
  see(r.dx, y, far_y);
  return choose(first < load(f.never), first, load(f.magnitude_bits));
}

// core's collision_time(), with the same operations: carried_to, relative, time_to_contact, touching_time. Differences
// may have the opposite sign, which changes no bit of the time. Not a number if there is no contact. least: the least
// doubt so far.
template <Bend bend, bool unequal_radii, bool newest, Images images>
[[gnu::always_inline]] inline Doubles four_contacts(const PredictionConstants& f, const Own& own, const DiskRecord& f0,
                                                    const DiskRecord& f1, const DiskRecord& f2, const DiskRecord& f3,
                                                    Doubles& least) {
  const Doubles m0 = load_motion(f0.path);
  const Doubles m1 = load_motion(f1.path);
  const Doubles m2 = load_motion(f2.path);
  const Doubles m3 = load_motion(f3.path);
  const Doubles xs01 = __builtin_shufflevector(m0, m1, 0, 4, 2, 6);  // x0 x1 vx0 vx1
  const Doubles ys01 = __builtin_shufflevector(m0, m1, 1, 5, 3, 7);
  const Doubles xs23 = __builtin_shufflevector(m2, m3, 0, 4, 2, 6);
  const Doubles ys23 = __builtin_shufflevector(m2, m3, 1, 5, 3, 7);
  Motions others{__builtin_shufflevector(xs01, xs23, 0, 1, 4, 5), __builtin_shufflevector(ys01, ys23, 0, 1, 4, 5),
                 __builtin_shufflevector(xs01, xs23, 2, 3, 6, 7), __builtin_shufflevector(ys01, ys23, 2, 3, 6, 7)};
  const Doubles start = Doubles{f0.path.start, f1.path.start, f2.path.start, f3.path.start};
  const Doubles both = newest ? own.start : larger(start, own.start);
  carry<bend>(f, both - start, others);
  Motions mine{own.x, own.y, own.vx, own.vy};
  if constexpr (!newest) carry<bend>(f, both - own.start, mine);
  Pairs r;
  r.dx = others.x - mine.x;
  r.dy = others.y - mine.y;
  if constexpr (images == Images::nearest) {
    r.dx = nearest(r.dx, f.period_x, f.periods_per_x);
    r.dy = nearest(r.dy, f.period_y, f.periods_per_y);
  }
  if constexpr (images == Images::beyond) {
    r.dx = nearest_of_any(f, r.dx, f.image_x);
    r.dy = nearest_of_any(f, r.dy, f.image_y);
    r.contact_distance = load(f.contact);
  }
  r.dvx = others.vx - mine.vx;
  r.dvy = others.vy - mine.vy;
  if constexpr (images == Images::sheared) {
    take_sheared_images(f, both, r);
    r.contact_distance = load(f.contact);
  }
  r.contact2 = load(f.contact2);
  r.blur2 = load(f.blur2);
  if constexpr (unequal_radii) {
    r.contact_distance = own.radius + Doubles{f0.radius, f1.radius, f2.radius, f3.radius};
    r.contact2 = r.contact_distance * r.contact_distance;
    r.blur2 = r.contact_distance * load(f.blur);
  }
  Doubles doubt;
  const Doubles until = until_contact(f, r, r.dx, r.dy, doubt);
  least = smaller(doubt, least);
  if constexpr (images == Images::sheared) {
    // Pairs for which this kernel does not have all images are in doubt.
    const Doubles span = load(f.horizon) - both;
    least = number(bits(least) & ~(meets_image_behind(f, r, span, r.dx, r.dvx, f.image_x) |
                                   meets_image_behind(f, r, span, r.dy, r.dvy, f.image_y)));
  }
  if constexpr (images == Images::beyond) {
    return both + until_any_image(f, r, load(f.horizon) - both, until, least);
  }
  return both + until;
}

constexpr FirstContact cannot_tell{std::numeric_limits<double>::quiet_NaN()};

// The places of a batch in the list, from the first one on.
inline Longs places_from(const PredictionConstants& f, std::size_t first) {
  Longs v;
  __builtin_memcpy(&v, &f.place[first], sizeof v);
  return v;
}

template <Bend bend, bool unequal_radii, bool newest, Images images, class Offset>
[[gnu::always_inline]] inline FirstContact first_contact(const PredictionConstants& f, const DiskRecord* record,
                                                         const Offset* offset, std::size_t count) {
  if (count == 0) [[unlikely]]
    return {};
  // Loads the numbers here, into all lanes at once.
  std::atomic_signal_fence(std::memory_order_seq_cst);
  const PathSegment& p = record->path;
  const Own own{all(p.start), all(p.x), all(p.y), all(p.vx), all(p.vy), all(record->radius)};
  Doubles doubt = load(f.never);
  const auto contacts_from = [&](std::size_t k) __attribute__((always_inline)) {
    // Constants are loaded each time they are used: if they were kept in registers from one turn to the next, they
    // would be moved to the stack.
    std::atomic_signal_fence(std::memory_order_seq_cst);
    const Offset* const n = offset + k;
    return four_contacts<bend, unequal_radii, newest, images>(f, own, record[n[0]], record[n[1]], record[n[2]],
                                                              record[n[3]], doubt);
  };
  Doubles first = smaller(contacts_from(0), load(f.never));
  Longs place_of_first = places_from(f, 0);
  for (std::size_t k = lanes; k < count; k += lanes) {
    const Doubles time = contacts_from(k);
    const Longs sooner = time < first;
    // A tie is in doubt, too.
    doubt = number(bits(doubt) & ~(time == first));
    place_of_first = bits(choose(sooner, number(places_from(f, k)), number(place_of_first)));
    first = smaller(time, first);
  }
  if (any_true(doubt <= load(f.slow_approach2))) [[unlikely]]
    return cannot_tell;
  FirstContact found;
  const Doubles least = least_of_all(first);
  found.time = least[0];
  const unsigned firsts = bits_of(first == least);
  found.neighbour = lane_of(place_of_first, firsts);
  if ((firsts & (firsts - 1)) != 0 && found.time < never) [[unlikely]] {
    // Padding gives the same neighbour twice, which is no tie.
    for (unsigned left = firsts & (firsts - 1); left != 0; left &= left - 1) {
      if (offset[lane_of(place_of_first, left)] != offset[found.neighbour]) return cannot_tell;
    }
  }
  return found;
}

// x and y of a vector. The type of plain_collision.hpp is not used: functions that other files inline must not be
// compiled for AVX2 here.
using Coordinates = double __attribute__((vector_size(16)));

inline Coordinates load(const AlongAxes& c) {
  Coordinates v;
  __builtin_memcpy(&v, &c, sizeof v);
  return v;
}

// The conversion is exact.
inline Coordinates to_doubles(const PredictionConstants& f, const FixedPointPosition& p) {
#if defined(__AVX2__)
  static_assert(sizeof p == sizeof(long long));
  const __m128i wide = _mm_cvtepu32_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&p)));
  const __m128i whole = _mm_castpd_si128(load(f.whole));
  return _mm_castsi128_pd(_mm_or_si128(wide, whole)) - load(f.whole);
#else
  (void)f;
  return Coordinates{static_cast<double>(p.x), static_cast<double>(p.y)};
#endif
}

// Squared distance of this place from the place where a disk is listed.
template <Images images>
[[gnu::always_inline]] inline double distance2_from_listed(const PredictionConstants& f, Coordinates at,
                                                           Coordinates listed) {
  Coordinates d = at - listed;
  if constexpr (images != Images::none) {
    const Coordinates periods = d * load(f.periods_per_length);
    constexpr double shift = 0x1.8p52;
    d = d - load(f.period) * ((periods + Coordinates{shift, shift}) - Coordinates{shift, shift});
  }
  const Coordinates d2 = d * d;
  return d2[0] + d2[1];
}

// The place on a path after a time s, in the frame in which disks are listed.
template <Bend bend>
[[gnu::always_inline]] inline Coordinates place_after(const PredictionConstants& f, const PathSegment& path, double s) {
  Coordinates v{path.vx, path.vy};
  if constexpr (bend == Bend::down || bend == Bend::tilted) v = v - load(f.half_gravity) * Coordinates{s, s};
  const Coordinates at = Coordinates{path.x, path.y} + v * Coordinates{s, s};
  if constexpr (bend != Bend::flow) return at;
  // As FlowFrame::carried_back.
  return Coordinates{at[0] - (f.flow.tilt + f.flow.rate * (path.start + s)) * (at[1] - f.flow.middle), at[1]};
}

// The most by which a path of duration s may be bent away from the line between its ends; length.
template <Bend bend>
[[gnu::always_inline]] inline double bent_by(const PredictionConstants& f, const PathSegment& path, double s) {
  if constexpr (bend == Bend::flow) return 0.25 * __builtin_fabs(f.flow.rate * path.vy) * (s * s);
  return f.eighth_gravity * (s * s);
}

// Negative if a path of duration s may go round the box from one image of the disk's listed position to another.
template <Bend bend>
[[gnu::always_inline]] inline double way_left_round(const PredictionConstants& f, const PathSegment& path, double s) {
  if constexpr (bend == Bend::none) {
    const Coordinates way = Coordinates{path.vx, path.vy} * Coordinates{s, s};
    const Coordinates way2 = way * way;
    return f.to_other_image2 - (way2[0] + way2[1]);
  }
  const Coordinates way = place_after<bend>(f, path, s) - place_after<bend>(f, path, 0.0);
  const Coordinates way2 = way * way;
  // This has to be true of each part of the path, too.
  const double straight = f.to_other_image - bent_by<bend>(f, path, s);
  const double left = straight * straight - (way2[0] + way2[1]);
  return straight < left ? straight : left;
}

// FirstContact::leaving_bit, or 0: the opposite of NeighbourLists::stays_listed, except for rounding and for paths so
// long that they may reach another image of the listed position; for bent paths, of stays_listed_bent for the whole
// path.
template <Bend bend, Images images>
[[gnu::always_inline]] inline std::uint32_t leaving_bit(const PredictionConstants& f, const PathSegment& path,
                                                        const FixedPointPosition& listed_at, double until) {
  const double s = until - path.start;
  const Coordinates listed = to_doubles(f, listed_at) * load(f.listed_unit);
  const double end2 = distance2_from_listed<images>(f, place_after<bend>(f, path, s), listed);
  // The sign of this decides: it is the room left.
  double left = f.stay2 - end2;
  if constexpr (bend != Bend::none) {
    const double start2 = distance2_from_listed<images>(f, place_after<bend>(f, path, 0.0), listed);
    const double room = f.stay - bent_by<bend>(f, path, s);
    const double inside = room * room - (end2 > start2 ? end2 : start2);
    left = room < inside ? room : inside;
  }
  if constexpr (images != Images::none) {
    const double round = way_left_round<bend>(f, path, s);
    left = round < left ? round : left;
  }
#if defined(__AVX__)
  const auto sign = static_cast<std::uint32_t>(__builtin_ia32_movmskpd(Coordinates{left, left}));
#else
  const auto sign = static_cast<std::uint32_t>(left < 0.0);
#endif
  static_assert(FirstContact::leaving_bit == 1U << 31);
  return sign << 31;
}

template <Bend bend, bool unequal_radii, bool newest, Images images>
FirstContact first_in_row(const PredictionConstants& f, const DiskRecord* record, const ListRow& row) {
  FirstContact found = first_contact<bend, unequal_radii, newest, images>(f, record, row.offset, row.count);
  found.neighbour |= leaving_bit<bend, images>(f, record->path, row.listed_at, found.time);
  return found;
}

template <Bend bend, bool unequal_radii, Images images>
FirstContact first_in_wide_row(const PredictionConstants& f, const DiskRecord* record, const std::int32_t* offset,
                               std::uint32_t count) {
  return first_contact<bend, unequal_radii, false, images>(f, record, offset, count);
}

template <Bend bend, bool unequal_radii>
PredictionKernels kernels_for() {
  RowKernel near_sheared = nullptr;
  WideRowKernel far_sheared = nullptr;
  if constexpr (bend == Bend::flow) {
    near_sheared = first_in_row<bend, unequal_radii, false, Images::sheared>;
    far_sheared = first_in_wide_row<bend, unequal_radii, Images::sheared>;
  }
  return {first_in_row<bend, unequal_radii, false, Images::nearest>,
          first_in_row<bend, unequal_radii, true, Images::nearest>,
          first_in_row<bend, unequal_radii, false, Images::none>,
          first_in_row<bend, unequal_radii, true, Images::none>,
          first_in_wide_row<bend, unequal_radii, Images::nearest>,
          first_in_row<bend, unequal_radii, false, Images::beyond>,
          first_in_wide_row<bend, unequal_radii, Images::beyond>,
          near_sheared,
          far_sheared};
}

template <Bend bend>
PredictionKernels kernels_for(bool unequal_radii) {
  return unequal_radii ? kernels_for<bend, true>() : kernels_for<bend, false>();
}

}  // namespace

PredictionKernels CAROM_PREDICTION_KERNELS(Bend bend, bool unequal_radii) {
  switch (bend) {
    case Bend::none:
      return kernels_for<Bend::none>(unequal_radii);
    case Bend::down:
      return kernels_for<Bend::down>(unequal_radii);
    case Bend::tilted:
      return kernels_for<Bend::tilted>(unequal_radii);
    case Bend::flow:
      return kernels_for<Bend::flow>(unequal_radii);
  }
  return {};
}

}  // namespace carom
