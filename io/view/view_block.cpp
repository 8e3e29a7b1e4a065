#include "io/view/view_block.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <new>
#include <utility>

#include "core/base/input_message.hpp"

namespace carom {

namespace {

using Places = std::vector<std::uint32_t>;

void put_varint(std::string& to, std::uint32_t value) {
  for (; value >= 0x80U; value >>= 7U) to += static_cast<char>(value | 0x80U);
  to += static_cast<char>(value);
}

void put_word(std::string& to, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) to += static_cast<char>(value >> shift);
}

// Writes ascending places as runs of neighbours.
void put_runs(std::string& to, const Places& places) {
  std::vector<std::array<std::uint32_t, 2>> runs;  // gap to the end of the run before, length
  std::uint32_t end = 0;
  for (const std::uint32_t place : places) {
    if (runs.empty() || place != end) runs.push_back({place - end, 0});
    ++runs.back()[1];
    end = place + 1;
  }
  put_varint(to, static_cast<std::uint32_t>(runs.size()));
  for (const auto& [gap, length] : runs) {
    put_varint(to, gap);
    put_varint(to, length);
  }
}

// The places of a that are not in b; both ascending.
Places difference(const Places& a, const Places& b) {
  Places only;
  if (a != b) std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only;
}

unsigned bytes_of(const ViewAxis& axis) {
  return (axis.bits + 7) / 8;
}

// The sign is stored in the lowest bit, so that the high bytes of small numbers of either sign are 0.
std::uint32_t folded(std::uint32_t residual, const ViewAxis& axis) {
  const unsigned spare = 32 - axis.bits;
  const auto value = static_cast<std::int32_t>(residual << spare) >> spare;
  return ((static_cast<std::uint32_t>(value) << 1U) ^ static_cast<std::uint32_t>(value >> 31)) & axis.mask();
}

std::uint32_t unfolded(std::uint32_t folded_value) {
  return (folded_value >> 1U) ^ (0U - (folded_value & 1U));
}

// The last two coordinates of a disk along one axis; `last` is the later one.
struct Track {
  std::uint32_t last = 0, before = 0;
  std::uint32_t expected(unsigned order) const { return order == 2 ? 2 * last - before : last; }
};

struct Changes {
  Places removed, added;
  bool none() const { return removed.empty() && added.empty(); }
};

std::vector<Changes> changes_of(const std::vector<ViewFrame>& frames) {
  const Places none;
  std::vector<Changes> changes;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Places& before = k == 0 ? none : frames[k - 1].place;
    changes.push_back({difference(before, frames[k].place), difference(frames[k].place, before)});
  }
  return changes;
}

using Residuals = std::vector<std::uint32_t>;

// The coding of an axis in a block.
struct AxisCode {
  std::size_t number;  // 0 of x, 1 of y
  ViewAxis axis;
  unsigned order;  // of differences

  std::uint32_t residual(std::uint32_t at, const Track& track) const {
    return folded((at - track.expected(order)) & axis.mask(), axis);
  }
  std::uint32_t value(std::uint32_t residual, const Track& track) const {
    return (track.expected(order) + unfolded(residual)) & axis.mask();
  }
};

// The residuals of frame k, whose two predecessors have the same disks.
void find_plain_residuals(const std::vector<ViewFrame>& frames, std::size_t k, const AxisCode& code,
                          std::uint32_t* residuals) {
  const AxisCode own = code;  // a copy that the writes below cannot change
  const std::vector<std::uint32_t>& at = frames[k].at[own.number];
  const std::uint32_t* const now = at.data();
  const std::uint32_t* const last = frames[k - 1].at[own.number].data();
  const std::uint32_t* const before = frames[k - 2].at[own.number].data();
  const std::size_t count = at.size();
  for (std::size_t i = 0; i < count; ++i) residuals[i] = own.residual(now[i], {last[i], before[i]});
}

// Sets the tracks of the disks of frame k, which are also those of the frame before.
void set_tracks(const std::vector<ViewFrame>& frames, std::size_t k, std::size_t axis, std::vector<Track>& tracks) {
  const ViewFrame& frame = frames[k];
  for (std::size_t i = 0; i < frame.place.size(); ++i) {
    tracks[frame.place[i]] = {frame.at[axis][i], frames[k - 1].at[axis][i]};
  }
}

// The residuals of one axis over all frames, in the order of the block. tracks: scratch, one for each place; they are
// not updated while the disks stay the same, but set anew when that ends.
void find_residuals(const std::vector<ViewFrame>& frames, const std::vector<Changes>& changes, const AxisCode& code,
                    std::vector<Track>& tracks, Residuals& residuals) {
  std::size_t next = 0;
  bool stale = false;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::vector<std::uint32_t>& at = frames[k].at[code.number];
    if (k >= 2 && changes[k].none() && changes[k - 1].none()) {
      find_plain_residuals(frames, k, code, residuals.data() + next);
      next += at.size();
      stale = true;
      continue;
    }
    if (std::exchange(stale, false)) set_tracks(frames, k - 1, code.number, tracks);
    for (const std::uint32_t p : changes[k].added) tracks[p] = {};
    for (std::size_t i = 0; i < at.size(); ++i) {
      Track& track = tracks[frames[k].place[i]];
      residuals[next++] = code.residual(at[i], track);
      track = {at[i], track.last};
    }
    for (const std::uint32_t p : changes[k].added) tracks[p].before = tracks[p].last;
  }
}

