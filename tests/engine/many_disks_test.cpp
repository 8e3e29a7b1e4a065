// More disks, contacts or cells than 32-bit numbers can count: they are refused, or handled correctly.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "parallel/exact/list_kernel.hpp"
#include "parallel/exact/most_listed.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/stepping/most_contacts.hpp"
#include "parallel/stepping/patches.hpp"
#include "parallel/stepping/support_batches.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {
namespace {

constexpr std::size_t beyond = std::size_t{1} << 32U;

// The text of the RunError that the call throws.
template <class Call>
std::string failure_of(Call&& call) {
  try {
    call();
  } catch (const RunError& error) {
    return error.what();
  }
  return "nothing";
}

// Zeroed memory of which only the pages touched exist; null if the system does not provide that much.
class SparseMemory {
 public:
  explicit SparseMemory(std::size_t bytes) : bytes_(bytes) {
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, -1, 0);
    if (at != MAP_FAILED) begin_ = at;
  }
  SparseMemory(const SparseMemory&) = delete;
  SparseMemory& operator=(const SparseMemory&) = delete;
  ~SparseMemory() {
    if (begin_ != nullptr) munmap(begin_, bytes_);
  }
  void* begin() const { return begin_; }

 private:
  std::size_t bytes_;
  void* begin_ = nullptr;
};

// The slots of cell 2^29 start at 2^32.
TEST(ManyDisks, ListKernelsReadTheRadiiOfLateCells) {
  constexpr std::uint32_t cell = (1U << 29U) + 1U;
  const SparseMemory cells((std::size_t{cell} + 1) * sizeof(SlotCell));
  const SparseMemory radii((std::size_t{cell} + 1) * slots_a_cell * sizeof(float));
  if (cells.begin() == nullptr || radii.begin() == nullptr) GTEST_SKIP() << "the system does not map so much";
  SlotCell& late = static_cast<SlotCell*>(cells.begin())[cell];
  for (std::uint32_t& disk : late.disk) disk = empty_slot;
  late.disk[5] = 7;
  late.position[5] = {100, 0};
  static_cast<float*>(radii.begin())[std::size_t{cell} * slots_a_cell + 5] = 90.0F;
  ListQuery query;
  query.unit_x = query.unit_y = std::numeric_limits<std::int16_t>::max();
  query.cutoff = 20.0F;
  query.self = 1;
  const SlotColumns columns{static_cast<const SlotCell*>(cells.begin()), static_cast<const float*>(radii.begin())};
  for (const ListKernel kernel : {list_kernel_baseline, choose_list_kernel()}) {
    std::vector<std::uint32_t> found(slots_a_cell + list_kernel_padding);
    ASSERT_EQ(kernel(query, columns, {cell, 1, 1, 1}, found.data()), 1U);
    EXPECT_EQ(found[0], 7U);
  }
}

TEST(ManyDisks, MoreThanListsCanNumberAreRefused) {
  NeighbourLists lists;
  const Disks disks;
  const auto first_too_many = static_cast<std::uint32_t>(most_listed_disks);
  EXPECT_EQ(failure_of([&] {
              lists.append(disks, first_too_many, {0.0, 0.0});
            }),
            "exact: 2147000001 disks are more than one process can list, 2147000000; run the scene on several ranks, "
            "or with method \"pairwise\"");
}

TEST(ManyDisks, MoreContactsThanCanBeNumberedAreRefused) {
  const std::string refused =
      "pairwise: 4294967296 contacts in a step are more than one process can number, 4294967294; run the scene on "
      "several ranks";
  Patches patches;
  EXPECT_EQ(failure_of([&] { take_as_one_patch(patches, beyond); }), refused);
  EXPECT_EQ(failure_of([&] { lay_out(patches, Disks{}, {}, beyond, Executor(1)); }), refused);
}

TEST(ManyDisks, MoreOfAPileThanCanBeNumberedAreRefused) {
  Patches patches;
  patches.start = {0, 0};
  SupportBatches batches;
  EXPECT_EQ(failure_of([&] { begin_batches(batches, patches, most_disks_of_pile + 1); }),
            "pairwise: 2146435073 disks of a pile are more than one process can number, 2146435072; run the scene on "
            "several ranks");
  batches.first = {0, 1U << 30U};
  EXPECT_EQ(failure_of([&] { lay_out_batches(batches); }),
            "pairwise: 4294967296 slots of supports are more than one process can number, 4294967294; run the scene on "
            "several ranks");
}

}  // namespace
}  // namespace carom
