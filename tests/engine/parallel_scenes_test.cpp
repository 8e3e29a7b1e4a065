// The engine compared with the reference in every scene of scenes/, after each of its first steps.
#include <set>

#include "tests/support/scenes_on_threads.hpp"

namespace carom {
namespace {

class ParallelScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(ParallelScenes, EqualTheReferenceAtFirst) {
  test::expect_engine_equals_reference(GetParam(), 40);
}

// The scenes that take more than half a second, or all the others.
std::vector<std::string> scenes(bool that_take_long) {
  const std::set<std::string> take_long{"analysis",    "couette",    "dense_mixture", "heat_conduction",
                                        "lorentz_gas", "mixing",     "paddle",        "piston",
                                        "rough_gas",   "shaken_bed", "tracer_in_bath"};
  std::vector<std::string> names = test::scene_files();
  std::erase_if(names, [&](const std::string& name) { return take_long.contains(name) != that_take_long; });
  return names;
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) {
  return info.param;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ParallelScenes, ::testing::ValuesIn(scenes(false)), name_of);
INSTANTIATE_TEST_SUITE_P(LongScenes, ParallelScenes, ::testing::ValuesIn(scenes(true)), name_of);

}  // namespace
}  // namespace carom
