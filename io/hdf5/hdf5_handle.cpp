#include "io/hdf5/hdf5_handle.hpp"

namespace carom {

namespace {

// HDF5 has the system's message within its own: "..., error message = 'No space left on device', buf = ...".
herr_t take_reason(unsigned /*depth*/, const H5E_error2_t* error, void* to) {
  auto& reason = *static_cast<std::string*>(to);
  const std::string text = error->desc == nullptr ? "" : error->desc;
  const std::string mark = "error message = '";
  const std::size_t at = text.find(mark);
  if (at != std::string::npos) {
    const std::size_t begin = at + mark.size();
    reason = text.substr(begin, text.find('\'', begin) - begin);
    return 1;  // the system's message is the best one
  }
  if (reason.empty()) reason = text;  // the innermost message of HDF5 itself
  return 0;
}

}  // namespace

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_reason, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

}  // namespace carom
