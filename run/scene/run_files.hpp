// The files of a run, from the first byte to the finished folder.
#pragma once

#include <filesystem>

#include "io/files/output_folder.hpp"
#include "run/outputs/run_outputs.hpp"
#include "run/scene/run_scene.hpp"

namespace carom {

// Is the run continued in another folder than that of its files, with copies of them? A checkpoint that a program saved
// has no files: its outputs begin with the run that continues from it.
bool goes_elsewhere(const ResumeFrom& from, const std::filesystem::path& folder);

struct RunFiles {
  // For a run that begins; scene must outlive it. Throws InputError, RunError.
  RunFiles(const Scene& scene, const RunSettings& settings, const std::filesystem::path& path);
  // For a run that is continued; next_id: of its state.
  RunFiles(const Scene& scene, const RunSettings& settings, const std::filesystem::path& path, const ResumeFrom& from,
           DiskId next_id);

  OutputFolder folder;
  RunOutputs outputs;
};

}  // namespace carom
