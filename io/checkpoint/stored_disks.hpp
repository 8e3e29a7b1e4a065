// The disks of a checkpoint, left in its file and read some at a time.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/disks/disk_columns.hpp"
#include "core/disks/disk_source.hpp"

namespace carom {

// Where a column lies in the file. No bytes: the disks have none, or there are no disks.
struct StoredColumn {
  std::streamoff begin = 0;
  std::uint64_t bytes = 0;
};

// In the order of for_each_column.
using StoredColumns = std::array<StoredColumn, count_columns()>;

// What a file has whose column is not of its disks.
template <class T>
const char* misfit(const DiskColumn<T>& column) {
  return column.flag == &DiskColumns::spin ? "has spins of other disks" : "has columns of different lengths";
}

class StoredDisks final : public DiskSource {
 public:
  // none: what the disks share, without a disk; name: of the file, for messages. Throws BadBytes where the columns are
  // not of the same disks, or a disk has not been made when `next_id` was next.
  StoredDisks(std::ifstream file, std::string name, const StoredColumns& columns, const Disks& none, DiskId next_id);

  std::size_t size() const override { return size_; }
  bool has_radii() const override { return present_.radius; }
  bool has_masses() const override { return present_.mass; }
  // Throws RunError where the file can be read no more.
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
