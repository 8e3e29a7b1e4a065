// Axes, speeds and thinning of a page follow from the whole trajectory.
#include "io/view/view_maker.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/view/view_axis.hpp"
#include "tests/support/replayed_trajectory.hpp"

namespace carom {
namespace {

using nlohmann::json;

ViewMade made_of(const std::vector<TrajectoryFrame>& frames, const ViewStory& story, std::size_t most = 64'000'000) {
  ViewWork work;
  work.most_bytes = most;
  return make_view([&] { return std::make_unique<test::ReplayedTrajectory>(frames); }, "test", story, work);
}

json head_of(const ViewMade& made) {
  const std::string begin = "<script type=\"application/json\" id=\"head\">";
  const std::size_t at = made.page.find(begin) + begin.size();
  return json::parse(made.page.substr(at, made.page.find("</script>", at) - at));
}

// One disk in each of two frames, in a box of 20 by 7.
std::vector<TrajectoryFrame> two_frames(Vec2 from, Vec2 to, double radius_before, double radius_after) {
  std::vector<TrajectoryFrame> frames(2);
  frames[0].box = frames[1].box = Domain{20.0, 7.0};
  frames[0].box.sides[2] = frames[0].box.sides[3] = SideKind::periodic;
  frames[1].box = frames[0].box;
  append(frames[0].disks, {from.x, from.y, 0.0, 0.0, radius_before, 1.0, 0});
  append(frames[1].disks, {to.x, to.y, 0.0, 0.0, radius_after, 1.0, 0});
  frames[1].time = 1.0;
  return frames;
}

TEST(ViewMaker, AxesAreThoseOfTheBoxAndTheSmallestDiskOfAllFrames) {
  for (const auto& [before, after] : {std::pair{0.01, 1.0}, std::pair{1.0, 0.01}}) {
    const json head = head_of(made_of(two_frames({1.0, 1.0}, {2.0, 1.0}, before, after), {}));
    EXPECT_EQ(head["box"]["width"], 20.0) << "the box of the trajectory, if the story has none";
    EXPECT_EQ(head["box"]["height"], 7.0);
    EXPECT_EQ(head["axes"][0]["bits"], view_axis(20.0, false, 0.01).bits);
    EXPECT_EQ(head["axes"][1]["bits"], view_axis(7.0, true, 0.01).bits);
    EXPECT_EQ(head["axes"][0]["periodic"], false);
    EXPECT_EQ(head["axes"][1]["periodic"], true);
  }
  ViewStory story;
  story.box = Domain{40.0, 14.0};
  const json head = head_of(made_of(two_frames({1.0, 1.0}, {2.0, 1.0}, 0.5, 0.5), story));
  EXPECT_EQ(head["box"]["width"], 40.0);
  EXPECT_EQ(head["axes"][1]["periodic"], false);
}

// At time 1 the upper images are displaced by 4: a disk that comes in at the bottom, displaced by -4, has moved by 0.3.
TEST(ViewMaker, SpeedsAreThoseInTheShearedBox) {
  ViewStory story;
  story.box = Domain{20.0, 7.0};
  story.box.sides.fill(SideKind::periodic);
  story.box.shear = {4.0 / 7.0, 4.0, 0.0};
  EXPECT_NEAR(head_of(made_of(two_frames({10.0, 6.9}, {6.0, 0.2}, 0.1, 0.1), story))["fast"], 0.3, 0.01);
}

std::string ending_of(int n) {
  if (n % 100 >= 11 && n % 100 <= 13) return "th";
  return n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
}

// The first frame, and every n-th after it.
TEST(ViewMaker, LeavesOutAllBetweenEveryNthFrame) {
  std::vector<TrajectoryFrame> frames(2500);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].box = Domain{20.0, 7.0};
    frames[k].time = static_cast<double>(k);
    for (DiskId id = 0; id < 20; ++id) {
      const double noise = std::abs(std::sin(static_cast<double>(12345 * k + 678 * id)));
      append(frames[k].disks, {20.0 * noise, 7.0 * (1.0 - noise), 0.0, 0.0, 0.1, 1.0, id});
    }
  }
  const ViewMade all = made_of(frames, {});
  EXPECT_TRUE(all.left_out.empty());
  EXPECT_EQ(all.disk_frames, 50'000U);
  const std::size_t packed = all.packed_bytes * 4 / 3;
  std::set<int> seen;
  for (const std::size_t tenths : {20U,  30U,  40U,  50U,  60U,  70U,  80U,  90U,  100U, 104U, 108U,
                                   112U, 116U, 125U, 132U, 140U, 150U, 165U, 180U, 200U, 220U, 240U}) {
    const ViewMade some = made_of(frames, {}, all.page.size() - packed + 11 * packed / tenths);
    ASSERT_EQ(some.left_out.size(), 1U) << tenths;
    const int n = std::stoi(some.left_out[0].substr(std::string("shows every ").size()));
    EXPECT_EQ(some.left_out[0], "shows every " + std::to_string(n) + ending_of(n) + " frame of 2500");
    EXPECT_EQ(some.frames, (2500U + static_cast<unsigned>(n) - 1U) / static_cast<unsigned>(n));
    EXPECT_EQ(head_of(some)["leftOut"], json{some.left_out[0]});
    seen.insert(n);
  }
  EXPECT_GE(seen.size(), 8U);
  EXPECT_TRUE(seen.contains(11) || seen.contains(12) || seen.contains(13));
}

TEST(ViewMaker, SaysHowManyRowsOfTheSeriesItPlots) {
  ViewStory story;
  story.series = {{"t"}, {{0.0, 2.0}}, 4};
  const std::vector<TrajectoryFrame> frames = two_frames({1.0, 1.0}, {2.0, 1.0}, 0.5, 0.5);
  EXPECT_EQ(made_of(frames, story).left_out, std::vector<std::string>{"plots 2 of the 4 rows of series.csv"});
  story.series.rows = 2;
  EXPECT_TRUE(made_of(frames, story).left_out.empty());
}

}  // namespace
}  // namespace carom
