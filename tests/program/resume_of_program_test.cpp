// carom resume of a file saved by a program: outputs start there, other files nearby are not changed, and the energy of
// the program's changes does not count as a gain.
#include <fmt/format.h>

#include "core/load/scene_file.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ResumeOfProgram : public test::CommandTest {
 protected:
  // A simulation of small.toml at time 0.5, in which disk 0 was made ten times as fast as any; it is saved beside files
  // of the user.
  std::string save() const {
    Simulation s(load_scene((at("small.toml")).string(), {}), choose_engine("", 1));
    s.run_until(0.5);
    s.set_velocity(0, {10.0, 0.0});
    fs::create_directories(at("mine"));
    write("mine/scene.toml", "# mine");
    write("mine/series.csv", "mine");
    s.save(at("mine/state.carom").string());
    s.run_until(1.0);
    return fmt::format("{:016x}", s.hash());
  }
};

using LongResumeOfProgram = ResumeOfProgram;

TEST_F(ResumeOfProgram, OutputsBeginAndNothingIsReplaced) {
  const std::string hash = save();
  const Outcome o = carom("resume mine/state.carom --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("results go to out/small"));
  EXPECT_THAT(o.err, Not(HasSubstr("has changed")));
  const Json j = Json::parse(o.out);
  EXPECT_EQ(j["state_hash"], hash);
  EXPECT_EQ(j["frames"], 6) << "frames from 0.5 to 1.0";
  EXPECT_THAT(files_in("mine"), testing::ElementsAre("scene.toml", "series.csv", "state.carom"));
  EXPECT_EQ(test::text_of(at("mine/scene.toml")), "# mine");
  EXPECT_EQ(test::text_of(at("mine/series.csv")), "mine");
  EXPECT_THAT(files_in("out/small"),
              testing::IsSupersetOf({"scene.toml", "series.csv", "summary.json", "trajectory.xyz"}));
  const std::string series = test::text_of(at("out/small/series.csv"));
  EXPECT_THAT(series.substr(series.find('\n') + 1), StartsWith("0.5"));
  EXPECT_THAT(carom("resume mine/state.carom --quiet -o mine").err, HasSubstr("scene.toml of an earlier run"));
}

// A file with a row for each disk of the scene must also have rows for disks added by a program, even if such a run is
// stopped and resumed.
TEST_F(LongResumeOfProgram, TrajectoriesHaveTheDisksThatAProgramAdded) {
  for (const std::string format : {"xyz", "h5md"}) {
    Simulation s(load_scene(at("small.toml").string(), {{"output.trajectory", format}, {"run.t_end", "4.0"}}),
                 choose_engine("", 1));
    s.run_until(0.5);
    s.remove(2);
    ASSERT_TRUE(s.add({0.2, 0.2, 1.0, 0.5, 0.1, 1.0}));
    ASSERT_TRUE(s.add({0.2, 9.8, 1.0, 0.5, 0.1, 1.0}));
    s.save(at("state.carom").string());
    s.run_until(4.0);
    ASSERT_EQ(carom("resume state.carom --max-walltime 0.000001 --quiet -o " + format).status, 4);
    const Outcome o = carom("resume --json " + format);
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(Json::parse(o.out)["state_hash"], fmt::format("{:016x}", s.hash()));
    const Outcome same = carom("resume state.carom --quiet -o whole_" + format);
    ASSERT_EQ(same.status, 0) << same.err;
    EXPECT_EQ(carom(fmt::format("compare {0} whole_{0}", format)).status, 0);
  }
}

// A change by the program has added a quarter of a hundred times the energy before.
TEST_F(ResumeOfProgram, EnergyThatAChangeBroughtIsPutIn) {
  save();
  const Outcome o = carom("resume mine/state.carom --strict -o again");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, Not(HasSubstr("was put in")));
}

}  // namespace
}  // namespace carom
