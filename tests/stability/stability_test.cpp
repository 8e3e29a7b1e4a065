// Every case of scenes/stability with every method: no result is wrong without a warning, the methods that the case
// calls right are right, and both engines agree in bits and warnings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "tests/stability/verdict.hpp"

namespace carom::stability {

// Prints a case in the name of its test.
static void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

namespace {

const std::string folder = CAROM_SOURCE_DIR "/scenes/stability";

std::vector<Case> cases(Takes takes) {
  std::vector<Case> list = read_cases(folder + "/cases.toml");
  std::erase_if(list, [&](const Case& c) { return c.takes != takes; });
  return list;
}

std::string explain(const MethodResult& m) {
  std::string text = m.method + ", " + std::string(text_of(m.verdict));
  for (const CheckResult& c : m.checks) {
    text += "\n  " + c.what + " " + std::to_string(c.measured) + ", should be " + std::to_string(c.expected) + " +- " +
            std::to_string(c.bound);
  }
  for (const std::string& warning : m.warnings) text += "\n  said: " + warning;
  return text;
}

class Stability : public ::testing::TestWithParam<Case> {};

TEST_P(Stability, IsRightOrSaysSo) {
  const Case& c = GetParam();
  const CaseResult result = run_case(c, folder, Which::parallel);
  for (const MethodResult& m : result.methods) {
    EXPECT_NE(m.verdict, Verdict::silent) << explain(m);
    if (std::find(c.right.begin(), c.right.end(), m.method) != c.right.end()) {
      EXPECT_TRUE(m.right()) << explain(m);
    }
  }
  if (c.takes == Takes::minutes) return;
  const CaseResult plain = run_case(c, folder, Which::reference);
  for (std::size_t k = 0; k < result.methods.size(); ++k) {
    EXPECT_EQ(result.methods[k].hash, plain.methods[k].hash) << explain(result.methods[k]);
    EXPECT_EQ(result.methods[k].warnings, plain.methods[k].warnings) << explain(result.methods[k]);
  }
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Fast, Stability, ::testing::ValuesIn(cases(Takes::less)), name_of);
INSTANTIATE_TEST_SUITE_P(Long, Stability, ::testing::ValuesIn(cases(Takes::seconds)), name_of);
INSTANTIATE_TEST_SUITE_P(Slow, Stability, ::testing::ValuesIn(cases(Takes::minutes)), name_of);

}  // namespace
}  // namespace carom::stability
