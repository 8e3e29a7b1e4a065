#include "run/engine/strict_engine.hpp"

#include <utility>

#include "core/base/check.hpp"

namespace carom {

namespace {

class StrictEngine final : public Engine {
 public:
  explicit StrictEngine(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

  void step() override {
    engine_->step();
    warnings_ = engine_->take_warnings();
    fail_if_any(warnings_);
  }
  const State& state() const override { return engine_->state(); }
  const State& progress() const override { return engine_->progress(); }
  std::unique_ptr<StatePieces> pieces() const override { return engine_->pieces(); }
  double disks_at(double t, Disks& out) const override { return engine_->disks_at(t, out); }
  std::unique_ptr<DisksInPieces> pieces_at(double t, Disks& room) const override { return engine_->pieces_at(t, room); }
  double fastest_within() const override { return engine_->fastest_within(); }
  void forget_paths() override { engine_->forget_paths(); }
  void release_memory() override { engine_->release_memory(); }
  void set_watch(const std::function<bool()>& go_on) override { engine_->set_watch(go_on); }
  bool edit(const Edit& edit) override { return engine_->edit(edit); }
  bool visit_near(Vec2 centre, double half_width, double half_height,
                  const std::function<void(std::size_t)>& visit) override {
    return engine_->visit_near(centre, half_width, half_height, visit);
  }
  std::vector<DiskContact> contacts() const override { return engine_->contacts(); }
  const PhaseTimes& phase_times() const override { return engine_->phase_times(); }
  std::vector<std::string> take_warnings() override {
    std::vector<std::string> warnings = std::exchange(warnings_, {});
    const std::vector<std::string> more = engine_->take_warnings();
    warnings.insert(warnings.end(), more.begin(), more.end());
    return warnings;
  }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<std::string> warnings_;  // raised by the step that ended the run
};

}  // namespace

std::unique_ptr<Engine> make_strict(std::unique_ptr<Engine> engine) {
  return std::make_unique<StrictEngine>(std::move(engine));
}

void fail_if_any(const std::vector<std::string>& warnings) {
  if (!warnings.empty()) throw PhysicsError(warnings.front() + " (--strict)");
}

}  // namespace carom
