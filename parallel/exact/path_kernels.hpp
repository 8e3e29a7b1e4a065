// The kernels that begin and end the paths of a window four disks at a time, where the machine has the instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/disks.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/event_calendar.hpp"

namespace carom {

// Of all disks, by storage index.
struct BegunPaths {
  const double* x;  // where they are
  const double* y;
  const double* vx;
  const double* vy;
  const DiskId* id;
  double radius;
  DiskRecord* record;
  CalendarEntry* entry;
  bool relists_stay;  // a disk whose next event was that of being relisted still has it
  double length;      // of the window before
  double early;       // by how much the times of next events come earlier than they were predicted
};

// Disks [begin, end) begin their paths where they are, at time 0. The time of a next event is from
// the new start. A contact is predicted again, since rounding at the start of paths may make another event the first.
using BeginPathsKernel = void (*)(const BegunPaths& in, std::size_t begin, std::size_t end);

// The same of disks that lie in the columns of others, disk i at slot[i] of x, y, vx and vy.
void begin_paths_at(const std::uint32_t* slot, const BegunPaths& in, std::size_t begin, std::size_t end);

// Of straight paths.
struct EndedPaths {
  const DiskRecord* record;
  double length;  // of the window
  double* x;      // where it leaves the disks
  double* y;
  double* vx;
  double* vy;
  // Disks are wrapped into [left, right) x [bottom, top); infinite where there is no period.
  double left, right, bottom, top;
};

// Ends the paths of disks [begin, end). The place of a disk that is gone is not a number, and stays so.
using EndPathsKernel = void (*)(const EndedPaths& in, std::size_t begin, std::size_t end);

struct PathKernels {
  BeginPathsKernel begin;
  EndPathsKernel end;
};

PathKernels path_kernels_baseline();
PathKernels path_kernels_avx2();
// The best versions for the processor at hand; the bits are the same.
PathKernels choose_path_kernels();

}  // namespace carom
