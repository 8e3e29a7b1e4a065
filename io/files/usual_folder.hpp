// The folder for the results of a run where none was named.
#pragma once

#include <filesystem>

namespace carom {

// The first of `wanted`, wanted-2, wanted-3 and so on that can take the results of a run. Throws InputError where none
// could be made at all.
std::filesystem::path free_output_folder(const std::filesystem::path& wanted, const std::filesystem::path& input);

// Where results go that no folder was named for: to the first of usual, usual-2, usual-3 and so on that can take them.
struct UsualFolder {
  std::filesystem::path usual;
  std::filesystem::path first_free;  // when it was looked for
};

// out/NAME of the scene file.
std::filesystem::path usual_folder_name(const std::filesystem::path& input);
UsualFolder usual_output_folder(const std::filesystem::path& input);

}  // namespace carom
