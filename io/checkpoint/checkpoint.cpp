#include "io/checkpoint/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/disks/disk_columns.hpp"
#include "io/checkpoint/checkpoint_fields.hpp"
#include "io/checkpoint/stored_disks.hpp"
#include "io/files/block_hash.hpp"
#include "io/files/output_file.hpp"

namespace carom {

namespace {

// The file: header, content filled up with zeros to a multiple of 8 bytes, tail. All numbers in the machine's order.
struct Header {
  std::array<char, 8> magic{'c', 'a', 'r', 'o', 'm', 'c', 'k', 'p'};
  std::uint64_t byte_order = 0x0102030405060708ULL;
  std::uint64_t format = 21;  // goes up with every change of what is written
};
struct Tail {
  std::uint64_t bytes = 0;     // of the content, without the zeros
  std::uint64_t checksum = 0;  // of everything before
};
static_assert(sizeof(Header) == 24 && sizeof(Tail) == 16);

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;  // multiple of 8; large enough that calls cost nothing

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(fmt::format("{}: {}", name, what));
}

// Collects bytes to chunks of whole words, which are summed and written.
class SummedFile {
 public:
  explicit SummedFile(const std::string& path) : file_(path) { chunk_.reserve(chunk_bytes); }

  void write(const char* data, std::size_t bytes) {
    while (bytes > 0) {
      const std::size_t taken = std::min(bytes, chunk_bytes - chunk_.size());
      chunk_.append(data, taken);
      data += taken;
      bytes -= taken;
      if (chunk_.size() == chunk_bytes) empty();
    }
  }

  void finish(std::uint64_t content) {
    chunk_.resize((chunk_.size() + 7) / 8 * 8, '\0');
    write(reinterpret_cast<const char*>(&content), sizeof content);
    empty();
    const std::uint64_t checksum = hash_.value();
    file_.write({reinterpret_cast<const char*>(&checksum), sizeof checksum});
    file_.sync();
    file_.close();
  }

 private:
  void empty() {
    hash_.add(chunk_.data(), chunk_.size());
    file_.write(chunk_);
    chunk_.clear();
  }

  OutputFile file_;
  BlockHash hash_;
  std::string chunk_;
};

// Writes record and state as bytes. The entries of each list come from its pieces, not from state.part().
void write_content(const ByteWriter::Sink& sink, const RunRecord& record, const StatePieces& state) {
  const auto write_list = [&](StateList list) {
    const std::uint64_t entries = state.entries(list);
    std::uint64_t left = entries * entry_bytes(list);
    sink(reinterpret_cast<const char*>(&entries), sizeof entries);
    state.visit(list, [&](std::span<const std::byte> some) {
      left -= some.size();
      sink(reinterpret_cast<const char*>(some.data()), some.size());
    });
    if (left != 0) throw std::logic_error("the pieces of a state do not have the announced number of entries");
  };
  ByteWriter writer(sink, [&](const void* there) {
    for (const StateList list : all_state_lists) {
      const bool same = with_list(state.part(), list, [&](const auto& values) { return there == &values; });
      if (!same) continue;
      write_list(list);
      return true;
    }
    return false;
  });
  writer(record, state.part());
}

std::ifstream open_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, "is a folder; expected a checkpoint");
  check_regular_file(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, fmt::format("{}; expected a checkpoint", std::strerror(errno)));
  return file;
}

constexpr const char* damaged = "is damaged: it was cut short or changed after it was written";

void check_header(const Header& header, const std::string& name) {
  if (header.magic != Header{}.magic)
    refuse(name, "is not a checkpoint of Carom, or a damaged one; expected a checkpoint.carom, or the folder of a run");
  if (header.byte_order == 0x0807060504030201ULL)
    refuse(
        name,
        "comes from a machine with the other byte order; expected a checkpoint of this machine, or to resume it there");
}

