// Owners for HDF5's identifiers, and the messages of HDF5's errors. Includes HDF5's own header, so it is only for files
// that read and write HDF5.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace carom {

// Owns an open file, group, dataset, space, type or list of properties, and closes it.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { close(); }

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

  // Releases it without closing.
  void abandon() { id_ = -1; }

  // Closes now; negative if HDF5 fails.
  herr_t close() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

// To be called before any other use of HDF5. Without it HDF5 prints its errors on standard error; and after a full disk
// it would try to write again at exit, and crash.
inline void silence_hdf5() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// The reason of the last failed call: the system's message ("No space left on device"), or else HDF5's.
std::string hdf5_reason();

}  // namespace carom
