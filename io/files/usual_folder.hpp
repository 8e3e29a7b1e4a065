// The folder for the results of a run if none was named.
#pragma once

#include <filesystem>

namespace carom {

// The first of `wanted`, wanted-2, wanted-3 and so on that can take the results of a run. Throws InputError if none of
// them could be made.
std::filesystem::path free_output_folder(const std::filesystem::path& wanted, const std::filesystem::path& input);

// The folder for results if none was named: the first of usual, usual-2, usual-3 and so on that can take them.
struct UsualFolder {
  std::filesystem::path usual;
  std::filesystem::path first_free;  // at the time of the search
};

// out/NAME of the scene file.
std::filesystem::path usual_folder_name(const std::filesystem::path& input);
UsualFolder usual_output_folder(const std::filesystem::path& input);

}  // namespace carom
