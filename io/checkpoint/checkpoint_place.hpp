// Where the checkpoints of a run lie, and how a new one takes the place of the last.
#pragma once

#include <filesystem>
#include <string>

#include "io/checkpoint/checkpoint.hpp"

namespace carom {

// Writes folder/checkpoint.carom; the one before becomes checkpoint.previous.carom. At every moment, whatever happens
// to the machine, the folder holds a whole one. Throws RunError; then both are as they were.
void save_checkpoint(const std::string& folder, const RunRecord& record, const StatePieces& state);

// A checkpoint that the user named, and the folder of its run.
struct CheckpointPlace {
  std::filesystem::path file;
  std::filesystem::path folder;
  bool finished = false;  // the run has come to its end, its files lie in the folder itself
};

// name: a checkpoint, or the folder of a run. Throws InputError where there is none.
CheckpointPlace find_checkpoint(const std::string& name);

// read_checkpoint; where the file is damaged, and the one before it is whole, the InputError names it.
Checkpoint read_checkpoint_at(const CheckpointPlace& place);
CheckpointInPieces read_checkpoint_in_pieces_at(const CheckpointPlace& place);

}  // namespace carom
