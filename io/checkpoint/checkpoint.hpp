// Checkpoints: everything from which a run goes on, bit for bit, in one file that is whole or refused.
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

// What belongs to a run beside its state.
struct RunRecord {
  std::string version;     // of the program that wrote it
  std::string scene_file;  // as the user named it
  std::string scene_text;  // resolved: every default and every list spelled out
  std::string engine;      // "parallel" or "reference"
  RunStart start;
  OutputMark outputs;
  double wall_s = 0.0, cpu_s = 0.0, step_s = 0.0;  // spent so far, as in the summary
  Count resumed = 0;                               // how often the run went on from a checkpoint
  std::vector<std::string> warnings;               // of its start; the others are in the state
};

// Of one that a program saved, from a simulation that is no run: without any outputs so far, and no wall time.
inline bool is_of_program(const RunRecord& record) {
  return !(record.wall_s > 0.0);
}

struct Checkpoint {
  RunRecord record;
  State state;
};

// Writes the file and returns when it is on the disk itself. Throws RunError. Of a state in pieces, one is in memory at
// a time, and the file is that of the whole state.
void write_checkpoint(const std::string& path, const RunRecord& record, const StatePieces& state);
void write_checkpoint(const std::string& path, const RunRecord& record, const State& state);

// Reads it back. The checksum over the whole file is verified before anything in it is used. Throws InputError, "path:
// what is wrong", for a file that is cut short, changed in any bit, of another byte order or format, or no checkpoint.
Checkpoint read_checkpoint(const std::string& path);

// The same, but for its disks, which stay in the file and are read from there.
struct CheckpointInPieces {
  Checkpoint checkpoint;
  std::unique_ptr<DiskSource> disks;
};
CheckpointInPieces read_checkpoint_in_pieces(const std::string& path);

// Is there a file of this name that is neither a checkpoint, of any version, nor empty? Pipes and devices are no files.
bool is_another_file(const std::string& path);

// A checkpoint in memory: the bytes of the file, and back. name is for messages. Throws InputError as read_checkpoint
// does.
std::string checkpoint_bytes(const RunRecord& record, const State& state);
Checkpoint checkpoint_from_bytes(std::string_view bytes, const std::string& name);

// The part of a checkpoint behind its checksum, from memory, for the fuzzer. Throws InputError.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name);
std::string encode_checkpoint(const RunRecord& record, const StatePieces& state);
std::string encode_checkpoint(const RunRecord& record, const State& state);

}  // namespace carom
