// Reading extended XYZ.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/disks/disk_columns.hpp"
#include "io/trajectory/trajectory_xyz.hpp"

namespace carom {

XyzReader::XyzReader(const std::string& path, bool growing) : path_(path), growing_(growing), file_(path) {
  if (!file_ || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: cannot be read; expected a trajectory in extended XYZ", path));
  }
}

void XyzReader::fail(const std::string& what) const {
  fail_input(fmt::format("{}:{}", path_, line_number_), what);
}

bool XyzReader::next_line() {
  ++line_number_;
  const bool read = static_cast<bool>(std::getline(file_, line_));
  if (line_number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  // An incomplete line may lack digits, too.
  return read && !(growing_ && file_.eof());
}

double XyzReader::number(std::string_view text) const {
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || !std::isfinite(value)) {
    fail(fmt::format("'{}' is not a finite number", text));
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
  constexpr std::string_view blanks = " \t\r";
  const auto take = [&line](std::size_t count) {
    const std::string_view taken = line.substr(0, count);
    line.remove_prefix(taken.size());
    return taken;
  };
  while (true) {
    take(line.find_first_not_of(blanks));
    if (line.empty()) return {};
    const std::string_view name = take(line.find_first_of(" \t\r="));
    if (take(line.starts_with('=') ? 1 : 0).empty()) continue;  // a word without a value
    const bool quoted = !take(line.starts_with('"') ? 1 : 0).empty();
    const std::string_view value = take(quoted ? line.find('"') : line.find_first_of(blanks));
    if (name == key) return value;
    if (quoted) take(1);
  }
}

constexpr std::size_t most_columns = 1000;  // beyond any file that makes sense

// The number of columns of a property; absent if the word is not such a number.
std::optional<std::size_t> width_of(std::string_view word) {
  std::size_t width = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), width);
  if (result.ec != std::errc{} || width == 0 || width > most_columns) return std::nullopt;
  return width;
}

}  // namespace

// The properties that the reader uses; all others are skipped.
struct XyzReader::Property {
  std::string_view name;
  Columns Layout::*columns;
  bool is_vector = false, is_needed = true;
  static const std::array<Property, 8> known;
};

const std::array<XyzReader::Property, 8> XyzReader::Property::known{
    {{.name = "pos", .columns = &Layout::position, .is_vector = true},
     {.name = "velo", .columns = &Layout::velocity, .is_vector = true},
     {.name = "radius", .columns = &Layout::radius},
     {.name = "mass", .columns = &Layout::mass},
     {.name = "id", .columns = &Layout::id},
     {.name = "group", .columns = &Layout::group, .is_needed = false},
     {.name = "spin", .columns = &Layout::spin, .is_needed = false},
     {.name = "map_shift", .columns = &Layout::image, .is_vector = true, .is_needed = false}}};

void XyzReader::refuse_properties(std::string_view what) const {
  fail(fmt::format("expected Properties={}, or more columns; {}", xyz_properties, what));
}

// Reads name:type:number of columns, and so on.
void XyzReader::read_layout(std::string_view properties) {
  Layout layout;
  std::string_view rest = properties;
  const auto next_word = [&rest] {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return word;
  };
  while (!rest.empty()) {
    const std::string_view name = next_word();
    next_word();  // the type
    const std::string_view width_text = next_word();
    const std::optional<std::size_t> width = width_of(width_text);
    if (!width || layout.all > most_columns) {
      refuse_properties(fmt::format("'{}' is not a number of columns", width_text));
    }
    for (const Property& property : Property::known) {
      if (name == property.name) layout.*property.columns = {layout.all, *width};
    }
    layout.all += *width;
  }
  for (const Property& property : Property::known) {
    const std::size_t width = (layout.*property.columns).width;
    if (width == 0 && !property.is_needed) continue;
    const bool fits = property.is_vector ? width == 2 || width == 3 : width == 1;
    if (!fits) refuse_properties(fmt::format("'{}' has {}", property.name, counted(width, "column")));
  }
  layout_ = layout;
  properties_ = properties;
}

// In a box of another shape, or with its corner elsewhere, disks would appear at other places than they have.
Domain XyzReader::read_box() const {
  const std::string_view edges = value_of(line_, "Lattice");
  const auto lattice = words(edges);
  if (lattice.size() != 9) fail("expected Lattice=\"W 0 0 0 H 0 0 0 1\"");
  Domain box;
  box.width = number(lattice[0]);
  box.height = number(lattice[4]);
  bool upright = box.width > 0.0 && box.height > 0.0;
  for (const std::size_t k : {1U, 2U, 3U, 5U, 6U, 7U}) upright = upright && number(lattice[k]) == 0.0;
  if (!upright) fail(fmt::format("Lattice is \"{}\", expected \"W 0 0 0 H 0 0 0 1\", W and H above 0", edges));
  for (const std::string_view corner : words(value_of(line_, "Origin"))) {
    if (number(corner) != 0.0) fail(fmt::format("Origin is \"{}\", expected \"0 0 0\"", value_of(line_, "Origin")));
  }
  const auto periodic = words(value_of(line_, "pbc"));
  if (periodic.size() != 3) fail("expected pbc=\"T F F\", T for each direction that is periodic");
  for (const std::string_view word : periodic) {
    if (word != "T" && word != "F") fail(fmt::format("pbc has '{}', expected T or F", word));
  }
  if (periodic[0] == "T") box.sides[0] = box.sides[1] = SideKind::periodic;
  if (periodic[1] == "T") box.sides[2] = box.sides[3] = SideKind::periodic;
  return box;
}

