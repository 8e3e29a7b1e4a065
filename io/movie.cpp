#include "io/movie.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
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

// Whether a file is a sequence of whole MP4 boxes (32-bit size, name, content), the index "moov" among them. ffmpeg
// says 0 even where a full disk cut its file short.
bool is_whole_mp4(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  bool indexed = false;
  std::uintmax_t at = 0;
  while (!error && at < bytes) {
    std::array<unsigned char, 8> head{};
    file.seekg(static_cast<std::streamoff>(at));
    if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) return false;
    std::uintmax_t size = (std::uintmax_t{head[0]} << 24) | (std::uintmax_t{head[1]} << 16) |
                          (std::uintmax_t{head[2]} << 8) | std::uintmax_t{head[3]};
    if (size == 1) {  // a box above 4 GB: its size follows in 64 bits
      std::array<unsigned char, 8> large{};
      if (!file.read(reinterpret_cast<char*>(large.data()), large.size())) return false;
      size = 0;
      for (const unsigned char byte : large) size = (size << 8) | byte;
    }
    if (size < head.size()) return false;
    if (std::memcmp(&head[4], "moov", 4) == 0) indexed = true;
    at += size;
  }
  return !error && indexed && at == bytes;
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
  if (encoder_->wait() != 0 || !is_whole_mp4(folder_ + "/" + file_name)) fail();
  std::error_code ignored;
  std::filesystem::remove(folder_ + "/" + log_name, ignored);
}

void MovieWriter::fail() const {
  // On a full disk the log is as empty as the movie.
  const std::string said = last_line(folder_ + "/" + log_name);
  throw RunError(fmt::format("ffmpeg could not write {}/{}: {}", folder_, file_name,
                             said.empty() ? "the file is incomplete; is the disk full?" : said));
}

}  // namespace carom
