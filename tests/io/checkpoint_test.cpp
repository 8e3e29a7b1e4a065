// A checkpoint has exactly what was written, bit by bit, or it is refused.
#include "io/checkpoint/checkpoint.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>

#include "core/base/check.hpp"
#include "core/base/random.hpp"
#include "io/checkpoint/checkpoint_place.hpp"
#include "io/files/block_hash.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_folder.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A state with something in every field, including unusual values.
State full_state() {
  State s;
  append(s.disks, {1.5, -0.0, 5e-324, 3.0, 0.5, 2.0, 4});
  append(s.disks, {2.5, 1e308, -7.0, 0.1, 0.25, 3.0, 1});
  s.time = 0.1 + 0.2;
  s.counters = {10, 1'000'000'000'000'000, 12, 13, 14, 15, 15.5, 1e-15, 1.0 / 3.0, 16.5, {1.0, 2.0, 3.0, 4.0}};
  s.next_id = 5;
  s.intervals = 6;
  s.step_begun = true;
  s.sources = {{7}, {8}};
  s.taken = {9, 0, 0, 4};
  s.loads = {{1, 4, 0.7}, {4, 4294967295U, 0.9}};
  s.stall = {99, 0.25};
  s.validity = {17,
                23,
                18,
                0.375,
                true,
                false,
                true,
                false,
                true,
                {{0.25, 1, 4}, 0.5},
                {{0.125, 4, 4294967295U}, 0.625},
                {60.0, 0.75},
                {0.0625, 0.875},
                {{0.28125, 5, 7}, 0.9375}};
  s.window = 0.0625;
  s.last_contact = {0.5, -std::numeric_limits<double>::infinity(), 1.5, 2.5};
  s.thermal_hits = {0, 3, 1, 7};
  return s;
}

RunRecord full_record() {
  RunRecord r;
  r.version = "1.2.3";
  r.scene_file = "some where/gas.toml";
  r.scene_text = "title = \"\xc3\xa9\"\n";
  r.engine = "reference";
  r.start = {2, 0.0, {1.0, 2.0}, {3.0, 4.0, 5.0}, 6.0};
  r.outputs.frames = 3;
  r.outputs.last_time = 0.3;
  r.outputs.trajectory = FileMark{"trajectory.xyz", 3, 12345678901};
  SeriesMark& series = r.outputs.series.emplace();
  series.file = {"series.csv", 3, 99};
  series.meter.counted_until = 0.3;
  series.meter.before = full_state().counters;
  series.meter.means = {1.5, 2.5, {0.5, 0.25, 0.125, 0.0625}};
  r.outputs.movie = MovieMark{3, false, {"a.mp4", "b.mp4"}, 0.5, 2.5, -1};
  r.outputs.velocities.curves = {{1, {0.0, 0.1}, {1.0, 2.0}, {3.0, 4.0}}};
  r.outputs.velocities.end = 0.1;
  r.outputs.velocities.bands = {{0.1, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}, {}}};
  r.outputs.velocities.most = 12;
  r.outputs.energies = {{0.0}, {1.0}, {2.0}, {3.0}};
  r.outputs.rounds.begun = true;
  r.outputs.rounds.x.sixteenth = {-5, not_followed, 33};
  r.wall_s = 1.5;
  r.cpu_s = 2.5;
  r.step_s = 0.5;
  r.resumed = 4;
  r.warnings = {"at time 1 two disks overlap", ""};
  return r;
}

std::string bytes_of(const fs::path& path) {
  std::ostringstream all;
  all << std::ifstream(path, std::ios::binary).rdbuf();
  return all.str();
}

class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile() : folder_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write_checkpoint(path(), full_record(), full_state());
    whole_ = bytes_of(path());
  }
  std::string path() const { return (folder_.path() / checkpoint_name).string(); }

  // The error when the file is read, which must be the same in pieces; empty if the file is accepted.
  static std::string complaint_of(const std::string& file) {
    const std::string complaint = complaint_of([&] { read_checkpoint(file); }, file);
    EXPECT_EQ(complaint_of([&] { read_checkpoint_in_pieces(file); }, file), complaint);
    return complaint;
  }
  template <class Read>
  static std::string complaint_of(Read&& read, const std::string& file) {
    try {
      read();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file + ": "));
      return error.what();
    }
    return "";
  }
  std::string complaint(const std::string& bytes) const { return complaint_of(folder_.write("other.carom", bytes)); }

  test::TestFolder folder_;
  std::string whole_;
};
using LongCheckpointFile = CheckpointFile;

