#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/run/held_signals.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/scene/picture_look.hpp"
#include "io/files/folder_lock.hpp"
#include "io/files/output_file.hpp"
#include "io/files/output_folder.hpp"
#include "io/movie/movie.hpp"
#include "io/trajectory/trajectory_reader.hpp"
#include "run/recordings/recording.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// What all frames have in common, and their number.
struct Survey {
  SeenValues seen;
  Count frames = 0;
  Domain box;
};

Survey survey_of(const Recording& recording) {
  const auto reader = open_frames(recording);
  Survey survey;
  for (TrajectoryFrame frame; reader->read(frame); ++survey.frames) {
    survey.seen.add(frame.disks, frame.group);
    survey.box = frame.box;
  }
  if (survey.frames == 0) fail_input(recording.trajectory.string(), "holds no frame");
  return survey;
}

// The look of the run's movie, with the changes of the options.
PictureLook look_of(const RenderOptions& options, const std::optional<Scene>& scene) {
  PictureLook look = scene ? scene->output.look : PictureLook{};
  if (options.colour && *options.colour != look.colour) {
    look.colour = *options.colour;
    look.range.reset();
  }
  if (options.range) {
    const std::string complaint = complaint_of_range(look.colour, (*options.range)[0], (*options.range)[1]);
    if (!complaint.empty()) fail_input("--range", "cannot be used", complaint);
    look.range = options.range;
  }
  if (options.size) {
    look.width = (*options.size)[0];
    look.height = (*options.size)[1];
  }
  if (options.fps) look.fps = *options.fps;
  return look;
}

// The colour scale covers the values of all frames, so that every picture and movie of a run has the same scale.
FrameStyle style_of(const Recording& recording, const RenderOptions& options, const Survey& survey) {
  const WarningSink warn = [&](std::string_view text) {
    if (!options.quiet) print_warning(text);
  };
  const std::optional<Scene> scene = scene_of(recording, warn);
  const PictureLook look = look_of(options, scene);
  if (scene) return frame_style(*scene, look, survey.seen);
  return frame_style(recording.trajectory.string(), survey.box, look, survey.seen);
}

// A folder beside the file for which it is used, inside one that only one carom render of this file can have at a time;
// removed with everything that is left in it.
struct WorkFolder {
  explicit WorkFolder(const fs::path& file) : held(file.string() + ".unfinished"), path(held / "made") {
    std::error_code error;
    fs::create_directories(held, error);
    if (!error && !lock.take(held)) {
      fail_input(file.string(), "another carom render is writing this file", "expected another file (-o)");
    }
    if (!error) fs::remove_all(path, error);  // left by one that was killed
    if (!error) fs::create_directory(path, error);
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(held, ignored);
  }
  fs::path held, path;
  FolderLock lock;  // on held
};

// The form of the output, from a file's extension.
struct Target {
  fs::path file;
  std::optional<MovieFormat> movie;  // absent: a picture
  bool svg = false;
  bool single_frames = false;  // of a movie if there is no ffmpeg: a folder of pictures beside its place

  fs::path made() const { return single_frames ? file.parent_path() / "frames" : file; }
};

// As check_free, for the folder of a movie's frames.
void check_frames_free(const fs::path& frames, bool force) {
  if (!fs::exists(frames)) return;
  if (!holds_frames_only(frames)) {
    fail_input(frames.string(), "is not a folder that holds only frames", "choose another folder with -o");
  }
  if (force) return;
  fail_input(frames.string(), "exists already", "choose another folder with -o, or replace it with --force");
}

