#include "io/view/view_block.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <new>
#include <utility>

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

}  // namespace carom
