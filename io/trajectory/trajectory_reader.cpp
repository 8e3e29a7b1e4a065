#include "io/trajectory/trajectory_reader.hpp"

#include <array>
#include <fstream>

#include "core/base/input_file.hpp"
#include "io/trajectory/h5md_reader.hpp"
#include "io/trajectory/trajectory_xyz.hpp"

namespace carom {

std::filesystem::path trajectory_in(const std::filesystem::path& folder) {
  for (const char* const name : {"trajectory.xyz", "trajectory.h5"}) {
    if (std::filesystem::exists(folder / name)) return folder / name;
  }
  return {};
}

std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, bool growing) {
  if (!std::filesystem::is_directory(path)) check_regular_file(path);  // a folder gets the reader's own words
  std::array<char, 4> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (std::string_view(head.data(), head.size()) == "\x89HDF") return std::make_unique<H5mdReader>(path, growing);
  return std::make_unique<XyzReader>(path, growing);
}

}  // namespace carom
