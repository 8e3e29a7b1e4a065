#include "io/movie.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/check.hpp"
#include "io/output_file.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

constexpr const char* file_name = "movie.mp4";
constexpr const char* log_name = "ffmpeg.log";
constexpr const char* list_name = "movie_parts.txt";
constexpr const char* joined_name = "movie_joined.mp4";
constexpr const char* part_prefix = "movie_part_";
constexpr const char* frames_per_second = "25";

// Raw frames on standard input; H.264 with the pixel format and the colour space that every player knows. crf 20 is
// visually lossless for flat disks; without B-frames (bf 0) parts can be joined with no frame out of its time;
// faststart lets a browser begin before the end has arrived.
std::vector<std::string> encoding(const std::string& program, const FramePainter& painter, const std::string& file) {
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
          "-bf",
          "0",
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
          file};
}

// The parts one after another, each frame as it was encoded.
std::vector<std::string> joining(const std::string& program) {
  return {program, "-nostdin", "-loglevel", "error", "-y",        "-f",         "concat",
          "-i",    list_name,  "-c",        "copy",  "-movflags", "+faststart", joined_name};
}

// Of this process only: an ffmpeg that outlived a process which was killed may still be writing its own part.
std::string part_name(Count first_frame) {
  return fmt::format("{}{:09}_{}.mp4", part_prefix, first_frame, getpid());
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

MovieWriter::MovieWriter(const std::string& folder, FrameStyle style)
    : folder_(folder), style_(std::move(style)), painter_(style_), ffmpeg_(find_program("ffmpeg")) {
  if (!single_frames()) return;
  std::error_code error;
  fs::create_directories(path("frames"), error);
  if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path("frames"), error.message()));
}

MovieWriter::MovieWriter(const std::string& folder, FrameStyle style, const MovieMark& from)
    : folder_(folder),
      style_(std::move(style)),
      painter_(style_),
      ffmpeg_(from.single_frames ? "" : find_program("ffmpeg")),
      parts_(from.parts),
      marked_(true),
      frames_(from.frames) {
  if (!from.single_frames && ffmpeg_.empty()) {
    throw RunError(fmt::format("cannot go on with {}: ffmpeg is not installed here", path(file_name)));
  }
  if (from.single_frames) {
    for (Count k = frames_ + 1; fs::remove(frame_path(k)); ++k) {
    }
  }
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(part_prefix) && std::find(parts_.begin(), parts_.end(), name) == parts_.end()) {
      fs::remove(entry.path());
    }
  }
  // A movie that was complete becomes the first part of the longer one, which will have its name.
  for (std::string& part : parts_) {
    if (part != file_name) continue;
    part = part_name(0);
    fs::copy_file(path(file_name), path(part), fs::copy_options::overwrite_existing);
  }
}

std::string MovieWriter::frame_path(Count number) const {
  return path(fmt::format("frames/frame_{:06}.png", number));
}

void MovieWriter::add(const Disks& disks, double time) {
  painter_.paint(disks, time);
  if (single_frames()) {
    painter_.write_png(frame_path(frames_ + 1));
  } else {
    if (encoder_ == nullptr) begin_part();
    if (!encoder_->write(painter_.pixels(), painter_.bytes())) {
      encoder_->wait();
      fail();
    }
  }
  ++frames_;
}

void MovieWriter::begin_part() {
  parts_.push_back(part_name(frames_));
  encoder_ = std::make_unique<ChildProcess>(encoding(ffmpeg_, painter_, parts_.back()), folder_, path(log_name));
}

void MovieWriter::end_part() {
  if (encoder_ == nullptr) return;
  const bool good = encoder_->wait() == 0 && is_whole_mp4(path(parts_.back()));
  encoder_ = nullptr;
  if (!good) fail();
}

MovieMark MovieWriter::mark() {
  const bool fresh = encoder_ != nullptr;
  end_part();
  if (fresh) sync_path(path(parts_.back()));
  marked_ = true;
  return {frames_, single_frames(), parts_, style_.fastest, style_.time_decimals};
}

MovieMark MovieWriter::finish() {
  MovieMark whole{frames_, single_frames(), {}, style_.fastest, style_.time_decimals};
  if (single_frames()) return whole;
  end_part();
  if (parts_.empty()) return whole;
  join_parts();
  std::error_code ignored;
  for (const char* const name : {log_name, list_name}) fs::remove(path(name), ignored);
  whole.parts.emplace_back(file_name);
  return whole;
}

void MovieWriter::join_parts() {
  std::string made = parts_.back();
  if (marked_) {
    std::string list;
    for (const std::string& part : parts_) list += fmt::format("file '{}'\n", part);
    write_file(path(list_name), list);
    ChildProcess join(joining(ffmpeg_), folder_, path(log_name));
    if (join.wait() != 0 || !is_whole_mp4(path(joined_name))) fail();
    made = joined_name;
    sync_path(path(made));
  }
  std::error_code error;
  fs::rename(path(made), path(file_name), error);
  if (error) throw RunError(fmt::format("cannot write {}: {}", path(file_name), error.message()));
}

void MovieWriter::fail() const {
  // On a full disk the log is as empty as the movie.
  const std::string said = last_line(path(log_name));
  throw RunError(fmt::format("ffmpeg could not write {}: {}", path(file_name),
                             said.empty() ? "the file is incomplete; is the disk full?" : said));
}

}  // namespace carom
