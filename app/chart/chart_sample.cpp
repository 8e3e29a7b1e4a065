#include "app/chart/chart_sample.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <utility>

#include "core/base/check.hpp"
#include "core/measure/displacement.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/shear_flow.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::chart {

namespace {

// The number of times that overlaps are measured in a run.
constexpr int looks = 20;

// CPU time of this thread only, since others measure at the same time.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

SideMotion at_rest(double inset) {
  SideMotion motion;
  motion.kind = SideMotion::Kind::steady;
  motion.inset = motion.furthest = inset;
  return motion;
}

// The scene's disks at time 0, in their equilibrium as an elastic gas between sides at rest. A shear flow begins then.
State start_state(const ChartScene& scene, std::uint64_t seed) {
  Scene melting = scene_of(scene, seed, Method::exact, 0.0, scene.melting);
  melting.physics.restitution = 1.0;
  melting.physics.law = {};
  melting.physics.diffusion = 0.0;
  const Shear shear = std::exchange(melting.box.shear, Shear{});
  for (SideMotion& motion : melting.box.motions) {
    if (motion.moves() && scene.melting > 0.0) motion = at_rest(motion.at(0.0).inset);
  }
  const auto engine = make_parallel_engine(melting, initial_state(melting), {1});
  engine->forget_paths();
  while (engine->state().time < scene.melting) engine->step();
  State state = engine->state();
  state.time = 0.0;
  state.window = 0.0;
  state.counters = {};
  for (std::size_t i = 0; i < state.disks.size() && shear.acts(); ++i) {
    state.disks.vx[i] += shear.flow(state.disks.y[i], melting.box.height);
  }
  return state;
}

// The work done by sides that move and by the images of a shear.
double work_on(const State& state) {
  double work = state.counters.shear_work;
  for (const double of_side : state.counters.side_energy) work += of_side;
  return work;
}

// The same start with every position moved to the next double, as rounding does.
State moved_by_rounding(State state) {
  for (double& x : state.disks.x) x = std::nextafter(x, 0.0);
  for (double& y : state.disks.y) y = std::nextafter(y, 0.0);
  return state;
}

// The end of a short run, and the collisions in it.
struct Flight {
  std::vector<Vec2> places;  // in order of id
  CollisionLog collisions;   // sorted
};

// Positions in order of id; ids of fixed disks, which are obstacles, are among those of the disks.
std::vector<Vec2> places_of(const Disks& d) {
  std::vector<Vec2> places;
  for (const std::size_t i : by_id(d)) places.push_back({d.x[i], d.y[i]});
  return places;
}

Flight fly(const Scene& scene, const State& start) {
  Flight flight;
  const auto engine = make_reference_engine(scene, start, &flight.collisions);
  while (engine->state().time < scene.run.t_end) engine->step();
  flight.places = places_of(engine->state().disks);
  std::sort(flight.collisions.begin(), flight.collisions.end());
  return flight;
}

double mean_distance(const Scene& scene, const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  const Domain box = box_at(scene.box, scene.run.t_end);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 apart = nearest_image(Vec2{a[i].x - b[i].x, a[i].y - b[i].y}, box);
    sum += std::hypot(apart.x, apart.y);
  }
  return sum / static_cast<double>(a.size());
}

// The number of entries of a that are not in b; a pair that collides twice in one and once in the other counts once.
std::size_t lacking(const CollisionLog& a, const CollisionLog& b) {
  CollisionLog rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest.size();
}

void compare_flights(const Scene& scene, const State& start, const Flight& exact, const Flight& flight,
                     Sample& sample) {
  const double collisions = static_cast<double>(std::max<std::size_t>(1, exact.collisions.size()));
  sample[Measure::path] =
      mean_distance(scene, exact.places, flight.places) / mean_distance(scene, exact.places, places_of(start.disks));
  sample[Measure::missed] = static_cast<double>(lacking(exact.collisions, flight.collisions)) / collisions;
  sample[Measure::spurious] = static_cast<double>(lacking(flight.collisions, exact.collisions)) / collisions;
}

