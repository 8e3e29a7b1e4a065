// The error about the output folder of a run.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/check.hpp"
#include "io/files/output_folder.hpp"

namespace carom::test {

// Empty if a run of the scene file `input` may write there.
inline std::string folder_refusal(const std::filesystem::path& folder, const std::filesystem::path& input, bool force) {
  try {
    check_output_folder(folder, input, force);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace carom::test
