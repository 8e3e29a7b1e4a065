#include <fmt/format.h>

#include <filesystem>

#include "app/commands.hpp"
#include "core/check.hpp"
#include "core/input_message.hpp"
#include "io/movie.hpp"
#include "io/trajectory_reader.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

struct Recording {
  fs::path folder;  // where the trajectory lies
  fs::path trajectory;
};

Recording open_recording(const std::string& name) {
  const fs::path path = name;
  if (!fs::exists(path)) fail_input(name, "does not exist", "expected a folder of a run, or a trajectory");
  if (!fs::is_directory(path)) return {path.parent_path().empty() ? fs::path(".") : path.parent_path(), path};
  const fs::path trajectory = trajectory_in(path);
  if (trajectory.empty()) {
    fail_input(name, "holds no trajectory.xyz or trajectory.h5",
               "expected the folder of a run with [output] trajectory = \"xyz\" or \"h5md\"");
  }
  return {path, trajectory};
}

// The style of the run's own movie where its scene lies beside the trajectory; else what the first frame tells.
FrameStyle style_of(const Recording& recording, const TrajectoryFrame& first) {
  const fs::path scene_file = recording.folder / "scene.toml";
  if (fs::exists(scene_file)) {
    try {
      return frame_style(load_scene(scene_file.string()), first.disks);
    } catch (const InputError& error) {
      print_warning(fmt::format("title and sides come from the trajectory alone: {}", error.what()));
    }
  }
  return frame_style(recording.trajectory.string(), first.box, first.disks);
}

// Throws InputError where a file is in the way.
void check_free(const fs::path& file, bool force) {
  if (fs::is_directory(file)) fail_input(file.string(), "is a folder", "expected a file (-o)");
  if (fs::exists(file) && !force) {
    fail_input(file.string(), "exists already", "choose another file with -o, or replace it with --force");
  }
}

// A folder beside the file it is for, removed with whatever is left in it.
struct WorkFolder {
  explicit WorkFolder(const fs::path& file) : path(file.string() + ".unfinished") {
    std::error_code error;
    fs::remove_all(path, error);
    fs::create_directories(path, error);
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

// Moves what the writer made to where the user wants it; returns its name.
fs::path move_result(const WorkFolder& work, const fs::path& target, bool single_frames) {
  const fs::path from = work.path / (single_frames ? "frames" : "movie.mp4");
  const fs::path to = single_frames ? target.parent_path() / "frames" : target;
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw RunError(fmt::format("cannot write {}: {}", to.string(), error.message()));
  return to;
}

void render_picture(const Recording& recording, int wanted, const fs::path& target) {
  const auto reader = open_trajectory(recording.trajectory.string());
  TrajectoryFrame first, frame;
  if (!reader->read(first)) fail_input(recording.trajectory.string(), "holds no frame");
  frame = first;
  for (int k = 2; k <= wanted; ++k) {
    if (!reader->read(frame)) {
      fail_input("--frame", fmt::format("there is no frame {}", wanted), fmt::format("expected 1 to {}", k - 1));
    }
  }
  const WorkFolder work(target);
  FramePainter painter(style_of(recording, first));
  painter.paint(frame.disks, frame.time);
  painter.write_png((work.path / "frame.png").string());
  std::error_code error;
  fs::rename(work.path / "frame.png", target, error);
  if (error) throw RunError(fmt::format("cannot write {}: {}", target.string(), error.message()));
}

fs::path render_movie(const Recording& recording, const fs::path& target, bool quiet) {
  const auto reader = open_trajectory(recording.trajectory.string());
  TrajectoryFrame frame;
  if (!reader->read(frame)) fail_input(recording.trajectory.string(), "holds no frame");
  const WorkFolder work(target);
  MovieWriter movie(work.path.string(), style_of(recording, frame));
  if (movie.single_frames() && !quiet) {
    print_warning("ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on");
  }
  do {
    movie.add(frame.disks, frame.time);
  } while (reader->read(frame));
  movie.finish();
  return move_result(work, target, movie.single_frames());
}

}  // namespace

int command_render(const RenderOptions& options) {
  const Recording recording = open_recording(options.source);
  fs::path target = recording.folder / (options.frame ? fmt::format("frame_{}.png", *options.frame) : "movie.mp4");
  if (options.file) target = *options.file;
  check_free(target, options.force);
  if (options.frame) {
    render_picture(recording, *options.frame, target);
  } else {
    target = render_movie(recording, target, options.quiet);
  }
  if (!options.quiet) print_out(fmt::format("{}\n", target.string()));
  return 0;
}

}  // namespace carom