void put_residuals(std::string& bytes, const std::array<Residuals, 2>& residuals, const ViewAxes& axes) {
  const std::size_t count = residuals[0].size();
  std::size_t to = bytes.size();
  bytes.resize(to + count * (bytes_of(axes[0]) + bytes_of(axes[1])));
  for (unsigned byte = 0; byte < std::max(bytes_of(axes[0]), bytes_of(axes[1])); ++byte) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (byte >= bytes_of(axes[axis])) continue;
      char* const plane = bytes.data() + to;
      const std::uint32_t* const from = residuals[axis].data();
      for (std::size_t i = 0; i < count; ++i) plane[i] = static_cast<char>(from[i] >> (8 * byte));
      to += count;
    }
  }
}

// The largest place of all frames, plus one; the places of a frame ascend.
std::uint32_t places_of(const std::vector<ViewFrame>& frames) {
  std::uint32_t places = 0;
  for (const ViewFrame& frame : frames) {
    if (!frame.place.empty()) places = std::max(places, frame.place.back() + 1);
  }
  return places;
}

// The order of differences, 1 or 2, with which residuals in x take fewer bits: the sum of their lengths, for a sample
// of the disks.
unsigned better_order(const std::vector<ViewFrame>& frames, const std::vector<Changes>& changes, const ViewAxis& axis) {
  std::array<std::uint64_t, 2> bits{};
  for (std::size_t k = 2; k < frames.size(); ++k) {
    if (!changes[k].none() || !changes[k - 1].none()) continue;
    const auto& now = frames[k].at[0];
    const std::size_t stride = 1 + now.size() / 256;
    for (std::size_t i = 0; i < now.size(); i += stride) {
      const Track track{frames[k - 1].at[0][i], frames[k - 2].at[0][i]};
      for (const unsigned order : {1U, 2U}) {
        bits[order - 1] += static_cast<unsigned>(std::bit_width(AxisCode{0, axis, order}.residual(now[i], track)));
      }
    }
  }
  return bits[0] < bits[1] ? 1 : 2;
}

// Reads the contents of an inflated block.
class Reading {
 public:
  explicit Reading(std::string_view bytes) : bytes_(bytes) {}
  bool good() const { return good_; }
  std::size_t left() const { return bytes_.size() - at_; }
  std::uint32_t byte() {
    if (at_ < bytes_.size()) return static_cast<unsigned char>(bytes_[at_++]);
    good_ = false;
    return 0;
  }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) value |= byte() << shift;
    return value;
  }
  std::uint32_t varint() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const std::uint32_t b = byte();
      value |= (b & 0x7fU) << (shift & 31U);
      if (b < 0x80U) return value;
    }
    good_ = false;
    return 0;
  }
  // Reads places below `places`.
  Places runs(std::uint32_t places) {
    Places all;
    std::uint64_t end = 0;
    for (std::uint32_t count = varint(); good_ && count > 0; --count) {
      const std::uint64_t begin = end + varint();
      end = begin + varint();
      good_ = good_ && end <= places;
      for (std::uint64_t p = begin; good_ && p < end; ++p) all.push_back(static_cast<std::uint32_t>(p));
    }
    return all;
  }
  std::string_view take(std::size_t count) {
    good_ = good_ && count <= left();
    const std::string_view taken = good_ ? bytes_.substr(at_, count) : std::string_view{};
    at_ += taken.size();
    return taken;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

// Inflates a stream; if it ends early or has a fault, gives what came before, and returns false.
bool inflated(std::string_view packed, std::string& to) {
  z_stream z{};
  if (inflateInit(&z) != Z_OK) throw std::bad_alloc();
  std::vector<char> chunk(std::size_t{1} << 16U);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // zlib does not write to it
  z.avail_in = static_cast<uInt>(packed.size());
  int status = Z_OK;
  while (status == Z_OK) {
    z.next_out = reinterpret_cast<Bytef*>(chunk.data());
    z.avail_out = static_cast<uInt>(chunk.size());
    status = inflate(&z, Z_NO_FLUSH);
    to.append(chunk.data(), chunk.size() - z.avail_out);
  }
  inflateEnd(&z);
  return status == Z_STREAM_END;
}

// Reads the places of all frames.
std::vector<Changes> read_places(Reading& reading, std::uint32_t places, std::vector<ViewFrame>& frames) {
  std::vector<Changes> changes;
  Places present;
  for (ViewFrame& frame : frames) {
    Places removed = reading.runs(places);
    changes.push_back({std::move(removed), reading.runs(places)});
    const Places kept = difference(present, changes.back().removed);
    const Places& added = changes.back().added;
    present.clear();
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), std::back_inserter(present));
    frame.place = present;
  }
  return changes;
}

