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

// Writes value(i) of the disk i at each place, and `nothing` where there is no disk.
template <class T, class Value>
void fill_with(std::vector<unsigned char>& buffer, const H5mdPlaces& places, T nothing, Value value) {
  buffer.resize((places.end - places.begin) * sizeof(T));
  unsigned char* to = buffer.data();
  for (std::size_t place = places.begin; place < places.end; ++place, to += sizeof(T)) {
    const std::uint32_t i = place < places.disk_at.size() ? places.disk_at[place] : no_disk;
    const T stored = i == no_disk ? nothing : value(i);
    std::memcpy(to, &stored, sizeof stored);
  }
}

template <class T, std::size_t n>
struct Vector {
  std::array<T, n> components;
};

// Writes x(i) and y(i) of the disk i at each place, and 0 as a third component if there is one.
template <class T, class X, class Y>
void fill_with_vectors(std::vector<unsigned char>& buffer, const H5mdPlaces& places, int dimensions, T nothing, X x,
                       Y y) {
  if (dimensions == 3) {
    fill_with(buffer, places, Vector<T, 3>{{nothing, nothing, nothing}}, [&](std::uint32_t i) {
      return Vector<T, 3>{{rounded<T>(x(i)), rounded<T>(y(i)), T{}}};
    });
  } else {
    fill_with(buffer, places, Vector<T, 2>{{nothing, nothing}}, [&](std::uint32_t i) {
      return Vector<T, 2>{{rounded<T>(x(i)), rounded<T>(y(i))}};
    });
  }
}

}  // namespace

void fill_with_values(H5mdQuantity quantity, const H5mdForm& form, const Disks& disks, const H5mdPlaces& places,
                      std::vector<unsigned char>& buffer) {
  const auto vectors = [&](const std::vector<double>& x, const std::vector<double>& y) {
    const auto of_x = [&x](std::uint32_t i) { return x[i]; };
    const auto of_y = [&y](std::uint32_t i) { return y[i]; };
    if (form.single) return fill_with_vectors(buffer, places, form.dimensions, h5md_single_nothing, of_x, of_y);
    fill_with_vectors(buffer, places, form.dimensions, h5md_nothing, of_x, of_y);
  };
  switch (quantity) {
    case H5mdQuantity::position:
      return vectors(disks.x, disks.y);
    case H5mdQuantity::velocity:
      return vectors(disks.vx, disks.vy);
    case H5mdQuantity::id:
      return fill_with(buffer, places, h5md_no_id, [&](std::uint32_t i) { return disks.id[i]; });
    case H5mdQuantity::mass:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.mass_of(i); });
    case H5mdQuantity::radius:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.radius_of(i); });
    case H5mdQuantity::image:
      return fill_with_vectors(
          buffer, places, form.dimensions, h5md_no_image,
          [&](std::uint32_t i) { return rounds_of(form.rounds->x, disks.id[i]); },
          [&](std::uint32_t i) { return rounds_of(form.rounds->y, disks.id[i]); });
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
