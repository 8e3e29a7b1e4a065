// Reads the table [output]: the disks and the precision of a trajectory, and the settings of movies.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The value of "select": "every 100th" (a whole number, 1 or more, with any ending), the name of a group, or
// [x0, y0, x1, y1]; all disks where it is absent. scene: groups and sources are known. Throws InputError for anything
// else, and where no trajectory is written.
Selection read_selection(const TableReader& output, const Scene& scene);

// Throws InputError if the selected rectangle does not overlap the box. Precondition: the size of the box is known.
void check_selection(const Scene& scene, const PlaceOfKey& place);

// Whether "precision" is "single". Throws InputError if it is given without a trajectory.
bool read_single_precision(const TableReader& output);

// Whether "dimensions" is 3. Throws InputError for anything but 2 and 3, and unless trajectory is "h5md".
bool read_third_dimension(const TableReader& output);

// Whether "view" is true. Throws InputError if it is true and no trajectory is written.
bool read_view(const TableReader& output);

// Does any output consist of frames? Only then "every" has the default t_end / 100.
bool wants_frames(const OutputPlan& plan);

// Reads "movie": whether one is wanted, and its settings.
void read_movie(const TableReader& output, OutputPlan& plan);

}  // namespace carom
