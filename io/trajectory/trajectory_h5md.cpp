#include "io/trajectory/trajectory_h5md.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "core/load/scene_file.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/scene_text.hpp"
#include "io/hdf5/hdf5_kinds.hpp"
#include "io/hdf5/hdf5_output.hpp"
#include "io/hdf5/shuffled_deflate.hpp"
#include "io/tables/group_columns.hpp"
#include "io/tables/rotation_columns.hpp"
#include "io/trajectory/disk_selection.hpp"
#include "io/trajectory/h5md_elements.hpp"
#include "io/trajectory/h5md_layout.hpp"
#include "io/trajectory/h5md_values.hpp"
#include "io/trajectory/place_batches.hpp"
#include "io/trajectory/xdmf.hpp"

namespace carom {

namespace {

// The places of chunks in the file depend on when it is flushed, and equal runs must write equal files: so flushes
// follow the work of the run, not a clock. Its unit is about 100 ns: a disk moved in a step, a tenth of a collision of
// exact motion, a tenth of a disk written. A run on one core flushes about twice a second.
constexpr double flush_work = 5e6;
constexpr double work_of_collision = 10.0, work_of_disk_written = 10.0, work_of_step = 10.0;

double work_done(Count steps, double collisions, double disks) {
  return static_cast<double>(steps) * (disks + work_of_step) + work_of_collision * collisions;
}

// Places in a chunk: 256 KiB of positions, enough to be packed well, and little to read for a few disks.
constexpr hsize_t largest_chunk = 16384;
constexpr hsize_t smallest_open_chunk = 256;  // if sources may add disks
constexpr hsize_t frames_per_column_chunk = 1024;

// A chunk to be written, and the memory to pack it.
struct Packer {
  std::vector<unsigned char> buffer;
  ShuffledDeflate deflate;
};
constexpr std::size_t chunks_at_once = 16;

Repetition repetition_of(H5mdQuantity quantity) {
  const bool has_patterns = quantity == H5mdQuantity::id || quantity == H5mdQuantity::species;
  return has_patterns ? Repetition::patterns : Repetition::runs;
}

std::string user_name() {
  const char* const name = std::getenv("USER");  // NOLINT(concurrency-mt-unsafe): it is never set here
  return name == nullptr || *name == '\0' ? "unknown" : name;
}

Count disks_at_start(const Scene& scene) {
  Count disks = 0;
  for (const DiskGroup& group : scene.groups) disks += group.count;
  return disks;
}

// The number of places that a file has in any case.
Count places_at_start(const Selection& select, Count disks) {
  if (select.by_region) return 0;
  const Count end = std::min<Count>(select.ids.end, disks);
  return end > select.ids.first ? (end - select.ids.first + select.stride - 1) / select.stride : 0;
}
// May more places be added? next_id: of the state's disks; larger than the number of disks of the scene if a program
// has added some.
bool may_grow(const Selection& select, const Scene& scene, Count disks, DiskId next_id) {
  return select.by_region || ((!scene.sources.empty() || next_id > disks) && select.ids.end > disks);
}

}  // namespace

struct H5mdWriter::File {
  File(const std::string& file_path, const Scene& scene, bool existing, const DisplacementTally* rounds,
       DiskId next_id);
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File();

  void describe(const Scene& scene) const;
  void make_elements();
  void open_elements(Count frames);
  void write_frame(const DisksInPieces& disks, const BlockRunner& run);
  void write_element(H5mdElement& element, const PlaceBatch& batch, const BlockRunner& run);
  void write_once(H5mdElement& element, const PlaceBatch& batch, hsize_t first, hsize_t last);
  // begin, end: counted from the first place of the batch.
  void fill(const H5mdElement& element, const PlaceBatch& batch, hsize_t begin, hsize_t end,
            std::vector<unsigned char>& buffer) const {
    fill_with_values(element.quantity, form, batch.disks, {batch.disk_at, begin, end}, buffer);
  }
  void flush();
  void close();

