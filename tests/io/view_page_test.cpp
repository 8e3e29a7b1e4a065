// The data of a page: box, walls, sources and tables as the program in the page (viewer/) reads them.
#include "io/view/view_page.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "io/view/base64.hpp"
#include "io/view/view_encoder.hpp"
#include "io/view/view_story.hpp"

namespace carom {
namespace {

using nlohmann::json;

// Two frames of three disks, the last of which comes later.
std::vector<TrajectoryFrame> three_disks() {
  std::vector<TrajectoryFrame> frames(2);
  for (TrajectoryFrame& frame : frames) {
    append(frame.disks, {1.0, 2.0, 0.0, 0.0, 0.5, 3.0, 4});
    append(frame.disks, {5.0, 6.0, 0.0, 0.0, 0.25, 7.0, 6});
    frame.group = {1, 0};
  }
  append(frames[1].disks, {9.0, 3.0, 0.0, 0.0, 0.125, 1.0, 8});
  frames[1].group.push_back(2);
  frames[1].time = 1.5;
  return frames;
}

const ViewAxes axes{view_axis(20.0, true, 0.1), view_axis(8.0, false, 0.1)};

ViewEncoder encoded(const std::vector<TrajectoryFrame>& frames) {
  ViewEncoder encoder(axes, 1);
  for (const TrajectoryFrame& frame : frames) encoder.add(frame);
  encoder.finish();
  return encoder;
}

std::string element_of(const std::string& page, const std::string& kind, const std::string& id) {
  const std::string begin = "<script type=\"" + kind + "\" id=\"" + id + "\">";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

json head_of(const ViewStory& story, const ViewEncoder& encoder) {
  return json::parse(element_of(view_page(story, encoder, {}), "application/json", "head"));
}

TEST(ViewPageHead, HasTheBoxItsSidesAndTheirMotion) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  story.box.sides = {SideKind::periodic, SideKind::periodic, SideKind::wall, SideKind::sink};
  story.box.temperatures[2] = 0.5;
  story.box.shear = {0.25, 2.0, 1.0};
  story.box.motions[3] = SideMotion{SideMotion::Kind::steady, 0.5, 2.0};
  const json head = head_of(story, encoded(three_disks()));
  EXPECT_EQ(head["box"],
            json::parse(R"({"width":20.0,"height":8.0,"shear":0.25,)"
                        R"("sides":["periodic","periodic","wall","sink"],"thermal":[false,false,true,false]})"));
  EXPECT_EQ(head["insets"], json::parse("[null,null,null,[0.5,3.5]]"));
  EXPECT_EQ(head["shifts"], json::array());
  ASSERT_EQ(head["axes"].size(), 2U);
  for (const std::size_t axis : {0U, 1U}) {
    EXPECT_EQ(head["axes"][axis]["bits"], axes[axis].bits);
    EXPECT_EQ(head["axes"][axis]["periodic"], axis == 0);
    EXPECT_EQ(head["axes"][axis]["quantum"], axes[axis].quantum());
  }
}

TEST(ViewPageHead, HasWhatStandsInTheBox) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  Obstacle disk, wall, sink;
  disk.x = 1.0, disk.y = 2.0, disk.radius = 0.5;
  wall.x = 3.0, wall.y = 4.0, wall.dx = 1.0, wall.dy = 0.5, wall.kind = ObstacleKind::wall;
  sink.x = 5.0, sink.y = 6.0, sink.dx = -1.0, sink.kind = ObstacleKind::sink, sink.id = 1;
  story.obstacles = {wall, disk, sink};
  story.wall_motions.resize(2);
  story.wall_motions[1].pace = SideMotion{SideMotion::Kind::steady, 0.0, 1.0};
  story.wall_motions[1].along = {2.0, -1.0};
  story.sources = {{Side::top, {}, {}}, {{}, {1.0, 2.0}, {3.0, 5.0}}};
  story.groups = {"sand", ""};
  const json head = head_of(story, encoded(three_disks()));
  EXPECT_EQ(head["obstacles"], json::parse("[[1.0,2.0,0.5]]"));
  EXPECT_EQ(head["walls"], json::parse("[[3.0,4.0,4.0,4.5,0,0],[5.0,6.0,4.0,6.0,1,1]]"));
  EXPECT_EQ(head["shifts"], json::parse("[null,[[0.0,0.0],[3.0,-1.5]]]"));
  EXPECT_EQ(head["sources"], json::parse(R"([{"side":3},{"region":[1.0,2.0,3.0,5.0]}])"));
  EXPECT_EQ(head["groups"], json::parse(R"(["sand",""])"));
}

TEST(ViewPageHead, ColoursHaveTheirNames) {
  const ViewEncoder encoder = encoded(three_disks());
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  for (const auto& [colour, name] :
       {std::pair{ColourBy::speed, "speed"}, std::pair{ColourBy::group, "group"}, std::pair{ColourBy::radius, "radius"},
        std::pair{ColourBy::mass, "mass"}, std::pair{ColourBy::id, "id"}}) {
    story.colour = colour;
    EXPECT_EQ(head_of(story, encoder)["colour"], name);
  }
}

TEST(ViewPageHead, HasColumnsAndCurves) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  story.series = {{"t", "kinetic"}, {{0.0, 1.0}, {2.5, std::nan("")}}, 2};
  story.curves = {{"g(r)", {1.0, 2.0}, {3.0, 4.0}, false}, {"pressure", {5.0}, {6.0}, true}};
  const json head = head_of(story, encoded(three_disks()));
  EXPECT_EQ(head["series"], json::parse(R"({"names":["t","kinetic"],"columns":[[0.0,1.0],[2.5,null]]})"));
  EXPECT_EQ(head["curves"], json::parse(R"J([{"name":"g(r)","x":[1.0,2.0],"y":[3.0,4.0],"inTime":false},)J"
                                        R"J({"name":"pressure","x":[5.0],"y":[6.0],"inTime":true}])J"));
}

