#include "io/movie/movie.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/base/check.hpp"
#include "io/files/output_file.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

constexpr const char* log_name = "ffmpeg.log";
constexpr const char* list_name = "movie_parts.txt";
constexpr const char* joined_name = "movie_joined.mp4";  // parts are of mp4 only
constexpr const char* part_prefix = "movie_part_";

// Joins the parts one after another, with each frame as it was encoded.
std::vector<std::string> joining(const std::string& program) {
  return {program, "-nostdin", "-loglevel", "error", "-y",        "-f",         "concat",
          "-i",    list_name,  "-c",        "copy",  "-movflags", "+faststart", joined_name};
}

// A name of this process only: an ffmpeg that outlived its killed process may still be writing its own part.
std::string part_name(Count first_frame, const std::string& extension) {
  return fmt::format("{}{:09}_{}{}", part_prefix, first_frame, getpid(), extension);
}

}  // namespace

bool finds_ffmpeg() {
  return !find_program("ffmpeg").empty();
}

MovieWriter::MovieWriter(const std::string& folder, FrameStyle style, MovieFormat format)
    : folder_(folder),
      style_(std::move(style)),
      format_(format),
      file_name_(movie_name(format)),
      painter_(style_),
      ffmpeg_(find_program("ffmpeg")) {
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
    throw RunError(fmt::format("cannot continue {}: ffmpeg is not installed here", path(file_name_)));
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
    if (part != file_name_) continue;
    part = part_name(0, ".mp4");
    fs::copy_file(path(file_name_), path(part), fs::copy_options::overwrite_existing);
  }
}

std::string MovieWriter::frame_path(Count number) const {
  return path(fmt::format("frames/frame_{:06}.png", number));
}

void MovieWriter::add(const DisksInPieces& disks, const std::vector<DiskId>& group) {
  painter_.paint(disks, group);
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
  parts_.push_back(part_name(frames_, fs::path(file_name_).extension().string()));
  encoder_ = std::make_unique<ChildProcess>(
      encoding(ffmpeg_, {painter_.width(), painter_.height(), style_.look.fps}, format_, parts_.back()), folder_,
      path(log_name));
}

void MovieWriter::end_part() {
  if (encoder_ == nullptr) return;
  const bool good = encoder_->wait() == 0 && is_whole_movie(path(parts_.back()), format_);
  encoder_ = nullptr;
  if (!good) fail();
}

MovieMark MovieWriter::mark() {
  const bool fresh = encoder_ != nullptr;
  end_part();
  if (fresh) sync_path(path(parts_.back()));
  marked_ = true;
  return {frames_, single_frames(), parts_, style_.low, style_.high, style_.time_decimals};
}

MovieMark MovieWriter::finish() {
  MovieMark whole{frames_, single_frames(), {}, style_.low, style_.high, style_.time_decimals};
  if (single_frames()) return whole;
  end_part();
  if (parts_.empty()) return whole;
  join_parts();
  std::error_code ignored;
  for (const char* const name : {log_name, list_name}) fs::remove(path(name), ignored);
  whole.parts.push_back(file_name_);
  return whole;
}

void MovieWriter::join_parts() {
  std::string made = parts_.back();
  if (marked_) {
    std::string list;
    for (const std::string& part : parts_) list += fmt::format("file '{}'\n", part);
    write_file(path(list_name), list);
    ChildProcess join(joining(ffmpeg_), folder_, path(log_name));
    if (join.wait() != 0 || !is_whole_movie(path(joined_name), format_)) fail();
    made = joined_name;
    sync_path(path(made));
  }
  rename_file(path(made), path(file_name_));
}

void MovieWriter::fail() const {
  // On a full disk the log is as empty as the movie.
  const std::string said = last_line(path(log_name));
  throw RunError(fmt::format("ffmpeg could not write {}: {}", path(file_name_),
                             said.empty() ? "the file is incomplete; is the disk full?" : said));
}

}  // namespace carom
