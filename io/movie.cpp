#include "io/movie.hpp"

#include <fmt/format.h>

#include <bit>
#include <filesystem>
#include <vector>

#include "core/check.hpp"

namespace carom {

namespace {

constexpr const char* file_name = "movie.mp4";
constexpr const char* log_name = "ffmpeg.log";
constexpr const char* frames_per_second = "25";

// Raw frames on standard input; H.264 with the pixel format and the colour space that every player knows. crf 20 is
// visually lossless for flat disks; faststart lets a browser begin before the end has arrived.
std::vector<std::string> ffmpeg_arguments(const std::string& program, const FramePainter& painter) {
  const char* const pixels = std::endian::native == std::endian::little ? "bgr0" : "0rgb";
  return {program,
          "-nostdin",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          pixels,
          "-video_size",
          fmt::format("{}x{}", painter.width(), painter.height()),
          "-framerate",
          frames_per_second,
          "-i",
          "pipe:0",
          "-an",
          "-vf",
          "scale=out_color_matrix=bt709:out_range=tv",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-crf",
          "20",
          "-pix_fmt",
          "yuv420p",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-movflags",
          "+faststart",
          file_name};
}

}  // namespace

MovieWriter::MovieWriter(const std::string& folder, FrameStyle style) : folder_(folder), painter_(std::move(style)) {
  const std::string ffmpeg = find_program("ffmpeg");
  if (!ffmpeg.empty()) {
    encoder_ = std::make_unique<ChildProcess>(ffmpeg_arguments(ffmpeg, painter_), folder, folder + "/" + log_name);
    return;
  }
  std::error_code error;
  std::filesystem::create_directories(folder_ + "/frames", error);
  if (error) throw RunError(fmt::format("cannot make the folder {}/frames: {}", folder_, error.message()));
}

void MovieWriter::add(const Disks& disks, double time) {
  painter_.paint(disks, time);
  ++frames_;
  if (encoder_ == nullptr) {
    painter_.write_png(fmt::format("{}/frames/frame_{:06}.png", folder_, frames_));
  } else if (!encoder_->write(painter_.pixels(), painter_.bytes())) {
    encoder_->wait();
    fail();
  }
}

void MovieWriter::finish() {
  if (encoder_ == nullptr) return;
  if (encoder_->wait() != 0) fail();
  std::error_code ignored;
  std::filesystem::remove(folder_ + "/" + log_name, ignored);
}

void MovieWriter::fail() const {
  throw RunError(
      fmt::format("ffmpeg could not write {}/{}: {}", folder_, file_name, last_line(folder_ + "/" + log_name)));
}

}  // namespace carom
