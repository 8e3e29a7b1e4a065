// A run that is killed at random moments, again and again, loses nothing: with carom resume it leaves the same results
// as an undisturbed run. CAROM_KILLS sets the number of kills (100 were done by hand, see docs/faults.md).
#include "core/base/random.hpp"
#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

struct KillCase {
  const char* name;
  const char* method;
  const char* output;
  double t_end;
  const char* trajectory = "xyz";
};

void PrintTo(const KillCase& c, std::ostream* out) {
  *out << c.name;
}

class Kill : public test::ProgramTest, public ::testing::WithParamInterface<KillCase> {
 protected:
  static int kills_wanted() {
    const char* const wanted = std::getenv("CAROM_KILLS");
    return wanted != nullptr ? std::atoi(wanted) : 8;
  }
  // The kill may have come before files no longer needed were removed: then the results must be complete, and resuming
  // must change nothing.
  void expect_whole_although_killed() const {
    const fs::path rest = at("out/carom-unfinished");
    if (fs::exists(rest / "checkpoint.carom")) {
      EXPECT_EQ(carom("resume out --quiet").status, 0);
    } else {
      fs::remove_all(rest);
    }
    expect_same_results("whole", "out");
  }
  bool has_checkpoint() const {
    return fs::exists(at("out/carom-unfinished/checkpoint.carom")) || fs::exists(at("out/checkpoint.carom"));
  }
};

TEST_P(Kill, NothingIsLost) {
  const KillCase& c = GetParam();
  write("busy.toml", test::busy_scene(c.method, std::string("checkpoint = 0.01\n") + c.output, c.trajectory));
  const std::string t_end = std::to_string(c.t_end);
  ASSERT_EQ(carom("run busy.toml --quiet -o whole --t-end " + t_end).status, 0);
  int kills = 0, runs = 0, from_nothing = 0;
  for (std::uint32_t attempt = 0; kills < kills_wanted(); ++attempt) {
    const bool resume = has_checkpoint();
    if (!resume) ++from_nothing;
    const pid_t run = resume ? start({"resume", "out", "--quiet", "--threads", attempt % 2 == 0 ? "2" : "1"})
                             : start({"run", "busy.toml", "--quiet", "-o", "out", "--force", "--t-end", t_end});
    // Most kills come during steps, some before the first step or while the run finishes.
    const double u = uniforms(17, Stream::position, attempt, 0).a;
    usleep(static_cast<useconds_t>(5e5 * u * u));
    kill(run, SIGKILL);
    const int status = wait_for(run);
    if (status == -SIGKILL && has_checkpoint()) ++kills;  // before the first checkpoint nothing can be lost
    if (status == 0) {
      ++runs;
      expect_same_results("whole", "out");
      fs::remove_all(at("out"));
    } else {
      ASSERT_EQ(status, -SIGKILL) << said();
    }
    if (fs::exists(at("out/summary.json"))) {  // killed after the last file was put in place
      expect_whole_although_killed();
      fs::remove_all(at("out"));
    }
    if (HasFailure()) return;
  }
  if (has_checkpoint()) {
    EXPECT_EQ(carom("resume out --quiet").status, 0);
    expect_same_results("whole", "out");
  }
  std::printf("%s: %d kills, %d runs came to their end between them, %d began from nothing\n", c.name, kills, runs,
              from_nothing);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, Kill,
    ::testing::Values(KillCase{"pairwise", "pairwise", "plots = [\"velocity\", \"energy\"]\n", 40.0},
                      KillCase{"exact", "exact", "plots = [\"energy\"]\n", 40.0},
                      KillCase{"rollback", "rollback", "", 20.0}, KillCase{"movie", "pairwise", "movie = true\n", 4.0},
                      KillCase{"h5md", "pairwise", "", 40.0, "h5md"}),
    [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace carom
