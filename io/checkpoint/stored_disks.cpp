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
      size_(static_cast<std::size_t>(columns.back().bytes / sizeof(DiskId))) {
  std::size_t k = 0;
  for_each_column([&](const auto& column) {
    if (column.flag != nullptr) present_.*column.flag = columns[k].bytes > 0;
    ++k;
  });
  present_.spin = none.spins();
  k = 0;
  for_each_column([&]<class T>(const DiskColumn<T>& column) {
    if (columns[k++].bytes == (column.is_in(present_) ? size_ : 0) * sizeof(T)) return;
    throw BadBytes(misfit(column));
  });
  std::vector<DiskId> ids;
  for (std::size_t begin = 0; begin < size_; begin += disks_of_a_read) {
    read_column(columns_.back(), begin, std::min(size_, begin + disks_of_a_read), ids);
    const bool born = std::all_of(ids.begin(), ids.end(), [&](DiskId id) { return id < next_id; });
    if (!born) throw BadBytes("has a disk with an id that was never given");
  }
}

Disks StoredDisks::read(std::size_t begin, std::size_t end) {
  Disks some = none_;
  std::size_t k = 0;
  for_each_column(some, [&](auto& entries) { read_column(columns_[k++], begin, end, entries); });
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
