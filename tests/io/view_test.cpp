// View files: packed data are read back within half a quantum, whatever disks come and go. How the page reports damage
// is tested in tests/browser.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/base/check.hpp"
#include "io/movie/colour_scale.hpp"
#include "io/view/base64.hpp"
#include "io/view/view_encoder.hpp"
#include "io/view/view_maker.hpp"
#include "io/view/view_page.hpp"
#include "tests/support/replayed_trajectory.hpp"
#include "tests/support/unpacked_block.hpp"

namespace carom {
namespace {

using testing::HasSubstr;
using testing::Not;

// Frames of disks that move, come, go and return; some frames have no disks.
std::vector<TrajectoryFrame> random_frames(unsigned seed, std::size_t count, std::size_t disks, bool periodic) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Domain box{20.0, 7.0};
  if (periodic) box.sides = {SideKind::periodic, SideKind::periodic, SideKind::wall, SideKind::sink};
  std::vector<Disk> all;
  for (DiskId id = 0; id < disks; ++id) {
    all.push_back({20.0 * unit(random), 7.0 * unit(random), unit(random) - 0.5, unit(random) - 0.5, 0.01 + unit(random),
                   1.0 + unit(random), 3 * id});
  }
  std::vector<TrajectoryFrame> frames(count);
  for (std::size_t k = 0; k < count; ++k) {
    frames[k].time = 0.25 * static_cast<double>(k);
    frames[k].box = box;
    for (Disk& d : all) {
      if (unit(random) < 0.1) d.vx = 8.0 * (unit(random) - 0.5);
      d.x += d.vx;
      d.y = std::clamp(d.y + d.vy, 0.0, 7.0);
      d.x = periodic ? d.x - 20.0 * std::floor(d.x / 20.0) : std::clamp(d.x, 0.0, 20.0);
      if (k % 17 == 5 || unit(random) < 0.05) continue;
      append(frames[k].disks, d);
      frames[k].group.push_back(d.id % 2);
    }
  }
  return frames;
}

// One more disk in every third frame.
std::vector<TrajectoryFrame> frames_with_more_and_more_disks() {
  auto frames = random_frames(5, 300, 30, true);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (std::size_t later = 0; 3 * later < k; ++later) {
      append(frames[k].disks,
             {0.05 * static_cast<double>(later), 3.0, 0.0, 0.0, 0.5, 1.0, 1000 + static_cast<DiskId>(later)});
      frames[k].group.push_back(2);
    }
  }
  return frames;
}

ViewEncoder encoded(const std::vector<TrajectoryFrame>& frames, const ViewAxes& axes, DiskId every = 1) {
  ViewEncoder encoder(axes, every);
  for (const TrajectoryFrame& frame : frames) encoder.add(frame);
  encoder.finish();
  return encoder;
}

// The largest distance in quanta; on a periodic axis to the nearest image.
double apart(const ViewAxis& axis, double x, std::uint32_t number) {
  double d = std::abs(x - axis.decode(number));
  if (axis.periodic) d = std::min(d, axis.length - d);
  return d / axis.quantum();
}

void expect_round_trip(const std::vector<TrajectoryFrame>& frames, const ViewAxes& axes, DiskId every = 1) {
  const ViewEncoder encoder = encoded(frames, axes, every);
  const ViewDisks& table = encoder.disks();
  std::size_t next = 0;
  for (const ViewBlock& block : encoder.blocks()) {
    ASSERT_EQ(block.first, next);
    for (const ViewFrame& view : test::unpack(block, axes)) {
      const Disks& disks = frames[next].disks;
      EXPECT_EQ(encoder.times()[next], frames[next].time);
      std::map<DiskId, std::size_t> expected;
      for (std::size_t i = 0; i < disks.size(); ++i) {
        if (disks.id[i] % every == 0) expected[disks.id[i]] = i;
      }
      ASSERT_EQ(view.place.size(), expected.size()) << "frame " << next;
      EXPECT_TRUE(std::is_sorted(view.place.begin(), view.place.end()));
      for (std::size_t k = 0; k < view.place.size(); ++k) {
        const std::uint32_t place = view.place[k];
        ASSERT_EQ(expected.count(table.id[place]), 1U);
        const std::size_t i = expected[table.id[place]];
        EXPECT_LE(apart(axes[0], disks.x[i], view.at[0][k]), 0.5 + 1e-9);
        EXPECT_LE(apart(axes[1], disks.y[i], view.at[1][k]), 0.5 + 1e-9);
        EXPECT_EQ(table.radius[place], disks.radius_of(i));
        EXPECT_EQ(table.mass[place], disks.mass_of(i));
        EXPECT_EQ(table.group[place], frames[next].group[i]);
      }
      ++next;
    }
  }
  EXPECT_EQ(next, frames.size());
}

