#include "io/view/view_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "io/view/view_encoder.hpp"
#include "io/view/view_page.hpp"

namespace carom {

namespace {

constexpr std::size_t least_shown_frames = 100;  // before disks are left out, too
constexpr DiskId most_thinned_disks = 100;       // at least one disk of this number stays

// What all frames have in common.
struct TrajectoryExtent {
  std::size_t frames = 0;
  double smallest_radius = std::numeric_limits<double>::infinity();
  Domain box;
};

TrajectoryExtent extent_of(const OpenTrajectory& open, const std::string& name) {
  TrajectoryExtent extent;
  const auto reader = open();
  for (TrajectoryFrame frame; reader->read(frame); ++extent.frames) {
    extent.box = frame.box;
    if (!frame.disks.empty()) extent.smallest_radius = std::min(extent.smallest_radius, smallest_radius(frame.disks));
  }
  if (extent.frames == 0) fail_input(name, "holds no frame");
  return extent;
}

// Shows one frame of `stride` and one disk of `every`.
struct Thinning {
  std::size_t stride = 1;
  DiskId every = 1;
};

std::size_t shown_frames(std::size_t frames, std::size_t stride) {
  return (frames + stride - 1) / stride;
}

std::size_t text_bytes(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

// The factor by which frames are too long, estimated from the first blocks. Only these count: how many more are packed
// by then depends on the threads, and the page must not.
double factor_by_first_blocks(const ViewEncoder& encoder, std::size_t shown, std::size_t most_bytes) {
  std::size_t bytes = 0;
  std::size_t frames = 0;
  for (const ViewBlock& block : encoder.blocks()) {
    bytes += block.packed.size();
    frames += block.frames;
    if (text_bytes(bytes) > most_bytes) break;
  }
  const double part = static_cast<double>(frames) / static_cast<double>(shown);
  return static_cast<double>(text_bytes(bytes)) / part / static_cast<double>(most_bytes);
}

// Packs the frames, and stops if they are too long; returns the factor by which they are, at most 1 if they are not.
double pack_frames(const OpenTrajectory& open, const Thinning& thin, std::size_t frames, std::size_t most_bytes,
                   ViewEncoder& encoder) {
  const auto reader = open();
  const auto is_too_long = [&] { return text_bytes(encoder.packed_bytes()) > most_bytes; };
  TrajectoryFrame frame;
  for (std::size_t k = 0; k < frames && !is_too_long() && reader->read(frame); ++k) {
    if (k % thin.stride == 0) encoder.add(frame);
  }
  if (!is_too_long()) encoder.finish();
  if (is_too_long()) return factor_by_first_blocks(encoder, shown_frames(frames, thin.stride), most_bytes);
  return static_cast<double>(text_bytes(encoder.packed_bytes())) / static_cast<double>(most_bytes);
}

// A stronger thinning for a page that is `factor` times too long: frames first. Nothing if no more can be left out.
std::optional<Thinning> thinner(const Thinning& thin, double factor, std::size_t frames) {
  const std::size_t most_stride = std::max<std::size_t>(1, frames / least_shown_frames);
  if (thin.stride < most_stride) {
    const double wanted = std::ceil(static_cast<double>(thin.stride) * std::min(factor, 1e6));
    return Thinning{std::clamp(static_cast<std::size_t>(wanted), thin.stride + 1, most_stride), 1};
  }
  if (thin.every >= most_thinned_disks) return {};
  const double wanted = std::ceil(thin.every * std::min(factor, 1e6));
  return Thinning{thin.stride, std::clamp(static_cast<DiskId>(wanted), thin.every + 1, most_thinned_disks)};
}

std::string ordinal(std::size_t n) {
  const std::size_t ten = n % 100;
  const char* const end = ten >= 11 && ten <= 13 ? "th"
                          : n % 10 == 1          ? "st"
                          : n % 10 == 2          ? "nd"
                          : n % 10 == 3          ? "rd"
                                                 : "th";
  return fmt::format("{}{}", n, end);
}

std::vector<std::string> sentences_of(const Thinning& thin, const TrajectoryExtent& extent, const ViewSeries& series) {
  std::vector<std::string> sentences;
  if (thin.stride > 1) {
    sentences.push_back(fmt::format("shows every {} frame of {}", ordinal(thin.stride), extent.frames));
  }
  if (thin.every > 1) sentences.push_back(fmt::format("shows every {} disk", ordinal(thin.every)));
  if (!series.columns.empty() && series.columns[0].size() < series.rows) {
    sentences.push_back(fmt::format("plots {} of the {} rows of series.csv", series.columns[0].size(), series.rows));
  }
  return sentences;
}

}  // namespace

ViewMade make_view(const OpenTrajectory& open, const std::string& name, ViewStory story, const ViewWork& work) {
  const TrajectoryExtent extent = extent_of(open, name);
  if (!(story.box.width > 0.0)) story.box = extent.box;
  const ViewAxes axes{view_axis(story.box.width, story.box.periodic_x(), extent.smallest_radius),
                      view_axis(story.box.height, story.box.periodic_y(), extent.smallest_radius)};
  std::size_t rest = 0;  // bytes of the page without the frames, once known
  Thinning least;        // the last one tried
  for (std::optional<Thinning> thin = Thinning{}; thin;) {
    least = *thin;
    ViewEncoder encoder(axes, thin->every, work.threads, work.run, story.box.shear);
    const std::size_t room = work.most_bytes > rest ? work.most_bytes - rest : 0;
    double factor = pack_frames(open, *thin, extent.frames, std::max<std::size_t>(room, 1), encoder);
    if (factor <= 1.0) {
      ViewMade made;
      made.left_out = sentences_of(*thin, extent, story.series);
      made.page = view_page(story, encoder, made.left_out);
      made.frames = encoder.times().size();
      made.disks = encoder.disks().id.size();
      made.disk_frames = encoder.disk_frames();
      made.packed_bytes = encoder.packed_bytes();
      if (made.page.size() <= work.most_bytes) return made;
      rest = made.page.size() - text_bytes(made.packed_bytes);
      factor = static_cast<double>(made.page.size()) / static_cast<double>(work.most_bytes);
    }
    thin = thinner(*thin, factor, extent.frames);
  }
  fail_input("--max-size",
             fmt::format("{} bytes are too few for a page with {} and {}", work.most_bytes,
                         least.every == 1 ? "all disks" : fmt::format("one disk in {}", least.every),
                         counted(shown_frames(extent.frames, least.stride), "frame")),
             "expected more");
}

}  // namespace carom
