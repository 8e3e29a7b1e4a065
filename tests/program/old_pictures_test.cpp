// Movies and plots of runs continued from a checkpoint: none may remain that shows less than the run, and the run must
// not claim any that does not exist.
#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using ::testing::HasSubstr;

class OldPictures : public test::ProgramTest {
 protected:
  OldPictures() {
    write("busy.toml", test::busy_scene("pairwise", "checkpoint = \"1 h\"\nplots = [\"energy\"]\nmovie = true\n"));
    // Programs that fail at once.
    fs::create_directories(at("bin"));
    for (const char* const name : {"bin/ffmpeg", "bin/gnuplot"}) {
      write(name, "#!/bin/sh\nexit 1\n");
      fs::permissions(at(name), fs::perms::owner_all);
    }
  }

  // Continues the run to a later end, on a machine that can make neither movies nor plots.
  Outcome resume_without_pictures(const std::string& options) const {
    return shell("PATH=$PWD/bin:$PATH $C resume out --quiet --t-end 2 " + options);
  }
};
using LongOldPictures = OldPictures;

const std::string first_part = "run busy.toml --quiet -o out --t-end 1 --set output.every=0.5 ";

TEST_F(OldPictures, APartOfTheMovieThatIsGoneIsMissed) {
  ASSERT_EQ(carom(first_part + "--max-walltime 1e-9").status, 4);
  const fs::path unfinished = at("out/carom-unfinished");
  ASSERT_EQ(shell("rm out/carom-unfinished/movie_part_*").status, 0);
  const Outcome o = carom("resume out --quiet");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("movie_part_"));
  EXPECT_THAT(o.err, HasSubstr("No such file or directory; expected the file that the resumed run continues"));
  EXPECT_TRUE(fs::exists(unfinished / "checkpoint.carom"));
}

TEST_F(LongOldPictures, WhatCannotBeMadeAnewIsNotThatOfAnEarlierEnd) {
  ASSERT_EQ(carom(first_part).status, 0);
  ASSERT_TRUE(fs::exists(at("out/movie.mp4")) && fs::exists(at("out/energy.svg")));
  const Outcome o = resume_without_pictures("");
  EXPECT_EQ(o.status, 1);
  EXPECT_FALSE(fs::exists(at("out/movie.mp4")));
  EXPECT_FALSE(fs::exists(at("out/energy.svg")));
  EXPECT_THAT(o.err, HasSubstr("carom resume out draws the plots; carom render out makes the movie"));
  EXPECT_EQ(carom("render out --quiet").status, 0);
  carom("resume out --quiet");  // its status is 1, as no movie was made
  EXPECT_TRUE(fs::exists(at("out/movie.mp4")));
  EXPECT_TRUE(fs::exists(at("out/energy.svg")));
}

// Without a trajectory the movie could not be made again: the old one stays, and the message says what it shows.
TEST_F(LongOldPictures, AMovieThatIsAllThereIsStays) {
  ASSERT_EQ(carom(first_part + "--set output.trajectory='\"none\"'").status, 0);
  const Outcome o = resume_without_pictures("");
  EXPECT_EQ(o.status, 1);
  EXPECT_TRUE(fs::exists(at("out/movie.mp4")));
  EXPECT_THAT(o.err, HasSubstr("; movie.mp4 ends where the run ended before"));
}

}  // namespace
}  // namespace carom
