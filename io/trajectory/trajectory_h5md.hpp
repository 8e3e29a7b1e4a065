// Trajectories as H5MD 1.1 (h5md_layout.hpp): HDF5, compressed, for h5py, ParaView and everything else that reads HDF5.
#pragma once

#include <memory>
#include <string>

#include "core/disks/disks_in_pieces.hpp"
#include "core/measure/displacement.hpp"
#include "core/scene/scene.hpp"
#include "io/files/file_mark.hpp"
#include "io/tables/series.hpp"

namespace carom {

// The file is consistent at any moment (HDF5's single-writer-multiple-reader mode): after kill -9 any reader can open
// it, with every frame up to the last flush.
class H5mdWriter {
 public:
  // Creates or replaces the file. rounds: how often each disk has gone round the periodic sides, updated by the caller;
  // if null, the file does not contain it. next_id: of the state; larger than the number of disks of the scene if a
  // program has added some. Throws RunError if the file cannot be written, as do all functions below.
  H5mdWriter(const std::string& path, const Scene& scene, const DisplacementTally* rounds = nullptr,
             DiskId next_id = 0);

  // Continues the file that a writer of this scene left, closed or killed, after its first `frames` frames; later ones
  // are cut off. Throws RunError if it has fewer, or was written for other disks.
  H5mdWriter(const std::string& path, const Scene& scene, Count frames, const DisplacementTally* rounds = nullptr,
             DiskId next_id = 0);

  ~H5mdWriter();
  H5mdWriter(const H5mdWriter&) = delete;
  H5mdWriter& operator=(const H5mdWriter&) = delete;

  // Writes one frame: the disks that scene.output.select chooses. step: the run's count of steps; it is written for
  // time stepping, while an exact run, whose frames may share a window, writes the number of the frame instead.
  void write(const DisksInPieces& disks, Count step, const SeriesRow& row, const BlockRunner& run = run_in_order);
  void write(const Disks& disks, double time, Count step, const SeriesRow& row, const BlockRunner& run = run_in_order) {
    write(WholeDisks(disks, time), step, row, run);
  }

  // Hands all frames so far to the system. write() does it about twice a second, by the work of the run and not by a
  // clock, so that equal runs write equal files.
  void flush();

  // The present end of the file, up to which everything has been handed to the system.
  FileMark mark();

  // Frames in the file.
  Count frames() const;

  // Flushes, closes, and writes PATH with .xdmf in place of .h5, the description by which ParaView reads it.
  void close();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace carom
