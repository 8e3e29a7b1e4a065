// Checkpoints: all that a run needs to continue bit for bit, in one file, which is read only if it is intact.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/disks/disk_source.hpp"
#include "core/disks/state.hpp"
#include "core/disks/state_pieces.hpp"
#include "core/measure/run_start.hpp"
#include "io/checkpoint/output_mark.hpp"

namespace carom {

// The data of a run apart from its state.
struct RunRecord {
  std::string version;     // of the program that wrote it
  std::string scene_file;  // as the user named it
  std::string scene_text;  // resolved: every default and every list spelled out
  std::string engine;      // "parallel" or "reference"
  RunStart start;
  OutputMark outputs;
  double wall_s = 0.0, cpu_s = 0.0, step_s = 0.0;  // spent so far, as in the summary
  Count resumed = 0;                               // number of times that the run was resumed
  std::vector<std::string> warnings;               // of its start; the others are in the state
};

// Was it saved by a program that uses the library, not by a run? Such a record has no outputs and no wall time.
inline bool is_of_program(const RunRecord& record) {
  return !(record.wall_s > 0.0);
}

struct Checkpoint {
  RunRecord record;
  State state;
};

// Writes the file and returns when it is on the disk. Throws RunError. Only one piece of the state is in memory at a
// time; the file does not depend on the division into pieces.
void write_checkpoint(const std::string& path, const RunRecord& record, const StatePieces& state);
void write_checkpoint(const std::string& path, const RunRecord& record, const State& state);

// Reads it back. The checksum over the whole file is verified before anything in it is used. Throws InputError, "path:
// what is wrong", for a file that is cut short, changed in any bit, of another byte order or format, or no checkpoint.
Checkpoint read_checkpoint(const std::string& path);

// The same without the disks, which are read from the file when needed.
struct CheckpointInPieces {
  Checkpoint checkpoint;
  std::unique_ptr<DiskSource> disks;
};
CheckpointInPieces read_checkpoint_in_pieces(const std::string& path);

// Is there a regular file of this name that is neither empty nor a checkpoint of any version?
bool is_another_file(const std::string& path);

// A checkpoint in memory: the bytes of the file, and their inverse. name: for messages. Throws InputError as
// read_checkpoint does.
std::string checkpoint_bytes(const RunRecord& record, const State& state);
Checkpoint checkpoint_from_bytes(std::string_view bytes, const std::string& name);

// Decodes the content of a checkpoint without testing the checksum, for the fuzzer. Throws InputError.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name);
std::string encode_checkpoint(const RunRecord& record, const StatePieces& state);
std::string encode_checkpoint(const RunRecord& record, const State& state);

}  // namespace carom