TEST_F(CheckpointFile, GivesBackEveryBit) {
  const Checkpoint back = read_checkpoint(path());
  EXPECT_EQ(encode_checkpoint(back.record, back.state), encode_checkpoint(full_record(), full_state()));
  EXPECT_EQ(back.state.disks.x, full_state().disks.x);
  EXPECT_TRUE(std::signbit(back.state.disks.y[0]));
  EXPECT_EQ(back.state.counters.wall_impulse[3], 4.0);
  EXPECT_EQ(back.state.loads[1].id2, 4294967295U);
  EXPECT_EQ(back.record.outputs.series->meter.before.collisions, 1'000'000'000'000'000U);
  EXPECT_EQ(back.record.outputs.rounds.x.sixteenth, full_record().outputs.rounds.x.sixteenth);
  EXPECT_EQ(back.record.outputs.movie->parts, (std::vector<std::string>{"a.mp4", "b.mp4"}));
}

// Gives its lists entry by entry, and does not hold them itself.
class EntryByEntry final : public StatePieces {
 public:
  explicit EntryByEntry(const State& state) : whole_(state), part_(state) {
    part_.disks = {};
    part_.disks.common_radius = state.disks.common_radius;
    part_.disks.common_mass = state.disks.common_mass;
    part_.disks.inertia = state.disks.inertia;
    part_.loads.clear();
    part_.last_contact.clear();
    part_.thermal_hits.clear();
  }
  const State& part() const override { return part_; }
  Count entries(StateList list) const override { return whole_.entries(list); }
  void visit(StateList list, const Use& use) const override {
    if (list == fails_at) throw RunError("no more of it");
    const std::size_t width = entry_bytes(list);
    whole_.visit(list, [&](std::span<const std::byte> all) {
      for (std::size_t at = 0; at < all.size(); at += width) use(all.subspan(at, width));
      if (list == lies_about) use(all.first(width));
    });
  }
  std::optional<StateList> fails_at, lies_about;

 private:
  WholeState whole_;
  State part_;
};

TEST_F(CheckpointFile, OfPiecesIsThatOfTheWhole) {
  State state = full_state();
  write_checkpoint(path(), full_record(), EntryByEntry(state));
  EXPECT_TRUE(bytes_of(path()) == whole_);
  state.disks.inertia = 0.5;
  state.disks.spin = {1.5, -2.5};
  for (const StateList list : all_state_lists) EXPECT_GT(WholeState(state).entries(list), 1U);
  const std::string bytes = encode_checkpoint(full_record(), EntryByEntry(state));
  EXPECT_EQ(decode_checkpoint(bytes, "c").state.disks.spin, state.disks.spin);
  EXPECT_TRUE(bytes == encode_checkpoint(full_record(), state));
}

// If any list breaks off, no whole file with half a state may result.
TEST_F(CheckpointFile, PiecesThatBreakOffHarmNoOther) {
  const State state = full_state();
  save_checkpoint(folder_.path().string(), full_record(), WholeState(state));
  EntryByEntry pieces(state);
  for (const StateList list : all_state_lists) {
    pieces.fails_at = list;
    EXPECT_THROW(save_checkpoint(folder_.path().string(), full_record(), pieces), RunError);
    EXPECT_EQ(bytes_of(path()), whole_);
    EXPECT_FALSE(fs::exists(folder_.path() / "checkpoint.new.carom"));
  }
  pieces.fails_at.reset();
  pieces.lies_about = StateList::y;
  EXPECT_THROW(save_checkpoint(folder_.path().string(), full_record(), pieces), std::logic_error);
  EXPECT_EQ(bytes_of(path()), whole_);
}

// Disks that stay in the file and are read in pieces, with all columns and with few.
TEST_F(CheckpointFile, GivesBackItsDisksInPieces) {
  State all = full_state();
  all.next_id = 200'000;
  for (DiskId id = 5; id < all.next_id; ++id) append(all.disks, {0.1 * id, 1.0 * id, 2.0, 3.0, 0.5, 2.0, id});
  State equal;
  equal.next_id = 100;
  equal.disks.inertia = 0.5;
  for (DiskId id = 0; id < 100; ++id) append(equal.disks, {1.0 * id, 2.0, 3.0, 4.0, 0.5, 2.0, id, 7.0 * id});
  for (const State& state : {all, equal, State{}}) {
    write_checkpoint(path(), full_record(), state);
    CheckpointInPieces back = read_checkpoint_in_pieces(path());
    State& read = back.checkpoint.state;
    EXPECT_TRUE(read.disks.empty());
    EXPECT_EQ(back.disks->size(), state.disks.size());
    EXPECT_EQ(back.disks->has_radii(), !state.disks.radius.empty());
    EXPECT_EQ(back.disks->has_masses(), !state.disks.mass.empty());
    visit_pieces(*back.disks, [&](const Disks& some) {
      EXPECT_LE(some.size(), disks_of_a_read);
      for (std::size_t i = 0; i < some.size(); ++i) append(read.disks, disk_at(some, i));
    });
    EXPECT_EQ(encode_checkpoint(back.checkpoint.record, read), encode_checkpoint(full_record(), state));
  }
}

// A disk with an id that has not been given yet is found anywhere in the file.
TEST_F(CheckpointFile, ADiskThatWasNeverMadeIsRefusedBeyondTheFirstPiece) {
  State state;
  state.next_id = static_cast<DiskId>(disks_of_a_read + 2);
  for (DiskId id = 0; id < state.next_id; ++id) append(state.disks, {0.1 * id, 1.0, 2.0, 3.0, 0.5, 2.0, id});
  write_checkpoint(path(), full_record(), state);
  ASSERT_EQ(complaint_of(path()), "");
  for (const std::size_t back : {1U, 2U}) {
    State other = state;
    other.disks.id[other.disks.size() - back] = state.next_id;
    write_checkpoint(path(), full_record(), other);
    EXPECT_THAT(complaint_of(path()), testing::HasSubstr("has a disk with an id that was never given"));
  }
}

TEST_F(CheckpointFile, AnEmptyStateToo) {
  write_checkpoint(path(), {}, State{});
  const Checkpoint back = read_checkpoint(path());
  EXPECT_TRUE(back.state.disks.empty());
  EXPECT_FALSE(back.record.outputs.trajectory.has_value());
}

TEST_F(LongCheckpointFile, EveryFlippedBitIsRefused) {
  ASSERT_EQ(complaint_of(path()), "");
  std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&](std::size_t at, char byte) {
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte).flush();
  };
  for (std::size_t at = 0; at < whole_.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      put(at, static_cast<char>(whole_[at] ^ (1 << bit)));
      ASSERT_NE(complaint_of(path()), "") << "byte " << at << ", bit " << bit;
    }
    put(at, whole_[at]);
  }
  EXPECT_EQ(complaint_of(path()), "");
}

