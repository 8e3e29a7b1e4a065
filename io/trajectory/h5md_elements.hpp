// The datasets of trajectory.h5 that are written frame by frame, as two tables: what each disk has, and what each frame
// has (h5md_layout.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/scene/scene.hpp"
#include "io/hdf5/hdf5_output.hpp"
#include "io/trajectory/h5md_values.hpp"

namespace carom {

// What every disk has: one value or several (x, y and perhaps z), at a place of its own, in each frame or once for all.
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
  Extent shape;                  // of what a frame has, where it is more than a number
  std::vector<double> constant;  // in every frame
};

// Positions first. images: with the rounds of each disk across the periodic sides.
std::vector<H5mdElement> h5md_elements(const Scene& scene, bool images);

// Which of series_columns the file has.
std::vector<std::size_t> observables_of(const Scene& scene);

// The step first, then observables_of(scene), those of the rotation, those of groups, and the time last.
std::vector<H5mdColumn> h5md_columns(const Scene& scene);

// The group that a dataset lies in.
std::string parent_group(const std::string& dataset);

// Lengths of a column over so many frames.
Extent shape_of(const H5mdColumn& column, Count frames);

}  // namespace carom
