// Which checkpoint of a run is found, the error if there is none, and contents that no run writes.
#include "io/checkpoint/checkpoint_place.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <functional>

#include "core/base/check.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/files/block_hash.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_folder.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

std::string complaint_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

State two_disks() {
  State state;
  for (DiskId id = 0; id < 2; ++id) append(state.disks, {1.0 * id, 2.0, 3.0, 4.0, 0.5 + id, 1.0 + id, id});
  state.next_id = 2;
  return state;
}

class CheckpointFolder : public ::testing::Test {
 protected:
  CheckpointFolder() { fs::create_directories(run_ / unfinished_name); }
  void save(const fs::path& file) const { write_checkpoint(file.string(), {}, two_disks()); }
  std::string complaint() const {
    return complaint_of([&] { read_checkpoint_at(find_checkpoint(run_.string())); });
  }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const fs::path run_ = folder_.path() / "run";
  const fs::path unfinished_ = run_ / unfinished_name;
};

// On file systems without hard links a power cut may come when the newest checkpoint has no name.
TEST_F(CheckpointFolder, TheOneBeforeServesWhereItIsAlone) {
  save(unfinished_ / previous_checkpoint_name);
  const CheckpointPlace place = find_checkpoint(run_.string());
  EXPECT_EQ(place.file, unfinished_ / previous_checkpoint_name);
  EXPECT_EQ(place.folder, run_);
  EXPECT_FALSE(place.finished);
}

// If a finished run was continued, the checkpoint of its unfinished part comes first.
TEST_F(CheckpointFolder, TheUnfinishedPartComesFirst) {
  save(run_ / checkpoint_name);
  EXPECT_TRUE(find_checkpoint(run_.string()).finished);
  save(unfinished_ / checkpoint_name);
  EXPECT_FALSE(find_checkpoint(run_.string()).finished);
  EXPECT_TRUE(find_checkpoint((run_ / checkpoint_name).string()).finished) << "but this names the file itself";
}

TEST_F(CheckpointFolder, IsFoundFromWithin) {
  save(unfinished_ / checkpoint_name);
  const fs::path here = fs::current_path();
  fs::current_path(unfinished_);
  const CheckpointPlace place = find_checkpoint(checkpoint_name);
  EXPECT_EQ(fs::canonical(place.folder), fs::canonical(run_));
  EXPECT_FALSE(place.finished);
  fs::current_path(run_);
  EXPECT_EQ(fs::canonical(find_checkpoint(".").folder), fs::canonical(run_));
  EXPECT_EQ(fs::canonical(find_checkpoint(std::string(unfinished_name) + "/" + checkpoint_name).folder),
            fs::canonical(run_));
  fs::current_path(here);
}

TEST_F(CheckpointFolder, WhereThereIsNoneItSaysWhatThereIs) {
  EXPECT_THAT(complaint(), EndsWith("run: holds no checkpoint; expected a checkpoint, or the folder of a run that "
                                    "wrote one"));
  folder_.write("run/summary.json", "{}");
  EXPECT_THAT(
      complaint(),
      HasSubstr("run: holds a finished run that kept no checkpoint; to go further, run it again with one: carom run "));
  save(run_ / previous_checkpoint_name);
  EXPECT_THAT(complaint(), HasSubstr("run: lacks its checkpoint.carom; the earlier one is there: carom resume "));
}

TEST_F(CheckpointFolder, WhereARunGoesOnItSaysSo) {
  const OutputFolder going_on(run_, folder_.write("scene.toml", ""), true);
  EXPECT_THAT(complaint(), EndsWith("run: another run is writing there, and has no checkpoint yet; expected the folder "
                                    "of a run that has stopped"));
}

TEST_F(CheckpointFolder, TheOneBeforeIsNamedWhereItHelps) {
  folder_.write("run/" + std::string(unfinished_name) + "/" + checkpoint_name, "damaged");
  EXPECT_THAT(complaint(), Not(HasSubstr("before")));
  save(unfinished_ / previous_checkpoint_name);
  EXPECT_THAT(complaint(), HasSubstr("; the earlier one is intact: carom resume "));
  const std::string scene = folder_.write("run/" + std::string(unfinished_name) + "/scene.toml", "[box]\n");
  EXPECT_THAT(complaint_of([&] { read_checkpoint_at(find_checkpoint(scene)); }),
              EndsWith("expected a checkpoint.carom, or the folder of a run"))
      << "the user took this file for a checkpoint; checkpoint.carom may be whole";
  // There is no checkpoint before the previous one.
  folder_.write("run/" + std::string(unfinished_name) + "/" + previous_checkpoint_name,
                test::text_of(unfinished_ / previous_checkpoint_name).substr(0, 100));
  const std::string previous = (unfinished_ / previous_checkpoint_name).string();
  const std::string said = complaint_of([&] { read_checkpoint_at(find_checkpoint(previous)); });
  EXPECT_EQ(said, previous + ": is damaged: it was cut short or changed after it was written");
}