// The long run: its cost and its figures.
void measure_rates(const ChartScene& scene, const Scene& s, const State& start, Sample& sample) {
  const auto engine = make_parallel_engine(s, start, {1});
  engine->forget_paths();
  const double n = static_cast<double>(start.disks.size());
  double seconds = 0.0, overlap = 0.0;
  DisplacementTally displacement;
  begin_displacement(displacement, start.disks, s.box, 0.0);
  for (int look = 1; look <= looks; ++look) {
    const double until = look == looks ? s.run.t_end : s.run.t_end * look / looks;
    const double before = thread_seconds();
    while (engine->state().time < until) engine->step();
    seconds += thread_seconds() - before;
    overlap = std::max(overlap, max_overlap(engine->state().disks, box_at(s.box, engine->state().time)));
    if (scene.figure == Figure::spread) look_at(displacement, engine->state().disks, s.box, engine->state().time);
  }
  const State& end = engine->state();
  const Energy first = energy_of(start.disks, s.physics.gravity);
  const Energy last = energy_of(end.disks, s.physics.gravity);
  const Disks before = relative_to_flow(start.disks, s.box), after = relative_to_flow(end.disks, s.box);
  sample[Measure::cost] = seconds / (n * s.run.t_end);
  sample[Measure::rate] = 2.0 * static_cast<double>(end.counters.collisions) / (n * s.run.t_end);
  sample[Measure::energy] =
      scene.keeps_energy ? std::abs(last.total() / (first.total() + work_on(end)) - 1.0) : undefined;
  sample[Measure::momentum] =
      scene.keeps_momentum ? momentum_drift(momentum_of(before), momentum_of(after)) : undefined;
  sample[Measure::overlap] = overlap;
  switch (scene.figure) {
    case Figure::pressure:
      sample[Measure::figure] = pressure({0.5 * (energy_of(before, 0.0).kinetic + energy_of(after, 0.0).kinetic), 0.0},
                                         end.counters.virial, s.run.t_end, s.box);
      break;
    case Figure::cooling:
      sample[Measure::figure] = (std::sqrt(first.kinetic / last.kinetic) - 1.0) / s.run.t_end;
      break;
    case Figure::spread:
      sample[Measure::figure] =
          mean_square_displacement(displacement, end.disks, s.box).value / (4.0 * s.physics.diffusion * s.run.t_end);
      break;
  }
}

}  // namespace

std::vector<Sample> measure_seed(const ChartScene& scene, std::uint64_t seed, const std::vector<Setting>& settings) {
  const State start = start_state(scene, seed);
  const bool brownian = scene.figure == Figure::spread;
  std::map<double, Flight> exact;  // by dt; 0 if exact needs none
  std::vector<Sample> samples;
  for (const Setting& setting : settings) {
    if (seed > setting.seeds) continue;
    const double key = brownian ? setting.dt : 0.0;
    const Scene flight = scene_of(scene, seed, setting.method, setting.dt, scene.flight);
    if (!exact.contains(key)) exact[key] = fly(scene_of(scene, seed, Method::exact, setting.dt, scene.flight), start);
    Sample& sample = samples.emplace_back(Sample{setting.method, setting.dt, {}});
    const bool itself = setting.method == Method::exact;
    try {
      compare_flights(flight, start, exact[key], fly(flight, itself ? moved_by_rounding(start) : start), sample);
      measure_rates(scene, scene_of(scene, seed, setting.method, setting.dt, scene.length), start, sample);
    } catch (const PhysicsError& error) {
      if (itself) throw;
      sample.stopped = error.what();
    }
  }
  return samples;
}

ShortRun run_fluid(std::size_t disks, Method method, double dt, int rounds) {
  const ChartScene scene = fluid_of(disks);
  const State start = start_state(scene, 1);
  ShortRun run{std::numeric_limits<double>::infinity(), 0.0};
  for (int round = 0; round < rounds; ++round) {
    const auto engine = make_parallel_engine(scene_of(scene, 1, method, dt, scene.length), start, {1});
    engine->forget_paths();
    const double before = thread_seconds();
    while (engine->state().time < scene.length) engine->step();
    run.cost = std::min(run.cost, (thread_seconds() - before) / (static_cast<double>(disks) * scene.length));
    run.steps = static_cast<double>(engine->state().counters.steps) / scene.length;
  }
  return run;
}

}  // namespace carom::chart