TEST(ViewBlocks, DisksThatMoveComeAndGoComeBackWithinHalfAStep) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    for (const bool periodic : {false, true}) {
      for (const double radius : {1.0, 1e-3, 1e-9}) {
        const ViewAxes axes{view_axis(20.0, periodic, radius), view_axis(7.0, false, radius)};
        expect_round_trip(random_frames(seed, 150, 1 + 13 * seed, periodic), axes);
        expect_round_trip(random_frames(seed, 20, 40, periodic), axes, 4);
      }
    }
  }
}

TEST(ViewBlocks, NoDisksAreFramesAsWell) {
  expect_round_trip(random_frames(1, 70, 0, true), {view_axis(20.0, true, 1.0), view_axis(7.0, false, 1.0)});
  expect_round_trip(random_frames(1, 1, 3, true), {view_axis(20.0, true, 1.0), view_axis(7.0, false, 1.0)});
}

// Other programs write frames with differing columns.
TEST(ViewBlocks, GroupsAreThoseOfTheirDisksWhereFramesLackThem) {
  std::vector<TrajectoryFrame> frames(2);
  append(frames[0].disks, {1.0, 2.0, 0.0, 0.0, 0.5, 1.0, 4});
  append(frames[1].disks, {1.0, 2.0, 0.0, 0.0, 0.5, 1.0, 7});
  frames[1].time = 1.0;
  frames[1].group = {3};
  const ViewEncoder encoder = encoded(frames, {view_axis(20.0, true, 1.0), view_axis(7.0, false, 1.0)});
  EXPECT_THAT(encoder.disks().group, testing::ElementsAre(0, 3));
}

// The head of such a page was once not valid JSON, and the page reported a truncated file.
TEST(ViewPage, ASpeedBeyondAllNumbersIsNone) {
  std::vector<TrajectoryFrame> frames(2);
  for (TrajectoryFrame& frame : frames) append(frame.disks, {1.0, 2.0, 0.0, 0.0, 0.5, 1.0, 4});
  frames[1].disks.x[0] = 3.0;
  frames[1].time = 1e-200;
  const ViewEncoder encoder = encoded(frames, {view_axis(20.0, true, 1.0), view_axis(7.0, false, 1.0)});
  EXPECT_THAT(view_page(ViewStory{}, encoder, {}), HasSubstr("\"fast\":null"));
}

TEST(LongViewBlocks, ManyDisksMakeBlocksOfFewFrames) {
  const auto frames = random_frames(3, 10, 300'000, true);
  const ViewAxes axes{view_axis(20.0, true, 0.01), view_axis(7.0, false, 0.01)};
  const ViewEncoder encoder = encoded(frames, axes);
  ASSERT_EQ(encoder.blocks().size(), 2U);
  EXPECT_EQ(encoder.blocks()[0].frames, 8U);
  const std::vector<ViewFrame> last = test::unpack(encoder.blocks()[1], axes);
  EXPECT_EQ(last.back().place.size(), frames.back().disks.size());
}

// Blocks packed together have the same bytes as blocks packed one by one, also if later blocks have more disks.
TEST(ViewBlocks, HowManyAtOnceChangesNoByte) {
  const auto frames = frames_with_more_and_more_disks();
  const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(7.0, false, 0.1)};
  const ViewEncoder one = encoded(frames, axes);
  ViewEncoder three(axes, 1, 3);
  for (const TrajectoryFrame& frame : frames) three.add(frame);
  three.finish();
  ASSERT_EQ(one.blocks().size(), three.blocks().size());
  ASSERT_GT(one.blocks().size(), 3U);
  for (std::size_t b = 0; b < one.blocks().size(); ++b) EXPECT_EQ(one.blocks()[b].packed, three.blocks()[b].packed);
}

