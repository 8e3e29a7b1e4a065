#include "io/hdf5/hdf5_output.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "core/base/check.hpp"
#include "io/hdf5/hdf5_superblock.hpp"

namespace carom {

namespace {

constexpr unsigned deflate_level = 1;

// The most that a flush may add to the file, in bytes, beyond the chunks that exist already: the last chunks of the
// plain datasets (a few hundred KiB) and of the indices. It costs nothing, see make_readable.
constexpr std::uint64_t flush_room = std::uint64_t{1} << 22;

hid_t as_id(herr_t status) {
  return static_cast<hid_t>(status);
}

// While this object exists, the superblock's extension is made without a time: it is made like a group without
// properties of its own, which would contain the time at which it was made.
class TimelessGroups {
 public:
  explicit TimelessGroups(const Hdf5Output& output) {
    output.checked(H5Pset_obj_track_times(H5P_GROUP_CREATE_DEFAULT, false));
  }
  TimelessGroups(const TimelessGroups&) = delete;
  TimelessGroups& operator=(const TimelessGroups&) = delete;
  ~TimelessGroups() { H5Pset_obj_track_times(H5P_GROUP_CREATE_DEFAULT, true); }
};

}  // namespace

Hdf5Output::Hdf5Output(std::string path, bool existing) : path_(std::move(path)) {
  silence_hdf5();
  const Hdf5Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Only the newest format keeps a file consistent while it is written.
  checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST));
  if (existing) {
    clear_writing_mark(path_);
    file_ = checked(H5Fopen(path_.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
  } else {
    // A kill may cut a write in two at a page of the system's cache, so no small write may cross one.
    constexpr hsize_t system_page = 4096;
    const Hdf5Handle plan = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    checked(H5Pset_file_space_strategy(plan.get(), H5F_FSPACE_STRATEGY_PAGE, false, 1));
    checked(H5Pset_file_space_page_size(plan.get(), system_page));
    checked(H5Pset_obj_track_times(plan.get(), false));  // of the root group
    const TimelessGroups timeless(*this);
    file_ = checked(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, plan.get(), access.get()), H5Fclose);
  }
}

