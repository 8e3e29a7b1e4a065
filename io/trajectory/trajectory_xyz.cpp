#include "io/trajectory/trajectory_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/base/huge_pages.hpp"
#include "core/base/same_bits.hpp"
#include "core/scene/disk_group.hpp"
#include "io/trajectory/decimal_batch.hpp"
#include "io/trajectory/disk_selection.hpp"
#include "io/trajectory/shortest_decimal.hpp"
#include "io/trajectory/single_precision.hpp"

namespace carom {

namespace {

// The most characters of a number and of a whole number, with the space before it.
constexpr std::size_t number_bytes = 1 + shortest_decimal_bytes, whole_number_bytes = 12;
// The most of a line: seven numbers, four whole numbers, "X", three times " 0" and the end of the line.
constexpr std::size_t line_bytes = 7 * number_bytes + 4 * whole_number_bytes + 8;

// Writes text into memory that has room for it.
class TextWriter {
 public:
  explicit TextWriter(char* begin) : end_(begin) {}
  char* end() const { return end_; }

  template <std::size_t bytes>
  void add(const char (&part)[bytes]) {
    std::memcpy(end_, part, bytes - 1);
    end_ += bytes - 1;
  }
  // A space and a number, with as many digits as it takes to come back as the same bits of its type.
  template <std::floating_point Number>
  void add_number(Number value) {
    *end_ = ' ';
    end_ = write_shortest(end_ + 1, value);
  }
  // The same, of a number of a batch.
  template <class Number>
  void add_number(const DecimalBatch<Number>& batch, std::size_t k) {
    *end_ = ' ';
    end_ = write_decimal(end_ + 1, batch, k);
  }
  template <std::integral Number>
  void add_number(Number value) {
    *end_ = ' ';
    end_ = std::to_chars(end_ + 1, end_ + whole_number_bytes, value).ptr;
  }
  // Adds the first bytes of a buffer. A copy of the whole buffer is quicker than one of varying length.
  template <std::size_t size>
  void add_first(const std::array<char, size>& buffer, std::size_t bytes) {
    std::memcpy(end_, buffer.data(), size);
    end_ += bytes;
  }

 private:
  char* end_;
};

std::string number_text(double value) {
  std::array<char, number_bytes> buffer;
  TextWriter text(buffer.data());
  text.add_number(value);
  return {buffer.data(), text.end()};
}

// Lines are made in blocks of this number, some hundreds of KB of text, with several blocks at the same time.
constexpr std::size_t lines_of_block = 4096;
constexpr std::size_t blocks_at_once = 16;
// Disks in a block when rows are filled.
constexpr std::size_t rows_of_block = std::size_t{1} << 16;
// Rows of neighbouring disks lie far apart in memory, so each is prefetched this many disks ahead.
constexpr std::size_t disks_ahead = 32;

// Radius and mass are often the same for many disks in a row: their text is made once.
class RepeatedNumbers {
 public:
  void add_to(TextWriter& line, double first, double second) {
    if (!same_bits(first, first_) || !same_bits(second, second_)) {
      first_ = first;
      second_ = second;
      TextWriter text(buffer_.data());
      text.add_number(first);
      text.add_number(second);
      bytes_ = static_cast<std::size_t>(text.end() - buffer_.data());
    }
    line.add_first(buffer_, bytes_);
  }

