#include "app/run/check_outputs.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>
#include <system_error>

#include "app/run/held_signals.hpp"
#include "app/run/picture_sizes.hpp"
#include "core/base/check.hpp"
#include "core/base/wall_clock.hpp"
#include "core/disks/disk_columns.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_output.hpp"
#include "core/scene/size_law.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/child_process.hpp"
#include "io/files/scratch_folder.hpp"
#include "io/movie/movie.hpp"
#include "io/plots/gnuplot.hpp"
#include "run/loop/frame_schedule.hpp"
#include "run/outputs/run_outputs.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Sizes = std::map<std::string, double>;

// The largest number of disks in a frame that is written; for more disks the result is scaled up.
constexpr std::size_t most_rehearsed = 100'000;
// Enough to distinguish the cost of a frame from that of starting ffmpeg.
constexpr Count rehearsed_frames = 24;
constexpr double slow_frame = 1.0;  // seconds, including ffmpeg's start
// With more disks, counting their pairs once would take too long.
constexpr std::size_t most_sampled = 2'000'000;

// Used if nothing can be written: bytes of a disk in a frame of trajectory.xyz, with all digits, and of trajectory.h5,
// packed, in double and single precision; and bytes of a frame in series.csv and in a movie.
constexpr double xyz_bytes = 134.0, xyz_spin_bytes = 21.0, xyz_single_bytes = 99.0, xyz_single_spin_bytes = 12.0,
                 h5md_bytes = 32.0, h5md_single_bytes = 15.0, row_bytes = 200.0, movie_bytes = 2e4;
// Processor time of this process and of those for which it has waited.
double cpu_seconds_with_children() {
  double seconds = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& t : {usage.ru_utime, usage.ru_stime}) {
      seconds += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    }
  }
  return seconds;
}

// A coordinate that continued in a straight line, wrapped or reflected by the sides.
double folded(double c, double low, double high, bool periodic) {
  const double length = high - low;
  if (!(length > 0.0)) return c;
  double part = std::fmod(c - low, 2.0 * length);
  if (part < 0.0) part += 2.0 * length;
  if (periodic) return low + (part < length ? part : part - length);
  return low + (part < length ? part : 2.0 * length - part);
}

// The displacement of disk i in that time if nothing stops it; for a Brownian disk, as far as disks diffuse, in a
// direction that depends on i.
Vec2 way_of(const Disks& disks, std::size_t i, const Scene& scene, double time) {
  if (scene.physics.diffusion > 0.0) {
    const double spread = std::sqrt(2.0 * scene.physics.diffusion * time);
    return {spread * std::sin(7.0 * static_cast<double>(i)), spread * std::cos(5.0 * static_cast<double>(i))};
  }
  const Gravity& g = scene.physics.gravity;
  const double fall = 0.5 * time * time;
  return {disks.vx[i] * time - fall * g.left, disks.vy[i] * time - fall * g.down};
}

// The disks some time later, as if they did not collide: a movie of disks at rest would be too cheap.
Disks moved(const Disks& disks, const Scene& scene, double time) {
  Disks later = disks;
  const bool periodic_x = scene.box.periodic_x(), periodic_y = scene.box.periodic_y();
  for (std::size_t i = 0; i < later.size(); ++i) {
    const double r = later.radius_of(i);
    const double margin_x = periodic_x ? 0.0 : r, margin_y = periodic_y ? 0.0 : r;
    const Vec2 way = way_of(disks, i, scene, time);
    later.x[i] = folded(later.x[i] + way.x, margin_x, scene.box.width - margin_x, periodic_x);
    later.y[i] = folded(later.y[i] + way.y, margin_y, scene.box.height - margin_y, periodic_y);
    if (later.spin.empty()) continue;
    // The spin that collisions will have given, if a run starts without.
    later.spin[i] += std::hypot(later.vx[i], later.vy[i]) / r * std::sin(3.0 * static_cast<double>(i));
  }
  return later;
}

