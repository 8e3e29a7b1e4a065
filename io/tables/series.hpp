// series.csv: a table of the run, one row for each frame.
#pragma once

#include <array>
#include <string>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/state.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_sinks.hpp"
#include "io/files/file_mark.hpp"
#include "io/files/output_file.hpp"
#include "io/tables/column_text.hpp"
#include "io/tables/group_columns.hpp"
#include "io/tables/rotation_columns.hpp"
#include "io/tables/shear_columns.hpp"
#include "io/tables/side_columns.hpp"

namespace carom {

// The columns of series.csv after the time, and the observables of trajectory.h5. docs/scene.md is made from this list.
struct SeriesColumn {
  const char* name;
  bool whole;  // a count
  const char* unit;
  const char* meaning;
};
inline constexpr std::array<SeriesColumn, 18> series_columns{{
    {"disks", true, "", "disks in the box"},
    {"kinetic", false, "energy",
     "sum of m v^2 / 2, in a sheared box with the flow; nan for Brownian motion, which has no velocities"},
    {"potential", false, "energy",
     "sum of -m g.r, 0 at the lower left corner; jumps, as does `total`, when a disk crosses a periodic side along "
     "gravity"},
    {"total", false, "energy", "`kinetic` + `potential` + `rotational`; nan for Brownian motion"},
    {"px", false, "momentum", "sum of m vx; nan for Brownian motion"},
    {"py", false, "momentum", "sum of m vy; nan for Brownian motion"},
    {"collisions", true, "", "collisions of two disks since the start"},
    {"wall_collisions", true, "", "collisions of a disk with a wall or a fixed disk since the start"},
    {"pressure", false, "energy / area",
     "pressure from the kinetic energy of this row (relative to a shear flow) and all collisions since the row before, "
     "divided by the area of the whole box, with fixed disks; if sides move, by the area between them. 0 in the first "
     "row; nan for Brownian motion. A row within the same window of `exact` repeats it"},
    {"collision_rate", false, "1 / time",
     "collisions of a disk per unit time, mean since the row before; for Brownian motion it grows as 1 / sqrt(dt)"},
    {"max_overlap", false, "",
     "largest overlap of two disks in this frame, over the sum of their radii; 0 without overlap"},
    {"removed", true, "", "disks that sinks have removed since the start"},
    {"emitted", true, "", "disks that came from sources since the start"},
    {"waiting", true, "", "disks of sources that are due and wait for room"},
    {"force_left", false, "force",
     "outward force on the left wall, mean since the row before; nan for Brownian motion"},
    {"force_right", false, "force", "as `force_left`, on the right wall"},
    {"force_bottom", false, "force", "as `force_left`, on the bottom wall"},
    {"force_top", false, "force", "as `force_left`, on the top wall"},
}};
inline constexpr const char* displacement_column = "displacement";  // behind them, if [analysis] asks for it
// Then a column for each sink; its full name is this name, an underscore, and the sink's name.
inline constexpr ColumnText taken_column{"removed_by", "", "disks that this sink has removed since the start"};
using SeriesRow = std::array<double, series_columns.size()>;  // counts are exact up to 2^53

inline constexpr std::size_t kinetic_column = 1, potential_column = 2, total_column = 3;
inline constexpr std::size_t collisions_column = 6, wall_collisions_column = 7;
inline constexpr std::size_t overlap_column = 10;  // max_overlap

class SeriesMeter {
 public:
  // with_overlap: the largest overlap needs a search over all disks, which costs many times more than all other
  // columns; without it the column is 0.
  SeriesMeter(const Scene& scene, bool with_overlap, const MeterMark& from = {})
      : box_(scene.box),
        gravity_(scene.physics.gravity),
        with_overlap_(with_overlap),
        drawn_(velocities_are_drawn(scene)),
        done_(from) {}

  // The row of a frame: disks at its time, and the counters of `now`. An exact run counts to the end of its window,
  // which may lie a little after the frame; means are over the time between two states, so that no collision is lost or
  // counted twice. pressure, collision_rate (per disk) and the four wall forces are means over the time since the row
  // before, and 0 in the first row; a row whose state is the one of the row before (a frame of the same window) repeats
  // them. Quantities from velocities are NaN with Brownian motion (core/scene/drawn_velocities.hpp).
  SeriesRow row(const DisksInPieces& disks, const State& now, const BlockRunner& run = run_in_order);

  // The values of shear_columns in the last row; only for a sheared box.
  const std::array<double, shear_columns.size()>& shear_row() const { return shear_row_; }

  const MeterMark& mark() const { return done_; }

 private:
  IntervalMeans means(const Energy& energy, double momentum_flow, const State& now) const;

  Domain box_;
  Gravity gravity_;
  bool with_overlap_;
  bool drawn_;  // quantities from velocities are NaN
  MeterMark done_;
  std::array<double, shear_columns.size()> shear_row_{};
};

class SeriesWriter {
 public:
  // Writes the heading. Throws RunError if the file cannot be written, as do all functions below.
  SeriesWriter(const std::string& path, const Scene& scene);

  // Continues an existing file after a mark; later rows are cut off. Throws InputError if the file is shorter or has
  // other columns.
  SeriesWriter(const std::string& path, const Scene& scene, const SeriesMark& from);

  // Writes a row and returns it (SeriesMeter::row). displacement: the mean square, a column if scene.analysis asks for
  // it. The columns of groups with names come last.
  SeriesRow write(const DisksInPieces& disks, const State& now, double displacement = 0.0,
                  const BlockRunner& run = run_in_order);
  SeriesRow write(const Disks& disks, double time, const State& now, double displacement = 0.0,
                  const BlockRunner& run = run_in_order) {
    return write(WholeDisks(disks, time), now, displacement, run);
  }

  // The present end of the file; all data before it are on the disk.
  SeriesMark mark();

  void close() { file_.close(); }

 private:
  OutputFile file_;
  EnergySources sources_;
  std::vector<SceneSink> sinks_;
  SeriesMeter meter_;
  GroupMeter groups_;
  bool rotates_;
  bool with_displacement_;
  Count rows_ = 0;
};

}  // namespace carom
