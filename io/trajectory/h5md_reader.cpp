#include "io/trajectory/h5md_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/disks/disk_columns.hpp"
#include "io/hdf5/hdf5_handle.hpp"
#include "io/trajectory/h5md_layout.hpp"

namespace carom {

namespace {

constexpr const char* expected = "expected a trajectory.h5 that Carom wrote";

}  // namespace

struct H5mdReader::File {
  explicit File(const std::string& file_path);

  [[noreturn]] void fail(const std::string& what) const { fail_input(path, what, expected); }
  [[noreturn]] void fail_to_open(const std::string& reason) const {
    fail(reason.starts_with("truncated file") ? fmt::format("was cut short ({})", reason) : reason);
  }
  Hdf5Handle checked(hid_t opened, Hdf5Handle::Close closer) const {
    if (opened < 0) fail(hdf5_reason());
    return {opened, closer};
  }
  Hdf5Handle open_set(const std::string& name) const {
    return checked(H5Dopen2(file.get(), (std::string(h5md_disks) + "/" + name).c_str(), H5P_DEFAULT), H5Dclose);
  }
  std::vector<hsize_t> size_of(const Hdf5Handle& set) const;
  void read_box();
  template <class T>
  void read_row(const Hdf5Handle& set, hid_t type, Count frame, std::vector<T>& to) const;
  void read_frame(Count next, TrajectoryFrame& frame);

  std::string path;
  Hdf5Handle file, position, velocity, id, radius, mass, species;
  Hdf5Handle spin;   // of rough disks
  Hdf5Handle image;  // if sides are periodic
  bool has_spin = false, has_image = false;
  Domain box;
  std::vector<double> times;
  std::size_t dimensions = 2;
  std::vector<double> xy, vxy, radii, masses, spins;  // of all places in one frame
  std::vector<DiskId> ids, groups;
  std::vector<std::int32_t> images;
};

H5mdReader::File::File(const std::string& file_path) : path(file_path) {
  silence_hdf5();
  hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (opened < 0) {
    // The writer was killed between two writes: the file is consistent, but marked as being written. By default HDF5
    // reads data whose checksum is wrong a hundred times, and waits before each attempt twice as long, from 1 ns on:
    // practically for ever in a damaged file.
    constexpr unsigned attempts = 20;
    const Hdf5Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    if (H5Pset_metadata_read_attempts(access.get(), attempts) < 0) fail(hdf5_reason());
    opened = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get());
    if (opened < 0) fail_to_open(hdf5_reason());  // must be read before access is closed, which clears it
  }
  file = checked(opened, H5Fclose);
  read_box();
  position = open_set("position/value");
  velocity = open_set("velocity/value");
  id = open_set("id/value");
  const std::string group = std::string(h5md_disks) + "/mass/value";
  const bool each_frame = H5Lexists(file.get(), (std::string(h5md_disks) + "/mass").c_str(), H5P_DEFAULT) > 0 &&
                          H5Lexists(file.get(), group.c_str(), H5P_DEFAULT) > 0;
  mass = open_set(each_frame ? "mass/value" : "mass");
  radius = open_set(each_frame ? "radius/value" : "radius");
  species = open_set(each_frame ? "species/value" : "species");
  has_image = H5Lexists(file.get(), (std::string(h5md_disks) + "/image").c_str(), H5P_DEFAULT) > 0;
  if (has_image) image = open_set("image/value");
  has_spin = H5Lexists(file.get(), (std::string(h5md_disks) + "/angular_velocity").c_str(), H5P_DEFAULT) > 0;
  if (has_spin) spin = open_set("angular_velocity/value");
  const Hdf5Handle time = open_set("position/time");
  const std::vector<hsize_t> length = size_of(time);
  const std::vector<hsize_t> places = size_of(position);
  const bool known_shape = length.size() == 1 && places.size() == 3 && (places[2] == 2 || places[2] == 3);
  if (!known_shape || size_of(velocity).size() != 3 || size_of(velocity)[2] != places[2]) {
    fail("its datasets have other shapes");
  }
  dimensions = places[2];
  times.resize(length[0]);
  if (!times.empty() && H5Dread(time.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()) < 0) {
    fail(hdf5_reason());
  }
}

