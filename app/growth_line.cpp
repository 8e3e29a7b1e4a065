#include "app/growth_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "app/progress.hpp"

namespace carom {

namespace {

constexpr double update_seconds = 0.2;

class GrowthLine {
 public:
  GrowthLine() = default;
  GrowthLine(const GrowthLine&) = delete;
  GrowthLine& operator=(const GrowthLine&) = delete;
  ~GrowthLine() {
    if (on_screen_) std::fputs("\r\x1b[K", stderr);
  }

  void update(const GrowthProgress& p) {
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < update_seconds) return;
    last_ = now;
    std::fputs(
        fmt::format("\rgrowing: packing fraction {:.5f} of {:g}  {} steps  {} collisions\x1b[K", p.packing_fraction,
                    p.final_packing_fraction, p.steps, short_number(static_cast<double>(p.collisions)))
            .c_str(),
        stderr);
    on_screen_ = true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  bool on_screen_ = false;
};

}  // namespace

std::function<void(const GrowthProgress&)> growth_line(bool wanted) {
  if (!wanted || isatty(STDERR_FILENO) != 1) return {};
  return [line = std::make_shared<GrowthLine>()](const GrowthProgress& progress) { line->update(progress); };
}

}  // namespace carom