// The mean number of disks of the run, those of sources at any place in the box; at most most_rehearsed.
Disks typical_disks(const Scene& scene, const State& state, double count) {
  const auto wanted = static_cast<std::size_t>(std::clamp(count, 0.0, static_cast<double>(most_rehearsed)));
  // Only these are copied: a whole copy may need more memory than the run.
  std::vector<std::size_t> places(std::min(wanted, state.disks.size()));
  std::iota(places.begin(), places.end(), std::size_t{0});
  Disks disks;
  gather_disks(state.disks, places, disks);
  if (scene.sources.empty()) return disks;
  const Source& source = scene.sources.front();
  for (Count k = 0; disks.size() < wanted; ++k) {
    const DiskSize size = draw_size(source.radius, source.mass, scene.seed, Stream::source_radius, Stream::source_mass,
                                    static_cast<DiskId>(k), k);
    const double step = static_cast<double>(k + 1);
    append(disks,
           {scene.box.width * std::fmod(0.618034 * step, 1.0), scene.box.height * std::fmod(0.754878 * step, 1.0),
            std::sin(step), std::cos(step), size.radius, size.mass, static_cast<DiskId>(state.next_id + k)});
  }
  return disks;
}

// What is written in order to measure its cost.
struct Rehearsal {
  Scene scene;
  const EngineChoice& choice;
  const Engine& tried;  // has made the first steps of the run
  Disks shown;          // in a frame
};

struct Rehearsed {
  double wall = 0.0, cpu = 0.0;  // seconds
  double sample_seconds = 0.0;   // of each sample
  Sizes sizes;
};

// The bytes of each file in the folder, and of all pictures together.
Sizes sizes_in(const fs::path& folder) {
  Sizes sizes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const bool picture = entry.path().parent_path() != folder;
    sizes[picture ? "frames" : entry.path().filename().string()] += static_cast<double>(entry.file_size());
  }
  sizes.erase("lock");
  return sizes;
}

double seconds_of_sample(RunningAnalysis& analysis, const Engine& tried) {
  const auto start = WallClock::now();
  analysis.follow(tried, tried.state().time);
  analysis.sample(WholeDisks(tried.state().disks, tried.state().time), tried.state());
  return seconds_since(start);
}

// Writes this number of frames in a new folder, and takes a sample of the analysis if that is wanted.
Rehearsed rehearse(const Rehearsal& what, const fs::path& path, Count frames, bool sample) {
  const Scene& scene = what.scene;
  Rehearsed r;
  const double every = scene.output.every > 0.0 ? scene.output.every : scene.run.t_end;
  const OutputFolder folder(path, scene.file, true);
  const auto start = WallClock::now();
  const double cpu_before = cpu_seconds_with_children();
  RunOutputs outputs(scene, folder, make_block_runner(what.choice));
  for (Count k = 0; k < frames; ++k) {
    const double time = static_cast<double>(k) * every;
    outputs.frame(WholeDisks(moved(what.shown, scene, time), time), what.tried.state());
    HeldSignals::end_if_asked();
  }
  outputs.finish(RunEnd::early);
  r.wall = seconds_since(start);
  r.cpu = cpu_seconds_with_children() - cpu_before;
  r.sizes = sizes_in(folder.unfinished());
  if (sample && outputs.analysis() != nullptr) r.sample_seconds = seconds_of_sample(*outputs.analysis(), what.tried);
  return r;
}

// The time for one plot: almost all of it is gnuplot's start.
double plot_seconds(const fs::path& folder) {
  const auto start = WallClock::now();
  const EnergyRecord record{{0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}, {1.0, 1.0}};
  return plot_energy((folder / "energy.svg").string(), "", record) ? seconds_since(start) : 0.0;
}

// The number of a frame's disks in the group that the trajectory shows; disks from sources all count.
double disks_shown(const Scene& scene, double disks) {
  const IdRange& ids = scene.output.select.ids;
  return std::min(disks, static_cast<double>(ids.end) - static_cast<double>(ids.first));
}

