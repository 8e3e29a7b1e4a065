// Ranks over MPI, started by mpiexec on several ranks (CMakeLists.txt). Every rank runs all tests in the same order; a
// failure on one rank fails the run.
#include <gtest/gtest.h>

#include "parallel/ranks/mpi_ranks.hpp"
#include "tests/support/ranks_support.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

const MpiSession* session = nullptr;

TEST(MpiRanks, HaveNumbersFromBottomToTop) {
  const auto ranks = session->ranks();
  test::expect_numbered(*ranks);
  EXPECT_GE(ranks->count(), 2);
}

TEST(MpiRanks, ExchangeMessagesWithTheirNeighbours) {
  test::expect_exchanges(*session->ranks());
}

TEST(MpiRanks, AgreeOnSumsAndMaxima) {
  test::expect_sums_and_maxima(*session->ranks());
}

TEST(MpiRanks, Gather) {
  test::expect_gathers(*session->ranks());
}

TEST(MpiRanks, RunPairwiseWithTheBitsOfOneMachine) {
  // Waiting ranks use processor time: with more ranks than cores steps take long. With LocalRanks all scenes are run.
  for (const char* sides : {"wall", "periodic"}) {
    const std::vector<Scene> scenes = test::slab_scenes(sides, 8);
    for (std::size_t k = 0; k < scenes.size(); k += 4) {
      SCOPED_TRACE(scenes[k].title);
      const State start = initial_state(scenes[k]);
      test::expect_same(test::one_machine_trace(scenes[k], start),
                        test::slab_trace(scenes[k], start, {2, 512}, *session->ranks()));
    }
  }
}

TEST(MpiRanks, RunExactWithTheBitsOfOneMachine) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 12.0\nheight = 400.0\n[[disks]]\ncount = 1600\npositions = \"random\"\n"
      "radius = { uniform = [0.4, 0.6] }\nmass = 1.0\nvelocities = { maxwell = 1.0 }\n"
      "[run]\nmethod = \"exact\"\nt_end = 5.0\n",
      "scene", "");
  const State start = initial_state(scene);
  const test::SlabTrace trace = test::slab_trace(scene, start, {2, 512}, *session->ranks());
  test::expect_same(test::one_machine_trace(scene, start), trace);
  EXPECT_LT(trace.most_disks, 1000U);
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const carom::MpiSession session;
  carom::session = &session;
  return RUN_ALL_TESTS();
}
