// Trajectories as extended XYZ: text that OVITO, ASE and VMD read, and that loses no bit in double precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"
#include "core/measure/displacement.hpp"
#include "core/scene/scene.hpp"
#include "io/files/file_mark.hpp"
#include "io/files/output_file.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

// The columns of every line of a frame, as declared in the frame's second line. The species is X, the symbol in
// chemistry for "no element"; z is 0, since programs for molecules expect three coordinates.
inline constexpr const char* xyz_properties = "species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1";

// The contents of a file, and the choice of disks.
struct XyzPlan {
  Domain box;
  Selection select{};
  // For disks in several groups (disk_group.hpp): a column group:I:1 is added. Empty if there is one group.
  std::vector<DiskId> group_ends{};
  // How often each disk has gone round the periodic sides: a column map_shift:I:3 is added, which OVITO takes for the
  // periodic image. Updated by the caller; null: not known.
  const DisplacementTally* rounds = nullptr;
  bool spins = false;   // disks are rough: a column spin:R:1 is added, the angular velocity
  bool single = false;  // positions, velocities and spins in single precision
};

class XyzWriter {
 public:
  // Throws RunError if the file cannot be written, as do all functions below.
  XyzWriter(const std::string& path, XyzPlan plan);

  // Continues an existing file after a mark; what follows the mark is cut off. Throws InputError if the file is
  // shorter.
  XyzWriter(const std::string& path, XyzPlan plan, const FileMark& from);

  // Writes one frame: the selected disks in order of id, with as many digits as are needed to read the same numbers
  // back. Throws InputError for a number beyond single precision.
  void write(const DisksInPieces& disks, const BlockRunner& run = run_in_order);
  void write(const Disks& disks, double time, const BlockRunner& run = run_in_order) {
    write(WholeDisks(disks, time), run);
  }

  // The present end of the file; everything before it is on the disk.
  FileMark mark();

  void close() { file_.close(); }

 private:
  // The data of a line, and the storage index of its disk.
  struct Row {
    double x, y, vx, vy;
    DiskId id;
    std::uint32_t place;
  };

  // The text of a block of lines, in memory that has room for the longest lines.
  struct Lines {
    std::unique_ptr<char[]> text;
    std::size_t bytes = 0;
  };

  Count count_of(const DisksInPieces& disks) const;  // number of selected disks
  std::size_t number_rows(const Disks& disks);
  void fill_rows(const Disks& disks, const BlockRunner& run);
  void write_lines(const Disks& disks, std::size_t begin, std::size_t end, Lines& lines) const;
  template <class Precision>
  void add_lines(const Disks& disks, std::size_t begin, std::size_t end, Precision in_precision, Lines& lines) const;
  void write_blocks(const Disks& disks, const BlockRunner& run);

  OutputFile file_;
  Count frames_ = 0;
  XyzPlan plan_;
  std::string lattice_;  // the constant part of each frame's second line
  // The selected disks of a piece in order of id, and the row of each disk by its storage index.
  std::vector<Row> rows_;
  std::vector<std::uint32_t> row_of_disk_;
  // The blocks that are being made and those that are being written. They are kept, so that memory is allocated once.
  std::vector<Lines> made_, written_;
};

using XyzFrame = TrajectoryFrame;

class XyzReader : public TrajectoryReader {
 public:
  // growing: a run is, or was, writing the file, and an incomplete frame at its end does not count. Throws InputError
  // if the file cannot be opened.
  explicit XyzReader(const std::string& path, bool growing = false);

  // Reads the next frame, with disks in order of id; returns false at the end of the file. Radius and mass are always
  // columns. Columns and lines may be in any order, positions and velocities may have two components or three, and
  // unknown columns are skipped. Throws InputError, "file:line: what is wrong, what was expected", for a file that
  // lacks something, or whose box is not upright with a corner at 0.
  bool read(XyzFrame& frame) override;
  bool skip() override;
  void follow(const std::string& path) override { path_ = path; }  // it stays open

 private:
  // Columns of a line that belong together: a vector has two or three. width 0: the file does not have them.
  struct Columns {
    std::size_t first = 0, width = 0;
  };
  struct Layout {
    Columns position, velocity, radius, mass, id, group, spin, image;
    std::size_t all = 0;  // number of columns in a line
  };
  struct Property;

  [[noreturn]] void fail(const std::string& what) const;
  bool next_line();
  template <class Pass>
  bool whole_or_not(Pass&& pass);
  bool read_whole(XyzFrame& frame);
  bool skip_whole();
  bool read_count(std::size_t& count);
  bool cut_short() const;
  void read_layout(std::string_view properties);
  [[noreturn]] void refuse_properties(std::string_view what) const;
  void read_header(XyzFrame& frame);
  Domain read_box() const;
  void read_disk(XyzFrame& frame) const;
  void sort_by_id(XyzFrame& frame) const;
  double number(std::string_view text) const;
  template <class Whole>
  Whole whole_number(std::string_view text, const char* what) const;

  std::string path_;
  bool growing_ = false;
  std::ifstream file_;
  std::string line_;
  std::size_t line_number_ = 0;
  Layout layout_;
  std::string properties_;  // from which the layout was read
};

}  // namespace carom