TEST(ViewAxes, AStepIsASixtyFourthOfTheSmallestRadiusAtMost) {
  EXPECT_EQ(view_axis(100.0, false, 1.0).bits, 16U);
  EXPECT_EQ(view_axis(1772.0, true, 0.5).bits, 18U);
  EXPECT_LE(64.0 * view_axis(1772.0, true, 0.5).quantum(), 0.5);
  EXPECT_EQ(view_axis(100.0, false, 1e-12).bits, 24U);
  const ViewAxis wall = view_axis(10.0, false, 1.0);
  EXPECT_EQ(wall.decode(wall.encode(10.0)), 10.0);
  EXPECT_EQ(wall.encode(11.0), wall.mask());
  EXPECT_EQ(wall.encode(-1.0), 0U);
  EXPECT_EQ(wall.encode(std::nan("")), 0U);
  const ViewAxis around = view_axis(10.0, true, 1.0);
  EXPECT_EQ(around.encode(10.0), 0U);
  EXPECT_EQ(around.encode(12.5), around.encode(2.5));
  EXPECT_EQ(around.encode(-2.5), around.encode(7.5));
}

// A disk in free flight takes far less than a byte for each axis, and one at rest nearly nothing.
TEST(ViewBlocks, FreeFlightIsShort) {
  std::vector<TrajectoryFrame> frames = random_frames(9, 1, 2000, false);
  std::vector<TrajectoryFrame> flight, still;
  for (int k = 0; k < 64; ++k) {
    still.push_back(frames[0]);
    flight.push_back(frames[0]);
    for (std::size_t i = 0; i < flight.back().disks.size(); ++i) {
      flight.back().disks.x[i] = 5.0 + 0.5 * frames[0].disks.x[i] + 0.01 * k * frames[0].disks.vx[i];
    }
  }
  const ViewAxes axes{view_axis(20.0, false, 1.0), view_axis(7.0, false, 1.0)};
  const auto cost = [&](const std::vector<TrajectoryFrame>& f) {
    const ViewEncoder e = encoded(f, axes);
    return static_cast<double>(e.packed_bytes()) / static_cast<double>(e.disk_frames());
  };
  EXPECT_LT(cost(still), 0.15);
  EXPECT_LT(cost(flight), 0.6);
}

// At time 1 the images above a sheared box are displaced by 4. A disk that rises through the top comes in at the
// bottom, displaced by -4: it has moved by 0.3. A position rounded up to the top is that of its image, too.
TEST(ViewBlocks, AcrossTheTopOfAShearedBoxPlacesAreThoseOfImages) {
  const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(7.0, true, 0.1)};
  const Shear shear{4.0 / 7.0, 4.0, 0.0};
  const auto frames_of = [&](Vec2 from, Vec2 to) {
    std::vector<TrajectoryFrame> frames(2);
    append(frames[0].disks, {from.x, from.y, 0.0, 0.0, 0.1, 1.0, 0});
    append(frames[1].disks, {to.x, to.y, 0.0, 0.0, 0.1, 1.0, 0});
    frames[1].time = 1.0;
    ViewEncoder encoder(axes, 1, 1, run_in_order, shear);
    for (const TrajectoryFrame& frame : frames) encoder.add(frame);
    encoder.finish();
    return encoder;
  };
  EXPECT_NEAR(frames_of({10.0, 6.9}, {6.0, 0.2}).fast_speed(), 0.3, 0.01);
  EXPECT_NEAR(frames_of({6.0, 0.2}, {10.0, 6.9}).fast_speed(), 0.3, 0.01);
  const ViewEncoder top = frames_of({10.0, 6.9}, {10.0, std::nextafter(7.0, 0.0)});
  const ViewFrame last = test::unpack(top.blocks().at(0), axes).at(1);
  EXPECT_EQ(last.at[1].at(0), 0U);
  EXPECT_NEAR(axes[0].decode(last.at[0].at(0)), 6.0, 0.01);
  const ViewEncoder bottom = frames_of({10.0, 0.1}, {10.0, 0.0});
  const ViewFrame there = test::unpack(bottom.blocks().at(0), axes).at(1);
  EXPECT_EQ(there.at[1].at(0), 0U);
  EXPECT_NEAR(axes[0].decode(there.at[0].at(0)), 10.0, 0.01) << "at the bottom itself";
}