TEST_F(CheckpointFile, EveryOtherLengthIsRefused) {
  for (std::size_t more = 1; more < 20; ++more) ASSERT_NE(complaint(whole_ + std::string(more, '\0')), "") << more;
  EXPECT_NE(complaint(whole_ + whole_), "");
  for (std::size_t length = whole_.size(); length-- > 0;) {
    fs::resize_file(path(), length);
    ASSERT_NE(complaint_of(path()), "") << length;
  }
}

TEST_F(CheckpointFile, ZerosInPlaceOfABlockAreRefused) {
  // A power cut leaves such a file if the file system stored the length before the content.
  for (std::size_t at = 0; at + 16 < whole_.size(); at += 8) {
    std::string holed = whole_;
    holed.replace(at, 16, std::string(16, '\0'));
    if (holed == whole_) continue;
    ASSERT_NE(complaint(holed), "") << at;
  }
}

// The file with another word in its header, and a matching checksum.
std::string with_header(std::string file, std::size_t at, std::uint64_t word) {
  std::memcpy(&file[at], &word, 8);
  BlockHash hash;
  hash.add(file.data(), file.size() - 8);
  const std::uint64_t sum = hash.value();
  std::memcpy(&file[file.size() - 8], &sum, 8);
  return file;
}

TEST_F(CheckpointFile, SaysWhatIsWrong) {
  EXPECT_THAT(complaint("title = \"a scene\"\n"), HasSubstr("is not a checkpoint of Carom"));
  EXPECT_THAT(complaint(""), HasSubstr("is not a checkpoint of Carom"));
  EXPECT_THAT(complaint(whole_.substr(0, 100)), HasSubstr("is damaged"));
  EXPECT_THAT(complaint(with_header(whole_, 8, 0x0807060504030201ULL)), HasSubstr("with the other byte order"));
  EXPECT_THAT(complaint(with_header(whole_, 16, 77)), HasSubstr("has format 77, and this version of Carom reads"));
  EXPECT_THROW(read_checkpoint(folder_.path().string()), InputError);
  EXPECT_THROW(read_checkpoint("/nonexistent/checkpoint.carom"), InputError);
}

