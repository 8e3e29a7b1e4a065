// Making and extending the parts of an HDF5 file; every failure is a RunError.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.hpp"

namespace carom {

// Lengths of a dataset, slowest dimension first.
using Extent = std::vector<hsize_t>;

// The kind of a dataset's values: their types, width and fill value.
struct Hdf5Kind {
  hid_t in_file = -1, in_memory = -1;
  std::size_t width = 0;       // bytes in memory, and in the file
  const void* fill = nullptr;  // of type in_memory
};

enum class Packing : std::uint8_t { plain, deflate };

class Hdf5Output {
 public:
  // Makes the file, or opens an existing one. Throws RunError, "cannot write PATH: why", as do all functions below.
  Hdf5Output(std::string path, bool existing);

  // A file in memory, whose bytes image() returns; path is its name in messages. It contains neither a time nor a user:
  // the same content has the same bytes.
  explicit Hdf5Output(std::string path);
  std::string image() const;

  // The id, if the call that returned it succeeded.
  Hdf5Handle checked(hid_t id, Hdf5Handle::Close closer) const;
  void checked(herr_t status) const;
  [[noreturn]] void fail(const std::string& why) const;
  [[noreturn]] void fail_of_hdf5() const;

  // After a failure of HDF5 no part of the file may be used any more, not even closed.
  bool broken() const { return broken_; }
  void abandon() { file_.abandon(); }

  hid_t file() const { return file_.get(); }
  void make_group(const std::string& name) const;
  void link(const std::string& target, const std::string& name) const;  // a second name for a dataset
  // An attribute with one value, or with a list of them, even if it has only one entry.
  void attribute(const std::string& object, const char* name, const std::string& text) const;
  void attribute(const std::string& object, const char* name, int number) const;
  void attribute(const std::string& object, const char* name, double number) const;
  void attribute(const std::string& object, const char* name, const std::vector<std::string>& texts) const;
  void attribute(const std::string& object, const char* name, const std::vector<int>& numbers) const;
  void text(const std::string& name, const std::string& text) const;  // as a dataset

  // limit: H5S_UNLIMITED if the dataset may grow.
  Hdf5Handle make_dataset(const std::string& name, const Hdf5Kind& kind, const Extent& size, const Extent& limit,
                          const Extent& chunk, Packing packing) const;
  Hdf5Handle open_dataset(const std::string& name) const;
  Extent size_of(const Hdf5Handle& dataset) const;
  void resize(const Hdf5Handle& dataset, const Extent& size) const;

  // Writes the block of a dataset that begins at `begin`.
  void write_block(const Hdf5Handle& dataset, const Hdf5Kind& kind, const Extent& begin, const Extent& size,
                   const void* data) const;
  // Writes a whole chunk of a dataset with Packing::deflate, packed by ShuffledDeflate.
  void write_packed_chunk(const Hdf5Handle& dataset, const Extent& begin,
                          const std::vector<unsigned char>& packed) const;

  // From here on nothing can be made, only extended and written, and the file is consistent at any moment.
  void start_safe_writing() const;
  // A flush in this mode: begin_flush makes readable what is already in the file, flush writes a dataset, and end_flush
  // all the rest.
  void begin_flush() const;
  void flush(const Hdf5Handle& dataset) const { checked(H5Dflush(dataset.get())); }
  void end_flush() const;
  // To be called after all datasets have been closed.
  void close();

 private:
  std::string path_;
  Hdf5Handle file_;
  mutable bool broken_ = false;
};

}  // namespace carom
