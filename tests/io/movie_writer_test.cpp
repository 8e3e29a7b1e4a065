// Movies made with a program in place of ffmpeg, which fails as ffmpeg may, or reports success wrongly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/check.hpp"
#include "io/movie/movie.hpp"
#include "tests/support/picture.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::one_disk;
using test::square_box;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// Writes a whole MP4 file without frames.
constexpr const char* whole = R"(printf '\000\000\000\010ftyp\000\000\000\010moov' >"$file")";
constexpr const char* cut_short = R"(printf '\000\000\000\010ftyp' >"$file")";

class StandInFfmpeg : public ::testing::Test {
 protected:
  StandInFfmpeg() : path_(std::getenv("PATH")) {
    fs::create_directories(results());
    setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~StandInFfmpeg() override { setenv("PATH", path_.c_str(), 1); }

  std::string results() const { return folder_.path() / "results"; }
  // Defines what the program does with the frames of a part, and what with the parts; $file is its output.
  void does(const std::string& with_frames, const std::string& with_parts) const {
    const std::string program =
        folder_.write("ffmpeg", "#!/bin/sh\nfor file; do :; done\ncase \"$*\" in\n*concat*) " + with_parts +
                                    " ;;\n*) cat >/dev/null; " + with_frames + " ;;\nesac\n");
    fs::permissions(program, fs::perms::owner_all);
  }
  // Writes two frames, with a mark between them if `marked`.
  static void make(MovieWriter& movie, bool marked) {
    movie.add(one_disk(1.0, 1.0, 1.0, 0.5), 0.0);
    if (marked) movie.mark();
    movie.add(one_disk(2.0, 1.0, 1.0, 0.5), 1.0);
    movie.finish();
  }
  // The error; empty if there is none.
  std::string error(bool marked) const {
    MovieWriter movie(results(), {"", square_box(4.0), 1.0, 1});
    try {
      make(movie, marked);
    } catch (const RunError& e) {
      return e.what();
    }
    return "";
  }

 private:
  test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  std::string path_;
};

TEST_F(StandInFfmpeg, AWholeMovieIsTaken) {
  does(whole, "cp \"$(ls movie_part_* | head -1)\" \"$file\"");
  for (const bool marked : {false, true}) {
    EXPECT_EQ(error(marked), "");
    EXPECT_TRUE(is_whole_movie(results() + "/movie.mp4", MovieFormat::mp4));
  }
}

TEST_F(StandInFfmpeg, AFileThatWasCutShortIsAnErrorWhateverItSays) {
  constexpr const char* incomplete = "movie.mp4: the file is incomplete; is the disk full?";
  does(cut_short, whole);
  EXPECT_THAT(error(false), EndsWith(incomplete));
  EXPECT_THAT(error(true), EndsWith(incomplete));
  does(whole, cut_short);
  EXPECT_EQ(error(false), "") << "a single part is not joined";
  EXPECT_THAT(error(true), EndsWith(incomplete));
}

TEST_F(StandInFfmpeg, WhatItSaysLastIsInTheError) {
  const std::string fails = "; echo first; echo out of ideas >&2; exit 1";
  does(std::string(whole) + fails, whole);
  EXPECT_THAT(error(false), EndsWith("movie.mp4: out of ideas"));
  does(whole, std::string(whole) + fails);
  EXPECT_THAT(error(true), EndsWith("movie.mp4: out of ideas"));
}

// The scale of the colours and the digits of the time are those from the start of the movie.
TEST_F(StandInFfmpeg, AMarkSaysWithWhatTheMovieBegan) {
  does(whole, whole);
  FrameStyle style{"", square_box(4.0), 3.0, 2};
  style.low = 1.5;
  MovieWriter movie(results(), style);
  movie.add(one_disk(1.0, 1.0, 1.0, 0.5), 0.0);
  const MovieMark mark = movie.mark();
  EXPECT_EQ(mark.frames, 1U);
  EXPECT_FALSE(mark.single_frames);
  EXPECT_EQ(mark.low, 1.5);
  EXPECT_EQ(mark.high, 3.0);
  EXPECT_EQ(mark.time_decimals, 2);
  EXPECT_EQ(mark.parts.size(), 1U);
  EXPECT_EQ(movie.mark().parts, mark.parts) << "no frame has come since the mark";
  movie.add(one_disk(2.0, 1.0, 1.0, 0.5), 1.0);
  EXPECT_THAT(movie.finish().parts, ElementsAre("movie.mp4"));
}

// Parts that a killed run began after its checkpoint are removed; those named in the checkpoint stay and are joined.
TEST_F(StandInFfmpeg, AMovieGoesOnFromItsMark) {
  does(whole, "cat movie_parts.txt >list; " + std::string(whole));
  MovieMark mark;
  {
    MovieWriter killed(results(), {"", square_box(4.0), 1.0, 1});
    killed.add(one_disk(1.0, 1.0, 1.0, 0.5), 0.0);
    mark = killed.mark();
    killed.add(one_disk(2.0, 1.0, 1.0, 0.5), 1.0);
    killed.mark();
  }
  MovieWriter movie(results(), {"", square_box(4.0), 1.0, 1}, mark);
  movie.add(one_disk(2.0, 1.0, 1.0, 0.5), 1.0);
  EXPECT_EQ(movie.finish().frames, 2U);
  const std::string list = test::text_of(results() + "/list");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2) << list;
  EXPECT_THAT(list, HasSubstr("file '" + mark.parts.at(0) + "'\nfile 'movie_part_000000001_"));
}

}  // namespace
}  // namespace carom
