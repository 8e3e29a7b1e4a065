// What a view page tells of a run beside its disks.
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

// Rows evenly chosen, so that there are at most so many values, but two rows at least. Columns without any number are
// left out, and so is a last line without its end, as of a run that was killed. Throws InputError where the text is no
// table; name is the file's, for the message.
ViewSeries read_view_series(std::string_view csv, std::size_t most_values, const std::string& name);

struct ViewSource {
  std::optional<Side> side;
  Vec2 low, high;  // of the region, where there is no side
};

struct ViewStory {
  std::string title;
  Domain box;
  std::vector<std::string> groups;  // by number; empty: no name
  std::vector<ViewSource> sources;
  std::vector<Obstacle> obstacles;
  std::vector<WallMotion> wall_motions;  // by number of a [[walls]] table; empty where no inner wall moves
  ColourBy colour = ColourBy::speed;
  ViewSeries series;
  std::vector<AnalysisCurve> curves;
};

// What the scene says; the series comes from elsewhere.
ViewStory view_story(const Scene& scene);

}  // namespace carom