// Neither reader may wait for a writer that never comes.
TEST_F(CheckpointFolder, APipeIsNoCheckpoint) {
  const std::string pipe = (unfinished_ / checkpoint_name).string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(complaint_of([&] { read_checkpoint(pipe); }), HasSubstr(pipe));
  EXPECT_THAT(complaint_of([&] { read_checkpoint_in_pieces(pipe); }), HasSubstr(pipe));
}

// --- Contents behind a checksum that is right -----------------------------------------------------------------------

class CheckpointBytes : public ::testing::Test {
 protected:
  // The error for these bytes, which must be the same from memory, from a file, and in pieces.
  std::string complaint(const std::string& bytes) const {
    const std::string file = folder_.write("c.carom", bytes);
    const std::string said = complaint_of([&] { checkpoint_from_bytes(bytes, file); });
    EXPECT_EQ(complaint_of([&] { read_checkpoint(file); }), said);
    EXPECT_EQ(complaint_of([&] { read_checkpoint_in_pieces(file); }), said);
    return said;
  }
  std::string complaint(const RunRecord& record, const State& state) const {
    return complaint(checkpoint_bytes(record, state));
  }
  // The bytes with this length of content, and a matching checksum.
  static std::string signed_again(std::string bytes, std::uint64_t content) {
    std::memcpy(&bytes[bytes.size() - 16], &content, 8);
    BlockHash hash;
    hash.add(bytes.data(), bytes.size() - 8);
    const std::uint64_t sum = hash.value();
    std::memcpy(&bytes[bytes.size() - 8], &sum, 8);
    return bytes;
  }
  static std::uint64_t content_of(const std::string& bytes) {
    std::uint64_t content = 0;
    std::memcpy(&content, &bytes[bytes.size() - 16], 8);
    return content;
  }
  const test::TestFolder folder_{"checkpoint_bytes"};
};

TEST_F(CheckpointBytes, AChangedBitIsSeenWhereverTheyLie) {
  const std::string whole = checkpoint_bytes({}, two_disks());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string bytes = whole;
    bytes[k] = static_cast<char>(bytes[k] ^ (1 << (k % 8)));
    EXPECT_NE(complaint(bytes), "") << k;
  }
}

// A new checkpoint may replace an older one, or an empty file.
TEST_F(CheckpointBytes, AnotherFileIsOneThatHoldsSomethingElse) {
  EXPECT_FALSE(is_another_file(folder_.write("c.carom", checkpoint_bytes({}, two_disks()))));
  EXPECT_FALSE(is_another_file(folder_.write("empty", "")));
  EXPECT_FALSE(is_another_file(folder_.path() / "none"));
  EXPECT_TRUE(is_another_file(folder_.write("short", "car")));
  EXPECT_TRUE(is_another_file(folder_.write("text", "carom checkpoint")));
}

TEST_F(CheckpointBytes, ItsLengthIsTheOneThatItSays) {
  const std::string whole = checkpoint_bytes({}, two_disks());
  const std::uint64_t content = content_of(whole);
  EXPECT_EQ(complaint(signed_again(whole, content)), "");
  for (const std::uint64_t other : {content + 8, content - 8, std::uint64_t{0}, std::uint64_t{1} << 63}) {
    EXPECT_THAT(complaint(signed_again(whole, other)), HasSubstr("is damaged")) << other;
  }
  std::string longer = whole;
  longer.insert(longer.size() - 16, std::string(8, '\0'));
  EXPECT_THAT(complaint(signed_again(longer, content)), HasSubstr("is damaged"));
  EXPECT_THAT(complaint(signed_again(longer, content + 8)), HasSubstr("holds more data than it should"));
}

