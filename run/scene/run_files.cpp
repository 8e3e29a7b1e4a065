#include "run/scene/run_files.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

#include "core/base/check.hpp"
#include "core/scene/scene_text.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_file.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Throws RunError.
void copy_there(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy(from, to, fs::copy_options::recursive, error);
  if (error) {
    throw RunError(fmt::format("cannot copy {} to {}: {}", from.string(), to.string(), error.message()));
  }
}

// Moves or copies the files with which the run continues to the folder's unfinished part. Returns the folder.
const OutputFolder& with_files(OutputFolder& folder, const fs::path& path, const ResumeFrom& from) {
  const CheckpointPlace& place = from.place;
  std::vector<std::string> files;
  for (const MarkedFile& file : files_of(from.checkpoint.record.outputs)) files.push_back(file.name);
  if (goes_elsewhere(from, path)) {
    for (const std::string& file : files) copy_there(present_path(place.folder, file), folder.path(file));
    return folder;
  }
  // Everything after the named checkpoint is given up, including a damaged newer one.
  if (place.file.filename() == previous_checkpoint_name) {
    fs::rename(place.file, place.file.parent_path() / checkpoint_name);
  }
  files.insert(files.end(), {previous_checkpoint_name, checkpoint_name});
  folder.take_back(place.finished, files);
  return folder;
}

}  // namespace

bool goes_elsewhere(const ResumeFrom& from, const fs::path& folder) {
  std::error_code error;
  return is_of_program(from.checkpoint.record) || !fs::equivalent(folder, from.place.folder, error);
}

RunFiles::RunFiles(const Scene& scene, const RunSettings& settings, const fs::path& path)
    : folder(settings.usual ? OutputFolder(*settings.usual, scene.file)
                            : OutputFolder(path, scene.file, settings.force)),
      outputs(scene, folder, make_block_runner(settings.engine)) {
  write_file(folder.path("scene.toml"), resolved_toml(scene));
}

RunFiles::RunFiles(const Scene& scene, const RunSettings& settings, const fs::path& path, const ResumeFrom& from,
                   DiskId next_id)
    : folder(settings.usual               ? OutputFolder(*settings.usual, from.place.file)
             : goes_elsewhere(from, path) ? OutputFolder(path, from.place.file, settings.force)
                                          : OutputFolder(path)),
      outputs(is_of_program(from.checkpoint.record)
                  ? RunOutputs(scene, folder, make_block_runner(settings.engine), next_id)
                  : RunOutputs(scene, with_files(folder, path, from), make_block_runner(settings.engine),
                               from.checkpoint.record.outputs, next_id)) {
  write_file(folder.path("scene.toml"), resolved_toml(scene));
}

}  // namespace carom