  std::string path;
  Hdf5Output output;
  Selection select;
  H5mdForm form;
  bool exact = false, growing = false, rotates = false;
  hsize_t chunk = 1;   // places
  hsize_t places = 0;  // that the file has
  hsize_t known = 0;   // places whose mass, radius and species are in the file
  Count frames = 0, flushed_frames = 0;
  std::vector<H5mdElement> elements;       // positions first
  std::vector<std::size_t> shown_columns;  // of series_columns
  std::vector<H5mdColumn> columns;  // step, observables, and last the time, which shows how many frames are complete
  GroupMeter groups;
  std::vector<Packer> packers = std::vector<Packer>(chunks_at_once);
  double work_seen = 0.0;  // of the run, at the last frame
  double unflushed_work = 0.0;
};

H5mdWriter::File::File(const std::string& file_path, const Scene& scene, bool existing, const DisplacementTally* rounds,
                       DiskId next_id)
    : path(file_path),
      output(file_path, existing),
      select(scene.output.select),
      form{scene.output.single_precision, scene.output.dimensions, ends_of_groups(scene), rounds},
      exact(scene.run.method == Method::exact),
      growing(may_grow(select, scene, disks_at_start(scene), next_id)),
      rotates(scene.physics.surfaces.are_rough()),
      elements(h5md_elements(scene, rounds != nullptr)),
      shown_columns(observables_of(scene)),
      columns(h5md_columns(scene)),
      groups(scene) {
  places = places_at_start(select, disks_at_start(scene));
  chunk = std::clamp<hsize_t>(places, growing ? smallest_open_chunk : 1, largest_chunk);
}

H5mdWriter::File::~File() {
  if (!output.broken()) return;
  for (H5mdElement& e : elements) e.set.abandon();
  for (H5mdColumn& c : columns) c.set.abandon();
  output.abandon();
}

// Writes all that does not change.
void H5mdWriter::File::describe(const Scene& scene) const {
  for (const char* const group : {"/h5md", "/h5md/author", "/h5md/creator", "/parameters", "/particles", h5md_disks}) {
    output.make_group(group);
  }
  output.attribute("/h5md", "version", std::vector<int>{1, 1});
  output.attribute("/h5md/author", "name", user_name());
  output.attribute("/h5md/creator", "name", "Carom");
  output.attribute("/h5md/creator", "version", CAROM_VERSION);
  output.text("/parameters/scene", resolved_toml(scene));
  const std::string box = std::string(h5md_disks) + "/box";
  output.make_group(box);
  output.attribute(box, "dimension", form.dimensions);
  const auto boundary = [](bool periodic) { return std::string(periodic ? "periodic" : "none"); };
  std::vector<std::string> boundaries{boundary(scene.box.periodic_x()), boundary(scene.box.periodic_y())};
  if (form.dimensions == 3) boundaries.push_back(boundary(false));
  output.attribute(box, "boundary", boundaries);
  if (form.dimensions == 3) return;  // the edges are a column then
  const std::array<double, 2> edges{scene.box.width, scene.box.height};
  const Hdf5Handle set = output.make_dataset(box + "/edges", double_kind(), {2}, {2}, {2}, Packing::plain);
  output.write_block(set, double_kind(), {0}, {2}, edges.data());
}

void H5mdWriter::File::make_elements() {
  const std::string root = std::string(h5md_disks) + "/";
  for (H5mdElement& e : elements) {
    const hsize_t limit = growing ? H5S_UNLIMITED : std::max<hsize_t>(1, places);
    if (!e.each_frame) {
      // A packed chunk cannot be extended in place without losing space, so only data that are written once are packed.
      e.set =
          output.make_dataset(e.name, e.kind, {places}, {limit}, {chunk}, growing ? Packing::plain : Packing::deflate);
      continue;
    }
    output.make_group(parent_group(e.name));
    Extent size{0, places}, most{H5S_UNLIMITED, limit}, block{1, chunk};
    if (e.components > 1) {
      for (Extent* const extent : {&size, &most, &block}) extent->push_back(e.components);
    }
    e.set = output.make_dataset(e.name, e.kind, size, most, block, Packing::deflate);
  }
  output.make_group("/observables");
  for (H5mdColumn& c : columns) {
    const std::string group = parent_group(c.name);
    if (group != root + "position") output.make_group(group);
    Extent size{0}, most{H5S_UNLIMITED}, block{frames_per_column_chunk};
    for (Extent* const extent : {&size, &most, &block}) extent->insert(extent->end(), c.shape.begin(), c.shape.end());
    c.set = output.make_dataset(c.name, c.kind, size, most, block, Packing::plain);
  }
  const auto share = [&](const std::string& name) {
    const std::string group = parent_group(name);
    if (group == root + "position") return;
    output.link(root + "position/step", group + "/step");
    output.link(root + "position/time", group + "/time");
  };
  for (const H5mdElement& e : elements) {
    if (e.each_frame) share(e.name);
  }
  for (const H5mdColumn& c : columns) share(c.name);
}

void H5mdWriter::File::open_elements(Count kept) {
  for (H5mdColumn& c : columns) c.set = output.open_dataset(c.name);
  for (H5mdElement& e : elements) e.set = output.open_dataset(e.name);
  const Count there = output.size_of(columns.back().set).at(0);
  const Extent held = output.size_of(elements[0].set);
  if (there < kept) output.fail(fmt::format("it holds {} frames, and {} were written before", there, kept));
  if (held.size() != 3 || held[2] != elements[0].components || held[1] < places || (!growing && held[1] != places)) {
    output.fail("it was written for other disks");
  }
  places = held[1];
  frames = flushed_frames = kept;
  known = kept == 0 ? 0 : places;
  for (H5mdElement& e : elements) {
    Extent size = output.size_of(e.set);
    if (!e.each_frame) {
      known = std::min(known, size.at(0));  // a kill may have come between writing it and the others
      continue;
    }
    size[0] = kept;
    size[1] = places;
    output.resize(e.set, size);
  }
  for (H5mdColumn& c : columns) output.resize(c.set, shape_of(c, kept));
}

// Writes these places of an element in the frame's row, chunk by chunk. Chunks without a disk are not written: reading
// them gives fill values.
void H5mdWriter::File::write_element(H5mdElement& e, const PlaceBatch& batch, const BlockRunner& run) {
  Extent begin{frames, 0};
  if (e.components > 1) begin.push_back(0);
  std::vector<hsize_t> firsts;
  for (hsize_t first = 0; first < batch.count; first += chunk) {
    const auto from = batch.disk_at.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = batch.disk_at.begin() + static_cast<std::ptrdiff_t>(std::min<hsize_t>(first + chunk, batch.count));
    if (std::any_of(from, to, [](std::uint32_t i) { return i != no_disk; })) firsts.push_back(first);
  }
  for (std::size_t done = 0; done < firsts.size(); done += chunks_at_once) {
    const std::size_t count = std::min(chunks_at_once, firsts.size() - done);
    run(count, [&](std::size_t k) {
      Packer& packer = packers[k];
      fill(e, batch, firsts[done + k], firsts[done + k] + chunk, packer.buffer);
      packer.deflate.pack(packer.buffer.data(), packer.buffer.size(), e.kind.width, repetition_of(e.quantity));
    });
    for (std::size_t k = 0; k < count; ++k) {
      begin[1] = batch.first + firsts[done + k];
      output.write_packed_chunk(e.set, begin, packers[k].deflate.packed());
    }
  }
}

// Writes the constant properties of the disks at places first to last - 1 that are in the batch. A disk that came and
// went since the frame before has not been noticed: its place keeps the fill values.
void H5mdWriter::File::write_once(H5mdElement& e, const PlaceBatch& batch, hsize_t first, hsize_t last) {
  const hsize_t here = std::min<hsize_t>(last, batch.first + batch.count);
  for (hsize_t begin = std::max<hsize_t>(first, batch.first); begin < here; begin += chunk) {
    const hsize_t end = std::min(begin + chunk, here);
    fill(e, batch, begin - batch.first, end - batch.first, packers[0].buffer);
    output.write_block(e.set, e.kind, {begin}, {end - begin}, packers[0].buffer.data());
  }
}

// Element by element, each for all disks, so that its chunks are next to each other in the file.
void H5mdWriter::File::write_frame(const DisksInPieces& disks, const BlockRunner& run) {
  FramePlaces frame(select, disks, chunk);
  const hsize_t shown = growing || known < places ? frame.count() : 0;
  places = std::max(places, shown);
  for (H5mdElement& e : elements) {
    if (e.each_frame) {
      Extent size{frames + 1, places};
      if (e.components > 1) size.push_back(e.components);
      output.resize(e.set, size);
      frame.visit([&](const PlaceBatch& batch) { write_element(e, batch, run); });
    } else if (shown > known) {
      // Exactly as long as what is known, which a later writer relies on.
      if (growing) output.resize(e.set, {shown});
      frame.visit([&](const PlaceBatch& batch) { write_once(e, batch, known, shown); });
    }
  }
  known = std::max(known, shown);
  ++frames;
}

// The numbers of each frame are written last, with the times at the end, so a frame that has a time is complete.
void H5mdWriter::File::flush() {
  output.begin_flush();
  if (frames > flushed_frames) {
    for (H5mdElement& e : elements) output.flush(e.set);
    std::vector<std::int64_t> whole;
    for (H5mdColumn& c : columns) {
      const Count fresh = frames - flushed_frames;
      if (!c.constant.empty()) {
        c.values.clear();
        for (Count k = 0; k < fresh; ++k) c.values.insert(c.values.end(), c.constant.begin(), c.constant.end());
      }
      const void* data = c.values.data();
      if (c.whole) {
        whole.assign(c.values.begin(), c.values.end());
        data = whole.data();
      }
      output.resize(c.set, shape_of(c, frames));
      Extent begin(1 + c.shape.size(), 0);
      begin[0] = flushed_frames;
      output.write_block(c.set, c.kind, begin, shape_of(c, fresh), data);
      output.flush(c.set);
      c.values.clear();
    }
    flushed_frames = frames;
  }
  output.end_flush();
  unflushed_work = 0.0;
}

void H5mdWriter::File::close() {
  flush();
  std::vector<double> times(frames);
  if (frames > 0)
    output.checked(H5Dread(columns.back().set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()));
  for (H5mdElement& e : elements) output.checked(e.set.close());
  for (H5mdColumn& c : columns) output.checked(c.set.close());
  output.close();
  write_xdmf(path, {times, places, elements[0].kind.width, form.dimensions, select.by_region});
}

H5mdWriter::H5mdWriter(const std::string& path, const Scene& scene, const DisplacementTally* rounds, DiskId next_id)
    : file_(std::make_unique<File>(path, scene, false, rounds, next_id)) {
  file_->describe(scene);
  file_->make_elements();
  file_->output.start_safe_writing();
}

H5mdWriter::H5mdWriter(const std::string& path, const Scene& scene, Count frames, const DisplacementTally* rounds,
                       DiskId next_id)
    : file_(std::make_unique<File>(path, scene, true, rounds, next_id)) {
  file_->open_elements(frames);
  file_->output.start_safe_writing();
}

H5mdWriter::~H5mdWriter() = default;

void H5mdWriter::write(const DisksInPieces& disks, Count step, const SeriesRow& row, const BlockRunner& run) {
  File& f = *file_;
  const Count shown = f.exact ? f.frames : step;
  f.write_frame(disks, run);
  f.columns.front().values.push_back(static_cast<double>(shown));
  std::size_t column = 0;
  for (const std::size_t k : f.shown_columns) f.columns[++column].values.push_back(row[k]);
  if (f.rotates) {
    for (const double value : rotation_column_values(disks, run)) f.columns[++column].values.push_back(value);
  }
  if (!f.groups.empty()) {
    for (const double value : f.groups.row(disks)) f.columns[++column].values.push_back(value);
  }
  f.columns.back().values.push_back(disks.time());
  const auto count = static_cast<double>(disks.size());
  const double work = work_done(step, row[collisions_column] + row[wall_collisions_column], count);
  f.unflushed_work += std::max(0.0, work - f.work_seen) + work_of_disk_written * count;
  f.work_seen = work;
  // A column's chunk gets its place in the file with its first value: so the file is always flushed then.
  const bool begins_chunk = f.frames % frames_per_column_chunk == 1;
  if (begins_chunk || f.unflushed_work > flush_work) f.flush();
}

void H5mdWriter::flush() {
  file_->flush();
}

FileMark H5mdWriter::mark() {
  flush();
  return {std::filesystem::path(file_->path).filename().string(), frames(), 0};
}

Count H5mdWriter::frames() const {
  return file_->frames;
}

void H5mdWriter::close() {
  file_->close();
}

}  // namespace carom
