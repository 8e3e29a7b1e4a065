// One step of a growth on all cores: what core's grow_step gives, bit for bit, on any number of threads. But overlap is
// looked for by disks that lack something alone, as long as any does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/start/growth_step.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Finds the disks near each by cells; the disks end up in the order of these.
GrowthTally grow_by_cells(const Executor& executor, Disks& disks, const Domain& box, const std::vector<double>& target);

// Calls visit(disk, near) for every disk, on all threads. near: disks of which all are that come within the sum of the
// two growth_reach.
using VisitNear = std::function<void(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit)>;

// The same where neighbour lists tell which disks are near each; the disks stay in their order.
GrowthTally grow_by_lists(const Executor& executor, Disks& disks, const Domain& box, const std::vector<double>& target,
                          const VisitNear& visit_lists);

}  // namespace carom
