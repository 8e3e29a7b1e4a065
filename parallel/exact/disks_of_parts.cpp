#include "parallel/exact/disks_of_parts.hpp"

#include <utility>

namespace carom {

namespace {

constexpr std::size_t disks_a_block = 65536;

}  // namespace

// Each block counts its disks by part first, and then writes them behind those of the blocks before it.
std::vector<DisksOfPart> disks_of_parts(const Disks& disks, const BoxCut& cut, const Executor& executor) {
  const std::size_t n = disks.size();
  const std::size_t parts = cut.parts();
  std::vector<std::vector<std::size_t>> count(executor.blocks(n, disks_a_block), std::vector<std::size_t>(parts));
  std::vector<std::vector<std::size_t>> own = count;
  executor.for_ranges(n, disks_a_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      bool is_owner = true;
      cut.visit_parts_at({disks.x[k], disks.y[k]}, [&](std::size_t part) {
        own[b][part] += std::exchange(is_owner, false) ? 1U : 0U;
        ++count[b][part];
      });
    }
  });
  std::vector<DisksOfPart> all(parts);
  executor.run(parts, [&](std::size_t part) {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < count.size(); ++b) {
      all[part].own += own[b][part];
      sum += std::exchange(count[b][part], sum);
    }
    all[part].index.resize(sum);
  });
  executor.for_ranges(n, disks_a_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      cut.visit_parts_at({disks.x[k], disks.y[k]},
                         [&](std::size_t part) { all[part].index[count[b][part]++] = static_cast<std::uint32_t>(k); });
    }
  });
  return all;
}

}  // namespace carom
