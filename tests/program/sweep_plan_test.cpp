// The syntax of --over, and the plan of a sweep: values, runs and their names.
#include "app/sweep/sweep_plan.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/check.hpp"

namespace carom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> values(const std::string& text) {
  return parse_sweep_axis("key=" + text).values;
}

// The error of work(); empty if there is none.
template <class Work>
std::string complaint_of(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string complaint(const std::string& text) {
  return complaint_of([&] { parse_sweep_axis(text); });
}

std::vector<std::string> names(const std::vector<SweepRun>& runs) {
  std::vector<std::string> all;
  for (const SweepRun& run : runs) all.push_back(run.name);
  return all;
}

std::vector<SweepRun> runs_over(const std::vector<std::string>& axes, std::uint64_t seed, int seeds) {
  std::vector<SweepAxis> parsed;
  for (const std::string& axis : axes) parsed.push_back(parse_sweep_axis(axis));
  return sweep_runs({}, parsed, seed, seeds);
}

TEST(SweepPlan, RangesHaveBothEndsAndNumbersAsOneWouldWriteThem) {
  EXPECT_THAT(values("0:1:11"), ElementsAre("0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"));
  EXPECT_THAT(values("0.5:1.0:3"), ElementsAre("0.5", "0.75", "1"));
  EXPECT_THAT(values("1:-1:3"), ElementsAre("1", "0", "-1"));
  EXPECT_THAT(values("10:20:3"), ElementsAre("10", "15", "20"));
  EXPECT_THAT(values("1e-3:2e-3:2"), ElementsAre("0.001", "0.002"));
  EXPECT_THAT(values("2.5:2.5:1"), ElementsAre("2.5"));
}

// Numbers below 2.2e-308, which have fewer digits, are numbers; a sweep over them once ended with "error: stod".
TEST(SweepPlan, TheSmallestAndTheLargestNumbersAreNumbers) {
  EXPECT_THAT(values("0:1e-310:2"), ElementsAre("0", "1e-310"));
  EXPECT_THAT(values("1e-310,1e-309"), ElementsAre("1e-310", "1e-309"));
  EXPECT_THAT(values("1.7976931348623157e308:1.7976931348623157e308:1"), ElementsAre("1.7976931348623157e+308"));
  EXPECT_THAT(complaint("key=1e-310,10e-311"), HasSubstr("has the value 10e-311 twice"));
}

TEST(SweepPlan, CommasWithinBracketsAndQuotesPartNoValues) {
  EXPECT_THAT(values("[0.1,-0.5],0.25,[0,-1]"), ElementsAre("[0.1,-0.5]", "0.25", "[0,-1]"));
  EXPECT_THAT(values("{ uniform = [0.1,0.2] },{ a = 1, b = 2 },3"),
              ElementsAre("{ uniform = [0.1,0.2] }", "{ a = 1, b = 2 }", "3"));
  EXPECT_THAT(values("\"a,b\",'c,\"d'"), ElementsAre("\"a,b\"", "'c,\"d'"));
  EXPECT_THAT(values("\"[\",']'"), ElementsAre("\"[\"", "']'"));
  EXPECT_THAT(values("C:x,y"), ElementsAre("C:x", "y"));
  EXPECT_EQ(parse_sweep_axis("disks.0.count=1,2").key, "disks.0.count");
}

// Values in quotes that contain colons, such as file names, make no range.
TEST(SweepPlan, ColonsWithinQuotesMakeNoRange) {
  EXPECT_THAT(values("\"a:b:c\""), ElementsAre("\"a:b:c\""));
  EXPECT_THAT(values("\"0:1:3\",'4:5'"), ElementsAre("\"0:1:3\"", "'4:5'"));
  EXPECT_THAT(values("{ file = \"a:b:c.csv\" }"), ElementsAre("{ file = \"a:b:c.csv\" }"));
  EXPECT_THAT(complaint("key=\"a\":1:3"), HasSubstr("\"\"a\"\" is not a number"));
}

TEST(SweepPlan, AQuoteAfterABackslashEndsNoString) {
  EXPECT_THAT(values(R"("a\"b,c",2)"), ElementsAre(R"("a\"b,c")", "2"));
  EXPECT_THAT(values(R"("a\\",2)"), ElementsAre(R"("a\\")", "2"));
  EXPECT_THAT(values(R"('a\',2)"), ElementsAre(R"('a\')", "2"))
      << "within single quotes a backslash is an ordinary character";
}

TEST(SweepPlan, SaysWhatIsNoRangeAndNoList) {
  for (const char* const text : {"key=0:1:1", "key=nan:1:3", "key=0:inf:2", "key=-1e308:1e308:3", "key=0:1:1000001",
                                 "key=0:1:0", "key=0:1:-2", "key=0:1", "key=0:1:2:3"}) {
    EXPECT_THAT(complaint(text), HasSubstr(std::string("--over: \"") + text +
                                           "\" is not a range; expected KEY=FROM:TO:COUNT, of two values or more, or"));
  }
  EXPECT_THAT(complaint("key=0:1:2.5"), HasSubstr("\"2.5\" is not a number"));
  EXPECT_THAT(complaint("key=0:1x:3"), HasSubstr("\"1x\" is not a number"));
  for (const char* const text : {"key", "=1,2", "key="}) {
    EXPECT_THAT(complaint(text), HasSubstr(std::string("--over: is \"") + text + "\"; expected KEY=FROM:TO:COUNT"));
  }
  for (const char* const text : {"key=1,,2", "key=1,2,", "key=,1"}) {
    EXPECT_THAT(complaint(text), HasSubstr("has an empty value"));
  }
}

// Both values would be the same run under two names, and each call of the sweep would run the second of them again.
TEST(SweepPlan, AValueIsNotGivenTwice) {
  EXPECT_EQ(complaint("key=0.5,1,0.50"),
            "--over: \"key=0.5,1,0.50\" has the value 0.50 twice; expected different values; --seeds N makes several "
            "runs of one");
  EXPECT_THAT(complaint("key=exact,pairwise,exact"), HasSubstr("has the value exact twice"));
  EXPECT_THAT(complaint("key=1.0,1"), HasSubstr("has the value 1 twice"));
  EXPECT_THAT(complaint("key=1:1.0000000000000002:3"), HasSubstr("has the value 1 twice"));
  EXPECT_THAT(complaint("key=2:2:2"), HasSubstr("has the value 2 twice"));
}

TEST(SweepPlan, SeedsTurnFastestAndThenTheLastKey) {
  const std::vector<SweepRun> runs = runs_over({"a=1,2", "b=x,y,z"}, 7, 2);
  ASSERT_EQ(runs.size(), 12U);
  const auto told = [&](std::size_t k) {
    std::string text = runs[k].name;
    for (const Override& change : runs[k].overrides) text += " " + change.key + "=" + change.value;
    return text;
  };
  EXPECT_EQ(told(0), "0001 a=1 b=x seed=7");
  EXPECT_EQ(told(1), "0002 a=1 b=x seed=8");
  EXPECT_EQ(told(2), "0003 a=1 b=y seed=7");
  EXPECT_EQ(told(6), "0007 a=2 b=x seed=7");
  EXPECT_EQ(told(11), "0012 a=2 b=z seed=8");
}

TEST(SweepPlan, SeedsAndRunsHaveAnEnd) {
  constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(runs_over({}, last - 1, 2).back().overrides.back().value, "18446744073709551615");
  EXPECT_THAT(complaint_of([] { runs_over({}, last - 1, 3); }), HasSubstr("expected at most 2,"));
  EXPECT_THAT(complaint_of([] {
                runs_over({"a=1:1000:1000", "b=1:1001:1001"}, 1, 1);
              }),
              HasSubstr("1.001e+06 runs are too many; expected at most 1000000"));
}

TEST(SweepPlan, RunsKeepTheirNamesAndNewOnesAreNumberedOn) {
  const std::string scene = "[box]\n\nwidth = 1\n";
  std::vector<SweepRun> few = runs_over({"a=1.0,2"}, 1, 2);
  std::string plan = sweep_identity(scene, few);
  EXPECT_EQ(take_names(plan, scene, few), "");
  EXPECT_THAT(names(few), ElementsAre("0001", "0002", "0003", "0004"));

  std::vector<SweepRun> more = runs_over({"a=0.5,1,2"}, 1, 2);
  EXPECT_EQ(take_names(plan, scene, more), "");
  EXPECT_THAT(names(more), ElementsAre("0005", "0006", "0001", "0002", "0003", "0004"));
  plan = sweep_identity(scene, more);
  // The last number need not be in the last line.
  std::vector<SweepRun> most = runs_over({"a=0.5,1,2"}, 1, 3);
  EXPECT_EQ(take_names(plan, scene, most), "");
  EXPECT_THAT(names(most), ElementsAre("0005", "0006", "0007", "0001", "0002", "0008", "0003", "0004", "0009"));

  EXPECT_EQ(take_names(plan, scene, few), "this one lacks its run a=0.5 seed=1");
  EXPECT_EQ(take_names(plan, scene + "#", most), "the scene has changed since");
  EXPECT_EQ(take_names("0001", scene, most), "the scene has changed since");
}

}  // namespace
}  // namespace carom
