// Frames of trajectories for scenes that start from one.
#pragma once

#include "core/scene/scene_frame.hpp"

namespace carom {

// The requested frame, from a trajectory of any format or a run's folder. Throws InputError.
SceneFrame read_scene_frame(const FrameAsked& asked);

}  // namespace carom