void guess_files(const Scene& scene, double disks, OutputForesight& f) {
  const auto frames = static_cast<double>(f.frames);
  const OutputPlan& plan = scene.output;
  const double shown = disks_shown(scene, disks) / static_cast<double>(plan.select.stride);
  const bool rough = scene.physics.surfaces.are_rough();
  if (plan.trajectory == TrajectoryFormat::xyz) {
    const double spin = !rough ? 0.0 : plan.single_precision ? xyz_single_spin_bytes : xyz_spin_bytes;
    const double each = (plan.single_precision ? xyz_single_bytes : xyz_bytes) + spin;
    f.files.emplace_back("trajectory.xyz", each * shown * frames);
  }
  if (plan.trajectory == TrajectoryFormat::h5md) {
    const double each =
        (plan.single_precision ? h5md_single_bytes : h5md_bytes) * (rough ? 1.25 : 1.0);  // a fifth number
    f.files.emplace_back("trajectory.h5", each * shown * frames);
  }
  if (plan.series) f.files.emplace_back("series.csv", row_bytes * frames);
  if (plan.movie) f.files.emplace_back("movie.mp4", movie_bytes * frames);
}

// Extrapolates from two rehearsals, of one frame and of several, to all frames. scale: disks in a frame over those
// rehearsed.
void extrapolate(const Rehearsed& one, const Rehearsed& several, Count rehearsed, double scale, OutputForesight& f) {
  const double more = std::max(1.0, static_cast<double>(rehearsed - 1));
  const double rest = static_cast<double>(f.frames) - 1.0;
  // A frame's cost is measured in processor time, since wall time depends on how busy the machine is; their ratio shows
  // how busy it is.
  const double each = std::max(0.0, several.cpu - one.cpu) / more;
  const double busy = (one.wall + several.wall) / std::max(1e-9, one.cpu + several.cpu);
  const double start = several.cpu > one.cpu ? std::max(0.0, one.cpu - each) : 0.0;  // ffmpeg's
  f.files_s = busy * (start + scale * (one.cpu - start + each * rest));
  for (const auto& [name, bytes] : several.sizes) {
    const auto first = one.sizes.find(name);
    const double first_bytes = first == one.sizes.end() ? 0.0 : first->second;
    const bool by_disks = name.starts_with("trajectory");
    f.files.emplace_back(name,
                         (by_disks ? scale : 1.0) * (first_bytes + std::max(0.0, bytes - first_bytes) / more * rest));
  }
}

void rehearse_files(const Scene& scene, const EngineChoice& choice, const Engine& tried, double disks,
                    const fs::path& workshop, OutputForesight& f) {
  const bool sample = scene.analysis.any() && tried.state().disks.size() <= most_sampled;
  if (f.frames == 0 && !sample) return;
  Rehearsal rehearsal{scene, choice, tried, typical_disks(scene, tried.state(), disks)};
  rehearsal.scene.output.checkpoint = 0.0;
  rehearsal.scene.analysis.start = 0.0;
  const double scale = std::max(1.0, disks / std::max(1.0, static_cast<double>(rehearsal.shown.size())));
  const Rehearsed one = rehearse(rehearsal, workshop / "one", std::min<Count>(f.frames, 1), sample);
  f.analysis_s = one.sample_seconds * static_cast<double>(f.samples);
  if (f.frames == 0) return;
  // A frame that takes long is enough for the measurement, except for the work before the first frame.
  const Count several = std::min(f.frames, one.cpu < slow_frame ? rehearsed_frames : 2);
  const Rehearsed more = several > 1 ? rehearse(rehearsal, workshop / "more", several, false) : one;
  extrapolate(one, more, several, scale, f);
  std::erase_if(f.files, [](const auto& file) { return file.first == "analysis.h5"; });
}

// The number of quantities that are measured during the run, with a plot each.
double quantities_of(const Scene& scene) {
  return static_cast<double>(std::count(scene.analysis.wanted.begin(), scene.analysis.wanted.end(), true));
}

// For a state like this one with this number of disks.
double checkpoint_bytes(const State& state, double disks) {
  const Disks& d = state.disks;
  if (d.size() > most_rehearsed) {
    constexpr double disk_bytes = 60.0, spin_bytes = 8.0;
    return (d.spins() ? disk_bytes + spin_bytes : disk_bytes) * disks;
  }
  const double columns = 4.0 + static_cast<double>(!d.radius.empty()) + static_cast<double>(!d.mass.empty()) +
                         static_cast<double>(d.spins());
  const double disk_bytes = sizeof(DiskId) + sizeof(double) * columns;
  return static_cast<double>(encode_checkpoint({}, state).size()) +
         disk_bytes * (disks - static_cast<double>(d.size()));
}