TEST_F(CheckpointFile, ContentThatContradictsItselfIsRefused) {
  const auto refused = [&](const auto& spoil) {
    RunRecord record = full_record();
    State state = full_state();
    spoil(record, state);
    write_checkpoint(path(), record, state);
    return complaint_of(path());
  };
  EXPECT_EQ(refused([](RunRecord&, State&) {}), "");
  EXPECT_THAT(refused([](RunRecord&, State& s) { s.disks.vx.pop_back(); }), HasSubstr("columns of different lengths"));
  EXPECT_THAT(refused([](RunRecord&, State& s) { s.disks.id[0] = 5; }),
              HasSubstr("a disk with an id that was never given"));
  EXPECT_THAT(refused([](RunRecord&, State& s) { s.disks.x.clear(); }), HasSubstr("columns of different lengths"));
  EXPECT_THAT(refused([](RunRecord&, State& s) { s.disks.mass.push_back(1.0); }),
              HasSubstr("columns of different lengths"));
  EXPECT_THAT(refused([](RunRecord&, State& s) { s.disks.inertia = 0.5; }), HasSubstr("spins of other disks"));
  EXPECT_THAT(refused([](RunRecord& r, State&) { r.outputs.movie->parts[0] = "../a"; }),
              HasSubstr("outside its folder"));
}

// With a right checksum the content may be anything: it is accepted or refused, and no length in it is used without a
// check.
TEST(CheckpointContent, ChangedAtRandomItIsTakenOrRefused) {
  const std::string whole = encode_checkpoint(full_record(), full_state());
  int refused = 0;
  for (std::uint32_t k = 0; k < 20000; ++k) {
    std::string bytes = whole;
    for (std::uint32_t change = 0; change <= k % 3; ++change) {
      const TwoUniforms u = uniforms(5, Stream::position, k, change);
      const auto at = static_cast<std::size_t>(u.a * static_cast<double>(bytes.size()));
      bytes[at] = static_cast<char>(static_cast<unsigned char>(u.b * 256.0));
    }
    try {
      decode_checkpoint(bytes, "c");
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST_F(CheckpointFile, TheLastTwoAreKept) {
  State state = full_state();
  for (int k = 1; k <= 3; ++k) {
    state.time = k;
    save_checkpoint(folder_.path().string(), full_record(), WholeState(state));
  }
  EXPECT_EQ(read_checkpoint(path()).state.time, 3.0);
  EXPECT_EQ(read_checkpoint((folder_.path() / previous_checkpoint_name).string()).state.time, 2.0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 2);
}

TEST_F(CheckpointFile, OneThatFindsNoRoomHarmsNoOther) {
  std::signal(SIGXFSZ, SIG_IGN);
  State state = full_state();
  save_checkpoint(folder_.path().string(), full_record(), WholeState(state));
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{200, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string what;
  try {
    save_checkpoint(folder_.path().string(), full_record(), WholeState(state));
  } catch (const RunError& error) {
    what = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THAT(what, HasSubstr("File too large"));
  EXPECT_EQ(bytes_of(path()), whole_);
  EXPECT_EQ(bytes_of(folder_.path() / previous_checkpoint_name), whole_);
  EXPECT_FALSE(fs::exists(folder_.path() / "checkpoint.new.carom")) << "a full disk needs the room";
}

TEST_F(CheckpointFile, IsFoundInTheFolderOfItsRun) {
  CheckpointPlace place = find_checkpoint(folder_.path().string() + "/");
  EXPECT_EQ(place.file, path());
  EXPECT_TRUE(place.finished);
  fs::create_directories(folder_.path() / unfinished_name);
  fs::rename(path(), folder_.path() / unfinished_name / checkpoint_name);
  place = find_checkpoint(folder_.path().string());
  EXPECT_FALSE(place.finished);
  EXPECT_EQ(place.folder, folder_.path());
  EXPECT_EQ(find_checkpoint(place.file.string()).folder, folder_.path());
  fs::remove(place.file);
  EXPECT_THROW(find_checkpoint(folder_.path().string()), InputError);
  EXPECT_THROW(find_checkpoint(place.file.string()), InputError);
}

TEST_F(CheckpointFile, OneThatIsDamagedNamesTheOneBefore) {
  const State state = full_state();
  save_checkpoint(folder_.path().string(), full_record(), WholeState(state));
  folder_.write(checkpoint_name, whole_.substr(0, 300));
  const auto complaint_of = [&] {
    try {
      read_checkpoint_at(find_checkpoint(path()));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(complaint_of(), HasSubstr("the earlier one is intact: carom resume "));
  EXPECT_THAT(complaint_of(), HasSubstr(previous_checkpoint_name));
  folder_.write(previous_checkpoint_name, "");
  EXPECT_THAT(complaint_of(), ::testing::Not(HasSubstr("the earlier one")));
}

}  // namespace
}  // namespace carom
