#include "io/trajectory_xyz.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "core/check.hpp"
#include "io/disk_selection.hpp"

namespace carom {

namespace {

// A space and a double as %.17g writes it: enough digits for every double to come back as the same bits.
void append_number(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17);
  text += ' ';
  text.append(digits, end.ptr);
}

void append_id(std::string& text, DiskId id) {
  char digits[16];
  const auto end = std::to_chars(digits, digits + sizeof digits, id);
  text += ' ';
  text.append(digits, end.ptr);
  text += '\n';
}

// Lines are made in blocks of so many, some hundreds of KB of text, so many blocks at the same time.
constexpr std::size_t lines_of_block = 4096;
constexpr std::size_t blocks_at_once = 32;

// Radius and mass are often the same for many disks in a row: their text is made once.
struct RepeatedNumber {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string text;
  void append_to(std::string& line, double next) {
    if (std::bit_cast<std::uint64_t>(next) != std::bit_cast<std::uint64_t>(value)) {
      value = next;
      text.clear();
      append_number(text, value);
    }
    line += text;
  }
};

// The constant part of each frame's second line.
std::string lattice_text(const Domain& box) {
  std::string width, height;
  append_number(width, box.width);
  append_number(height, box.height);
  return fmt::format(
      "Lattice=\"{} 0 0 0{} 0 0 0 1\" Origin=\"0 0 0\" pbc=\"{} {} F\" Properties={} Time=", width.substr(1), height,
      box.periodic_x() ? 'T' : 'F', box.periodic_y() ? 'T' : 'F', xyz_properties);
}

}  // namespace

XyzWriter::XyzWriter(const std::string& path, const Domain& box, const Selection& select)
    : file_(path), select_(select), lattice_(lattice_text(box)) {}

XyzWriter::XyzWriter(const std::string& path, const Domain& box, const Selection& select, const FileMark& from)
    : file_(path, from.bytes), frames_(from.frames), select_(select), lattice_(lattice_text(box)) {}

FileMark XyzWriter::mark() {
  file_.sync();
  return {file_.name(), frames_, file_.bytes()};
}

void XyzWriter::write_lines(const Disks& disks, const std::vector<std::size_t>& order, std::size_t begin,
                            std::size_t end, std::string& text) {
  text.clear();
  RepeatedNumber radius, mass;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = order[k];
    text += 'D';
    append_number(text, disks.x[i]);
    append_number(text, disks.y[i]);
    append_number(text, disks.vx[i]);
    append_number(text, disks.vy[i]);
    radius.append_to(text, disks.radius_of(i));
    mass.append_to(text, disks.mass_of(i));
    append_id(text, disks.id[i]);
  }
}

void XyzWriter::write(const Disks& disks, double time, const BlockRunner& run) {
  std::vector<std::size_t> order = by_id(disks);
  if (select_.by_region || select_.stride != 1) {
    std::erase_if(order, [&](std::size_t i) { return !is_selected(select_, disks, i); });
  }
  std::string head = fmt::format("{}\n{}", order.size(), lattice_);
  std::string time_text;
  append_number(time_text, time);
  head.append(time_text, 1);
  file_.write(head + '\n');
  const std::size_t blocks = (order.size() + lines_of_block - 1) / lines_of_block;
  texts_.resize(std::min(blocks, blocks_at_once));
  for (std::size_t first = 0; first < blocks; first += blocks_at_once) {
    const std::size_t count = std::min(blocks_at_once, blocks - first);
    run(count, [&](std::size_t b) {
      const std::size_t begin = (first + b) * lines_of_block;
      write_lines(disks, order, begin, std::min(begin + lines_of_block, order.size()), texts_[b]);
    });
    for (std::size_t b = 0; b < count; ++b) file_.write(texts_[b]);
  }
  file_.flush();
  ++frames_;
}

XyzReader::XyzReader(const std::string& path) : path_(path), file_(path) {
  if (!file_ || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: cannot be read; expected a trajectory in extended XYZ", path));
  }
}

void XyzReader::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_, line_number_, what));
}

bool XyzReader::next_line() {
  ++line_number_;
  return static_cast<bool>(std::getline(file_, line_));
}

double XyzReader::number(std::string_view text) const {
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value)) {
    fail(fmt::format("'{}' is no finite number", text));
  }
  return value;
}

namespace {

// The words of a line, split at blanks.
std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return found;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    found.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

// The value of key=value or key="several words" in a frame's second line; empty if absent.
std::string_view value_of(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = line.substr(at + key.size());
  if (rest.substr(0, 1) != "\"") return rest.substr(0, rest.find_first_of(" \t\r"));
  rest.remove_prefix(1);
  return rest.substr(0, rest.find('"'));
}

}  // namespace

void XyzReader::read_header(XyzFrame& frame) const {
  if (value_of(line_, "Properties=") != xyz_properties) fail(fmt::format("expected Properties={}", xyz_properties));
  const auto lattice = words(value_of(line_, "Lattice="));
  const auto periodic = words(value_of(line_, "pbc="));
  if (lattice.size() != 9) fail("expected Lattice=\"W 0 0 0 H 0 0 0 1\"");
  if (periodic.size() != 3) fail("expected pbc=\"T F F\"");
  frame.box = {};
  frame.box.width = number(lattice[0]);
  frame.box.height = number(lattice[4]);
  if (periodic[0] == "T") frame.box.sides[0] = frame.box.sides[1] = SideKind::periodic;
  if (periodic[1] == "T") frame.box.sides[2] = frame.box.sides[3] = SideKind::periodic;
  frame.time = number(value_of(line_, "Time="));
}

void XyzReader::read_disk(Disks& disks) const {
  const auto columns = words(line_);
  if (columns.size() != 8) fail(fmt::format("{} columns, expected 8: {}", columns.size(), xyz_properties));
  DiskId id = 0;
  const auto result = std::from_chars(columns[7].data(), columns[7].data() + columns[7].size(), id);
  if (result.ec != std::errc{}) fail(fmt::format("'{}' is no disk id", columns[7]));
  disks.x.push_back(number(columns[1]));
  disks.y.push_back(number(columns[2]));
  disks.vx.push_back(number(columns[3]));
  disks.vy.push_back(number(columns[4]));
  disks.radius.push_back(number(columns[5]));
  disks.mass.push_back(number(columns[6]));
  disks.id.push_back(id);
}

bool XyzReader::read(XyzFrame& frame) {
  if (!next_line()) return false;
  std::size_t count = 0;
  const auto result = std::from_chars(line_.data(), line_.data() + line_.size(), count);
  if (result.ec != std::errc{}) fail(fmt::format("'{}' is no number of disks", line_.substr(0, 40)));
  frame.disks = {};
  if (!next_line()) fail("the file ends inside a frame");
  read_header(frame);
  for (std::size_t k = 0; k < count; ++k) {
    if (!next_line()) fail("the file ends inside a frame");
    read_disk(frame.disks);
  }
  return true;
}

}  // namespace carom
