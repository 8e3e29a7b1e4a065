// What a view page shows of a run besides its disks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/obstacle.hpp"
#include "core/scene/scene.hpp"
#include "io/tables/analysis_curves.hpp"

namespace carom {

// Columns of series.csv against its first one, time; NaN where a row has no number.
struct ViewSeries {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // as many as names, of equal length
  std::size_t rows = 0;                      // in the file; columns may have fewer
};

// Evenly spaced rows, with at most this number of values in all, but at least two rows. Columns without any number are
// left out, and so is an incomplete last line, as of a run that was killed. Throws InputError if the text is not a
// table; name: of the file, for the message.
ViewSeries read_view_series(std::string_view csv, std::size_t most_values, const std::string& name);

struct ViewSource {
  std::optional<Side> side;
  Vec2 low, high;  // of the region, if there is no side
};

struct ViewStory {
  std::string title;
  Domain box;
  std::vector<std::string> groups;  // by number; empty: no name
  std::vector<ViewSource> sources;
  std::vector<Obstacle> obstacles;
  std::vector<WallMotion> wall_motions;  // by number of a [[walls]] table; empty if no inner wall moves
  ColourBy colour = ColourBy::speed;
  ViewSeries series;
  std::vector<AnalysisCurve> curves;
};

// The story as far as the scene gives it; the series comes from elsewhere.
ViewStory view_story(const Scene& scene);

}  // namespace carom
