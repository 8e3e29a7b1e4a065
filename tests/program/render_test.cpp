// carom render: the format by the extension, the look by options and scene, for finished and unfinished runs.
#include <string>
#include <vector>

#include "io/files/folder_lock.hpp"
#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* small_scene = R"(title = "two groups"
[box]
width = 20.0
height = 10.0
[[disks]]
count = 10
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[[disks]]
count = 5
positions = "random"
radius = { uniform = [0.3, 0.9] }
mass = 3.0
[run]
method = "exact"
t_end = 2.0
[output]
every = 0.5
trajectory = "xyz"
movie = { colour = "group", fps = 5, size = [640, 400] }
)";

class Render : public test::ProgramTest {
 protected:
  Render() { write("small.toml", small_scene); }

  void run_small(const std::string& options = "") {
    const Outcome o = carom("run small.toml --quiet --force -o out " + options);
    ASSERT_EQ(o.status, 0) << o.err;
  }

  // Codec, width, height, frames per second, and number of frames.
  std::string probe(const std::string& file) {
    return shell(
               "ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,r_frame_rate,nb_read_frames"
               " -of csv=p=0 " +
               file)
        .out;
  }
};
using LongRender = Render;

// Half a character, or an invalid one, is an error for Cairo, which once drew nothing more: neither title nor colours.
TEST_F(Render, OddTitlesLeaveThePictureWhole) {
  std::string three_bytes_each = "x";
  for (int k = 0; k < 700; ++k) three_bytes_each += "日";
  for (const std::string& title : {three_bytes_each, std::string("\xef\xbf\xbe a \xef\xbf\xbf")}) {
    run_small("--set output.movie=false --set 'title=\"" + title + "\"'");
    const Outcome o = carom("render out -o out/last.svg --force");
    EXPECT_EQ(o.status, 0) << o.err;
  }
}

// A trajectory by itself is titled with its file name, which need not be UTF-8: such a picture once had neither title
// nor colours.
TEST_F(Render, AFileOfAnyNameHasTheWholePicture) {
  run_small("--set output.movie=false");
  for (const char* const name : {"b\344d.xyz", "b\357\277\275d.xyz"}) {
    fs::copy_file(at("out/trajectory.xyz"), at(name));
  }
  const Outcome o = shell("$C render b\344d.xyz -o a.svg && $C render b\357\277\275d.xyz -o b.svg");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(text_of(at("a.svg")), text_of(at("b.svg")));
}

// Drawing a disk that covers the box many times once took for ever.
TEST_F(Render, ADiskFarLargerThanTheBoxIsDrawn) {
  write("one.xyz",
        "1\nLattice=\"20 0 0 0 12 0 0 0 1\" pbc=\"F F F\" "
        "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:id:I:1 "
        "Time=0.5\nX 6.25 9.5 0 -2 0.5 0 1e300 1 0\n");
  const Outcome o = shell("timeout 60 $C render one.xyz -o one.svg && timeout 60 $C render one.xyz -o one.png");
  EXPECT_EQ(o.status, 0) << o.err;
}

// A render that was stopped once left a folder with a part of the movie.
TEST_F(LongRender, OneThatIsStoppedLeavesNothingBehind) {
  run_small("--set output.movie=false --set output.every=2e-4");
  fs::create_directories(at("film"));
  const Outcome o = shell(
      "$C render out -o film/movie.mp4 & P=$!; until ls film/movie.mp4.unfinished/made/* >/dev/null 2>&1 || ! kill -0 "
      "$P; do sleep 0.01; done; "
      "kill -TERM $P; wait $P");
  EXPECT_EQ(o.status, 128 + 15);
  EXPECT_TRUE(fs::is_empty(at("film")));
}

// The second render once removed the work of the first, and asked whether the disk was full.
TEST_F(Render, TwoDoNotMakeOneFileAtOnce) {
  run_small("--set output.movie=false");
  fs::create_directories(at("a.svg.unfinished/made"));
  write("a.svg.unfinished/made/frame", "of the first");
  {
    FolderLock first;
    ASSERT_TRUE(first.take(at("a.svg.unfinished")));
    const Outcome o = carom("render out -o a.svg");
    EXPECT_EQ(o.status, 2);
    EXPECT_EQ(o.err, "carom: error: a.svg: another carom render is writing this file; expected another file (-o)\n");
    EXPECT_EQ(text_of(at("a.svg.unfinished/made/frame")), "of the first");
  }
  EXPECT_EQ(carom("render out -o a.svg").status, 0) << "the rest of a killed render must not matter";
  EXPECT_FALSE(fs::exists(at("a.svg.unfinished")));
}

