#include "io/checkpoint/stored_disks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "io/files/byte_stream.hpp"

namespace carom {

StoredDisks::StoredDisks(std::ifstream file, std::string name, const StoredColumns& columns, const Disks& none,
                         DiskId next_id)
    : file_(std::move(file)),
      name_(std::move(name)),
      columns_(columns),
      none_(none),
      size_(static_cast<std::size_t>(columns.id.bytes / sizeof(DiskId))) {
  const auto fits = [&](const StoredColumn& column, bool needed) {
    return column.bytes == size_ * sizeof(double) || (!needed && column.bytes == 0);
  };
  const auto& [x, y, vx, vy, radius, mass, spin] = columns.numbers;
  if (none.spins() ? !fits(spin, true) : spin.bytes > 0) throw BadBytes("has spins of other disks");
  const bool whole =
      fits(x, true) && fits(y, true) && fits(vx, true) && fits(vy, true) && fits(radius, false) && fits(mass, false);
  if (!whole) throw BadBytes("has columns of different lengths");
  std::vector<DiskId> ids;
  for (std::size_t begin = 0; begin < size_; begin += disks_of_a_read) {
    read_column(columns_.id, begin, std::min(size_, begin + disks_of_a_read), ids);
    const bool born = std::all_of(ids.begin(), ids.end(), [&](DiskId id) { return id < next_id; });
    if (!born) throw BadBytes("has a disk that was never made");
  }
}

Disks StoredDisks::read(std::size_t begin, std::size_t end) {
  Disks some = none_;
  const auto numbers = columns_of_numbers(some);
  for (std::size_t k = 0; k < numbers.size(); ++k) read_column(columns_.numbers[k], begin, end, *numbers[k]);
  read_column(columns_.id, begin, end, some.id);
  return some;
}

template <class T>
void StoredDisks::read_column(const StoredColumn& column, std::size_t begin, std::size_t end, std::vector<T>& values) {
  if (column.bytes == 0) return;
  values.resize(end - begin);
  file_.seekg(column.begin + static_cast<std::streamoff>(begin * sizeof(T)));
  const auto bytes = static_cast<std::streamsize>(values.size() * sizeof(T));
  if (!file_.read(reinterpret_cast<char*>(values.data()), bytes)) {
    throw RunError(fmt::format("{}: could not be read again", name_));
  }
}

}  // namespace carom
