// A movie from frames, through ffmpeg; where there is none, the frames as PNG files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/child_process.hpp"
#include "io/files/file_mark.hpp"
#include "io/movie/frame.hpp"
#include "io/movie/movie_format.hpp"

namespace carom {

// False where a movie becomes single frames.
bool finds_ffmpeg();

// A movie is encoded in parts, as a file that ffmpeg has not finished cannot be continued: every mark ends a part. A
// run without marks has one part, which becomes the movie; else ffmpeg joins them, without encoding anything again.
class MovieWriter {
 public:
  // The movie goes to `folder`/movie.mp4 (H.264, which plays everywhere; or movie.webm, movie.gif), or frames to
  // `folder`/frames/frame_000001.png and so on. Throws RunError if neither can be started.
  MovieWriter(const std::string& folder, FrameStyle style, MovieFormat format = MovieFormat::mp4);

  // Goes on with a movie.mp4 behind a mark; parts that came after it are removed. Throws RunError where there is no
  // ffmpeg any more.
  MovieWriter(const std::string& folder, FrameStyle style, const MovieMark& from);

  // True where ffmpeg is not installed and single frames are written instead.
  bool single_frames() const { return ffmpeg_.empty(); }

  // Throws RunError if the frame cannot be drawn or handed over, with what ffmpeg said.
  // group: as for FramePainter::paint.
  void add(const DisksInPieces& disks, const std::vector<DiskId>& group = {});
  void add(const Disks& disks, double time, const std::vector<DiskId>& group = {}) {
    add(WholeDisks(disks, time), group);
  }

  // Of a movie.mp4: ends the part that is being made; what all parts hold is on the disk. Throws RunError if ffmpeg
  // could not write it.
  MovieMark mark();

  // Completes the movie and returns a mark to which it can be taken up again. Throws RunError if ffmpeg could not write
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
  std::vector<std::string> parts_;  // the one being made is the last
  bool marked_ = false;             // a mark names parts_: they must stay as they are
  Count frames_ = 0;
};

}  // namespace carom
