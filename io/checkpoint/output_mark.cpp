#include "io/checkpoint/output_mark.hpp"

namespace carom {

std::vector<MarkedFile> files_of(const OutputMark& mark) {
  std::vector<MarkedFile> files;
  if (mark.trajectory) files.push_back({mark.trajectory->name, mark.trajectory->bytes});
  if (mark.series) files.push_back({mark.series->file.name, mark.series->file.bytes});
  if (!mark.movie) return files;
  if (mark.movie->single_frames) files.push_back({"frames", 0});
  for (const std::string& part : mark.movie->parts) files.push_back({part, 0});
  return files;
}

}  // namespace carom
