// HDF5's identifiers with an owner each, and what HDF5 says of its errors. Includes HDF5's own header: for the files
// that read and write HDF5 alone.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace carom {

// An open file, group, dataset, space, type or list of properties, closed with the object.
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

  // Forgets it without closing.
  void abandon() { id_ = -1; }

  // Closes now; negative where HDF5 could not.
  herr_t close() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

// Before anything else: HDF5 prints its errors on standard error unless that is switched off; and at exit it would try
// once more to write what a full disk did not take, and crash over it.
inline void silence_hdf5() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// What the last failed call says of the system's part in it ("No space left on device"), or of its own.
std::string hdf5_reason();

}  // namespace carom