std::array<Residuals, 2> read_residuals(Reading& reading, const ViewAxes& axes, std::size_t count) {
  std::array<Residuals, 2> residuals;
  for (Residuals& column : residuals) column.assign(count, 0);
  for (unsigned byte = 0; byte < std::max(bytes_of(axes[0]), bytes_of(axes[1])); ++byte) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (byte >= bytes_of(axes[axis])) continue;
      const std::string_view plane = reading.take(count);
      for (std::size_t i = 0; i < plane.size(); ++i) {
        residuals[axis][i] |= std::uint32_t{static_cast<unsigned char>(plane[i])} << (8 * byte);
      }
    }
  }
  return residuals;
}

// Computes one axis of all frames. places: number of entries in the table of all disks.
void follow_residuals(const Residuals& residuals, const std::vector<Changes>& changes, const AxisCode& code,
                      std::uint32_t places, std::vector<ViewFrame>& frames) {
  std::vector<Track> tracks(places);
  std::size_t next = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const std::uint32_t p : changes[k].added) tracks[p] = {};
    for (const std::uint32_t p : frames[k].place) {
      const std::uint32_t at = code.value(residuals[next++], tracks[p]);
      frames[k].at[code.number].push_back(at);
      tracks[p] = {at, tracks[p].last};
    }
    for (const std::uint32_t p : changes[k].added) tracks[p].before = tracks[p].last;
  }
}

}  // namespace

// Only runs of one byte and Huffman codes: the rest of the residuals is noise, in which a search for longer matches
// finds nothing at many times the cost.
std::string deflated(std::string_view bytes) {
  z_stream z{};
  if (deflateInit2(&z, 1, Z_DEFLATED, MAX_WBITS, 9, Z_RLE) != Z_OK) throw std::bad_alloc();
  std::string packed(deflateBound(&z, static_cast<uLong>(bytes.size())), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write to it
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(packed.data());
  z.avail_out = static_cast<uInt>(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(z.total_out);
  deflateEnd(&z);
  return packed;
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

ViewBlock pack_view_block(const std::vector<ViewFrame>& frames, std::size_t first, const ViewAxes& axes) {
  const std::uint32_t places = places_of(frames);
  const std::vector<Changes> changes = changes_of(frames);
  ViewBlock block{first, frames.size(), 0, {}, 0};
  for (const ViewFrame& frame : frames) block.residuals += frame.place.size();
  const unsigned order = better_order(frames, changes, axes[0]);
  std::string bytes;
  for (const std::uint32_t word : {static_cast<std::uint32_t>(frames.size()), std::uint32_t{order}, places}) {
    put_word(bytes, word);
  }
  for (const auto& [removed, added] : changes) {
    put_runs(bytes, removed);
    put_runs(bytes, added);
  }
  std::vector<Track> tracks(places);
  std::array<Residuals, 2> residuals;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    residuals[axis].resize(block.residuals);
    find_residuals(frames, changes, {axis, axes[axis], order}, tracks, residuals[axis]);
  }
  put_residuals(bytes, residuals, axes);
  block.packed = deflated(bytes);
  block.check = crc_of(block.packed);
  return block;
}

std::vector<ViewFrame> unpack_view_block(const ViewBlock& block, const ViewAxes& axes, const std::string& name) {
  const auto damaged = [&](const char* what) {
    fail_input(name, fmt::format("frames {} to {} are damaged: {}", block.first + 1, block.first + block.frames, what));
  };
  std::string bytes;
  if (crc_of(block.packed) != block.check) damaged("their checksum is another");
  if (!inflated(block.packed, bytes)) damaged("their stream breaks off");
  Reading reading(bytes);
  if (reading.word() != block.frames) damaged("their number is another");
  const unsigned order = reading.word();
  const std::uint32_t places = reading.word();
  if (order < 1 || order > 2) damaged("there is no such order of differences");
  std::vector<ViewFrame> frames(block.frames);
  const std::vector<Changes> changes = read_places(reading, places, frames);
  if (!reading.good()) damaged("their list of disks breaks off");
  std::size_t count = 0;
  for (const ViewFrame& frame : frames) count += frame.place.size();
  const auto residuals = read_residuals(reading, axes, block.residuals);
  if (!reading.good() || reading.left() != 0 || count != block.residuals) damaged("they are not as long as they say");
  for (std::size_t axis = 0; axis < 2; ++axis) {
    follow_residuals(residuals[axis], changes, {axis, axes[axis], order}, places, frames);
  }
  return frames;
}

}  // namespace carom
