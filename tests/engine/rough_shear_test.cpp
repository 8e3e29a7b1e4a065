// Rough disks in a shear flow: a contact across the border by hand, the balance of energy, bits, and resuming.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/load/scene_file.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/run_start.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/resume_support.hpp"

namespace carom::test {
namespace {

struct Flow {
  std::string method, surface, more_physics;
  double t_end = 5.0;
};

Scene flow_scene(const Flow& f) {
  return parse_scene(
      fmt::format(
          "[box]\nwidth = 24.0\nheight = 18.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
          "top = \"periodic\"\nshear_rate = -0.6\n[physics]\nroughness = {{ {} }}\n{}\n[[disks]]\nname = \"a\"\n"
          "count = 180\npositions = \"random\"\nvelocities = {{ maxwell = 1.0 }}\nspin_temperature = 0.5\n"
          "radius = {{ uniform = [0.3, 0.6] }}\nmass = {{ uniform = [1, 2] }}\n[run]\nmethod = \"{}\"\n"
          "dt = 0.005\nt_end = {}\n",
          f.surface, f.more_physics, f.method, f.t_end),
      "shear.toml", "");
}

const char* const method_words[] = {"exact", "pairwise", "rollback"};
constexpr const char* perfect = "tangential_restitution = 1.0";
constexpr const char* sliding = "tangential_restitution = 0.4, friction = 0.2, inertia = 0.4";

double energy(const State& s) {
  const Energy e = energy_of(s.disks, 0.0);
  return e.kinetic + e.rotational;
}

// The upper image of the second disk, with velocity (3, -1), is a diameter above the first, with (2, 1). The surfaces
// slip at -1, which is reversed, as b = 1. With q = 1/2 a third of the change of -2 changes the velocities, by 1/3
// each.
TEST(RoughShear, DisksRubAcrossTheBorder) {
  for (const Method method : {Method::exact, Method::pairwise, Method::rollback}) {
    Scene scene = scene_of(method, 10.0, 10.0, 0.001, 1.0);
    set_sides(scene.box, SideKind::periodic, SideKind::periodic);
    scene.box.shear = {0.4, 4.0, 0.0};
    scene.physics.surfaces.disks = {1.0, HUGE_VAL};
    scene.physics.surfaces.inertia = 0.5;
    State start = state_of({{3.9, 8.7, 2.0, 1.0, 0.5, 1.0}, {3.0, 1.5, -1.0, -1.0, 0.5, 1.0}});
    start.disks.spin.assign(2, 0.0);
    start.disks.inertia = 0.5;
    const State end = run(scene, start);
    ASSERT_EQ(end.counters.collisions, 1U);
    EXPECT_NEAR(end.disks.vx[0], 2.0 + 1.0 / 3.0, 1e-11);
    EXPECT_NEAR(end.disks.vy[0], -1.0, 1e-11);
    EXPECT_NEAR(end.disks.vx[1], -1.0 - 1.0 / 3.0, 1e-11);
    EXPECT_NEAR(end.disks.vy[1], 1.0, 1e-11);
    EXPECT_NEAR(end.disks.spin[0], -4.0 / 3.0, 1e-11);
    EXPECT_NEAR(end.disks.spin[1], -4.0 / 3.0, 1e-11);
    EXPECT_NEAR(end.counters.shear_virial, -1.0 / 3.0, 1e-11)
        << "momentum along x, transferred by one diameter along y";
    EXPECT_NEAR(end.counters.shear_work, 4.0 / 3.0, 1e-11) << "the work of the image, at velocity 4";
    EXPECT_NEAR(energy(end), energy(start) + 4.0 / 3.0, 1e-11);
  }
}

TEST(RoughShear, WorkIsTheEnergyGainedBySurfacesThatLoseNone) {
  for (const char* method : method_words) {
    const Scene scene = flow_scene({method, perfect, ""});
    const State start = initial_state(scene);
    const State end = run(scene, start);
    EXPECT_GT(end.counters.collisions, 300U);
    EXPECT_GT(energy(end), energy(start) * 1.02) << "the flow must heat the disks";
    EXPECT_NEAR((energy(start) + end.counters.shear_work) / energy(end), 1.0, 1e-12) << method;
    EXPECT_TRUE(energy_warnings(scene, run_start(start, scene), end).empty());
  }
}

TEST(RoughShear, SmoothSurfacesChangeNoBit) {
  for (const char* method : method_words) {
    Scene scene = flow_scene({method, "tangential_restitution = -1.0", "", 2.0});
    State start = initial_state(scene);
    const State rough = run(scene, start);
    scene.physics.surfaces = {};
    start.disks.spin.clear();
    start.disks.inertia = 0.0;
    const State smooth = run(scene, start);
    EXPECT_EQ(rough.disks.x, smooth.disks.x);
    EXPECT_EQ(rough.disks.vx, smooth.disks.vx);
    EXPECT_EQ(rough.counters.shear_work, smooth.counters.shear_work);
    EXPECT_NEAR(rough.counters.shear_virial / smooth.counters.shear_virial, 1.0, 1e-12);
  }
}

TEST(LongRoughShear, SameBitsOnAnyThreadsAndResumed) {
  constexpr const char* law = "restitution = 0.9\n[[physics.pairs]]\ngroups = [\"a\", \"a\"]\nrestitution = 0.8";
  constexpr const char* bath = "thermostat = { kind = \"langevin\", temperature = 1.0, rate = 0.2, dt = 0.05 }";
  constexpr Count steps = 60;
  int first = 0;
  for (const char* method : method_words) {
    for (const char* surface : {perfect, sliding}) {
      for (const char* physics : {law, bath}) {
        SCOPED_TRACE(fmt::format("{} {} {}", method, surface, physics));
        const Scene scene = flow_scene({method, surface, physics});
        const State start = initial_state(scene);
        EXPECT_GT(expect_bits_of_reference(scene, start, steps).counters.collisions, 20U);
        expect_same_bits(scene, start, steps, first++);
      }
    }
  }
}

}  // namespace
}  // namespace carom::test
