// The memory that a run needs besides its steps. carom check allocates the same after its trial steps, so that the peak
// of its own process is that of the run.
#pragma once

#include <memory>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/measure/displacement.hpp"
#include "core/scene/scene.hpp"
#include "core/step/engine.hpp"
#include "io/trajectory/trajectory_xyz.hpp"

namespace carom {

// The most memory that this process has used so far; bytes.
double peak_bytes();

// Frames with all disks. What one needs is kept for the next, as in a run, so that steps in between have it beside
// them. Of the files only trajectory.xyz is written, to /dev/null. Nothing is done if the scene has no frames.
class TrialFrames {
 public:
  // scene must outlive it.
  TrialFrames(const Scene& scene, BlockRunner run);
  TrialFrames(const TrialFrames&) = delete;  // the trajectory refers to the counts of rounds
  TrialFrames& operator=(const TrialFrames&) = delete;

  // Makes the frame of this moment, between two steps.
  void make(const Engine& tried);

 private:
  const Scene& scene_;
  BlockRunner run_;
  Disks room_;
  DisplacementTally rounds_;
  std::unique_ptr<XyzWriter> trajectory_;
  std::vector<char> h5md_buffers_;
};

// Does what a run does after its last step: frees the memory of steps, and searches for the largest overlap.
void end_in_memory(Engine& tried, const Scene& scene, const BlockRunner& run);

}  // namespace carom
