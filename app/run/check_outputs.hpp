// The size of a run's files and the time to write them, from a rehearsal: a few frames are actually written, in a
// temporary folder, and removed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/run/check_foresight.hpp"
#include "run/engine/make_engine.hpp"

namespace carom {

struct OutputForesight {
  Count frames = 0, samples = 0;
  std::vector<std::pair<std::string, double>> files;  // name and bytes of each
  double files_s = 0.0;                               // trajectory, series, movie
  double analysis_s = 0.0;                            // samples
  double plots_s = 0.0;
  double ffmpeg_bytes = 0.0;         // memory that ffmpeg uses besides the run's own while it makes the movie
  std::string not_tried;             // why the figures are guesses, or empty
  std::vector<std::string> missing;  // what the run will lack because a program is not installed

  double bytes() const;
  double seconds() const { return files_s + analysis_s + plots_s; }
};

// The number of frames, or samples, in a time at this interval: at most the number of steps if the method has steps,
// since they are taken at the end of a step.
Count moments_shown(const Scene& scene, double every, double time);

// tried: the run's engine, at any moment. step_seconds: expected time for all steps.
OutputForesight foresee_outputs(const Scene& scene, const EngineChoice& choice, const Engine& tried,
                                const Population& population, double step_seconds);

}  // namespace carom