Hdf5Output::Hdf5Output(std::string path) : path_(std::move(path)) {
  silence_hdf5();
  constexpr std::size_t growth = std::size_t{1} << 16;
  const Hdf5Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The format that every version reads. Images in the newest one have a wrong checksum (HDF5 1.10.8).
  checked(H5Pset_fapl_core(access.get(), growth, false));
  file_ = checked(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
}

std::string Hdf5Output::image() const {
  checked(H5Fflush(file(), H5F_SCOPE_LOCAL));
  const ssize_t bytes = H5Fget_file_image(file(), nullptr, 0);
  if (bytes < 0) fail_of_hdf5();
  std::string image(static_cast<std::size_t>(bytes), '\0');
  if (H5Fget_file_image(file(), image.data(), image.size()) < 0) fail_of_hdf5();
  return image;
}

void Hdf5Output::fail(const std::string& why) const {
  throw RunError(fmt::format("cannot write {}: {}", path_, why));
}

void Hdf5Output::fail_of_hdf5() const {
  broken_ = true;
  fail(hdf5_reason());
}

Hdf5Handle Hdf5Output::checked(hid_t id, Hdf5Handle::Close closer) const {
  if (id < 0) fail_of_hdf5();
  return {id, closer};
}

void Hdf5Output::checked(herr_t status) const {
  if (as_id(status) < 0) fail_of_hdf5();
}

namespace {

// Properties of a group or dataset to be made, without the time of its making.
Hdf5Handle timeless(const Hdf5Output& output, hid_t kind) {
  Hdf5Handle plan = output.checked(H5Pcreate(kind), H5Pclose);
  output.checked(H5Pset_obj_track_times(plan.get(), false));
  return plan;
}

}  // namespace

void Hdf5Output::make_group(const std::string& name) const {
  const Hdf5Handle plan = timeless(*this, H5P_GROUP_CREATE);
  checked(H5Gcreate2(file(), name.c_str(), H5P_DEFAULT, plan.get(), H5P_DEFAULT), H5Gclose);
}

void Hdf5Output::link(const std::string& target, const std::string& name) const {
  checked(H5Lcreate_hard(file(), target.c_str(), file(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

namespace {

// Text of fixed length, UTF-8, as long as the longest text and at least a byte.
Hdf5Handle text_type(const Hdf5Output& output, std::size_t length) {
  Hdf5Handle type = output.checked(H5Tcopy(H5T_C_S1), H5Tclose);
  output.checked(H5Tset_size(type.get(), std::max<std::size_t>(1, length)));
  output.checked(H5Tset_cset(type.get(), H5T_CSET_UTF8));
  output.checked(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
  return type;
}

Hdf5Handle space_of_one(const Hdf5Output& output) {
  return output.checked(H5Screate(H5S_SCALAR), H5Sclose);
}

Hdf5Handle space_of_list(const Hdf5Output& output, std::size_t length) {
  const hsize_t size = length;
  return output.checked(H5Screate_simple(1, &size, nullptr), H5Sclose);
}

void write_attribute(const Hdf5Output& output, const std::string& object, const char* name, const Hdf5Handle& space,
                     hid_t in_file, hid_t in_memory, const void* data) {
  const Hdf5Handle owner = output.checked(H5Oopen(output.file(), object.c_str(), H5P_DEFAULT), H5Oclose);
  const Hdf5Handle attribute =
      output.checked(H5Acreate2(owner.get(), name, in_file, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  output.checked(H5Awrite(attribute.get(), in_memory, data));
}

}  // namespace

void Hdf5Output::attribute(const std::string& object, const char* name, const std::string& text) const {
  const Hdf5Handle type = text_type(*this, text.size());
  write_attribute(*this, object, name, space_of_one(*this), type.get(), type.get(), text.c_str());
}

void Hdf5Output::attribute(const std::string& object, const char* name, int number) const {
  write_attribute(*this, object, name, space_of_one(*this), H5T_STD_I32LE, H5T_NATIVE_INT, &number);
}

void Hdf5Output::attribute(const std::string& object, const char* name, double number) const {
  write_attribute(*this, object, name, space_of_one(*this), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &number);
}

void Hdf5Output::attribute(const std::string& object, const char* name, const std::vector<std::string>& texts) const {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string all;
  for (const std::string& text : texts) all += text + std::string(length - text.size(), '\0');
  const Hdf5Handle type = text_type(*this, length);
  write_attribute(*this, object, name, space_of_list(*this, texts.size()), type.get(), type.get(), all.data());
}

void Hdf5Output::attribute(const std::string& object, const char* name, const std::vector<int>& numbers) const {
  write_attribute(*this, object, name, space_of_list(*this, numbers.size()), H5T_STD_I32LE, H5T_NATIVE_INT,
                  numbers.data());
}

void Hdf5Output::text(const std::string& name, const std::string& text) const {
  const Hdf5Handle type = text_type(*this, text.size());
  const Hdf5Handle space = space_of_one(*this);
  const Hdf5Handle plan = timeless(*this, H5P_DATASET_CREATE);
  const Hdf5Handle set = checked(
      H5Dcreate2(file(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, plan.get(), H5P_DEFAULT), H5Dclose);
  checked(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
}

Hdf5Handle Hdf5Output::make_dataset(const std::string& name, const Hdf5Kind& kind, const Extent& size,
                                    const Extent& limit, const Extent& chunk, Packing packing) const {
  const auto rank = static_cast<int>(size.size());
  const Hdf5Handle space = checked(H5Screate_simple(rank, size.data(), limit.data()), H5Sclose);
  const Hdf5Handle plan = timeless(*this, H5P_DATASET_CREATE);
  checked(H5Pset_chunk(plan.get(), rank, chunk.data()));
  checked(H5Pset_fill_value(plan.get(), kind.in_memory, kind.fill));
  if (packing == Packing::deflate) {
    checked(H5Pset_shuffle(plan.get()));
    checked(H5Pset_deflate(plan.get(), deflate_level));
  }
  return checked(H5Dcreate2(file(), name.c_str(), kind.in_file, space.get(), H5P_DEFAULT, plan.get(), H5P_DEFAULT),
                 H5Dclose);
}

Hdf5Handle Hdf5Output::open_dataset(const std::string& name) const {
  return checked(H5Dopen2(file(), name.c_str(), H5P_DEFAULT), H5Dclose);
}

Extent Hdf5Output::size_of(const Hdf5Handle& dataset) const {
  const Hdf5Handle space = checked(H5Dget_space(dataset.get()), H5Sclose);
  Extent size(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  return size;
}

void Hdf5Output::resize(const Hdf5Handle& dataset, const Extent& size) const {
  checked(H5Dset_extent(dataset.get(), size.data()));
}

void Hdf5Output::write_block(const Hdf5Handle& dataset, const Hdf5Kind& kind, const Extent& begin, const Extent& size,
                             const void* data) const {
  const Hdf5Handle from = checked(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const Hdf5Handle to = checked(H5Dget_space(dataset.get()), H5Sclose);
  checked(H5Sselect_hyperslab(to.get(), H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr));
  checked(H5Dwrite(dataset.get(), kind.in_memory, from.get(), to.get(), H5P_DEFAULT, data));
}

void Hdf5Output::write_packed_chunk(const Hdf5Handle& dataset, const Extent& begin,
                                    const std::vector<unsigned char>& packed) const {
  checked(H5Dwrite_chunk(dataset.get(), H5P_DEFAULT, 0, begin.data(), packed.size(), packed.data()));
}

void Hdf5Output::start_safe_writing() const {
  checked(H5Fstart_swmr_write(file()));
  end_flush();
}

void Hdf5Output::begin_flush() const {
  make_readable(path_, flush_room);
}

void Hdf5Output::end_flush() const {
  checked(H5Fflush(file(), H5F_SCOPE_LOCAL));
  // HDF5 has just set the mark "being written" again; without the mark the file can be opened after a kill.
  make_readable(path_, flush_room);
}

void Hdf5Output::close() {
  checked(file_.close());
  cut_at_end(path_);
}

}  // namespace carom