TEST_F(CheckpointBytes, NothingIsOfDisksThatWereNeverMade) {
  State state = two_disks();
  state.last_contact = {1.0, 2.0, 3.0};
  EXPECT_THAT(complaint({}, state), HasSubstr("has contact times of ids that were never given"));
  state = two_disks();
  state.thermal_hits = {1, 2, 3};
  EXPECT_THAT(complaint({}, state), HasSubstr("has reflections of ids that were never given"));
  state = two_disks();
  state.disks.id = {0, 2};
  EXPECT_THAT(complaint({}, state), HasSubstr("has a disk with an id that was never given"));
  state = two_disks();
  state.disks.spin = {1.0, 2.0};
  EXPECT_THAT(complaint({}, state), HasSubstr("has spins of other disks"));
  state = two_disks();
  state.disks.inertia = 0.5;
  state.disks.spin = {1.0};
  EXPECT_THAT(complaint({}, state), HasSubstr("has spins of other disks"));
}

TEST_F(CheckpointBytes, ColumnsAreOfTheSameDisks) {
  for (const auto column : {&Disks::x, &Disks::y, &Disks::vx, &Disks::vy, &Disks::radius, &Disks::mass}) {
    State state = two_disks();
    (state.disks.*column).pop_back();
    EXPECT_THAT(complaint({}, state), HasSubstr("has columns of different lengths"));
    const bool needed = column != &Disks::radius && column != &Disks::mass;
    (state.disks.*column).clear();
    EXPECT_THAT(complaint({}, state), needed ? HasSubstr("has columns of different lengths") : HasSubstr(""));
  }
}

TEST_F(CheckpointBytes, ItNamesFilesOfItsFolderAlone) {
  for (const char* const name : {"", "..", "/etc/passwd", "../trajectory.xyz", "a/b"}) {
    RunRecord record;
    record.outputs.trajectory = FileMark{name, 1, 1};
    EXPECT_THAT(complaint(record, two_disks()), HasSubstr("names a file outside its folder")) << name;
  }
  RunRecord record;
  record.outputs.trajectory = FileMark{"trajectory.xyz", 1, 1};
  EXPECT_EQ(complaint(record, two_disks()), "");
}

// A run can go on only if these files exist with at least these lengths.
TEST(OutputMarks, AllFilesOfARunAreMissedWhereTheyAreGone) {
  OutputMark mark;
  EXPECT_TRUE(files_of(mark).empty());
  mark.trajectory = FileMark{"trajectory.xyz", 3, 500};
  mark.series.emplace().file = {"series.csv", 3, 90};
  mark.movie.emplace().parts = {"a.mp4", "b.mp4"};
  const auto said = [&] {
    std::string all;
    for (const MarkedFile& file : files_of(mark)) all += file.name + ":" + std::to_string(file.bytes) + " ";
    return all;
  };
  EXPECT_EQ(said(), "trajectory.xyz:500 series.csv:90 a.mp4:0 b.mp4:0 ");
  mark.movie = MovieMark{};
  mark.movie->single_frames = true;
  EXPECT_EQ(said(), "trajectory.xyz:500 series.csv:90 frames:0 ");
}

// A flag must be 0 or 1, and no list may be longer than the rest of the file, given the size of its entries.
TEST_F(CheckpointBytes, FlagsAndLengthsAreChecked) {
  State state = two_disks();
  const std::string whole = checkpoint_bytes({}, state);
  // Columns start with their length: here two entries, then 0 and 1, the positions of the disks.
  const std::uint64_t two = 2;
  const double places[] = {0.0, 1.0};
  std::string column(reinterpret_cast<const char*>(&two), 8);
  column.append(reinterpret_cast<const char*>(places), 16);
  const std::size_t at = whole.find(column);
  ASSERT_NE(at, std::string::npos);
  for (const std::uint64_t entries : {whole.size() / 8, whole.size() / 2, std::size_t{1} << 61}) {
    std::string spoilt = whole;
    std::memcpy(&spoilt[at], &entries, 8);
    EXPECT_THAT(complaint(signed_again(spoilt, content_of(whole))), HasSubstr("has a list longer than itself"));
  }
  State begun = state;
  begun.step_begun = true;
  const std::string other = checkpoint_bytes({}, begun);
  std::size_t flag = 0;
  while (whole[flag] == other[flag]) ++flag;
  std::string spoilt = whole;
  spoilt[flag] = 2;
  EXPECT_THAT(complaint(signed_again(spoilt, content_of(whole))), HasSubstr("has a flag that is neither 0 nor 1"));
}

}  // namespace
}  // namespace carom
