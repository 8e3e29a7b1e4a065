// carom run and resume with --ranks if a rank is killed or stopped.
#include <chrono>
#include <random>

#include "tests/ranks/ranks_run.hpp"

namespace carom {
namespace {

using test::exact_tall;
using test::far_end;
using test::RanksRun;

// Any of any number of ranks dies at any time: the others end, there is one line of error, and from the last checkpoint
// the run goes on with another number of ranks as if nothing had happened. There it is killed again, and after the
// fourth time one process runs it to its end. Every other run uses exact. The end of the runs is later than any of them
// gets before it is killed.
TEST_F(RanksRun, AKilledRankEndsAllAndNothingIsLost) {
  const std::string run_one = "run scene.toml --quiet --set output.every=1e3 ";
  const std::string end = "--t-end 1e3";
  const std::string exact_end = "--t-end 1e4";
  ASSERT_EQ(carom(run_one + end + " -o one_pairwise").status, 0);
  ASSERT_EQ(carom(run_one + exact_end + exact_tall + "-o one_exact").status, 0);
  std::mt19937 random(19);
  for (int k = 0; k < 5; ++k) {
    const bool exact = k % 2 == 1;
    const std::string folder = fmt::format("killed{}", k);
    std::size_t count = 2 + random() % 3;
    for (int kills = 0; kills < 4; ++kills, count = 2 + (count - 1) % 3) {
      const std::size_t victim = random() % count;
      const auto delay = static_cast<useconds_t>(random() % 300'000);
      SCOPED_TRACE(fmt::format("run {}: rank {} of {}, after {} us", k, victim, count, delay));
      const std::string ranks = std::to_string(count);
      const auto started = std::chrono::steady_clock::now();
      const pid_t run = kills == 0 ? start_long(folder, ranks, exact ? exact_tall : "") : resume_long(folder, ranks);
      const std::vector<pid_t> all = ranks_of(folder);
      ASSERT_EQ(all.size(), count);
      const std::size_t before = said().size();
      // On a machine so busy that the start takes long the end may take long, too.
      const auto start_took = std::chrono::steady_clock::now() - started;
      usleep(delay);
      kill(all[victim], SIGKILL);
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_EQ(wait_for(run), 1);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10) + 10 * start_took);
      EXPECT_EQ(said().substr(before),
                "carom: error: one of the ranks was killed by signal 9; the last checkpoint, if the run has written "
                "one, is intact: use carom resume with its folder\n");
      EXPECT_TRUE(ranks_of(folder).empty());
    }
    const std::string one = exact ? "one_exact" : "one_pairwise";
    ASSERT_EQ(carom("resume " + folder + " --quiet " + (exact ? exact_end : end)).status, 0);
    EXPECT_EQ(summary(folder)["state_hash"], summary(one)["state_hash"]);
    EXPECT_EQ(summary(folder)["collisions"], summary(one)["collisions"]);
  }
}

// The others wait for a rank that is stopped.
TEST_F(RanksRun, AStoppedRankIsWaitedFor) {
  ASSERT_EQ(carom("run scene.toml --quiet --set output.every=1e3 -o one " + far_end).status, 0);
  for (const std::size_t victim : {0U, 1U}) {
    const std::string folder = fmt::format("stopped{}", victim);
    const pid_t run = start_long(folder, "2");
    const std::vector<pid_t> ranks = ranks_of(folder);
    ASSERT_EQ(ranks.size(), 2U);
    kill(ranks[victim], SIGSTOP);
    sleep(3);
    EXPECT_EQ(waitpid(run, nullptr, WNOHANG), 0) << said();
    const auto last = checkpoint_time(folder);
    kill(ranks[victim], SIGCONT);
    await_checkpoint_after(last, folder, run);
    kill(run, SIGTERM);
    EXPECT_EQ(wait_for(run), 4) << said();
    expect_undisturbed(folder, 3);
  }
}

}  // namespace
}  // namespace carom
