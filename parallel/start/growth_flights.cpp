#include "parallel/start/growth_flights.hpp"

#include <memory>
#include <utility>

#include "parallel/exact/exact_engine.hpp"
#include "parallel/start/growth_step.hpp"

namespace carom {

namespace {

// Lists that allow for more growth than this factor times what is left are made anew, since they leave disks less of
// the skin; but not if they allow for less than `hardly_any` times the largest radius, so that it hardly matters.
constexpr double most_left_over = 2.0;
constexpr double hardly_any = 0.02;

class GrowthFlights {
 public:
  GrowthFlights(const Executor& executor, const Threads& threads) : executor_(executor), threads_(threads) {}

  State fly(const Scene& scene, State state, const std::function<void()>& look) {
    const double growth = most_lack_ / closed_share;
    if (!engine_) {
      engine_ = make_exact_flights(scene, std::move(state), threads_, growth);
    } else {
      const bool is_much = engine_->growth() > hardly_any * largest_;
      const bool serve = in_order_ && !(is_much && engine_->growth() > most_left_over * growth);
      engine_->begin_flight(std::move(state), scene.run.t_end, growth, serve);
    }
    engine_->forget_paths();
    while (engine_->state().time < scene.run.t_end) {
      engine_->step();
      look();
    }
    return engine_->end_flight();
  }

  GrowthTally step(Disks& d, const Domain& box, const std::vector<double>& target) {
    in_order_ = engine_ && engine_->growth() > 0.0;
    const GrowthTally tally =
        in_order_ ? grow_by_lists(executor_, d, box, target, [&](const auto& visit) { engine_->visit_lists(visit); })
                  : grow_by_cells(executor_, d, box, target);
    most_lack_ = tally.most_lack;
    largest_ = largest_radius(d);
    return tally;
  }

 private:
  const Executor& executor_;
  Threads threads_;
  std::unique_ptr<ExactFlights> engine_;
  double most_lack_ = 0.0;  // of the radius of any disk, after the last step; length
  double largest_ = 0.0;    // largest radius
  bool in_order_ = false;   // are the disks stored as they were at the last flight's end?
};

}  // namespace

GrowthTools parallel_growth(const Executor& executor, const Threads& threads) {
  const auto flights = std::make_shared<GrowthFlights>(executor, threads);
  GrowthTools tools;
  tools.fly = [flights](const Scene& scene, State state, const std::function<void()>& look) {
    return flights->fly(scene, std::move(state), look);
  };
  tools.step = [flights](Disks& d, const Domain& box, const std::vector<double>& target) {
    return flights->step(d, box, target);
  };
  return tools;
}

}  // namespace carom
