#include "io/trajectory/trajectory_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/scene/disk_group.hpp"
#include "io/trajectory/disk_selection.hpp"
#include "io/trajectory/single_precision.hpp"

namespace carom {

namespace {

// The text of one line, on the stack.
class LineText {
 public:
  std::string_view text() const { return {buffer_.data(), static_cast<std::size_t>(end_ - buffer_.data())}; }
  void add(std::string_view part) { end_ = std::copy(part.begin(), part.end(), end_); }
  // A space and a number, with as many digits as it takes to come back as the same bits of its type.
  template <class Number>
  void add_number(Number value) {
    *end_++ = ' ';
    end_ = std::to_chars(end_, buffer_.data() + buffer_.size(), value).ptr;
  }

 private:
  // Seven doubles of up to 24 characters, six whole numbers of up to 11, and what stands between them.
  std::array<char, 288> buffer_;
  char* end_ = buffer_.data();
};

std::string number_text(double value) {
  LineText text;
  text.add_number(value);
  return std::string(text.text());
}

// Lines are made in blocks of so many, some hundreds of KB of text, so many blocks at the same time.
constexpr std::size_t lines_of_block = 4096;
constexpr std::size_t blocks_at_once = 16;
// In order of id, disks lie all over memory: what a line is made of is prefetched so many lines before.
constexpr std::size_t lines_ahead = 16;

// Radius and mass are often the same for many disks in a row: their text is made once.
struct RepeatedNumber {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string text;
  void add_to(LineText& line, double next) {
    if (std::bit_cast<std::uint64_t>(next) != std::bit_cast<std::uint64_t>(value)) {
      value = next;
      text = number_text(value);
    }
    line.add(text);
  }
};

// Inlined, as g++ 12 leaves out calls of functions that do nothing but prefetch.
[[gnu::always_inline]] inline void prefetch_disk(const Disks& d, std::size_t i) {
  __builtin_prefetch(&d.x[i]);
  __builtin_prefetch(&d.y[i]);
  __builtin_prefetch(&d.vx[i]);
  __builtin_prefetch(&d.vy[i]);
  __builtin_prefetch(&d.id[i]);
  if (!d.radius.empty()) __builtin_prefetch(&d.radius[i]);
  if (!d.mass.empty()) __builtin_prefetch(&d.mass[i]);
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

void XyzWriter::write_lines(const Disks& disks, const std::vector<std::size_t>& order, std::size_t begin,
                            std::size_t end, std::string& text) const {
  text.clear();
  const auto in_single = [](double value) { return single_of(value, "trajectory.xyz"); };
  const auto in_double = [](double value) { return value; };
  if (plan_.single) return add_lines(disks, order, begin, end, in_single, text);
  add_lines(disks, order, begin, end, in_double, text);
}

template <class Precision>
void XyzWriter::add_lines(const Disks& disks, const std::vector<std::size_t>& order, std::size_t begin, std::size_t end,
                          Precision in_precision, std::string& text) const {
  RepeatedNumber radius, mass;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = order[k];
    if (k + lines_ahead < end) prefetch_disk(disks, order[k + lines_ahead]);
    const DiskId id = disks.id[i];
    LineText line;
    line.add("X");
    line.add_number(in_precision(disks.x[i]));
    line.add_number(in_precision(disks.y[i]));
    line.add(" 0");
    line.add_number(in_precision(disks.vx[i]));
    line.add_number(in_precision(disks.vy[i]));
    line.add(" 0");
    radius.add_to(line, disks.radius_of(i));
    mass.add_to(line, disks.mass_of(i));
    line.add_number(id);
    if (!plan_.group_ends.empty()) line.add_number(group_of(plan_.group_ends, id));
    if (plan_.rounds != nullptr) {
      line.add_number(rounds_of(plan_.rounds->x, id));
      line.add_number(rounds_of(plan_.rounds->y, id));
      line.add(" 0");
    }
    if (plan_.spins) line.add_number(in_precision(disks.spin_of(i)));
    line.add("\n");
    text += line.text();
  }
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
    std::vector<std::size_t> order = by_id(some);
    if (!plan_.select.all()) {
      std::erase_if(order, [&](std::size_t i) { return !is_selected(plan_.select, some, i); });
    }
    write_blocks(some, order, run);
  });
  file_.flush();
  ++frames_;
}

// While the lines of some blocks are made, one task writes those of the blocks before.
void XyzWriter::write_blocks(const Disks& disks, const std::vector<std::size_t>& order, const BlockRunner& run) {
  const std::size_t blocks = (order.size() + lines_of_block - 1) / lines_of_block;
  texts_.resize(std::min(blocks, blocks_at_once));
  written_.resize(texts_.size());
  std::size_t held = 0;  // of written_
  const auto write_held = [&] {
    for (std::size_t b = 0; b < held; ++b) file_.write(written_[b]);
  };
  for (std::size_t first = 0; first < blocks; first += blocks_at_once) {
    const std::size_t count = std::min(blocks_at_once, blocks - first);
    run(count + 1, [&](std::size_t task) {
      if (task == 0) return write_held();
      const std::size_t begin = (first + task - 1) * lines_of_block;
      write_lines(disks, order, begin, std::min(begin + lines_of_block, order.size()), texts_[task - 1]);
    });
    texts_.swap(written_);
    held = count;
  }
  write_held();
}

}  // namespace carom
