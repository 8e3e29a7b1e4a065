// One step of a growth on all cores: the result of core's grow_step, bit for bit, on any number of threads; except
// that, as long as any disk lacks something, only such disks check for overlap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/start/growth_step.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Finds the disks near each other by cells; afterwards the disks are in the order of these.
GrowthTally grow_by_cells(const Executor& executor, Disks& disks, const Domain& box, const std::vector<double>& target);

// Calls visit(disk, near) for every disk, on all threads. near: disks that include all that come within the sum of the
// two growth_reach.
using VisitNear = std::function<void(const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit)>;

// The same with neighbour lists for the disks near each other; the disks stay in their order.
GrowthTally grow_by_lists(const Executor& executor, Disks& disks, const Domain& box, const std::vector<double>& target,
                          const VisitNear& visit_lists);

}  // namespace carom