 private:
  double first_ = std::numeric_limits<double>::quiet_NaN(), second_ = first_;
  std::array<char, 2 * number_bytes> buffer_{};
  std::size_t bytes_ = 0;
};

// The smallest id if all ids from there to the largest exist once, as if no disk has left.
std::optional<DiskId> first_of_all(const std::vector<DiskId>& id) {
  if (id.empty()) return {};
  DiskId first = id.front();
  for (const DiskId one : id) first = std::min(first, one);
  std::vector<bool> found(id.size());
  for (const DiskId one : id) {
    if (one - first >= id.size()) return {};
    found[one - first] = true;
  }
  if (std::find(found.begin(), found.end(), false) != found.end()) return {};  // one occurs twice, in a damaged file
  return first;
}

// The constant part of each frame's second line.
std::string lattice_text(const XyzPlan& plan) {
  const std::string width = number_text(plan.box.width);
  const std::string height = number_text(plan.box.height);
  return fmt::format("Lattice=\"{} 0 0 0{} 0 0 0 1\" Origin=\"0 0 0\" pbc=\"{} {} F\" Properties={}{}{}{} Time=",
                     width.substr(1), height, plan.box.periodic_x() ? 'T' : 'F', plan.box.periodic_y() ? 'T' : 'F',
                     xyz_properties, plan.group_ends.empty() ? "" : ":group:I:1",
                     plan.rounds == nullptr ? "" : ":map_shift:I:3", plan.spins ? ":spin:R:1" : "");
}

}  // namespace

XyzWriter::XyzWriter(const std::string& path, XyzPlan plan)
    : file_(path), plan_(std::move(plan)), lattice_(lattice_text(plan_)) {}

XyzWriter::XyzWriter(const std::string& path, XyzPlan plan, const FileMark& from)
    : file_(path, from.bytes), frames_(from.frames), plan_(std::move(plan)), lattice_(lattice_text(plan_)) {}

FileMark XyzWriter::mark() {
  file_.sync();
  return {file_.name(), frames_, file_.bytes()};
}

// Sets row_of_disk_ and returns the number of rows. The order by id, which takes longer and is needed only if not all
// disks are there, is freed before rows take memory.
std::size_t XyzWriter::number_rows(const Disks& disks) {
  const std::optional<DiskId> first = plan_.select.all() ? first_of_all(disks.id) : std::nullopt;
  if (first) {
    row_of_disk_.resize(disks.size());
    std::transform(disks.id.begin(), disks.id.end(), row_of_disk_.begin(), [&](DiskId id) { return id - *first; });
    return disks.size();
  }
  std::vector<std::size_t> order = by_id(disks);
  if (!plan_.select.all()) {
    std::erase_if(order, [&](std::size_t i) { return !is_selected(plan_.select, disks, i); });
  }
  row_of_disk_.assign(disks.size(), no_disk);
  for (std::size_t k = 0; k < order.size(); ++k) row_of_disk_[order[k]] = static_cast<std::uint32_t>(k);
  return order.size();
}

// Goes through the disks in order of storage, where each disk costs one cache miss, that of its row. In order of id it
// would cost one for each column.
void XyzWriter::fill_rows(const Disks& disks, const BlockRunner& run) {
  grow_in_huge_pages(rows_, number_rows(disks));
  run((disks.size() + rows_of_block - 1) / rows_of_block, [&](std::size_t b) {
    const std::size_t end = std::min((b + 1) * rows_of_block, disks.size());
    for (std::size_t i = b * rows_of_block; i < end; ++i) {
      const std::uint32_t later = i + disks_ahead < end ? row_of_disk_[i + disks_ahead] : no_disk;
      if (later != no_disk) __builtin_prefetch(&rows_[later], 1);
      if (row_of_disk_[i] == no_disk) continue;
      rows_[row_of_disk_[i]] = {disks.x[i],  disks.y[i],  disks.vx[i],
                                disks.vy[i], disks.id[i], static_cast<std::uint32_t>(i)};
    }
  });
}

void XyzWriter::write_lines(const Disks& disks, std::size_t begin, std::size_t end, Lines& lines) const {
  if (lines.text == nullptr) lines.text = std::make_unique_for_overwrite<char[]>(lines_of_block * line_bytes);
  const auto in_single = [](double value) { return single_of(value, "trajectory.xyz"); };
  const auto in_double = [](double value) { return value; };
  if (plan_.single) return add_lines(disks, begin, end, in_single, lines);
  add_lines(disks, begin, end, in_double, lines);
}

template <class Precision>
void XyzWriter::add_lines(const Disks& disks, std::size_t begin, std::size_t end, Precision in_precision,
                          Lines& lines) const {
  using Number = std::invoke_result_t<Precision, double>;
  using Batch = DecimalBatch<Number>;
  constexpr std::size_t numbers_of_row = 4, rows_of_batch = Batch::size / numbers_of_row;
  const DecimalKernel<Number> convert = choose_decimal_kernel<Number>();
  Batch batch;
  TextWriter line(lines.text.get());
  RepeatedNumbers radius_and_mass;
  const auto add_line = [&](const Row& row, std::size_t number) {
    line.add("X");
    line.add_number(batch, number);
    line.add_number(batch, number + 1);
    line.add(" 0");
    line.add_number(batch, number + 2);
    line.add_number(batch, number + 3);
    line.add(" 0");
    radius_and_mass.add_to(line, disks.radius_of(row.place), disks.mass_of(row.place));
    line.add_number(row.id);
    if (!plan_.group_ends.empty()) line.add_number(group_of(plan_.group_ends, row.id));
    if (plan_.rounds != nullptr) {
      line.add_number(rounds_of(plan_.rounds->x, row.id));
      line.add_number(rounds_of(plan_.rounds->y, row.id));
      line.add(" 0");
    }
    if (plan_.spins) line.add_number(in_precision(disks.spin_of(row.place)));
    line.add("\n");
  };
  for (std::size_t first = begin; first < end; first += rows_of_batch) {
    const std::size_t rows = std::min(rows_of_batch, end - first);
    for (std::size_t k = 0; k < rows; ++k) {
      const Row& row = rows_[first + k];
      const std::array<Number, numbers_of_row> numbers = {in_precision(row.x), in_precision(row.y),
                                                          in_precision(row.vx), in_precision(row.vy)};
      std::copy(numbers.begin(), numbers.end(), &batch.numbers[numbers_of_row * k]);
    }
    convert(batch);
    for (std::size_t k = 0; k < rows; ++k) add_line(rows_[first + k], numbers_of_row * k);
  }
  lines.bytes = static_cast<std::size_t>(line.end() - lines.text.get());
}

Count XyzWriter::count_of(const DisksInPieces& disks) const {
  if (plan_.select.all()) return disks.size();
  Count count = 0;
  disks.visit([&](const Disks& some) {
    for (std::size_t i = 0; i < some.size(); ++i) count += is_selected(plan_.select, some, i) ? 1U : 0U;
  });
  return count;
}

void XyzWriter::write(const DisksInPieces& disks, const BlockRunner& run) {
  std::string head = fmt::format("{}\n{}", count_of(disks), lattice_);
  head.append(number_text(disks.time()), 1);
  file_.write(head + '\n');
  disks.visit([&](const Disks& some) {
    fill_rows(some, run);
    write_blocks(some, run);
  });
  file_.flush();
  ++frames_;
}

// While the lines of some blocks are made, one task writes those of the blocks before.
void XyzWriter::write_blocks(const Disks& disks, const BlockRunner& run) {
  const std::size_t blocks = (rows_.size() + lines_of_block - 1) / lines_of_block;
  made_.resize(std::min(blocks, blocks_at_once));
  written_.resize(made_.size());
  std::size_t held = 0;  // of written_
  const auto write_held = [&] {
    std::size_t bytes = 0;
    for (std::size_t b = 0; b < held; ++b) bytes += written_[b].bytes;
    file_.reserve(bytes);
    for (std::size_t b = 0; b < held; ++b) file_.write({written_[b].text.get(), written_[b].bytes});
  };
  for (std::size_t first = 0; first < blocks; first += blocks_at_once) {
    const std::size_t count = std::min(blocks_at_once, blocks - first);
    run(count + 1, [&](std::size_t task) {
      if (task == 0) return write_held();
      const std::size_t begin = (first + task - 1) * lines_of_block;
      write_lines(disks, begin, std::min(begin + lines_of_block, rows_.size()), made_[task - 1]);
    });
    made_.swap(written_);
    held = count;
  }
  write_held();
}

}  // namespace carom