// A disk that enters a region again has no position in the frame before from which its speed could be computed.
TEST(ViewBlocks, DisksThatComeBackHaveNoSpeed) {
  const ViewAxes axes{view_axis(20.0, false, 0.1), view_axis(7.0, false, 0.1)};
  const Disk coming{1.0, 1.0, 0.0, 0.0, 0.1, 1.0, 0}, staying{5.0, 5.0, 0.0, 0.0, 0.1, 1.0, 1};
  ViewEncoder encoder(axes, 1);
  for (const double time : {0.0, 1.0, 2.0}) {
    TrajectoryFrame frame;
    frame.time = time;
    if (time != 1.0) append(frame.disks, coming);
    append(frame.disks, staying);
    encoder.add(frame);
  }
  EXPECT_EQ(encoder.fast_speed(), 0.0);
}

TEST(ViewBlocks, NoBlockIsEmpty) {
  const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(7.0, false, 0.1)};
  EXPECT_EQ(encoded(random_frames(7, 64, 20, true), axes).blocks().size(), 1U);
}

// The page compares it before it unpacks a block.
TEST(ViewBlocks, TheChecksumIsThatOfThePackedBytes) {
  const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(7.0, false, 0.1)};
  const ViewEncoder encoder = encoded(random_frames(7, 100, 20, true), axes);
  ASSERT_EQ(encoder.blocks().size(), 2U);
  for (const ViewBlock& block : encoder.blocks()) EXPECT_EQ(block.check, crc_of(block.packed));
  EXPECT_EQ(crc_of("123456789"), 0xcbf43926U) << "CRC-32 as in zlib and PNG";
}