std::vector<hsize_t> H5mdReader::File::size_of(const Hdf5Handle& set) const {
  const Hdf5Handle space = checked(H5Dget_space(set.get()), H5Sclose);
  std::vector<hsize_t> size(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  return size;
}

void H5mdReader::File::read_box() {
  const std::string name = std::string(h5md_disks) + "/box/edges";
  const bool each_frame = H5Lexists(file.get(), name.c_str(), H5P_DEFAULT) > 0 &&
                          H5Oexists_by_name(file.get(), name.c_str(), H5P_DEFAULT) > 0 &&
                          H5Lexists(file.get(), (name + "/value").c_str(), H5P_DEFAULT) > 0;
  const Hdf5Handle edges = open_set(each_frame ? "box/edges/value" : "box/edges");
  const std::vector<hsize_t> size = size_of(edges);
  // Three vectors in each frame, equal in all of them: those of the first frame are enough.
  std::vector<double> lengths(each_frame ? 9 : 2);
  if (each_frame) {
    if (size.size() != 3 || size[1] != 3 || size[2] != 3) fail("has no box of three edges");
    if (size[0] > 0) read_row(edges, H5T_NATIVE_DOUBLE, 0, lengths);
  } else if (size != std::vector<hsize_t>{2} ||
             H5Dread(edges.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, lengths.data()) < 0) {
    fail("has no box of two edges");
  }
  box.width = lengths.front();
  box.height = lengths[each_frame ? 4 : 1];
  const Hdf5Handle group =
      checked(H5Oopen(file.get(), (std::string(h5md_disks) + "/box").c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle boundary = checked(H5Aopen(group.get(), "boundary", H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type = checked(H5Aget_type(boundary.get()), H5Tclose);
  const std::size_t width = H5Tget_size(type.get());
  const hsize_t stored = H5Aget_storage_size(boundary.get());
  if (width == 0 || (stored != 2 * width && stored != 3 * width)) fail("has no boundary of two words");
  std::string words(stored, '\0');
  if (H5Aread(boundary.get(), type.get(), words.data()) < 0) fail(hdf5_reason());
  if (words.starts_with("periodic")) box.sides[0] = box.sides[1] = SideKind::periodic;
  if (words.compare(width, 8, "periodic") == 0) box.sides[2] = box.sides[3] = SideKind::periodic;
}

// Reads one frame of a dataset, or all of one without frames.
template <class T>
void H5mdReader::File::read_row(const Hdf5Handle& set, hid_t type, Count frame, std::vector<T>& to) const {
  const Hdf5Handle space = checked(H5Dget_space(set.get()), H5Sclose);
  std::vector<hsize_t> size = size_of(set);
  std::vector<hsize_t> begin(size.size(), 0);
  if (size.size() > 1) {
    if (frame >= size[0]) fail(fmt::format("frame {} is missing", frame + 1));
    begin[0] = frame;
    size[0] = 1;
  }
  to.resize(std::accumulate(size.begin(), size.end(), hsize_t{1}, std::multiplies<>()));
  if (to.empty()) return;
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr);
  const Hdf5Handle memory = checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  if (H5Dread(set.get(), type, memory.get(), space.get(), H5P_DEFAULT, to.data()) < 0) {
    fail(fmt::format("frame {} cannot be read: {}", frame + 1, hdf5_reason()));
  }
}

void H5mdReader::File::read_frame(Count next, TrajectoryFrame& frame) {
  read_row(position, H5T_NATIVE_DOUBLE, next, xy);
  read_row(velocity, H5T_NATIVE_DOUBLE, next, vxy);
  read_row(radius, H5T_NATIVE_DOUBLE, next, radii);
  read_row(mass, H5T_NATIVE_DOUBLE, next, masses);
  read_row(id, H5T_NATIVE_UINT32, next, ids);
  read_row(species, H5T_NATIVE_UINT32, next, groups);
  if (has_spin) read_row(spin, H5T_NATIVE_DOUBLE, next, spins);
  if (has_image) read_row(image, H5T_NATIVE_INT32, next, images);
  // A writer that was killed while places were added may have lengthened only some datasets for frames to come.
  std::size_t places = std::min({ids.size(), xy.size() / dimensions, vxy.size() / dimensions});
  if (has_spin) places = std::min(places, spins.size());
  if (has_image) places = std::min(places, images.size() / dimensions);
  frame = {};
  frame.box = box;
  frame.time = times[next];
  frame.has_groups = true;
  frame.has_images = has_image;
  frame.has_spins = has_spin;
  for (std::size_t p = 0; p < places; ++p) {
    if (ids[p] == h5md_no_id) continue;
    if (p >= radii.size() || p >= masses.size() || p >= groups.size()) {
      fail(fmt::format("disk {} has no radius, mass or species", ids[p]));
    }
    const std::size_t at = p * dimensions;
    if (dimensions == 3 && (xy[at + 2] != 0.0 || vxy[at + 2] != 0.0)) {
      fail(fmt::format("frame {}: disk {} has left the plane z = 0", next + 1, ids[p]));
    }
    frame.group.push_back(groups[p]);
    if (has_image) {
      frame.image_x.push_back(images[at]);
      frame.image_y.push_back(images[at + 1]);
    }
    const Disk disk{xy[at], xy[at + 1], vxy[at], vxy[at + 1], radii[p], masses[p], ids[p], has_spin ? spins[p] : 0.0};
    push_back(frame.disks, disk, {.radius = true, .mass = true, .spin = has_spin});
    for (const double value : {disk.x, disk.y, disk.vx, disk.vy, disk.radius, disk.mass, disk.spin}) {
      if (!std::isfinite(value))
        fail(fmt::format("frame {}: disk {} has a value that is not a number", next + 1, ids[p]));
    }
  }
}

H5mdReader::H5mdReader(const std::string& path, bool growing)
    : path_(path), growing_(growing), file_(std::make_unique<File>(path)) {}

H5mdReader::~H5mdReader() = default;

// HDF5 keeps what it knows of a file while that is open, so it is opened anew. If that fails, since the file is being
// moved, there are no more frames for now.
bool H5mdReader::has_more() {
  if (file_ && next_ < file_->times.size()) return true;
  if (!growing_) return false;
  file_ = nullptr;
  try {
    file_ = std::make_unique<File>(path_);
  } catch (const InputError&) {
    return false;
  }
  return next_ < file_->times.size();
}

bool H5mdReader::read(TrajectoryFrame& frame) {
  if (!has_more()) return false;
  file_->read_frame(next_, frame);
  ++next_;
  return true;
}

bool H5mdReader::skip() {
  if (!has_more()) return false;
  ++next_;
  return true;
}

Count H5mdReader::frames() const {
  return file_->times.size();
}

}  // namespace carom
