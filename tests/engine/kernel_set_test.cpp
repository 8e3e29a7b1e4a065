// The environment variable CAROM_KERNELS, and that every kernel with several versions follows it.
#include "core/base/kernel_set.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "parallel/exact/list_kernel.hpp"
#include "parallel/kicks/draw_kernels.hpp"
#include "parallel/stepping/move_kernel.hpp"
#include "parallel/stepping/near_walls.hpp"
#include "parallel/stepping/search_kernel.hpp"
#include "tests/support/program_support.hpp"

namespace carom {
namespace {

TEST(KernelSet, BaselineWhereAskedForAndOtherwiseTheBest) {
  EXPECT_EQ(choose_kernel_set("baseline"), KernelSet::baseline);
#if defined(__x86_64__)
  const KernelSet best = __builtin_cpu_supports("avx2") ? KernelSet::avx2 : KernelSet::baseline;
#else
  const KernelSet best = KernelSet::baseline;
#endif
  EXPECT_EQ(choose_kernel_set(nullptr), best);
  EXPECT_EQ(choose_kernel_set(""), best);
}

// ctest runs this test twice, once with CAROM_KERNELS=baseline.
TEST(KernelSet, KernelsFollowTheEnvironment) {
  EXPECT_EQ(kernel_set(), choose_kernel_set(std::getenv("CAROM_KERNELS")));
  const bool baseline = kernel_set() == KernelSet::baseline;
  EXPECT_EQ(choose_interior_kernel(), baseline ? search_interior_baseline : search_interior_avx2);
  EXPECT_EQ(choose_near_walls_kernel(), baseline ? near_walls_baseline : near_walls_avx2);
  EXPECT_EQ(choose_move_kernels().in_levels, baseline ? move_disks_baseline : move_disks_avx2);
  EXPECT_EQ(choose_move_kernels().sheared, baseline ? move_sheared_baseline : move_sheared_avx2);
  EXPECT_EQ(choose_draw_kernels().normals, baseline ? draw_normals_baseline : draw_normals_avx2);
  EXPECT_EQ(choose_list_kernel(), baseline ? list_kernel_baseline : list_kernel_avx2);
  EXPECT_EQ(choose_change_kernel(), baseline ? change_kernel_baseline : change_kernel_avx2);
  const EditKernels edits = baseline ? edit_kernels_baseline() : edit_kernels_avx2();
  EXPECT_EQ(choose_edit_kernels().insert, edits.insert);
  EXPECT_EQ(choose_edit_kernels().remove, edits.remove);
}

class KernelSetProgram : public test::ProgramTest {};

TEST_F(KernelSetProgram, AnUnknownSetIsOneLineAndStatusTwo) {
  const test::Outcome o = shell("CAROM_KERNELS=sse9 $C docs scene");
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(o.err, "carom: error: CAROM_KERNELS: there are no kernels \"sse9\"; expected baseline, or no value\n");
}

}  // namespace
}  // namespace carom