TEST(ViewPage, TextOfTheSceneNeverBecomesMarkup) {
  const std::string hostile = "</script><script>alert(1)</script><!--<img src=x onerror=alert(2)>\"'\x01";
  ViewStory story;
  story.title = hostile;
  story.box = Domain{20.0, 7.0};
  story.groups = {hostile};
  story.series = {{hostile}, {{1.0, std::nan("")}}, 2};
  const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(7.0, false, 0.1)};
  const std::string page = view_page(story, encoded(random_frames(7, 3, 2, true), axes), {hostile});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script&gt;"));
  EXPECT_THAT(page, HasSubstr("\\u003c/script\\u003e"));
  EXPECT_THAT(page, Not(HasSubstr("<!--embed")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST(ViewPage, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ViewSeries, ColumnsOfNumbersAndNoMoreRowsThanAskedFor) {
  std::string csv = "t,kinetic,gone\n";
  for (int k = 0; k < 100; ++k) csv += std::to_string(k) + ",0.5,\n";
  const ViewSeries series = read_view_series(csv, 90, "series.csv");
  EXPECT_EQ(series.names, (std::vector<std::string>{"t", "kinetic"}));
  EXPECT_EQ(series.rows, 100U);
  EXPECT_EQ(series.columns[0].size(), 25U);
  EXPECT_EQ(series.columns[0][1], 4.0);
  EXPECT_EQ(read_view_series("t,kinetic\n0,1\n1,2\n2,3\n", 1, "s").columns[1], (std::vector<double>{1.0, 3.0}))
      << "two rows are needed";
  EXPECT_EQ(read_view_series("t,kinetic\n-,1\n-,2\n", 30, "s").names, (std::vector<std::string>{"t", "kinetic"}))
      << "the time is kept whatever it contains";
  EXPECT_EQ(read_view_series("t,kinetic\n0,1\n1,2\n2", 30, "s").columns[1].size(), 2U) << "a row that is cut off";
  EXPECT_EQ(read_view_series("t,kinetic\n0,1\n1,2.5\n2,3.", 30, "s").columns[1], (std::vector<double>{1.0, 2.5}))
      << "the last number may lack digits";
  EXPECT_EQ(read_view_series("t,kinetic\r\n0,1\r\n1,2\r\n", 30, "s").columns[1], (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(read_view_series("t,kin", 30, "s").rows, 0U);
  for (const char* const row : {"1", "1,2,3", "1,2,"}) {
    const std::string text = std::string("t,kinetic\n0,1\n") + row + "\n2,3\n";
    try {
      read_view_series(text, 30, "s");
      FAIL() << "no error";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::StartsWith("s:3: has ")) << row;
    }
  }
  std::string even = "t\n";
  for (int k = 0; k < 90; ++k) even += std::to_string(k) + "\n";
  EXPECT_EQ(read_view_series(even, 90, "s").columns[0].size(), 90U) << "as many as were asked for";
}

TEST(ViewMaker, ThePageIsNoLongerThanAskedForAndSaysWhatItLacks) {
  const auto frames = random_frames(11, 1000, 60, true);
  const auto made_of = [&](std::size_t most) {
    ViewWork work;
    work.most_bytes = most;
    return make_view([&] { return std::make_unique<test::ReplayedTrajectory>(frames); }, "test", {}, work);
  };
  const ViewMade all = made_of(64'000'000);
  EXPECT_EQ(all.frames, 1000U);
  EXPECT_TRUE(all.left_out.empty());
  const std::size_t page_alone = all.page.size() - all.packed_bytes / 3 * 4;
  std::size_t frames_before = all.frames;
  for (const double part : {0.7, 0.4, 0.2}) {
    const auto most = static_cast<std::size_t>(static_cast<double>(page_alone) +
                                               part * static_cast<double>(all.packed_bytes) * 4 / 3);
    const ViewMade some = made_of(most);
    EXPECT_LE(some.page.size(), most);
    EXPECT_LT(some.frames, frames_before);
    EXPECT_EQ(some.disks, 60U) << "frames are dropped first";
    ASSERT_EQ(some.left_out.size(), 1U);
    EXPECT_THAT(some.left_out[0], testing::AllOf(HasSubstr("frame of 1000"), HasSubstr("every")));
    EXPECT_THAT(some.page, HasSubstr(some.left_out[0]));
    frames_before = some.frames;
  }
  const ViewMade few = made_of(page_alone + all.packed_bytes / 30);
  EXPECT_EQ(few.frames, 100U);
  EXPECT_LT(few.disks, 60U);
  EXPECT_EQ(few.left_out.size(), 2U);
  EXPECT_THROW(made_of(1000), InputError);
}

// Later blocks hold more disks, so an estimate from the first blocks would depend on how many of them are asked.
TEST(ViewMaker, WhatIsLeftOutDoesNotDependOnTheThreads) {
  const auto frames = frames_with_more_and_more_disks();
  const auto made_by = [&](std::size_t threads, std::size_t most) {
    ViewWork work;
    work.threads = threads;
    work.most_bytes = most;
    return make_view([&] { return std::make_unique<test::ReplayedTrajectory>(frames); }, "test", {}, work);
  };
  const ViewMade all = made_by(1, 64'000'000);
  const std::size_t page_alone = all.page.size() - all.packed_bytes / 3 * 4;
  for (const unsigned part : {4U, 30U}) {
    const std::size_t most = page_alone + all.packed_bytes / part;
    const ViewMade one = made_by(1, most);
    for (const unsigned threads : {2U, 8U}) EXPECT_EQ(made_by(threads, most).page, one.page) << threads;
  }
}

// A group has the same colour in a run's movie and in its page.
TEST(ViewMaker, GroupsHaveTheColoursOfMovies) {
  const auto frames = random_frames(12, 2, 4, false);
  const ViewMade made = make_view([&] { return std::make_unique<test::ReplayedTrajectory>(frames); }, "test", {}, {});
  std::string colours;
  for (DiskId group = 0; group < 8; ++group) {
    const Colour c = group_colour(group);
    colours += fmt::format("{}0x{:06x}", group > 0 ? ", " : "",
                           (std::lround(c.red) << 16) + (std::lround(c.green) << 8) + std::lround(c.blue));
  }
  EXPECT_THAT(made.page, HasSubstr("[" + colours + "]"));
}

}  // namespace
}  // namespace carom