TEST_F(LongRender, TheScenesMovieLooksAsItSays) {
  run_small();
  EXPECT_EQ(probe("out/movie.mp4"), "h264,640,400,5/1,5\n");
  ASSERT_EQ(carom("render out -o again.mp4 --quiet").status, 0);
  EXPECT_EQ(text_of(at("again.mp4")), text_of(at("out/movie.mp4")));
}

TEST_F(LongRender, TheExtensionSaysWhatItBecomes) {
  run_small();
  for (const auto& [file, expected] :
       {std::pair{"a.mp4", "h264,640,400,10/1,5\n"}, std::pair{"a.webm", "vp9,640,400,10/1,5\n"},
        std::pair{"a.GIF", "gif,640,400,10/1,5\n"}}) {
    const Outcome o = carom(std::string("render out --fps 10 -o ") + file);
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.out, std::string(file) + "\n");
    EXPECT_EQ(probe(file), expected) << file;
  }
  ASSERT_EQ(carom("render out -o last.png --size 800x600").status, 0);
  ASSERT_EQ(carom("render out -o fifth.png --size 800x600 --frame 5").status, 0);
  EXPECT_THAT(text_of(at("last.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(text_of(at("last.png")), text_of(at("fifth.png"))) << "without --frame it is the last frame";
  EXPECT_THAT(probe("last.png"), StartsWith("png,800,600,"));
  ASSERT_EQ(carom("render out/trajectory.xyz -o picture.svg --colour radius --frame 1").status, 0);
  EXPECT_THAT(text_of(at("picture.svg")), HasSubstr("<svg"));
  EXPECT_THAT(text_of(at("picture.svg")), HasSubstr("</svg>"));
}

TEST_F(Render, WhatItCannotMakeIsRefusedInOneLine) {
  run_small();
  const auto refused = [&](const std::string& options, const std::string& message) {
    const Outcome o = carom("render out " + options);
    EXPECT_EQ(o.status, 2) << options;
    EXPECT_THAT(o.err, HasSubstr(message)) << options;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  };
  refused("-o film.avi", "film.avi\" ends in \".avi\"; expected .mp4, .webm or .gif for a movie, .png or .svg");
  refused("-o film", "expected .mp4");
  refused("-o film.mp4 --frame 2", "is a movie, but --frame draws a picture; expected .png or .svg");
  refused("-o x.png --frame 6", "there is no frame 6; expected 1 to 5");
  refused("-o x.png --colour sped",
          "there is no \"sped\"; expected one of speed, group, radius, mass, id (nearest: speed)");
  refused("-o x.png --range 0:1", "--range: cannot be used; groups have colours of their own");
  refused("-o x.png --colour mass --range 2:1", "expected two numbers, the lower first");
  refused("-o x.png --size 641x400", "expected a width and a height in pixels, even numbers from 320 to 8192");
  refused("-o x.png --size 640", "expected WIDTHxHEIGHT, as in 1280x720");
  refused("-o x.gif --fps 60", "expected at most 50 for a GIF");
  refused("-o x.mp4 --fps 0", "expected from 0.1 to 1000 frames a second");
  refused("-o small.toml/x.png", "small.toml/x.png: cannot be written: Not a directory");
  for (const char* const file : {"film.avi", "film", "film.mp4", "x.png", "x.gif", "x.mp4"})
    EXPECT_FALSE(fs::exists(at(file)));
}

// Without ffmpeg a movie is a folder of frames, which is only replaced on request, like a file.
TEST_F(LongRender, FramesOfAMovieAreReplacedByForceOnly) {
  run_small("--set output.movie=false");
  const std::string render = "PATH=/nonexistent $C render out ";
  const Outcome first = shell(render);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out, "out/frames\n");
  write("out/frames/frame_000099.png", "of a longer run");
  const Outcome refused = shell(render);
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "carom: error: out/frames: exists already; choose another folder with -o, or replace it with --force\n");
  const Outcome again = shell(render + "--force --quiet");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(fs::exists(at("out/frames/frame_000005.png")));
  EXPECT_FALSE(fs::exists(at("out/frames/frame_000099.png"))) << "no frame of an earlier movie may remain";
  EXPECT_FALSE(fs::exists(at("out/movie.mp4.unfinished")));
  write("out/frames/notes.txt", "mine");
  const Outcome mine = shell(render + "--force");
  EXPECT_EQ(mine.status, 2);
  EXPECT_THAT(mine.err, HasSubstr("out/frames: is not a folder that holds only frames; choose another folder"));
  EXPECT_EQ(text_of(at("out/frames/notes.txt")), "mine");
}

