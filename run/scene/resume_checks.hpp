// Whether a run can go on from a checkpoint: all that is asked before anything is changed.
#pragma once

#include <string>

#include "run/scene/run_scene.hpp"

namespace carom {

// Throws InputError with one line where the run cannot go on: a state that does not belong to its scene, an end that
// lies before the checkpoint or would have made an earlier step another one, files that are not there, a run that is
// done. before: the scene as the checkpoint has it; now: as it shall go on; name: of the checkpoint, as the user wrote
// it.
void check_resumable(const ResumeFrom& from, const Scene& before, const Scene& now, const std::string& name);

}  // namespace carom
