// The rounding mode and flush-to-zero of a host program change no bit, and are the same after a call as before.
#include "core/base/float_environment.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parallel/threads/executor.hpp"
#include "run/scene/run_scene.hpp"
#include "run/simulation/simulation.hpp"
#include "tests/support/simulation_support.hpp"

namespace carom {
namespace {

#ifdef __SSE2__
constexpr unsigned flush_to_zero = 0x8040U;  // FTZ and DAZ
#else
constexpr unsigned flush_to_zero = 0;
#endif

// A host whose floating-point environment is as left by libraries built with -ffast-math, with rounding upwards as
// well.
class HostileHost {
 public:
  HostileHost() {
    std::fesetround(FE_UPWARD);
#ifdef __SSE2__
    _mm_setcsr(_mm_getcsr() | flush_to_zero);
#endif
  }
  ~HostileHost() {
    std::fesetenv(&before_);
  }
  HostileHost(const HostileHost&) = delete;
  HostileHost& operator=(const HostileHost&) = delete;

  static bool is_as_set() {
#ifdef __SSE2__
    if ((_mm_getcsr() & flush_to_zero) != flush_to_zero) return false;
#endif
    return std::fegetround() == FE_UPWARD;
  }

 private:
  std::fenv_t before_ = [] {
    std::fenv_t now;
    std::fegetenv(&now);
    return now;
  }();
};

Scene gas(const char* method) {
  const std::string text = R"(
    [box]
    packing_fraction = 0.4
    [physics]
    gravity = 0.1
    restitution = 0.9
    [[disks]]
    count = 12000
    positions = "hexagonal"
    velocities = { maxwell = 1.0 }
    radius = 0.5
    mass = 1.0
    [run]
    dt = 0.01
    t_end = 0.05
    method = ")" + std::string(method) +
                           "\"\n";
  return parse_scene(text, "gas.toml", "");
}

TEST(FloatEnvironment, NumbersAreTheUsualOnesInside) {
  const HostileHost host;
  volatile double one = 1.0, third = 3.0, tiny = 1e-310;
  const double up = one / third;
  {
    const FloatEnvironment environment;
    EXPECT_LT(one / third, up);
    EXPECT_GT(tiny * 1.0, 0.0);
    EXPECT_EQ(std::strtod("0.3", nullptr), 0.3) << "the numbers of a scene may be read like this";
  }
  EXPECT_TRUE(HostileHost::is_as_set());
  EXPECT_GT(std::strtod("0.3", nullptr), 0.3);
  EXPECT_EQ(one / third, up);
}

TEST(FloatEnvironment, WorkersRoundAsUsual) {
  const HostileHost host;
  const Executor executor(4);
  std::vector<double> thirds(1000);
  executor.run(thirds.size(), [&](std::size_t b) {
    volatile double one = 1.0, third = 3.0;
    thirds[b] = one / third;
  });
  const FloatEnvironment environment;
  volatile double one = 1.0, third = 3.0;
  for (const double t : thirds) EXPECT_EQ(t, one / third);
}

TEST(FloatEnvironment, SimulationAndRunHaveTheSameBits) {
  for (const char* method : {"pairwise", "exact"}) {
    for (const int threads : {1, 3}) {
      const EngineChoice engine = choose_engine("parallel", threads);
      const auto simulated = [&] {
        Simulation s(gas(method), engine);
        s.run_until(0.02);
        s.add({0.1, 0.1, 0.0, 0.0, 0.01, 1e-6});
        s.run_until(0.05);
        return s.hash();
      };
      const auto run_whole = [&] {
        RunSettings settings;
        settings.engine = engine;
        return run(gas(method), settings).summary.state_hash;
      };
      const std::uint64_t hash = simulated();
      const std::string whole = run_whole();
      const HostileHost host;
      EXPECT_EQ(simulated(), hash) << method << threads;
      EXPECT_EQ(run_whole(), whole) << method << threads;
      EXPECT_TRUE(HostileHost::is_as_set());
    }
  }
}

// Times of contacts are computed when they are asked for, and some changes at once.
TEST(FloatEnvironment, ContactsAndChangesHaveTheSameBits) {
  for (const char* method : {"pairwise", "exact", "rollback"}) {
    for (const char* engine : {"parallel", "reference"}) {
      SCOPED_TRACE(std::string(method) + " " + engine);
      const auto changed = [&] {
        Simulation s(test::gas(method), choose_engine(engine, 1));
        s.step(3);
        std::vector<DiskContact> met = s.contacts();
        s.remove(7);
        s.set_velocity(3, {0.1, -0.7});
        s.step(3);
        const std::vector<DiskContact> later = s.contacts();
        met.insert(met.end(), later.begin(), later.end());
        return std::pair(met, s.hash());
      };
      const auto usual = changed();
      EXPECT_FALSE(usual.first.empty());
      const HostileHost host;
      const auto hostile = changed();
      EXPECT_EQ(hostile.second, usual.second);
      ASSERT_EQ(hostile.first.size(), usual.first.size());
      for (std::size_t k = 0; k < usual.first.size(); ++k) EXPECT_EQ(hostile.first[k].time, usual.first[k].time) << k;
    }
  }
}

// A checkpoint contains the energies of the start, which are summed again if disks were added before the first step.
TEST(FloatEnvironment, SavedStatesHaveTheSameBits) {
  const auto saved = [](bool hostile) {
    Simulation s(test::gas("exact"), choose_engine("", 1));
    s.set_velocity(3, {0.1, -0.7});
    std::optional<HostileHost> host;
    if (hostile) host.emplace();
    return s.save();
  };
  EXPECT_EQ(saved(true), saved(false));
}

}  // namespace
}  // namespace carom