// While a run is going on, or after it was killed, only a part of its last frame may exist.
TEST_F(LongRender, AnUnfinishedRunIsShownAsFarAsItCame) {
  run_small();
  fs::create_directories(at("broken/carom-unfinished"));
  const std::string whole = text_of(at("out/trajectory.xyz"));
  const std::size_t last = whole.rfind("15\nLattice");
  for (const std::size_t kept : {last, last + 1, last + 40, whole.size() - 300, whole.size() - 1}) {
    std::ofstream(at("broken/carom-unfinished/trajectory.xyz")) << whole.substr(0, kept);
    const Outcome o = carom("render broken -o part.mp4 --force");
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_THAT(probe("part.mp4"), ::testing::EndsWith(",4\n")) << kept;
  }
  EXPECT_EQ(carom("render broken/carom-unfinished -o part.png").status, 0);
  EXPECT_EQ(carom("render broken/carom-unfinished/trajectory.xyz -o part.png --force").status, 0);

  const Outcome stopped = carom("run small.toml --quiet -o cut --max-walltime 1e-6 --set output.trajectory=h5md");
  ASSERT_EQ(stopped.status, 4) << stopped.err;
  const Outcome o = carom("render cut");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out, "cut/movie.mp4\n");
  ASSERT_EQ(carom("resume cut --quiet").status, 0) << "the movie must not be in the way";
  EXPECT_EQ(probe("cut/movie.mp4"), "h264,640,400,5/1,5\n");
}

// One disk with a constant speed, so that the other frames do not change the colours.
TEST_F(Render, APictureIsOfTheFrameThatIsAskedFor) {
  const auto frame = [](const std::string& time, const std::string& place) {
    return "1\nLattice=\"10 0 0 0 8 0 0 0 1\" Origin=\"0 0 0\" pbc=\"F F F\" "
           "Properties=species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=" +
           time + "\nA " + place + " 1 0 0.5 1 0\n";
  };
  const std::vector<std::string> frames{frame("0", "2 2"), frame("1", "3 2")};
  std::vector<std::string> alone;
  for (const std::string& only : frames) {
    write("disk.xyz", only);
    ASSERT_EQ(carom("render disk.xyz -o alone.svg --force").status, 0);
    alone.push_back(text_of(at("alone.svg")));
  }
  write("disk.xyz", frames[0] + frames[1]);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    ASSERT_EQ(carom("render disk.xyz -o one.svg --force --frame " + std::to_string(k + 1)).status, 0);
    EXPECT_TRUE(text_of(at("one.svg")) == alone[k]) << "frame " << k + 1;
  }
  EXPECT_NE(alone[0], alone[1]);
}

// The scale covers all frames, so that pictures of a run can be compared. The scene beside a trajectory may belong to
// another run.
TEST_F(Render, TheScaleReachesOverAllFrames) {
  const auto picture_of_first = [&](const std::string& speed_of_second) {
    std::string frames;
    for (const std::string& speed : {std::string("1"), speed_of_second}) {
      frames +=
          "1\nLattice=\"8 0 0 0 6 0 0 0 1\" pbc=\"F F F\" "
          "Properties=species:S:1:pos:R:2:velo:R:2:radius:R:1:mass:R:1:id:I:1 Time=" +
          std::string(frames.empty() ? "0" : "1") + "\nX 2 2 " + speed + " 0 0.5 1 0\n";
    }
    write("t.xyz", frames);
    EXPECT_EQ(carom("render t.xyz --frame 1 -o t.svg --force").status, 0);
    return text_of(at("t.svg"));
  };
  const std::string slow = picture_of_first("1");
  EXPECT_EQ(picture_of_first("0.5"), slow);
  EXPECT_NE(picture_of_first("4"), slow);
}

