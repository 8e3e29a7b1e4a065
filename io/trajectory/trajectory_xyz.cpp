#include "io/trajectory/trajectory_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <tuple>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/base/short_number.hpp"
#include "core/scene/disk_group.hpp"
#include "io/trajectory/disk_selection.hpp"

namespace carom {

namespace {

// The text of one line, on the stack.
class LineText {
 public:
  std::string_view text() const { return {buffer_.data(), static_cast<std::size_t>(end_ - buffer_.data())}; }
  void add(std::string_view part) { end_ = std::copy(part.begin(), part.end(), end_); }
  // A space and a double, with as many digits as it takes to come back as the same bits; or a whole number.
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
  RepeatedNumber radius, mass;
  for (std::size_t k = begin; k < end; ++k) {
    const std::size_t i = order[k];
    if (k + lines_ahead < end) prefetch_disk(disks, order[k + lines_ahead]);
    const DiskId id = disks.id[i];
    LineText line;
    line.add("X");
    line.add_number(disks.x[i]);
    line.add_number(disks.y[i]);
    line.add(" 0");
    line.add_number(disks.vx[i]);
    line.add_number(disks.vy[i]);
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
    if (plan_.spins) line.add_number(disks.spin_of(i));
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
  // A line without its end may lack digits, too.
  return static_cast<bool>(std::getline(file_, line_)) && !(growing_ && file_.eof());
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

// name:type:number of columns, and so on.
void XyzReader::read_layout(std::string_view properties) {
  const auto refuse = [&](std::string_view what) {
    fail(fmt::format("expected Properties={}, or more columns; {}", xyz_properties, what));
  };
  Layout layout;
  std::size_t radius_width = 0, mass_width = 0, id_width = 0, group_width = 0, spin_width = 0, image_width = 0;
  std::array<std::tuple<std::string_view, std::size_t*, std::size_t*>, 8> known{
      {{"pos", &layout.position, &layout.position_width},
       {"velo", &layout.velocity, &layout.velocity_width},
       {"radius", &layout.radius, &radius_width},
       {"mass", &layout.mass, &mass_width},
       {"id", &layout.id, &id_width},
       {"group", &layout.group, &group_width},
       {"spin", &layout.spin, &spin_width},
       {"map_shift", &layout.image, &image_width}}};
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
    std::size_t width = 0;
    const auto result = std::from_chars(width_text.data(), width_text.data() + width_text.size(), width);
    constexpr std::size_t most_columns = 1000;  // beyond any file that makes sense
    if (result.ec != std::errc{} || width == 0 || width > most_columns || layout.all > most_columns) {
      refuse(fmt::format("'{}' is no number of columns", width_text));
    }
    for (const auto& [known_name, begin, known_width] : known) {
      if (name != known_name) continue;
      *begin = layout.all;
      *known_width = width;
    }
    layout.all += width;
  }
  for (const auto& [name, begin, width] : known) {
    const bool vector = name == "pos" || name == "velo" || name == "map_shift";
    if ((name == "group" || name == "spin" || name == "map_shift") && *width == 0) continue;
    if (vector ? *width != 2 && *width != 3 : *width != 1)
      refuse(fmt::format("'{}' has {}", name, counted(*width, "column")));
  }
  layout.has_group = group_width > 0;
  layout.has_spin = spin_width > 0;
  layout.has_image = image_width > 0;
  layout_ = layout;
  properties_ = properties;
}

void XyzReader::read_header(XyzFrame& frame) {
  const std::string_view properties = value_of(line_, "Properties=");
  if (properties.empty() || properties != properties_) read_layout(properties);
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
  const auto flat = [&](std::size_t begin, std::size_t width) {
    if (width == 3 && number(columns[begin + 2]) != 0.0) {
      fail(fmt::format("z is {}, expected 0: disks move in a plane", columns[begin + 2]));
    }
  };
  flat(at.position, at.position_width);
  flat(at.velocity, at.velocity_width);
  Disks& disks = frame.disks;
  disks.id.push_back(whole_number<DiskId>(columns[at.id], "disk id"));
  disks.x.push_back(number(columns[at.position]));
  disks.y.push_back(number(columns[at.position + 1]));
  disks.vx.push_back(number(columns[at.velocity]));
  disks.vy.push_back(number(columns[at.velocity + 1]));
  disks.radius.push_back(number(columns[at.radius]));
  disks.mass.push_back(number(columns[at.mass]));
  if (at.has_spin) disks.spin.push_back(number(columns[at.spin]));
  if (at.has_group) frame.group.push_back(whole_number<DiskId>(columns[at.group], "group"));
  if (!at.has_image) return;
  frame.image_x.push_back(whole_number<std::int32_t>(columns[at.image], "number of rounds"));
  frame.image_y.push_back(whole_number<std::int32_t>(columns[at.image + 1], "number of rounds"));
}

bool XyzReader::read(XyzFrame& frame) {
  if (!growing_) return read_whole(frame);
  const std::streampos begin = file_.tellg();
  const std::size_t line = line_number_;
  if (read_whole(frame)) return true;
  // The rest of it may come.
  file_.clear();
  file_.seekg(begin);
  line_number_ = line;
  return false;
}

bool XyzReader::read_whole(XyzFrame& frame) {
  if (!next_line()) return false;
  std::size_t count = 0;
  const auto result = std::from_chars(line_.data(), line_.data() + line_.size(), count);
  if (result.ec != std::errc{}) {
    const char* const expected =
        line_number_ == 1 ? "; expected trajectory.xyz or trajectory.h5 of a run, or its folder" : "";
    fail(fmt::format("'{}' is no number of disks{}", line_.substr(0, 40), expected));
  }
  frame.disks = {};
  frame.group.clear();
  frame.image_x.clear();
  frame.image_y.clear();
  const auto cut_short = [this] {
    if (!growing_) fail("the file ends inside a frame");
    return false;
  };
  if (!next_line()) return cut_short();
  read_header(frame);
  for (std::size_t k = 0; k < count; ++k) {
    if (!next_line()) return cut_short();
    read_disk(frame);
  }
  return true;
}

}  // namespace carom
