// carom compare for folders with only a summary, and for what cannot be compared.
#include <filesystem>

#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;

class CompareSummaries : public test::CommandTest {
 protected:
  // Makes a folder with only this summary.
  void summary(const std::string& folder, const std::string& text) const {
    std::filesystem::create_directories(at(folder));
    write(folder + "/summary.json", text);
  }
};

TEST_F(CompareSummaries, KeysThatDifferAreNamed) {
  const std::string of_three = R"({"state_hash": "00ff", "particles": 3, "pressure": null, "step_s": 1.5})";
  summary("a", of_three);
  summary("b", test::replaced(of_three, "1.5", "2.5"));
  Outcome o = carom("compare a b");
  EXPECT_EQ(o.status, 0) << "times are not results";
  EXPECT_EQ(o.out, "same summary, state hash included\n");
  summary("b", R"({"state_hash": "00fe", "particles": 3, "pressure": 0.25})");
  o = carom("compare a b");
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.out,
            "different: summary.json\n"
            "  state_hash      \"00ff\" against \"00fe\"\n"
            "  pressure        null against 0.25\n");
  o = carom("compare a b --json");
  EXPECT_EQ(o.status, 1);
  const Json j = Json::parse(o.out);
  EXPECT_EQ(j["same"], false);
  EXPECT_EQ(j["different_keys"], Json({"state_hash", "pressure"}));
  EXPECT_FALSE(j.contains("frames") || j.contains("tolerance"));
}

// Figures that only some scenes have, or that earlier versions did not write.
TEST_F(CompareSummaries, FiguresThatBothHaveAreCompared) {
  summary("a", R"({"state_hash": "00ff", "heat": {"left": 1.5}, "waiting": 0, "removed_by": {"left": 1},
                   "analysis": {"diffusion": 0.5}, "worst_overlap_ids": [1, 2]})");
  summary("b", R"({"state_hash": "00ff", "heat": {"left": 2.5}, "waiting": 3, "removed_by": {"left": 2},
                   "analysis": {"diffusion": 0.25}, "worst_overlap_ids": [1, 3]})");
  EXPECT_EQ(carom("compare a b").out,
            "different: summary.json\n"
            "  heat            {\"left\":1.5} against {\"left\":2.5}\n"
            "  waiting         0 against 3\n"
            "  removed_by      {\"left\":1} against {\"left\":2}\n"
            "  analysis        {\"diffusion\":0.5} against {\"diffusion\":0.25}\n"
            "  worst_overlap_ids [1,2] against [1,3]\n");
  summary("b", R"({"state_hash": "00ff"})");
  EXPECT_EQ(carom("compare a b").status, 0);
}

TEST_F(CompareSummaries, WhatIsNoSummaryIsNoSameSummary) {
  summary("a", R"({"particles": 3})");
  summary("cut", R"({"particles": )");
  expect_error("$C compare a cut", 2, "cut/summary.json: is not JSON; expected the summary of a run");
  for (const std::string other : {"[]", "3", "null", "\"00ff\""}) {
    summary("other", other);
    expect_error("$C compare other other", 2,
                 "other/summary.json: is not a JSON object; expected the summary of a run");
    expect_error("$C compare a other", 2, "other/summary.json: is not a JSON object");
  }
}

TEST_F(CompareSummaries, WhatCannotBeComparedSaysWhy) {
  summary("a", R"({"particles": 3})");
  write("a.xyz",
        "1\nLattice=\"10 0 0 0 8 0 0 0 1\" Properties=species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=0\n"
        "A 1 2 3 4 0.5 1 0\n");
  std::filesystem::create_directories(at("empty"));
  expect_error("$C compare a empty", 2, "empty: holds neither trajectory.xyz, trajectory.h5 nor summary.json");
  std::filesystem::create_directories(at("going on/carom-unfinished"));
  expect_error("$C compare a 'going on'", 2,
               "going on: holds a run that is not finished; expected a finished run (carom resume 'going on'), or a "
               "trajectory in going on/carom-unfinished");
  expect_error("$C compare a a.xyz", 2, "a and a.xyz: have nothing in common to compare");
  expect_error("$C compare a.xyz a", 2, "a.xyz and a: have nothing in common to compare");
  expect_error("$C compare a nowhere", 2, "nowhere: does not exist");
  std::filesystem::create_symlink("round", at("round"));
  for (const char* const command : {"compare a round", "view round", "render round"}) {
    expect_error(std::string("$C ") + command, 2, "round: cannot be opened: Too many levels of symbolic links");
  }
  expect_error("$C view a.xyz -o " + std::string(300, 'a') + ".html", 2, "cannot be written: File name too long");
}

}  // namespace
}  // namespace carom
