// Frames show everything at its place, and movies can be played by every player.
#include "io/movie/movie.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "core/base/check.hpp"
#include "io/movie/colour_map.hpp"
#include "tests/support/picture.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::one_disk;
using test::packed;
using test::pixel;
using test::square_box;
using ::testing::HasSubstr;

int count_of(const FramePainter& painter, std::uint32_t colour) {
  int count = 0;
  // The colour bar on the right has all colours, so only the box is searched.
  for (int row = 0; row < painter.height(); ++row) {
    for (int column = 0; column < painter.width() - 132; ++column)
      count += pixel(painter, column, row) == colour ? 1 : 0;
  }
  return count;
}

TEST(ColourMap, EndsAndMiddleOfViridis) {
  EXPECT_EQ(packed(viridis(0.0)), 0x440154U);
  EXPECT_EQ(packed(viridis(0.5)), 0x21908dU);
  EXPECT_EQ(packed(viridis(1.0)), 0xfde725U);
  EXPECT_EQ(packed(viridis(-1.0)), 0x440154U);
  EXPECT_EQ(packed(viridis(7.0)), 0xfde725U);
}

TEST(Frame, DiskIsWhereItIsInTheColourOfItsSpeed) {
  FramePainter painter({"test", square_box(10.0), 2.0, 1});
  EXPECT_EQ(painter.width() % 2, 0);
  EXPECT_EQ(painter.height() % 2, 0);
  painter.paint(one_disk(2.5, 7.5, 1.0, 1.0), 0.0);
  // The box is 800 pixels wide, with 28 to its left and 78 above.
  EXPECT_EQ(pixel(painter, 28 + 200, 78 + 200), packed(viridis(0.5)));
  EXPECT_EQ(pixel(painter, 28 + 600, 78 + 600), 0xffffffU);
  painter.paint(one_disk(7.5, 2.5, 9.0, 1.0), 0.1);
  EXPECT_EQ(pixel(painter, 28 + 200, 78 + 200), 0xffffffU);
  EXPECT_EQ(pixel(painter, 28 + 600, 78 + 600), packed(viridis(1.0)));
}

TEST(Frame, ADiskAcrossAPeriodicSideIsSeenOnBoth) {
  Domain box = square_box(10.0);
  FramePainter walls({"", box, 1.0, 1});
  box.sides.fill(SideKind::periodic);
  FramePainter periodic({"", box, 1.0, 1});
  const Disks corner = one_disk(0.1, 9.9, 1.0, 1.0);
  walls.paint(corner, 0.0);
  periodic.paint(corner, 0.0);
  EXPECT_EQ(pixel(periodic, 28 + 790, 78 + 790), packed(viridis(1.0)));
  EXPECT_EQ(pixel(walls, 28 + 790, 78 + 790), 0xffffffU);
  EXPECT_GT(count_of(periodic, packed(viridis(1.0))), 2 * count_of(walls, packed(viridis(1.0))));
}

TEST(Frame, EachKindOfSideLooksDifferent) {
  std::array<std::string, 3> sides;
  for (const SideKind kind : {SideKind::wall, SideKind::periodic, SideKind::sink}) {
    Domain box = square_box(10.0);
    box.sides.fill(kind);
    FramePainter painter({"", box, 1.0, 1});
    painter.paint({}, 0.0);
    sides[static_cast<std::size_t>(kind)].assign(reinterpret_cast<const char*>(painter.pixels()), painter.bytes());
  }
  EXPECT_NE(sides[0], sides[1]);
  EXPECT_NE(sides[1], sides[2]);
  EXPECT_NE(sides[0], sides[2]);
}

FrameStyle predicted(const Scene& scene, const Disks& first) {
  return frame_style(scene, scene.output.look, foreseen_values(scene, first));
}

TEST(FrameStyle, SpeedScaleCoversWhatIsExpected) {
  Scene scene;
  scene.box = square_box(10.0);
  scene.run.dt = 0.01;
  scene.run.t_end = 10.0;
  scene.output.every = 0.25;
  const Disks rest = one_disk(5.0, 5.0, 0.0, 1.0);
  EXPECT_EQ(predicted(scene, rest).high, 1.0) << "everything at rest";
  EXPECT_EQ(predicted(scene, rest).time_decimals, 2);
  EXPECT_EQ(predicted(scene, one_disk(5.0, 5.0, 3.0, 1.0)).high, 3.0);
  Disks mixed = one_disk(2.0, 5.0, 1.0, 1.0);
  append(mixed, {6.0, 5.0, 1.0, 0.0, 1.0, 100.0, 1});
  // kT = 101 / 4, the mean of 2 kT / m is 25.5, times 2.5: its root is 8.
  EXPECT_EQ(predicted(scene, mixed).high, 8.0) << "the light disk will be the faster";
  scene.physics.gravity = 0.5;
  EXPECT_EQ(predicted(scene, rest).high, 2.0) << "sqrt(2 g 4)";
  scene.physics.gravity = 0.0;
  scene.physics.diffusion = 0.1;
  EXPECT_EQ(predicted(scene, rest).high, 10.0) << "sqrt(2.5 * 4 D / dt)";
}

