#include "io/trajectory/h5md_values.hpp"

#include <array>
#include <cstring>
#include <type_traits>

#include "core/scene/disk_group.hpp"
#include "io/trajectory/disk_selection.hpp"
#include "io/trajectory/h5md_layout.hpp"
#include "io/trajectory/single_precision.hpp"

namespace carom {

namespace {

// A number in the file's precision.
template <class T, class Value>
T rounded(Value value) {
  if constexpr (std::is_same_v<T, float>) return single_of(value, "trajectory.h5");
  return static_cast<T>(value);
}

// Disks at neighbouring places lie far apart in memory, so each is prefetched this many places ahead.
constexpr std::size_t places_ahead = 32;

// Writes value(i) of the disk i at each place, and `nothing` where there is no disk. columns: what value(i) reads at i.
template <class T, class Value, class... Column>
void fill_with(std::vector<unsigned char>& buffer, const H5mdPlaces& places, T nothing, Value value,
               const Column&... columns) {
  buffer.resize((places.end - places.begin) * sizeof(T));
  unsigned char* to = buffer.data();
  const auto disk_at = [&](std::size_t place) {
    return place < places.disk_at.size() ? places.disk_at[place] : no_disk;
  };
  for (std::size_t place = places.begin; place < places.end; ++place, to += sizeof(T)) {
    const std::uint32_t i = disk_at(place), later = disk_at(place + places_ahead);
    if (later != no_disk) (__builtin_prefetch(&columns[later]), ...);
    const T stored = i == no_disk ? nothing : value(i);
    std::memcpy(to, &stored, sizeof stored);
  }
}

template <class T, std::size_t n>
struct Vector {
  std::array<T, n> components;
};

// Writes x(i) and y(i) of the disk i at each place, and 0 as a third component if there is one.
template <class T, class X, class Y, class... Column>
void fill_with_vectors(std::vector<unsigned char>& buffer, const H5mdPlaces& places, int dimensions, T nothing, X x,
                       Y y, const Column&... columns) {
  if (dimensions == 3) {
    fill_with(
        buffer, places, Vector<T, 3>{{nothing, nothing, nothing}},
        [&](std::uint32_t i) {
          return Vector<T, 3>{{rounded<T>(x(i)), rounded<T>(y(i)), T{}}};
        },
        columns...);
  } else {
    fill_with(
        buffer, places, Vector<T, 2>{{nothing, nothing}},
        [&](std::uint32_t i) {
          return Vector<T, 2>{{rounded<T>(x(i)), rounded<T>(y(i))}};
        },
        columns...);
  }
}

}  // namespace

void fill_with_values(H5mdQuantity quantity, const H5mdForm& form, const Disks& disks, const H5mdPlaces& places,
                      std::vector<unsigned char>& buffer) {
  const auto vectors = [&](const std::vector<double>& x, const std::vector<double>& y) {
    const auto of_x = [&x](std::uint32_t i) { return x[i]; };
    const auto of_y = [&y](std::uint32_t i) { return y[i]; };
    if (form.single) return fill_with_vectors(buffer, places, form.dimensions, h5md_single_nothing, of_x, of_y, x, y);
    fill_with_vectors(buffer, places, form.dimensions, h5md_nothing, of_x, of_y, x, y);
  };
  switch (quantity) {
    case H5mdQuantity::position:
      return vectors(disks.x, disks.y);
    case H5mdQuantity::velocity:
      return vectors(disks.vx, disks.vy);
    case H5mdQuantity::id:
      return fill_with(
          buffer, places, h5md_no_id, [&](std::uint32_t i) { return disks.id[i]; }, disks.id);
    case H5mdQuantity::mass:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.mass_of(i); });
    case H5mdQuantity::radius:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.radius_of(i); });
    case H5mdQuantity::image:
      return fill_with_vectors(
          buffer, places, form.dimensions, h5md_no_image,
          [&](std::uint32_t i) { return rounds_of(form.rounds->x, disks.id[i]); },
          [&](std::uint32_t i) { return rounds_of(form.rounds->y, disks.id[i]); }, disks.id);
    case H5mdQuantity::spin:
      if (form.single) {
        return fill_with(buffer, places, h5md_single_nothing,
                         [&](std::uint32_t i) { return rounded<float>(disks.spin_of(i)); });
      }
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.spin_of(i); });
    case H5mdQuantity::species:
      fill_with(buffer, places, h5md_no_species,
                [&](std::uint32_t i) { return group_of(form.group_ends, disks.id[i]); });
  }
}

}  // namespace carom
