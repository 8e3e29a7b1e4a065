// A movie from frames, through ffmpeg; without ffmpeg, the frames as PNG files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/child_process.hpp"
#include "io/files/file_mark.hpp"
#include "io/movie/frame.hpp"
#include "io/movie/movie_format.hpp"

namespace carom {

// False if frames are written in place of a movie.
bool finds_ffmpeg();

// A movie is encoded in parts, since a file that ffmpeg has not finished cannot be continued: every mark ends a part.
// Without marks there is one part, which becomes the movie; otherwise ffmpeg joins the parts, without encoding them
// again.
class MovieWriter {
 public:
  // The movie is written to `folder`/movie.mp4 (H.264, which plays everywhere; or movie.webm, movie.gif), or frames to
  // `folder`/frames/frame_000001.png and so on. Throws RunError if neither can be started.
  MovieWriter(const std::string& folder, FrameStyle style, MovieFormat format = MovieFormat::mp4);

  // Continues a movie.mp4 behind a mark; parts after it are removed. Throws RunError if ffmpeg is no longer found.
  MovieWriter(const std::string& folder, FrameStyle style, const MovieMark& from);

  // True if ffmpeg is not installed and single frames are written instead.
  bool single_frames() const { return ffmpeg_.empty(); }

  // Throws RunError, with the message of ffmpeg, if the frame cannot be drawn or handed over. group: as for
  // FramePainter::paint.
  void add(const DisksInPieces& disks, const std::vector<DiskId>& group = {});
  void add(const Disks& disks, double time, const std::vector<DiskId>& group = {}) {
    add(WholeDisks(disks, time), group);
  }

  // For movie.mp4: ends the present part; the frames of all parts are then on the disk. Throws RunError if ffmpeg could
  // not write it.
  MovieMark mark();

  // Completes the movie and returns a mark from which it can be continued. Throws RunError if ffmpeg could not write
  // it.
  MovieMark finish();

 private:
  [[noreturn]] void fail() const;
  std::string path(const std::string& file) const { return folder_ + "/" + file; }
  std::string frame_path(Count number) const;
  void begin_part();
  void end_part();
  void join_parts();

  std::string folder_;
  FrameStyle style_;
  MovieFormat format_ = MovieFormat::mp4;
  std::string file_name_ = movie_name(format_);
  FramePainter painter_;
  std::string ffmpeg_;  // path of the program, empty if there is none
  std::unique_ptr<ChildProcess> encoder_;
  std::vector<std::string> parts_;  // the last one is being made
  bool marked_ = false;             // a mark names parts_, which must then stay as they are
  Count frames_ = 0;
};

}  // namespace carom
