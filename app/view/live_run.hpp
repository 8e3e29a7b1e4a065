// A run that is going on, for the page that follows it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/view/loopback_server.hpp"
#include "io/view/view_encoder.hpp"
#include "run/recordings/run_view.hpp"

namespace carom {

class LiveRun {
 public:
  // folder: of a run that is going on; waits for its first frame. Throws InputError if no run is going on, or if it
  // ends without a frame.
  LiveRun(const std::filesystem::path& folder, const ViewSettings& settings);

  // Packs the frames that have come, for at most about this number of seconds.
  void read(double seconds);

  // Has the run ended, and have all its frames been read?
  bool ended() const { return ended_; }
  const std::string& state() const { return state_; }  // of the run, a sentence

  // "" is the page, "blockN" a block of its frames, and "news/BLOCKS/DISKS" what a page with these numbers lacks.
  HttpAnswer answer(std::string_view path) const;

 private:
  void begin(const TrajectoryFrame& frame);
  void add(const TrajectoryFrame& frame);
  bool moved_up() const;
  void see_the_end();

  std::filesystem::path folder_;
  ViewSettings settings_;
  Recording recording_;
  FileIdentity file_;  // of the trajectory, whatever folder it is in
  std::unique_ptr<TrajectoryReader> reader_;
  ViewStory story_;
  std::optional<ViewEncoder> encoder_;
  std::size_t frames_ = 0, stride_ = 1;  // frames read; one of `stride` is shown
  std::size_t limit_ = 0;                // bytes of frames at which the stride is doubled
  double thinned_from_ = 0.0;            // simulated time from which frames are left out
  std::uintmax_t series_bytes_ = 0;
  bool ended_ = false;
  std::string state_;
};

}  // namespace carom
