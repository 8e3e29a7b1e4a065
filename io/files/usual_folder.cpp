#include "io/files/usual_folder.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "io/files/output_folder.hpp"

namespace carom {

namespace fs = std::filesystem;

fs::path free_output_folder(const fs::path& wanted, const fs::path& input) {
  constexpr int patience = 10'000;
  try {
    check_output_folder(wanted, input, false);
    return wanted;
  } catch (const InputError&) {
    std::error_code error;
    if (!fs::is_directory(wanted, error)) throw;
    for (int k = 2; k <= patience; ++k) {
      const fs::path next = fmt::format("{}-{}", wanted.string(), k);
      try {
        check_output_folder(next, input, false);
        return next;
      } catch (const InputError&) {
        if (!fs::exists(next, error)) throw;
      }
    }
    throw;
  }
}

fs::path usual_folder_name(const fs::path& input) {
  return fs::path("out") / input.stem();
}

UsualFolder usual_output_folder(const fs::path& input) {
  const fs::path usual = usual_folder_name(input);
  return {usual, free_output_folder(usual, input)};
}

}  // namespace carom
