// Disks that are read in pieces, so that the disks of a file need not all be in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/disks/disks.hpp"

namespace carom {

class DiskSource {
 public:
  DiskSource() = default;
  DiskSource(const DiskSource&) = delete;
  DiskSource& operator=(const DiskSource&) = delete;
  virtual ~DiskSource() = default;

  virtual std::size_t size() const = 0;
  // Are there columns of radii, of masses? Asked here because empty pieces do not tell.
  virtual bool has_radii() const = 0;
  virtual bool has_masses() const = 0;
  // Disks [begin, end), in the same order each time. Precondition: begin <= end <= size().
  virtual Disks read(std::size_t begin, std::size_t end) = 0;
};

// Disks in a piece: a few megabytes.
inline constexpr std::size_t disks_of_a_read = std::size_t{1} << 16;

// Calls use(piece) for all pieces in order.
template <class Use>
void visit_pieces(DiskSource& source, Use&& use) {
  for (std::size_t begin = 0; begin < source.size(); begin += disks_of_a_read) {
    use(source.read(begin, std::min(source.size(), begin + disks_of_a_read)));
  }
}

// A source of disks that are in memory.
class HeldDisks final : public DiskSource {
 public:
  explicit HeldDisks(Disks disks) : disks_(std::move(disks)) {}

  std::size_t size() const override { return disks_.size(); }
  bool has_radii() const override { return !disks_.radius.empty(); }
  bool has_masses() const override { return !disks_.mass.empty(); }
  Disks read(std::size_t begin, std::size_t end) override;

 private:
  Disks disks_;
};

}  // namespace carom
