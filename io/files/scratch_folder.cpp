#include "io/files/scratch_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "core/base/check.hpp"

namespace carom {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const fs::path& parent, const char* name) {
  std::string made = (parent / fmt::format("{}-XXXXXX", name)).string();
  if (mkdtemp(made.data()) == nullptr) {
    throw RunError(fmt::format("cannot make the folder {}: {}", made, std::strerror(errno)));
  }
  path_ = fs::absolute(made);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace carom
