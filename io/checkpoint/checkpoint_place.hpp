// The checkpoint files of a run, and the replacement of the last one by a new one.
#pragma once

#include <filesystem>
#include <string>

#include "io/checkpoint/checkpoint.hpp"

namespace carom {

// Writes folder/checkpoint.carom; the one before becomes checkpoint.previous.carom. At every moment, whatever happens
// to the machine, the folder holds an intact one. Throws RunError; then both are unchanged.
void save_checkpoint(const std::string& folder, const RunRecord& record, const StatePieces& state);

// A checkpoint that the user named, and the folder of its run.
struct CheckpointPlace {
  std::filesystem::path file;
  std::filesystem::path folder;
  bool finished = false;  // the run is finished: its files lie in the folder itself
};

// name: a checkpoint, or the folder of a run. Throws InputError if there is none.
CheckpointPlace find_checkpoint(const std::string& name);

// read_checkpoint. If the file is damaged and the previous one is intact, the InputError names that.
Checkpoint read_checkpoint_at(const CheckpointPlace& place);
CheckpointInPieces read_checkpoint_in_pieces_at(const CheckpointPlace& place);

}  // namespace carom
