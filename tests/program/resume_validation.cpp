// All cases of which resume_test.cpp takes a sample: every method with every combination of features, interrupted again
// and again.
#include <tuple>

#include "tests/support/resume_support.hpp"

namespace carom {
namespace {

class ResumeAll : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(ResumeAll, HasTheBitsOfARunThatWasNeverStopped) {
  test::expect_same_bits(std::get<0>(GetParam()), std::get<1>(GetParam()), 0, 1);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, ResumeAll,
                         ::testing::Combine(::testing::Values("pairwise", "rollback", "exact"),
                                            ::testing::Values("wall", "periodic", "periodic_x", "sink")),
                         test::method_and_sides);

}  // namespace
}  // namespace carom