// Disks that come later, and sources of energy, count like those of the start.
TEST(FrameStyle, SpeedScaleCoversWhatComesLater) {
  Scene scene;
  scene.box = square_box(10.0);
  scene.run.t_end = 10.0;
  const Disks rest = one_disk(5.0, 5.0, 0.0, 1.0);
  Scene rain = scene;
  Source& source = rain.sources.emplace_back();
  source.region_low = source.region_high = {5.0, 9.0};
  source.radius.value = source.mass.value = 1.0;
  source.rate = 1.0;
  rain.physics.gravity = 1.0;
  EXPECT_EQ(predicted(rain, {}).high, 4.0) << "sqrt(2 g 8)";
  rain.sources[0].side = Side::top;
  EXPECT_EQ(predicted(rain, {}).high, 5.0) << "sqrt(2 g 9) = 4.2";
  Scene heated = scene;
  heated.box.temperatures[0] = 5.0;
  EXPECT_EQ(predicted(heated, rest).high, 5.0) << "sqrt(2.5 * 2 T / m)";
  Scene kicked = scene;
  kicked.physics.thermostat = {Thermostat::Kind::langevin, 20.0, 1.0, 0.1};
  EXPECT_EQ(predicted(kicked, rest).high, 10.0);
  Scene pushed = scene;
  pushed.box.motions[0].kind = SideMotion::Kind::steady;
  pushed.box.motions[0].speed = 4.0;
  EXPECT_EQ(predicted(pushed, rest).high, 8.0) << "twice the wall's speed";
}

// The list of groups shows fixed disks in the grey in which they are drawn.
TEST(FrameStyle, GroupsOfFixedDisksAreGrey) {
  Scene scene;
  scene.box = square_box(10.0);
  scene.groups.resize(2);
  scene.groups[0].count = 1;
  scene.groups[1].fixed = true;
  scene.output.look.colour = ColourBy::group;
  FramePainter painter(predicted(scene, one_disk(5.0, 5.0, 0.0, 1.0)));
  painter.paint({}, 0.0);
  const int column = painter.width() - 100, row = 86;  // within the first square of the list
  EXPECT_EQ(pixel(painter, column, row), packed(group_colour(0)));
  EXPECT_EQ(pixel(painter, column, row + 26), packed({150, 150, 150}));
}

Disks two_kinds() {
  Disks d = one_disk(2.5, 7.5, 1.0, 1.0);
  append(d, {7.5, 2.5, 0.0, 0.0, 2.0, 9.0, 10});
  return d;
}

// The colours of the two disks in a picture.
std::pair<std::uint32_t, std::uint32_t> colours_of(const Scene& scene, ColourBy colour) {
  Scene coloured = scene;
  coloured.output.look.colour = colour;
  FramePainter painter(predicted(coloured, two_kinds()));
  painter.paint(two_kinds(), 0.0);
  return {pixel(painter, 28 + 200, 78 + 200), pixel(painter, 28 + 600, 78 + 600)};
}

TEST(FrameStyle, ColoursFollowTheLook) {
  Scene scene;
  scene.box = square_box(10.0);
  scene.run.t_end = 1.0;
  scene.groups.resize(2);
  scene.groups[0].count = 10;
  scene.groups[1].count = 1;
  const std::pair ends{packed(viridis(0.0)), packed(viridis(1.0))};
  EXPECT_EQ(colours_of(scene, ColourBy::radius), ends) << "the scale goes from 1 to 2";
  EXPECT_EQ(colours_of(scene, ColourBy::mass), std::pair(packed(viridis(0.1)), packed(viridis(0.9)))) << "0 to 10";
  EXPECT_EQ(colours_of(scene, ColourBy::id), std::pair(packed(viridis(0.0)), packed(viridis(1.0)))) << "0 to 10";
  EXPECT_EQ(colours_of(scene, ColourBy::group), std::pair(packed(group_colour(0)), packed(group_colour(1))));
  scene.output.look.range = {-2.0, 2.0};
  EXPECT_EQ(colours_of(scene, ColourBy::speed), std::pair(packed(viridis(0.75)), packed(viridis(0.5))));
  EXPECT_EQ(colours_of(scene, ColourBy::radius), std::pair(packed(viridis(0.75)), packed(viridis(1.0))));
}

PictureLook by_radius() {
  PictureLook look;
  look.colour = ColourBy::radius;
  return look;
}

TEST(FrameStyle, OneValueHasOneColour) {
  SeenValues seen;
  seen.add(one_disk(1.0, 1.0, 0.0, 0.5), {});
  const FrameStyle style = frame_style("", square_box(10.0), by_radius(), seen);
  EXPECT_EQ(style.low, 0.5);
  EXPECT_EQ(style.high, 0.5);
  FramePainter painter(style);
  painter.paint(one_disk(2.5, 7.5, 0.0, 0.5), 0.0);
  EXPECT_EQ(pixel(painter, 28 + 200, 78 + 200), packed(viridis(0.5)));
}

