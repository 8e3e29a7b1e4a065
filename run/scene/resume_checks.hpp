// Whether a run can be continued from a checkpoint: all checks that come before anything is changed.
#pragma once

#include <string>

#include "run/scene/run_scene.hpp"

namespace carom {

// Throws InputError with one line if the run cannot be continued: a state that does not belong to its scene, an end
// that is before the checkpoint or would have changed an earlier step, missing files, or a run that is done. before:
// the scene in the checkpoint; now: the scene for the continuation; name: of the checkpoint, as the user wrote it.
void check_resumable(const ResumeFrom& from, const Scene& before, const Scene& now, const std::string& name);

}  // namespace carom