TEST_F(Render, TheScenesScaleIsOfItsOwnColourAlone) {
  const auto picture = [&](const std::string& movie, const std::string& colour) {
    run_small("--set output.movie=false");
    std::string scene = text_of(at("out/scene.toml"));
    const std::string none = "movie = false";
    scene.replace(scene.find(none), none.size(), "movie = " + movie);
    write("out/scene.toml", scene);
    const Outcome o = carom("render out -o p.svg --force --colour " + colour);
    EXPECT_EQ(o.status, 0) << o.err;
    return text_of(at("p.svg"));
  };
  const std::string plain = picture("{ colour = \"mass\" }", "mass");
  EXPECT_EQ(picture("{ colour = \"radius\", range = [0, 50] }", "mass"), plain);
  EXPECT_NE(picture("{ colour = \"mass\", range = [0, 50] }", "mass"), plain);
}

TEST_F(Render, ASceneOfAnotherBoxIsNotThatOfTheTrajectory) {
  const std::string told =
      "carom: warning: title and sides come from the trajectory alone: a/scene.toml: has another box "
      "than trajectory.xyz";
  ASSERT_EQ(carom("run small.toml --quiet -o a --set output.movie=false").status, 0);
  for (const char* const other : {"box.width=21", "box.height=11", "box.left=periodic --set box.right=periodic"}) {
    ASSERT_EQ(carom(std::string("run small.toml --quiet --force -o b --set output.movie=false --set ") + other).status,
              0);
    ASSERT_EQ(carom("render b --force -o b.svg").err.find("warning"), std::string::npos);
    EXPECT_EQ(shell("cp b/trajectory.xyz a").status, 0);
    EXPECT_THAT(carom("render a --force -o a.svg").err, HasSubstr(told)) << other;
    EXPECT_THAT(carom("view a --force -o a.html").err, HasSubstr(told)) << other;
    EXPECT_EQ(carom("render a --force -o a.svg --quiet").err, "") << other;
    EXPECT_EQ(carom("view a --force -o a.html --quiet").err, "") << other;
  }
}

TEST_F(Render, ATrajectoryWithoutAFrameHasNoPicture) {
  write("empty.xyz", "");
  for (const std::string file : {"a.png", "a.svg", "a.mp4"}) {
    const Outcome o = carom("render empty.xyz -o " + file);
    EXPECT_EQ(o.status, 2);
    EXPECT_EQ(o.err, "carom: error: empty.xyz: holds no frame\n");
    EXPECT_FALSE(fs::exists(at(file)));
  }
}

TEST_F(Render, KeysOfTheSceneAreChecked) {
  const auto message = [&](const std::string& movie) {
    const Outcome o = carom("check small.toml --set 'output.movie=" + movie + "'");
    EXPECT_EQ(o.status, 2) << movie;
    return o.err;
  };
  EXPECT_THAT(message("3"), HasSubstr("output.movie: is an integer; expected true or false, or a table"));
  EXPECT_THAT(message("{ colour = \"red\" }"), HasSubstr("output.movie.colour: "));
  EXPECT_THAT(message("{ fps = 2000 }"), HasSubstr("fps: is 2000; expected from 0.1 to 1000 frames a second"));
  EXPECT_THAT(message("{ size = [640] }"), HasSubstr("has 1 number; expected two numbers"));
  EXPECT_THAT(message("{ size = [640, 300] }"),
              HasSubstr("size: is [640, 300]; expected a width and a height in pixels, even"));
  EXPECT_THAT(message("{ range = [1, 1] }"), HasSubstr("range: is [1, 1]; expected two numbers, the lower first"));
  EXPECT_THAT(message("{ colour = \"group\", range = [0, 1] }"),
              HasSubstr("is [0, 1]; groups have colours of their own"));
  EXPECT_THAT(message("{ colr = \"group\" }"), HasSubstr("(nearest: colour)"));
}

}  // namespace
}  // namespace carom
