#include "app/view/live_run.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <system_error>
#include <thread>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/wall_clock.hpp"
#include "io/files/output_folder.hpp"
#include "io/view/view_page.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_looks{50};

// Takes the whole number at the beginning off the text; nothing if there is none.
std::optional<std::size_t> take_number(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

HttpAnswer found(const char* type, std::string body) {
  return {200, type, std::move(body)};
}

}  // namespace

LiveRun::LiveRun(const fs::path& folder, const ViewSettings& settings) : folder_(folder), settings_(settings) {
  if (!is_being_written(folder)) {
    fail_input("--live", fmt::format("there is no run in progress in {}", folder.string()),
               "expected the folder of a run in progress; carom view without --live plays one that has ended");
  }
  TrajectoryFrame frame;
  for (bool last_look = false;; std::this_thread::sleep_for(between_looks)) {
    const fs::path trajectory = trajectory_in(folder / unfinished_name);
    const std::optional<FileIdentity> file = identity_of(trajectory);
    if (!reader_ && file) {
      recording_ = {folder, trajectory, true};
      file_ = *file;
      try {
        reader_ = open_frames(recording_);
      } catch (const InputError&) {
        if (last_look) throw;  // otherwise its first bytes may still come
      }
    }
    if (reader_ && reader_->read(frame)) break;
    if (last_look) fail_input("--live", "the run has ended without a frame", "expected a run with a trajectory");
    last_look = !is_being_written(folder);
  }
  begin(frame);
}

void LiveRun::begin(const TrajectoryFrame& frame) {
  story_ = story_of(recording_, settings_);
  settings_.warn = [](std::string_view) {};  // only one warning is needed
  if (!(story_.box.width > 0.0)) story_.box = frame.box;
  const double smallest = frame.disks.empty() ? story_.box.width : smallest_radius(frame.disks);
  encoder_.emplace(ViewAxes{view_axis(story_.box.width, story_.box.periodic_x(), smallest),
                            view_axis(story_.box.height, story_.box.periodic_y(), smallest)},
                   1, static_cast<std::size_t>(settings_.engine.threads), make_block_runner(settings_.engine),
                   story_.box.shear);
  limit_ = settings_.most_bytes / 2;
  state_ = "The run goes on.";
  add(frame);
  encoder_->finish();
}

// The frames never take more than their room: each time that half of what is left of it is full, every second frame is
// left out, and all later frames once it is full.
void LiveRun::add(const TrajectoryFrame& frame) {
  const std::size_t room = settings_.most_bytes / 20 * 19;
  if (limit_ >= room) return;
  if (frames_++ % stride_ == 0) encoder_->add(frame);
  constexpr std::size_t padding = 4;  // of the text of a block
  if (encoder_->packed_bytes() / 3 * 4 + padding * encoder_->blocks().size() <= limit_) return;
  if (stride_ == 1) thinned_from_ = frame.time;
  stride_ *= 2;
  limit_ += (room - limit_ + 1) / 2;
}

// Has the run moved its trajectory up into the folder? Until then the folder may contain that of an earlier run, with a
// summary.
bool LiveRun::moved_up() const {
  return identity_of(trajectory_in(folder_)) == std::optional(file_);
}

void LiveRun::see_the_end() {
  const bool finished = moved_up();
  if (finished) {
    recording_ = {folder_, trajectory_in(folder_), false};
    reader_->follow(recording_.trajectory.string());
  }
  TrajectoryFrame frame;
  while (reader_->read(frame)) add(frame);
  ended_ = true;
  state_ = finished && fs::exists(folder_ / "summary.json") ? "The run is done." : "The run has stopped.";
}

void LiveRun::read(double seconds) {
  if (ended_) return;
  const bool going_on = is_being_written(folder_);
  const auto start = WallClock::now();
  TrajectoryFrame frame;
  while (seconds_since(start) < seconds && reader_->read(frame)) add(frame);
  if (!going_on) see_the_end();
  encoder_->finish();
  if (stride_ > 1 && !ended_) {
    state_ =
        fmt::format("The run goes on; from t = {:g} on, the page shows one frame of up to {}.", thinned_from_, stride_);
  }
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(recording_.trajectory.parent_path() / "series.csv", error);
  if (error || bytes == series_bytes_) return;
  series_bytes_ = bytes;
  story_.series = series_of(recording_, settings_);
}

HttpAnswer LiveRun::answer(std::string_view path) const {
  if (path.empty()) return found("text/html; charset=utf-8", live_page(story_, *encoder_));
  constexpr std::string_view block = "block", news = "news/";
  const std::size_t blocks = encoder_->blocks().size();
  if (path.starts_with(block)) {
    path.remove_prefix(block.size());
    const std::optional<std::size_t> k = take_number(path);
    if (k && path.empty() && *k < blocks) return found("text/plain; charset=utf-8", block_text(*encoder_, *k));
  } else if (path.starts_with(news)) {
    path.remove_prefix(news.size());
    const std::optional<std::size_t> has = take_number(path);
    if (!path.starts_with('/')) return {};
    path.remove_prefix(1);
    const std::optional<std::size_t> disks = take_number(path);
    if (has && disks && path.empty() && *has <= blocks) {
      return found("application/json", view_news(story_, *encoder_, *has, *disks, state_, ended_));
    }
  }
  return {};
}

}  // namespace carom
