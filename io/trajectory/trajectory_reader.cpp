#include "io/trajectory/trajectory_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <system_error>

#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "io/trajectory/h5md_reader.hpp"
#include "io/trajectory/trajectory_xyz.hpp"

namespace carom {

void check_present(const std::string& name) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(name, error);
  if (std::filesystem::exists(status)) return;
  const bool absent = status.type() == std::filesystem::file_type::not_found;
  fail_input(name, absent ? "does not exist" : fmt::format("cannot be opened: {}", error.message()),
             "expected a folder of a run, or a trajectory");
}

std::filesystem::path trajectory_in(const std::filesystem::path& folder) {
  std::error_code error;
  for (const char* const name : {"trajectory.xyz", "trajectory.h5"}) {
    if (std::filesystem::exists(folder / name, error)) return folder / name;
  }
  return {};
}

std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, bool growing) {
  if (!std::filesystem::is_directory(path)) check_regular_file(path);  // a folder gets the reader's own message
  std::array<char, 4> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (std::string_view(head.data(), head.size()) == "\x89HDF") return std::make_unique<H5mdReader>(path, growing);
  return std::make_unique<XyzReader>(path, growing);
}

}  // namespace carom
