// The engine compared with the reference in every scene of scenes/, after each of many steps.
#include "tests/support/scenes_on_threads.hpp"

namespace carom {
namespace {

class ParallelScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(ParallelScenes, EqualTheReferenceAfterEveryStep) {
  test::expect_engine_equals_reference(GetParam(), 250);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ParallelScenes, ::testing::ValuesIn(test::scene_files()),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace carom
