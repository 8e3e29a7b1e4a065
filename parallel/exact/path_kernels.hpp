// The kernels that begin and end the paths of a window, four disks at a time if the machine has the instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/disks.hpp"
#include "parallel/exact/disk_record.hpp"
#include "parallel/exact/event_calendar.hpp"

namespace carom {

// The columns of all disks, by storage index.
struct BegunPaths {
  const double* x;  // positions
  const double* y;
  const double* vx;
  const double* vy;
  const DiskId* id;
  double radius;
  DiskRecord* record;
  CalendarEntry* entry;
  bool relists_stay;  // a disk whose next event was relisting keeps it
  double length;      // of the window before
  double early;       // the times of next events are made earlier by this than predicted
};

// Begins the paths of disks [begin, end) where the disks are, at time 0, and makes the times of their next events
// relative to the new start. Contacts are predicted again, since rounding at the start of paths may make another event
// the first.
using BeginPathsKernel = void (*)(const BegunPaths& in, std::size_t begin, std::size_t end);

// The same for disks that are in the columns of other disks, disk i at slot[i] of x, y, vx and vy.
void begin_paths_at(const std::uint32_t* slot, const BegunPaths& in, std::size_t begin, std::size_t end);

// The columns to which straight paths lead.
struct EndedPaths {
  const DiskRecord* record;
  double length;  // of the window
  double* x;      // positions at the window's end
  double* y;
  double* vx;
  double* vy;
  // Positions are wrapped into [left, right) x [bottom, top); these are infinite without a period.
  double left, right, bottom, top;
};

// Ends the paths of disks [begin, end). The position of a disk that has left the box is not a number, and stays so.
using EndPathsKernel = void (*)(const EndedPaths& in, std::size_t begin, std::size_t end);

struct PathKernels {
  BeginPathsKernel begin;
  EndPathsKernel end;
};

PathKernels path_kernels_baseline();
PathKernels path_kernels_avx2();
// The best versions for the processor in use; all have the same bits.
PathKernels choose_path_kernels();

}  // namespace carom