// size: of all. Precondition: the checksum is right.
void check_frame(const Header& header, const Tail& tail, std::uint64_t size, const std::string& name) {
  if (header.byte_order != Header{}.byte_order || (tail.bytes + 7) / 8 * 8 != size - sizeof header - sizeof tail) {
    refuse(name, damaged);
  }
  if (header.format != Header{}.format) {
    refuse(name, fmt::format("has format {}, and this version of Carom reads format {}; expected the version that "
                             "wrote it",
                             header.format, Header{}.format));
  }
}

// Reads the whole file once. Returns the size of its content, if the checksum is right.
std::uint64_t verified_content(std::ifstream& file, const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  Header header;
  header.magic = {};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  check_header(header, path);
  if (error || !file || size < sizeof(Header) + sizeof(Tail) || size % 8 != 0) refuse(path, damaged);
  BlockHash hash;
  hash.add(reinterpret_cast<const char*>(&header), sizeof header);
  std::string chunk(chunk_bytes, '\0');
  std::uint64_t left = size - sizeof(Header) - sizeof(std::uint64_t);
  while (left > 0) {
    const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(left, chunk_bytes));
    if (!file.read(chunk.data(), static_cast<std::streamsize>(taken))) refuse(path, damaged);
    hash.add(chunk.data(), taken);
    left -= taken;
  }
  Tail tail;
  file.seekg(static_cast<std::streamoff>(size - sizeof tail));
  if (!file.read(reinterpret_cast<char*>(&tail), sizeof tail) || tail.checksum != hash.value()) refuse(path, damaged);
  check_frame(header, tail, size, path);
  return tail.bytes;
}

// Checks that hold for every state; only a bug in the program that wrote the file can break them.
void check_state(const State& state) {
  const Disks& d = state.disks;
  const DiskColumns columns = columns_of(d);
  for_each_column([&](const auto& column) {
    const std::size_t entries = column.is_in(columns) ? d.size() : 0;
    if ((d.*column.entries).size() != entries) throw BadBytes(misfit(column));
  });
  const auto born = [&](DiskId id) { return id < state.next_id; };
  if (!std::all_of(d.id.begin(), d.id.end(), born)) throw BadBytes("has a disk with an id that was never given");
  const std::size_t times = state.last_contact.size();
  if (times > state.next_id) throw BadBytes("has contact times of ids that were never given");
  const std::size_t hits = state.thermal_hits.size();
  if (hits > state.next_id) throw BadBytes("has reflections of ids that were never given");
}

// Checks that all files lie in the run's folder.
void check_names(const OutputMark& mark) {
  for (const MarkedFile& file : files_of(mark)) {
    const bool plain = !file.name.empty() && file.name.find('/') == std::string::npos && file.name != "..";
    if (!plain) throw BadBytes("names a file outside its folder");
  }
}

// then(): a further step that may throw BadBytes.
template <class Then>
void decode_into(Checkpoint& checkpoint, ByteReader reader, const std::string& name, Then&& then) {
  try {
    reader(checkpoint.record, checkpoint.state);
    if (reader.left() != 0) throw BadBytes("holds more data than it should");
    check_state(checkpoint.state);
    check_names(checkpoint.record.outputs);
    then();
  } catch (const BadBytes& bad) {
    refuse(name, fmt::format("holds no state of a run: it {}", bad.what()));
  }
}

Checkpoint decode(ByteReader reader, const std::string& name) {
  Checkpoint checkpoint;
  decode_into(checkpoint, std::move(reader), name, [] {});
  return checkpoint;
}

// The entry for this list, if it is a column of the disks; else null.
StoredColumn* column_for(const void* list, Disks& disks, StoredColumns& columns) {
  StoredColumn* found = nullptr;
  std::size_t k = 0;
  for_each_column(disks, [&](const auto& entries) {
    if (list == &entries) found = &columns[k];
    ++k;
  });
  return found;
}

}  // namespace

