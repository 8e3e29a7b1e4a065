// The datasets of trajectory.h5 that are written frame by frame, as two tables: those with a value for each disk, and
// those with a value for each frame (h5md_layout.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/scene/scene.hpp"
#include "io/hdf5/hdf5_output.hpp"
#include "io/trajectory/h5md_values.hpp"

namespace carom {

// A quantity of every disk: one value or several (x, y and possibly z), at the disk's place, in each frame or only
// once.
struct H5mdElement {
  H5mdQuantity quantity = H5mdQuantity::position;
  std::string name;  // of the dataset
  Hdf5Kind kind;
  hsize_t components = 1;
  bool each_frame = true;
  Hdf5Handle set;
};

// One number a frame, kept here between flushes; or the same numbers in every frame.
struct H5mdColumn {
  std::string name;    // of the dataset
  bool whole = false;  // counts, in the file as std::int64_t
  Hdf5Kind kind;
  Hdf5Handle set;
  std::vector<double> values;
  Extent shape;                  // of a frame's values, if they are more than a number
  std::vector<double> constant;  // the same in every frame
};

// Positions first. images: with the number of times that each disk has crossed each periodic side (net).
std::vector<H5mdElement> h5md_elements(const Scene& scene, bool images);

// Which of series_columns the file has.
std::vector<std::size_t> observables_of(const Scene& scene);

// The step first, then observables_of(scene), those of the rotation, those of groups, and the time last.
std::vector<H5mdColumn> h5md_columns(const Scene& scene);

// The group that contains a dataset.
std::string parent_group(const std::string& dataset);

// The lengths of a column with this number of frames.
Extent shape_of(const H5mdColumn& column, Count frames);

}  // namespace carom
