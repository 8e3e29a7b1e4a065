// movie.mp4 from frames, through ffmpeg; where there is none, the frames as PNG files.
#pragma once

#include <memory>
#include <string>

#include "io/child_process.hpp"
#include "io/frame.hpp"

namespace carom {

class MovieWriter {
 public:
  // The movie goes to `folder`/movie.mp4 (H.264, 25 frames a second, plays everywhere), or frames to
  // `folder`/frames/frame_000001.png and so on. Throws RunError if neither can be started.
  MovieWriter(const std::string& folder, FrameStyle style);

  // True where ffmpeg is not installed and single frames are written instead.
  bool single_frames() const { return encoder_ == nullptr; }

  // Throws RunError if the frame cannot be drawn or handed over, with what ffmpeg said.
  void add(const Disks& disks, double time);

  // Completes the file. Throws RunError if ffmpeg could not write it.
  void finish();

 private:
  [[noreturn]] void fail() const;

  std::string folder_;
  FramePainter painter_;
  std::unique_ptr<ChildProcess> encoder_;
  int frames_ = 0;
};

}  // namespace carom
