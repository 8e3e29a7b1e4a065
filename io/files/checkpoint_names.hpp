// The names of the checkpoint files of a run.
#pragma once

namespace carom {

inline constexpr const char* checkpoint_name = "checkpoint.carom";
inline constexpr const char* previous_checkpoint_name = "checkpoint.previous.carom";

}  // namespace carom
