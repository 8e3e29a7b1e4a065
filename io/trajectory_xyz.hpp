// Trajectories as extended XYZ: text that OVITO, ASE and VMD read, and that loses no bit.
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "core/block_runner.hpp"
#include "core/disks.hpp"
#include "core/domain.hpp"
#include "core/scene.hpp"
#include "io/output_file.hpp"
#include "io/output_mark.hpp"
#include "io/trajectory_reader.hpp"

namespace carom {

// What every line of a frame holds, as the second line of the frame declares it.
inline constexpr const char* xyz_properties = "species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1";

class XyzWriter {
 public:
  // Throws RunError where the file cannot be written, here and below.
  XyzWriter(const std::string& path, const Domain& box, const Selection& select = {});

  // Goes on behind a mark in a file that is there; what follows it is cut off. Throws InputError where the file is
  // shorter.
  XyzWriter(const std::string& path, const Domain& box, const Selection& select, const FileMark& from);

  // One frame: the selected disks in order of id, numbers with 17 significant digits.
  void write(const Disks& disks, double time, const BlockRunner& run = run_in_order);

  // Where the file has come to; all up to there is on the disk.
  FileMark mark();

  void close() { file_.close(); }

 private:
  static void write_lines(const Disks& disks, const std::vector<std::size_t>& order, std::size_t begin, std::size_t end,
                          std::string& text);

  OutputFile file_;
  Count frames_ = 0;
  Selection select_;
  std::string lattice_;             // the constant part of each frame's second line
  std::vector<std::string> texts_;  // of the blocks being written; kept for their capacity
};

using XyzFrame = TrajectoryFrame;

class XyzReader : public TrajectoryReader {
 public:
  // Throws InputError if the file cannot be opened.
  explicit XyzReader(const std::string& path);

  // The next frame, or false at the end of the file. Radius and mass always come as columns. Throws InputError,
  // "file:line: what is wrong, what was expected", for anything but a file that XyzWriter wrote in full.
  bool read(XyzFrame& frame) override;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  bool next_line();
  void read_header(XyzFrame& frame) const;
  void read_disk(Disks& disks) const;
  double number(std::string_view text) const;

  std::string path_;
  std::ifstream file_;
  std::string line_;
  std::size_t line_number_ = 0;
};

}  // namespace carom