void XyzReader::read_header(XyzFrame& frame) {
  const std::string_view properties = value_of(line_, "Properties");
  if (properties.empty() || properties != properties_) read_layout(properties);
  frame.box = read_box();
  const std::string_view time = value_of(line_, "Time");
  if (time.empty()) fail("expected Time=0.5, the time of the frame");
  frame.time = number(time);
}

template <class Whole>
Whole XyzReader::whole_number(std::string_view text, const char* what) const {
  Whole value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
    fail(fmt::format("'{}' is no {}", text, what));
  return value;
}

void XyzReader::read_disk(XyzFrame& frame) const {
  const auto columns = words(line_);
  const Layout& at = layout_;
  if (columns.size() != at.all)
    fail(fmt::format("{}, expected {}: {}", counted(columns.size(), "column"), at.all, properties_));
  const auto planar = [&](const Columns& vector) {
    if (vector.width == 3 && number(columns[vector.first + 2]) != 0.0) {
      fail(fmt::format("z is {}, expected 0: disks move in a plane", columns[vector.first + 2]));
    }
  };
  planar(at.position);
  planar(at.velocity);
  Disk disk;
  disk.id = whole_number<DiskId>(columns[at.id.first], "disk id");
  disk.x = number(columns[at.position.first]);
  disk.y = number(columns[at.position.first + 1]);
  disk.vx = number(columns[at.velocity.first]);
  disk.vy = number(columns[at.velocity.first + 1]);
  const auto above_zero = [&](const Columns& one, const char* what) {
    const double value = number(columns[one.first]);
    if (!(value > 0.0)) fail(fmt::format("{} is {}, expected a number above 0", what, columns[one.first]));
    return value;
  };
  disk.radius = above_zero(at.radius, "radius");
  disk.mass = above_zero(at.mass, "mass");
  const bool has_spin = at.spin.width > 0;
  if (has_spin) disk.spin = number(columns[at.spin.first]);
  push_back(frame.disks, disk, {.radius = true, .mass = true, .spin = has_spin});
  if (at.group.width > 0) frame.group.push_back(whole_number<DiskId>(columns[at.group.first], "group"));
  if (at.image.width == 0) return;
  frame.image_x.push_back(whole_number<std::int32_t>(columns[at.image.first], "number of rounds"));
  frame.image_y.push_back(whole_number<std::int32_t>(columns[at.image.first + 1], "number of rounds"));
}

// Other programs may have written the disks in another order.
void XyzReader::sort_by_id(XyzFrame& frame) const {
  Disks& d = frame.disks;
  if (std::adjacent_find(d.id.begin(), d.id.end(), std::greater_equal<>()) == d.id.end()) return;
  std::vector<std::size_t> order(d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return d.id[a] < d.id[b]; });
  const auto same = [&](std::size_t a, std::size_t b) { return d.id[a] == d.id[b]; };
  const auto twice = std::adjacent_find(order.begin(), order.end(), same);
  if (twice != order.end()) {
    const std::size_t line = line_number_ - d.size() + 1 + std::max(twice[0], twice[1]);
    fail_input(fmt::format("{}:{}", path_, line), fmt::format("disk {} appears twice in its frame", d.id[*twice]));
  }
  const auto sort = [&](auto& column) {
    const auto as_read = column;
    for (std::size_t k = 0; k < column.size(); ++k) column[k] = as_read[order[k]];
  };
  for_each_column(d, sort);
  sort(frame.group);
  sort(frame.image_x);
  sort(frame.image_y);
}

bool XyzReader::read(XyzFrame& frame) {
  return whole_or_not([&] { return read_whole(frame); });
}

bool XyzReader::skip() {
  return whole_or_not([&] { return skip_whole(); });
}

// If pass() does not reach the frame's end, the reader returns to its beginning.
template <class Pass>
bool XyzReader::whole_or_not(Pass&& pass) {
  if (!growing_) return pass();
  const std::streampos begin = file_.tellg();
  const std::size_t line = line_number_;
  if (pass()) return true;
  // The rest of the frame may still come.
  file_.clear();
  file_.seekg(begin);
  line_number_ = line;
  return false;
}

// Reads the line with which a frame begins; returns false at the end of the file.
bool XyzReader::read_count(std::size_t& count) {
  if (!next_line()) return false;
  // Editors and other programs leave blank lines at a file's end.
  while (line_number_ > 1 && words(line_).empty()) {
    if (!next_line()) return false;
    if (!words(line_).empty()) fail("the line before is blank; expected a frame, or the end of the file");
  }
  const auto words_of_line = words(line_);
  const std::string_view text = words_of_line.size() == 1 ? words_of_line[0] : std::string_view{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) {
    const char* const expected =
        line_number_ == 1 ? "; expected trajectory.xyz or trajectory.h5 of a run, or its folder" : "";
    fail(fmt::format("'{}' is not a number of disks{}", line_.substr(0, 40), expected));
  }
  return true;
}

bool XyzReader::cut_short() const {
  if (!growing_) fail("the file ends inside a frame");
  return false;
}

bool XyzReader::skip_whole() {
  std::size_t count = 0;
  if (!read_count(count)) return false;
  for (std::size_t line = 0; line <= count; ++line) {
    if (!next_line()) return cut_short();
  }
  return true;
}

bool XyzReader::read_whole(XyzFrame& frame) {
  std::size_t count = 0;
  if (!read_count(count)) return false;
  frame.disks = {};
  frame.group.clear();
  frame.image_x.clear();
  frame.image_y.clear();
  if (!next_line()) return cut_short();
  read_header(frame);
  frame.has_groups = layout_.group.width > 0;
  frame.has_images = layout_.image.width > 0;
  frame.has_spins = layout_.spin.width > 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!next_line()) return cut_short();
    read_disk(frame);
  }
  sort_by_id(frame);
  return true;
}

}  // namespace carom
