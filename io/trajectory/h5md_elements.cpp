#include "io/trajectory/h5md_elements.hpp"

#include <fmt/format.h>

#include "io/hdf5/hdf5_kinds.hpp"
#include "io/tables/group_columns.hpp"
#include "io/tables/rotation_columns.hpp"
#include "io/tables/series.hpp"
#include "io/trajectory/h5md_layout.hpp"

namespace carom {

namespace {

Hdf5Kind single_kind() {
  return {H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, sizeof(float), &h5md_single_nothing};
}
Hdf5Kind id_kind() {
  return {H5T_STD_U32LE, H5T_NATIVE_UINT32, sizeof(DiskId), &h5md_no_id};
}
Hdf5Kind image_kind() {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32, sizeof(std::int32_t), &h5md_no_image};
}

std::string of_disks(const std::string& name) {
  return fmt::format("{}/{}", h5md_disks, name);
}

H5mdColumn column(const std::string& name, bool whole) {
  return {name, whole, whole ? count_kind() : double_kind(), {}, {}, {}, {}};
}

}  // namespace

std::vector<H5mdElement> h5md_elements(const Scene& scene, bool images) {
  const Hdf5Kind place_kind = scene.output.single_precision ? single_kind() : double_kind();
  const auto components = static_cast<hsize_t>(scene.output.dimensions);
  const bool moving = scene.output.select.by_region;  // a place may belong to another disk in each frame
  std::vector<H5mdElement> elements;
  const auto add = [&](H5mdQuantity quantity, const char* name, Hdf5Kind kind, hsize_t width) {
    elements.push_back({quantity, of_disks(name) + "/value", kind, width, true, {}});
  };
  const auto add_once = [&](H5mdQuantity quantity, const char* name, Hdf5Kind kind) {
    elements.push_back({quantity, of_disks(name) + (moving ? "/value" : ""), kind, 1, moving, {}});
  };
  add(H5mdQuantity::position, "position", place_kind, components);
  add(H5mdQuantity::velocity, "velocity", place_kind, components);
  add(H5mdQuantity::id, "id", id_kind(), 1);
  add_once(H5mdQuantity::mass, "mass", double_kind());
  add_once(H5mdQuantity::radius, "radius", double_kind());
  add_once(H5mdQuantity::species, "species", id_kind());
  if (images) add(H5mdQuantity::image, "image", image_kind(), components);
  if (scene.physics.surfaces.are_rough()) add(H5mdQuantity::spin, "angular_velocity", place_kind, 1);
  return elements;
}

std::vector<std::size_t> observables_of(const Scene& scene) {
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < series_columns.size(); ++k) {
    if (k != overlap_column || scene.output.series) shown.push_back(k);  // see SeriesMeter
  }
  return shown;
}

std::vector<H5mdColumn> h5md_columns(const Scene& scene) {
  std::vector<H5mdColumn> columns;
  columns.push_back(column(of_disks("position/step"), true));
  for (const std::size_t k : observables_of(scene)) {
    columns.push_back(column(fmt::format("/observables/{}/value", series_columns[k].name), series_columns[k].whole));
  }
  for (const std::string& name : rotation_column_names(scene)) {
    columns.push_back(column(fmt::format("/observables/{}/value", name), false));
  }
  for (const GroupColumn& c : GroupMeter(scene).columns()) {
    columns.push_back(column(fmt::format("/observables/{}/value", c.name), c.whole));
  }
  if (scene.output.dimensions == 3) {
    // MDAnalysis expects three vectors as the box of each frame.
    H5mdColumn& edges = columns.emplace_back(column(of_disks("box/edges/value"), false));
    edges.shape = {3, 3};
    edges.constant = {scene.box.width, 0.0, 0.0, 0.0, scene.box.height, 0.0, 0.0, 0.0, 1.0};
  }
  columns.push_back(column(of_disks("position/time"), false));
  return columns;
}

std::string parent_group(const std::string& dataset) {
  return dataset.substr(0, dataset.rfind('/'));
}

Extent shape_of(const H5mdColumn& column, Count frames) {
  Extent extent{frames};
  extent.insert(extent.end(), column.shape.begin(), column.shape.end());
  return extent;
}

}  // namespace carom