template <class Value>
void put(std::string& to, Value value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);  // little-endian, as on every processor that Carom runs on
  to.append(bytes, sizeof value);
}

// Times, then properties that differ between disks: viewer/decode.js reads them in this order.

TEST(ViewPageTable, HasTimesAndWhatDistinguishesDisks) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  std::vector<TrajectoryFrame> frames = three_disks();
  std::string expected;
  for (const double value : {0.0, 1.5, 0.5, 0.25, 0.125, 3.0, 7.0, 1.0}) put(expected, value);
  for (const std::uint32_t value : {4U, 6U, 8U, 1U, 0U, 2U}) put(expected, value);
  std::string page = view_page(story, encoded(frames), {});
  EXPECT_EQ(element_of(page, "text/plain", "table"), base64(deflated(expected)));
  json head = json::parse(element_of(page, "application/json", "head"));
  EXPECT_EQ(head["table"]["bytes"], deflated(expected).size());
  EXPECT_EQ(head["table"]["check"], crc_of(deflated(expected)));
  EXPECT_TRUE(head["radius"].is_null());
  EXPECT_TRUE(head["mass"].is_null());
  EXPECT_EQ(head["grouped"], true);
  EXPECT_EQ(head["disks"], 3);
  EXPECT_EQ(head["frames"], 2);
  // All disks are alike, and in one group.
  for (TrajectoryFrame& frame : frames) {
    frame.disks.radius.assign(frame.disks.size(), 0.5);
    frame.disks.mass.assign(frame.disks.size(), 3.0);
    frame.group.assign(frame.disks.size(), 1);
  }
  expected.clear();
  for (const double value : {0.0, 1.5}) put(expected, value);
  for (const std::uint32_t value : {4U, 6U, 8U}) put(expected, value);
  page = view_page(story, encoded(frames), {});
  EXPECT_EQ(element_of(page, "text/plain", "table"), base64(deflated(expected)));
  head = json::parse(element_of(page, "application/json", "head"));
  EXPECT_EQ(head["radius"], 0.5);
  EXPECT_EQ(head["mass"], 3.0);
  EXPECT_EQ(head["grouped"], false);
  EXPECT_EQ(head["group"], 1) << "disks that come later may have another";
}

TEST(ViewPageBlocks, AreListedAsTheyAre) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  std::vector<TrajectoryFrame> frames;
  for (int k = 0; k < 70; ++k) {
    frames.push_back(three_disks()[k == 0 ? 0 : 1]);
    frames.back().time = k;
  }
  const ViewEncoder encoder = encoded(frames);
  ASSERT_EQ(encoder.blocks().size(), 2U);
  const std::string page = view_page(story, encoder, {});
  const json head = json::parse(element_of(page, "application/json", "head"));
  ASSERT_EQ(head["blocks"].size(), 2U);
  for (const std::size_t b : {0U, 1U}) {
    const ViewBlock& block = encoder.blocks()[b];
    EXPECT_EQ(head["blocks"][b], (json{block.first, block.frames, block.residuals, block.packed.size(), block.check}));
    EXPECT_EQ(element_of(page, "text/plain", "block" + std::to_string(b)), base64(block.packed));
  }
  EXPECT_EQ(head["blocks"][0][0], 0);
  EXPECT_EQ(head["blocks"][0][1], 64);
  EXPECT_EQ(head["blocks"][0][2], 64 * 3 - 1);
  EXPECT_EQ(head["blocks"][1][0], 64);
  EXPECT_EQ(head["blocks"][1][1], 6);
}