void write_checkpoint(const std::string& path, const RunRecord& record, const StatePieces& state) {
  SummedFile file(path);
  const Header header;
  file.write(reinterpret_cast<const char*>(&header), sizeof header);
  std::uint64_t content = 0;
  const auto sink = [&](const char* data, std::size_t bytes) {
    content += bytes;
    file.write(data, bytes);
  };
  write_content(sink, record, state);
  file.finish(content);
}

void write_checkpoint(const std::string& path, const RunRecord& record, const State& state) {
  write_checkpoint(path, record, WholeState(state));
}

Checkpoint read_checkpoint(const std::string& path) {
  std::ifstream file = open_file(path);
  const std::uint64_t content = verified_content(file, path);
  file.seekg(sizeof(Header));
  const auto take = [&](char* data, std::size_t bytes) {
    if (!file.read(data, static_cast<std::streamsize>(bytes))) throw BadBytes("could not be read twice");
  };
  return decode(ByteReader(take, content), path);
}

CheckpointInPieces read_checkpoint_in_pieces(const std::string& path) {
  std::ifstream file = open_file(path);
  const std::uint64_t content = verified_content(file, path);
  file.seekg(sizeof(Header));
  CheckpointInPieces read;
  State& state = read.checkpoint.state;
  StoredColumns columns;
  const auto take = [&](char* data, std::size_t bytes) {
    if (!file.read(data, static_cast<std::streamsize>(bytes))) throw BadBytes("could not be read twice");
  };
  const auto pass = [&](const void* list, std::uint64_t bytes) {
    StoredColumn* const column = column_for(list, state.disks, columns);
    if (column == nullptr) return false;
    *column = {static_cast<std::streamoff>(file.tellg()), bytes};
    file.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    return true;
  };
  decode_into(read.checkpoint, ByteReader(take, content, pass), path, [&] {
    read.disks = std::make_unique<StoredDisks>(std::move(file), path, columns, state.disks, state.next_id);
  });
  return read;
}

std::string checkpoint_bytes(const RunRecord& record, const State& state) {
  const Header header;
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  write_content([&](const char* data, std::size_t count) { bytes.append(data, count); }, record, WholeState(state));
  Tail tail;
  tail.bytes = bytes.size() - sizeof header;
  bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
  bytes.append(reinterpret_cast<const char*>(&tail.bytes), sizeof tail.bytes);
  BlockHash hash;
  hash.add(bytes.data(), bytes.size());
  tail.checksum = hash.value();
  return bytes.append(reinterpret_cast<const char*>(&tail.checksum), sizeof tail.checksum);
}

bool is_another_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, Header{}.magic.size()> first{};
  std::ifstream file(path, std::ios::binary);
  file.read(first.data(), first.size());
  return file.gcount() > 0 && first != Header{}.magic;
}

Checkpoint checkpoint_from_bytes(std::string_view bytes, const std::string& name) {
  Header header;
  Tail tail;
  if (bytes.size() < sizeof header + sizeof tail || bytes.size() % 8 != 0) refuse(name, damaged);
  std::memcpy(&header, bytes.data(), sizeof header);
  check_header(header, name);
  std::memcpy(&tail, bytes.data() + bytes.size() - sizeof tail, sizeof tail);
  BlockHash hash;
  hash.add(bytes.data(), bytes.size() - sizeof tail.checksum);
  if (tail.checksum != hash.value()) refuse(name, damaged);
  check_frame(header, tail, bytes.size(), name);
  return decode_checkpoint(bytes.substr(sizeof header, tail.bytes), name);
}

std::string encode_checkpoint(const RunRecord& record, const StatePieces& state) {
  std::string bytes;
  write_content([&](const char* data, std::size_t count) { bytes.append(data, count); }, record, state);
  return bytes;
}

std::string encode_checkpoint(const RunRecord& record, const State& state) {
  return encode_checkpoint(record, WholeState(state));
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name) {
  const auto take = [&](char* data, std::size_t count) {
    if (count > 0) std::memcpy(data, bytes.data(), count);
    bytes.remove_prefix(count);
  };
  return decode(ByteReader(take, bytes.size()), name);
}

}  // namespace carom
