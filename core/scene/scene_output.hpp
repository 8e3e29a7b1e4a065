// Reading which disks a trajectory shows, how precisely, and how movies look.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The value of "select": "every 100th" (a whole number, 1 or more, with any ending), the name of a group, or
// [x0, y0, x1, y1]; all disks where it is absent. scene: groups and sources are known. Throws InputError for anything
// else, and where no trajectory is written.
Selection read_selection(const TableReader& output, const Scene& scene);

// Throws InputError where the rectangle selected has no room in common with the box, whose size is known here.
void check_selection(const Scene& scene, const PlaceOfKey& place);

// Whether "precision" is "single". Throws InputError where it is given and there is no trajectory.
bool read_single_precision(const TableReader& output);

// Whether "dimensions" is 3. Throws InputError for anything but 2 and 3, and unless trajectory is "h5md".
bool read_third_dimension(const TableReader& output);

// Whether "view" is true. Throws InputError where it is and no trajectory is written.
bool read_view(const TableReader& output);

// Whether the plan has anything that is made of frames: only then "every" is t_end / 100 where it is absent.
bool wants_frames(const OutputPlan& plan);

// "movie": whether there is one, and how it looks.
void read_movie(const TableReader& output, OutputPlan& plan);

}  // namespace carom