Target target_of(const RenderOptions& options, const Recording& recording) {
  Target target{recording.folder / (options.frame ? fmt::format("frame_{}.png", *options.frame) : "movie.mp4"), {}};
  if (options.file) target.file = *options.file;
  const std::string extension = target.file.extension().string();
  target.movie = movie_format_of(extension);
  std::string small = extension;
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  target.svg = small == ".svg";
  if (!target.movie && !target.svg && small != ".png") {
    fail_input("-o", fmt::format("{} ends in \"{}\"", in_quotes(target.file.string()), extension),
               "expected .mp4, .webm or .gif for a movie, .png or .svg for a picture");
  }
  if (target.movie && options.frame) {
    fail_input("-o", fmt::format("{} is a movie, but --frame draws a picture", in_quotes(target.file.string())),
               "expected .png or .svg");
  }
  target.single_frames = target.movie && !finds_ffmpeg();
  return target;
}

void render_picture(const Recording& recording, const RenderOptions& options, const Target& target) {
  const Survey survey = survey_of(recording);
  const Count wanted = options.frame ? static_cast<Count>(*options.frame) : survey.frames;
  if (wanted > survey.frames) {
    fail_input("--frame", fmt::format("there is no frame {}", wanted), fmt::format("expected 1 to {}", survey.frames));
  }
  const auto reader = open_frames(recording);
  TrajectoryFrame frame;
  for (Count k = 0; k < wanted; ++k) {
    if (!reader->read(frame)) fail_replaced(recording);
  }
  FramePainter painter(style_of(recording, options, survey));
  const WorkFolder work(target.file);
  const fs::path made = work.path / "frame";
  if (target.svg) {
    painter.write_svg(made.string(), frame.disks, frame.time, frame.group);
  } else {
    painter.paint(frame.disks, frame.time, frame.group);
    painter.write_png(made.string());
  }
  rename_file(made, target.file);
}

// The new frames replace earlier ones in one step, so that at any moment one or the other are there. If the file system
// cannot exchange two folders, the earlier ones are moved aside, and back if the new ones cannot be moved.
void put_frames(const fs::path& made, const fs::path& place, const fs::path& aside) {
  if (!fs::exists(place)) return rename_file(made, place);
  if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) return;
  rename_file(place, aside);
  try {
    rename_file(made, place);
  } catch (const RunError&) {
    std::error_code ignored;
    fs::rename(aside, place, ignored);
    throw;
  }
}

void render_movie(const Recording& recording, const RenderOptions& options, const Target& target) {
  constexpr double fastest_gif = 50.0;  // delays are whole hundredths of a second, and viewers treat one as two
  const Survey survey = survey_of(recording);
  const FrameStyle style = style_of(recording, options, survey);
  if (target.movie == MovieFormat::gif && style.look.fps > fastest_gif) {
    fail_input("--fps", fmt::format("is {}", style.look.fps),
               fmt::format("expected at most {} for a GIF", fastest_gif));
  }
  const HeldSignals held;  // until the work folder is removed
  const WorkFolder work(target.file);
  MovieWriter movie(work.path.string(), style, *target.movie);
  if (target.single_frames && !options.quiet) {
    print_warning("ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on");
  }
  const auto reader = open_frames(recording);
  TrajectoryFrame frame;
  for (Count k = 0; k < survey.frames; ++k) {
    if (!reader->read(frame)) fail_replaced(recording);  // by a shorter one, in the same file
    movie.add(frame.disks, frame.time, frame.group);
    HeldSignals::end_if_asked();
  }
  movie.finish();
  if (!target.single_frames) return rename_file(work.path / movie_name(*target.movie), target.file);
  put_frames(work.path / "frames", target.made(), work.path / "earlier");
}

}  // namespace

int command_render(const RenderOptions& options) {
  const Recording recording = open_recording(options.source);
  const Target target = target_of(options, recording);
  if (target.single_frames) {
    check_frames_free(target.made(), options.force);
  } else {
    check_free(target.file, options.force);
  }
  check_writable(target.made());
  const std::string note = note_of_another_run(recording);
  if (!options.quiet && !note.empty()) print_note(note);
  if (target.movie) {
    render_movie(recording, options, target);
  } else {
    render_picture(recording, options, target);
  }
  if (!options.quiet) print_out(fmt::format("{}\n", target.made().string()));
  return 0;
}

}  // namespace carom
