// The disks of a checkpoint, read from its file in pieces.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/disks/disk_columns.hpp"
#include "core/disks/disk_source.hpp"

namespace carom {

// The position of a column in the file. 0 bytes: the column does not exist, or there are no disks.
struct StoredColumn {
  std::streamoff begin = 0;
  std::uint64_t bytes = 0;
};

// In the order of for_each_column.
using StoredColumns = std::array<StoredColumn, count_columns()>;

// The description of a column that does not fit the disks.
template <class T>
const char* misfit(const DiskColumn<T>& column) {
  return column.flag == &DiskColumns::spin ? "has spins of other disks" : "has columns of different lengths";
}

class StoredDisks final : public DiskSource {
 public:
  // none: no disks, but their shared numbers; name: of the file, for messages. Throws BadBytes if the columns have
  // different lengths, or a disk has an id that is not below next_id.
  StoredDisks(std::ifstream file, std::string name, const StoredColumns& columns, const Disks& none, DiskId next_id);

  std::size_t size() const override { return size_; }
  bool has_radii() const override { return present_.radius; }
  bool has_masses() const override { return present_.mass; }
  // Throws RunError if the file can no longer be read.
  Disks read(std::size_t begin, std::size_t end) override;

 private:
  template <class T>
  void read_column(const StoredColumn& column, std::size_t begin, std::size_t end, std::vector<T>& values);

  std::ifstream file_;
  std::string name_;
  StoredColumns columns_;
  DiskColumns present_;
  Disks none_;
  std::size_t size_;
};

}  // namespace carom