TEST(FrameStyle, ScaleCoversAllFrames) {
  SeenValues seen;
  seen.add(one_disk(1.0, 1.0, 3.0, 0.5), {});
  seen.add(one_disk(1.0, 1.0, 1.0, 0.9), {2});
  EXPECT_EQ(colour_range({}, seen).high, 3.0);
  EXPECT_EQ(colour_range(by_radius(), seen).low, 0.5);
  EXPECT_EQ(colour_range(by_radius(), seen).high, 0.9);
  EXPECT_EQ(seen.groups, 3U);
}

TEST(Frame, SizeIsWhatTheLookSays) {
  for (const auto& [width, height] : {std::pair{1280, 720}, std::pair{320, 320}, std::pair{3840, 2160}}) {
    FrameStyle style{"a title", square_box(10.0), 1.0, 1};
    style.look.width = width;
    style.look.height = height;
    const FramePainter painter(style);
    EXPECT_EQ(painter.width(), width);
    EXPECT_EQ(painter.height(), height);
    const FrameLayout layout = frame_layout(style);
    EXPECT_GE(layout.left, 0.0);
    EXPECT_LE(layout.left + 10.0 * layout.scale, width);
    EXPECT_LE(layout.bottom, height);
    EXPECT_GE(layout.bottom - 10.0 * layout.scale, 0.0);
  }
}

// The description of a file by ffprobe: codec, pixel format, size, number of frames.
std::string probe(const std::string& path) {
  const std::string command =
      "ffprobe -v error -count_frames -show_entries "
      "stream=codec_name,pix_fmt,width,height,nb_read_frames -of default=nk=1:nw=1 '" +
      path + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text += static_cast<char>(c);
  return text;
}

class Movie : public ::testing::Test {
 protected:
  const test::TestFolder test_folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
  const std::string folder_ = test_folder_.path().string();
};
using LongMovie = Movie;

TEST_F(Movie, IsH264WithEveryFrame) {
  Domain box = square_box(10.0);
  box.height = 3.17;
  MovieWriter movie(folder_, {"test", box, 1.0, 1});
  EXPECT_FALSE(movie.single_frames());
  for (int k = 0; k < 12; ++k) movie.add(one_disk(1.0 + 0.5 * k, 1.5, 1.0, 1.0), 0.1 * k);
  movie.finish();
  EXPECT_EQ(probe(folder_ + "/movie.mp4"), "h264\n1120\n432\nyuv420p\n12\n");
  EXPECT_FALSE(fs::exists(folder_ + "/ffmpeg.log"));
}

TEST_F(LongMovie, OtherFormatsAndFramesPerSecond) {
  for (const auto& [format, codec] : {std::pair{MovieFormat::webm, "vp9"}, std::pair{MovieFormat::gif, "gif"}}) {
    FrameStyle style{"test", square_box(10.0), 1.0, 1};
    style.look.fps = 10.0;
    style.look.width = 400;
    style.look.height = 320;
    MovieWriter movie(folder_, style, format);
    for (int k = 0; k < 5; ++k) movie.add(one_disk(1.0 + 0.5 * k, 1.5, 1.0, 1.0), 0.1 * k);
    movie.finish();
    const std::string file = folder_ + "/" + movie_name(format);
    EXPECT_THAT(probe(file), ::testing::StartsWith(std::string(codec) + "\n400\n320\n"));
    EXPECT_THAT(probe(file), ::testing::EndsWith("\n5\n"));
    EXPECT_TRUE(is_whole_movie(file, format));
    // A file cut short anywhere is not whole.
    for (const std::uintmax_t lost : {1U, 100U, 1000U}) {
      fs::resize_file(file, fs::file_size(file) - lost);
      EXPECT_FALSE(is_whole_movie(file, format)) << codec << " " << lost;
    }
  }
}

TEST_F(LongMovie, WhatFfmpegSaysIsInTheError) {
  fs::create_directories(folder_ + "/movie.mp4");  // it cannot be opened as a file
  MovieWriter movie(folder_, {"test", square_box(1.0), 1.0, 1});
  try {
    // The pipe has a buffer, so the failure may show only at the end.
    for (int k = 0; k < 50; ++k) movie.add({}, 0.1 * k);
    movie.finish();
    FAIL() << "no error";
  } catch (const RunError& e) {
    EXPECT_THAT(e.what(), HasSubstr("movie.mp4: Is a directory"));
  }
}

TEST_F(Movie, WithoutFfmpegFramesArePictures) {
  const std::string saved = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  MovieWriter movie(folder_, {"test", square_box(1.0), 1.0, 1});
  setenv("PATH", saved.c_str(), 1);
  EXPECT_TRUE(movie.single_frames());
  movie.add({}, 0.0);
  movie.add({}, 0.1);
  movie.finish();
  EXPECT_TRUE(fs::exists(folder_ + "/frames/frame_000001.png"));
  EXPECT_TRUE(fs::exists(folder_ + "/frames/frame_000002.png"));
  EXPECT_FALSE(fs::exists(folder_ + "/movie.mp4"));
}

}  // namespace
}  // namespace carom
