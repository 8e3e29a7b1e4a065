// The files of a run, from the first byte to the finished folder.
#pragma once

#include <filesystem>

#include "io/files/output_folder.hpp"
#include "run/outputs/run_outputs.hpp"
#include "run/scene/run_scene.hpp"

namespace carom {

// Does the run go on in another folder than the one in which its files lie, with copies of them? A checkpoint that a
// program saved has no files: its outputs begin with the run that goes on from it.
bool goes_elsewhere(const ResumeFrom& from, const std::filesystem::path& folder);

struct RunFiles {
  // Of a run that begins; scene must outlive it. Throws InputError, RunError.
  RunFiles(const Scene& scene, const RunSettings& settings, const std::filesystem::path& path);
  // Of a run that goes on; next_id: of its state.
  RunFiles(const Scene& scene, const RunSettings& settings, const std::filesystem::path& path, const ResumeFrom& from,
           DiskId next_id);

  OutputFolder folder;
  RunOutputs outputs;
};

}  // namespace carom