// For a run that is going on: the data after this number of blocks and disks.
TEST(ViewNews, TellWhatAPageDoesNotHave) {
  ViewStory story;
  story.box = Domain{20.0, 8.0};
  story.box.motions[0] = SideMotion{SideMotion::Kind::steady, 0.0, 2.0};
  const ViewEncoder encoder = encoded(three_disks());
  json news = json::parse(view_news(story, encoder, 0, 2, "it \"runs\"", false));
  EXPECT_EQ(news["state"], "it \"runs\"");
  EXPECT_EQ(news["ended"], false);
  EXPECT_EQ(news["times"], (json{0.0, 1.5}));
  EXPECT_EQ(news["insets"], json::parse("[[0.0,3.0],null,null,null]"));
  EXPECT_EQ(news["id"], json{8});
  EXPECT_EQ(news["radius"], json{0.125});
  EXPECT_EQ(news["mass"], json{1.0});
  EXPECT_EQ(news["group"], json{2});
  EXPECT_EQ(news["blocks"].size(), 1U);
  news = json::parse(view_news(story, encoder, 1, 3, "", true));
  EXPECT_EQ(news["ended"], true);
  for (const char* const key : {"times", "id", "radius", "mass", "group", "blocks"}) {
    EXPECT_EQ(news[key], json::array()) << key;
  }
}

// 2.5 times the root mean square of the speeds shown, or the fastest if that is slower.
TEST(ViewSpeeds, EndWhereMostDisksAre) {
  const auto fast_of = [](const std::vector<double>& ways) {
    std::vector<TrajectoryFrame> frames(3);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      frames[k].time = 2.0 + 0.5 * static_cast<double>(k);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const double x = 10.0 + ways[i] * static_cast<double>(k);
        append(frames[k].disks, {x < 20.0 ? x : x - 20.0, 4.0, 0.0, 0.0, 0.1, 1.0, static_cast<DiskId>(i)});
      }
    }
    return encoded(frames).fast_speed();
  };
  EXPECT_NEAR(fast_of({1.0, 0.0}), 2.0, 1e-3) << "the fastest disk";
  EXPECT_NEAR(fast_of({0.0, 1.0}), 2.0, 1e-3);
  EXPECT_NEAR(fast_of({6.0, 6.0}), 12.0, 1e-3) << "across a periodic side";
  std::vector<double> one_of_many(25, 0.0);
  one_of_many[3] = 4.0;
  EXPECT_NEAR(fast_of(one_of_many), 2.5 * 8.0 / 5.0, 1e-2);
  EXPECT_EQ(fast_of({0.0}), 0.0);
}

TEST(ViewStory, SaysWhatTheSceneHas) {
  const Scene scene = parse_scene(R"(title = "all"
[box]
width = 20.0
height = 8.0
[[disks]]
name = "sand"
count = 1
positions = [[2.0, 2.0]]
radius = 0.5
mass = 1.0
[[walls]]
points = [[10.0, 1.0], [10.0, 3.0]]
motion = { velocity = [0.1, 0.0] }
[[sources]]
region = [12.0, 4.0, 18.0, 6.0]
rate = 1.0
radius = 0.1
mass = 1.0
[run]
method = "exact"
t_end = 1.0
[output]
movie = { colour = "mass" }
)",
                                  "scene", "");
  const ViewStory story = view_story(scene);
  EXPECT_EQ(story.title, "all");
  EXPECT_EQ(story.box.width, 20.0);
  EXPECT_EQ(story.groups, (std::vector<std::string>{"sand", "sources"}));
  ASSERT_EQ(story.sources.size(), 1U);
  EXPECT_EQ(story.sources[0].low.x, 12.0);
  EXPECT_EQ(story.sources[0].low.y, 4.0);
  EXPECT_EQ(story.sources[0].high.x, 18.0);
  EXPECT_EQ(story.sources[0].high.y, 6.0);
  EXPECT_FALSE(story.sources[0].side);
  ASSERT_EQ(story.obstacles.size(), 1U);
  EXPECT_EQ(story.obstacles[0].dy, 2.0);
  ASSERT_EQ(story.wall_motions.size(), 1U);
  EXPECT_EQ(story.wall_motions[0].largest_speed(), 0.1);
  EXPECT_EQ(story.colour, ColourBy::mass);
}

}  // namespace
}  // namespace carom
