#include "app/run/trial_memory.hpp"

#include <sys/resource.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/measure/invariants.hpp"
#include "core/scene/scene_output.hpp"
#include "run/outputs/run_outputs.hpp"

namespace carom {

namespace {

// Bytes that the library HDF5 and the chunks that are packed at the same time take, measured with 10^6 disks; they do
// not grow with the disks. With fewer than these, chunks are smaller, and the rehearsal of the files takes as much.
constexpr std::size_t h5md_buffer_bytes = 20'000'000, many_disks = 300'000;

}  // namespace

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TrialFrames::TrialFrames(const Scene& scene, BlockRunner run) : scene_(scene), run_(std::move(run)) {
  if (scene_.output.trajectory != TrajectoryFormat::xyz) return;
  trajectory_ = std::make_unique<XyzWriter>("/dev/null", xyz_plan(scene_, &rounds_));
}

void TrialFrames::make(const Engine& tried) {
  if (!wants_frames(scene_.output)) return;
  // exact computes the disks of a frame within its last window; time stepping shows those of its state.
  const double now = tried.state().time;
  if (scene_.run.method == Method::exact) tried.disks_at(std::nextafter(now, 0.0), room_);
  const WholeDisks disks(scene_.run.method == Method::exact ? room_ : tried.state().disks, now);
  if (scene_.output.trajectory == TrajectoryFormat::h5md && disks.size() > many_disks)
    h5md_buffers_.resize(h5md_buffer_bytes);
  if (shows_rounds(scene_)) follow_rounds(rounds_, disks, scene_.box, run_);
  if (trajectory_) trajectory_->write(disks, run_);
  // Sums over the disks need it while the trajectory keeps its lines.
  const std::vector<std::size_t> order = by_id(tried.state().disks);
}

void end_in_memory(Engine& tried, const Scene& scene, const BlockRunner& run) {
  tried.release_memory();
  max_overlap(tried.state().disks, scene.box, run);
}

}  // namespace carom