// What a checkpoint keeps: for plots that are drawn at the end, for each frame, ten curves and the bands, or energies;
// for trajectories, for each disk, the counts of rounds.
double remembered_bytes(const Scene& scene, double frames, double disks) {
  constexpr double velocity_bytes = 360.0, energy_bytes = 32.0, rounds_bytes = 8.0;
  double bytes = 0.0;
  for (const std::string& plot : plots_over_frames(scene)) {
    bytes += frames * (plot == "velocity" ? velocity_bytes : energy_bytes);
  }
  return shows_rounds(scene) ? bytes + rounds_bytes * disks : bytes;
}

}  // namespace

double OutputForesight::bytes() const {
  double sum = 0.0;
  for (const auto& [name, size] : files) sum += size;
  return sum;
}

Count moments_shown(const Scene& scene, double every, double time) {
  const bool has_steps = scene.run.method != Method::exact && every > 0.0;
  return frame_count(has_steps ? std::max(every, scene.run.dt) : every, time);
}

OutputForesight foresee_outputs(const Scene& scene, const EngineChoice& choice, const Engine& tried,
                                const Population& population, double step_seconds) {
  OutputForesight f;
  f.frames = wants_frames(scene.output) ? moments_shown(scene, scene.output.every, scene.run.t_end) : 0;
  if (scene.analysis.any())
    f.samples = moments_shown(scene, scene.analysis.every, scene.run.t_end - scene.analysis.start);
  if (!wants_files(scene)) return f;
  f.ffmpeg_bytes = memory_of_ffmpeg(scene);
  const double plots = static_cast<double>(plots_over_frames(scene).size()) + quantities_of(scene);
  const bool draws = plots > 0.0 && !find_program("gnuplot").empty();
  if (scene.output.movie && !finds_ffmpeg()) f.missing.emplace_back(without_ffmpeg);
  if (plots > 0.0 && !draws) f.missing.emplace_back(without_gnuplot);
  const HeldSignals held;  // until the workshop is removed
  try {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    if (error) throw RunError("there is no folder for temporary files");
    const ScratchFolder workshop(temporary, "carom-check");
    rehearse_files(scene, choice, tried, population.mean, workshop.path(), f);
    if (draws) f.plots_s = plots * plot_seconds(workshop.path());
  } catch (const std::runtime_error& error) {  // a full disk, or a folder that cannot be written
    f.files.clear();
    f.not_tried = error.what();
    guess_files(scene, population.mean, f);
  }
  if (scene.output.view) {
    add_page(scene, disks_shown(scene, population.mean) / static_cast<double>(scene.output.select.stride), f);
  }
  if (draws) add_plots(scene, population.mean, f);
  if (scene.analysis.any()) {
    constexpr double file_bytes = 10e3, table_bytes = 10e3, sample_bytes = 30.0;
    const double each = table_bytes + sample_bytes * static_cast<double>(f.samples);
    f.files.emplace_back("analysis.h5", file_bytes + each * quantities_of(scene));
    if (draws) f.files.emplace_back("plots of the analysis", quantities_of(scene) * analysis_plot_bytes);
  }
  if (scene.output.checkpoint > 0.0) {
    const double bytes = checkpoint_bytes(tried.state(), population.end);
    const double remembered = remembered_bytes(scene, static_cast<double>(f.frames), population.end);
    // If the run ends before its second checkpoint is due, the previous one is that of its start.
    const bool one_alone = step_seconds < scene.output.checkpoint;
    f.files.emplace_back(checkpoint_name, bytes + remembered);
    f.files.emplace_back(previous_checkpoint_name,
                         one_alone ? checkpoint_bytes(tried.state(), population.start) : bytes + remembered);
  }
  return f;
}

}  // namespace carom
