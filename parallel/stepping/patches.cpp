#include "parallel/stepping/patches.hpp"

#include <algorithm>
#include <cmath>

#include "core/disks/cell_index.hpp"
#include "parallel/stepping/most_contacts.hpp"

namespace carom {

namespace {

// Contacts in a patch: their records and disks fit into a core's own cache. Smaller patches have more contacts on
// edges.
constexpr std::size_t patch_contacts = 4096;
// Disks in a block of passes over all disks.
constexpr std::size_t disk_block = 8192;
// The shift of each layout against the first, in quarters of a patch along both axes. So no place is on an edge of all
// three layouts, and where edges of two of them cross there is no edge of the third.
constexpr std::array<std::uint32_t, patch_layouts> shift_quarters{0, 2, 1};

// A grid of patches with corner (x, y); columns_per_length and rows_per_length count quarters of patches.
struct Layout {
  double x, y;
  double columns_per_length, rows_per_length;
  std::uint32_t columns, rows;
};

// Smallest and largest x and y of the disks in contact.
std::array<double, 4> bounds_of(Patches& patches, const Disks& d, const std::vector<std::uint16_t>& in_contact,
                                const Executor& executor) {
  const std::array<double, 4> none{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
  const auto join = [](std::array<double, 4>& a, double x0, double x1, double y0, double y1) {
    a = {std::min(a[0], x0), std::max(a[1], x1), std::min(a[2], y0), std::max(a[3], y1)};
  };
  assign_amply(patches.bounds, executor.blocks(d.size(), disk_block), none);
  executor.for_ranges(d.size(), disk_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::array<double, 4> bounds = none;
    for (std::size_t i = begin; i < end; ++i) {
      if (in_contact[i] != 0) join(bounds, d.x[i], d.x[i], d.y[i], d.y[i]);
    }
    patches.bounds[b] = bounds;
  });
  std::array<double, 4> all = none;
  for (const auto& b : patches.bounds) join(all, b[0], b[1], b[2], b[3]);
  return all;
}

// About `wanted` patches, nearly square.
Layout layout_for(const std::array<double, 4>& bounds, std::size_t wanted) {
  const double width = std::max(bounds[1] - bounds[0], 1e-300);
  const double height = std::max(bounds[3] - bounds[2], 1e-300);
  const auto count = static_cast<double>(wanted);
  const double columns = std::clamp(std::floor(std::sqrt(count * width / height) + 0.5), 1.0, count);
  const double rows = std::max(1.0, std::floor(count / columns + 0.5));
  return {bounds[0],
          bounds[2],
          4.0 * columns / width,
          4.0 * rows / height,
          static_cast<std::uint32_t>(columns),
          static_cast<std::uint32_t>(rows)};
}

// A shifted patch that begins in the last quarters continues at the other end: as it should along a period, and
// harmless elsewhere.
std::uint32_t patch_of(std::uint32_t quarter, std::uint32_t shift, std::uint32_t patches) {
  const std::uint32_t p = (quarter + shift) / 4;
  return p < patches ? p : 0;
}

}  // namespace

bool lay_out(Patches& patches, const Disks& d, const std::vector<std::uint16_t>& in_contact, std::size_t contacts,
             const Executor& executor) {
  check_contacts(contacts);
  const std::size_t wanted = std::min<std::size_t>(contacts / executor.grain(patch_contacts), 0x7fff);
  patches.first = {0, 0, 0, 0, 1};
  if (wanted < 2) return false;
  const Layout layout = layout_for(bounds_of(patches, d, in_contact, executor), wanted);
  const std::uint32_t count = layout.columns * layout.rows;
  for (std::uint32_t l = 0; l < patch_layouts; ++l) patches.first[l + 1] = (l + 1) * count;
  patches.first[patch_phases] = patch_layouts * count + 1;
  resize_amply(patches.home, d.size());
  executor.for_ranges(d.size(), disk_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (in_contact[i] == 0) continue;
      const std::uint32_t column = cell_index((d.x[i] - layout.x) * layout.columns_per_length, 4 * layout.columns);
      const std::uint32_t row = cell_index((d.y[i] - layout.y) * layout.rows_per_length, 4 * layout.rows);
      for (std::uint32_t l = 0; l < patch_layouts; ++l) {
        patches.home[i][l] = static_cast<std::uint16_t>(patch_of(row, shift_quarters[l], layout.rows) * layout.columns +
                                                        patch_of(column, shift_quarters[l], layout.columns));
      }
    }
  });
  return true;
}

void take_as_one_patch(Patches& patches, std::size_t contacts) {
  check_contacts(contacts);
  patches.first = {0, 0, 0, 0, 1};
  patches.start.assign({0U, static_cast<std::uint32_t>(contacts)});
}

void order_by_patch(Patches& patches) {
  const std::size_t count = patches.first.back();
  assign_amply(patches.start, count + 1, 0U);
  for (const std::uint32_t p : patches.patch) ++patches.start[p + 1];
  for (std::size_t p = 0; p < count; ++p) patches.start[p + 1] += patches.start[p];
  resize_amply(patches.order, patches.patch.size());
  // start is used as the running place; each entry then has its successor's value, and all are moved back by one.
  for (std::size_t k = 0; k < patches.patch.size(); ++k) {
    patches.order[patches.start[patches.patch[k]]++] = static_cast<std::uint32_t>(k);
  }
  for (std::size_t p = count; p > 0; --p) patches.start[p] = patches.start[p - 1];
  patches.start[0] = 0;
}

}  // namespace carom
