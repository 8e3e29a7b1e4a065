#include "io/h5md_values.hpp"

#include <cstring>

#include "core/disk_group.hpp"
#include "io/disk_selection.hpp"
#include "io/h5md_layout.hpp"

namespace carom {

namespace {

// value(i) of the disk at each place; nothing where there is none.
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

template <class T>
struct Pair {
  T x, y;
};

template <class T>
void fill_with_pairs(std::vector<unsigned char>& buffer, const H5mdPlaces& places, T nothing,
                     const std::vector<double>& x, const std::vector<double>& y) {
  fill_with(buffer, places, Pair<T>{nothing, nothing}, [&](std::uint32_t i) {
    return Pair<T>{static_cast<T>(x[i]), static_cast<T>(y[i])};
  });
}

}  // namespace

void fill_with_values(H5mdQuantity quantity, bool single, const Disks& disks, const std::vector<DiskId>& group_ends,
                      const H5mdPlaces& places, std::vector<unsigned char>& buffer) {
  const auto pairs = [&](const std::vector<double>& x, const std::vector<double>& y) {
    if (single) return fill_with_pairs(buffer, places, h5md_single_nothing, x, y);
    fill_with_pairs(buffer, places, h5md_nothing, x, y);
  };
  switch (quantity) {
    case H5mdQuantity::position:
      return pairs(disks.x, disks.y);
    case H5mdQuantity::velocity:
      return pairs(disks.vx, disks.vy);
    case H5mdQuantity::id:
      return fill_with(buffer, places, h5md_no_id, [&](std::uint32_t i) { return disks.id[i]; });
    case H5mdQuantity::mass:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.mass_of(i); });
    case H5mdQuantity::radius:
      return fill_with(buffer, places, h5md_nothing, [&](std::uint32_t i) { return disks.radius_of(i); });
    case H5mdQuantity::species:
      fill_with(buffer, places, h5md_no_species, [&](std::uint32_t i) { return group_of(group_ends, disks.id[i]); });
  }
}

}  // namespace carom
