// What the files of a run will take, in bytes and in time, from a rehearsal: a few frames are written for real, in a
// temporary folder, and thrown away.
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
  double ffmpeg_bytes = 0.0;         // memory that ffmpeg takes, beside the run's own, while it makes the movie
  std::string not_tried;             // why the figures are guesses, or empty
  std::vector<std::string> missing;  // what the run will lack as a program is not installed

  double bytes() const;
  double seconds() const { return files_s + analysis_s + plots_s; }
};

// Frames, or samples, of a time at this interval: no more than steps, where the method has some, as they are of a
// step's end.
Count moments_shown(const Scene& scene, double every, double time);

// tried: the run's engine, at some moment. step_seconds: that its steps will take.
OutputForesight foresee_outputs(const Scene& scene, const EngineChoice& choice, const Engine& tried,
                                const Population& population, double step_seconds);

}  // namespace carom
