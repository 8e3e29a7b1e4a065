// carom view: one page from a run, finished or not, in any format; with bad input no file is left behind.
#include <cmath>

#include "tests/support/program_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* gas = R"(title = "a gas <of disks>"
[box]
packing_fraction = 0.5
left = "periodic"
right = "periodic"
[[disks]]
count = 1000
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[run]
method = "exact"
t_end = 5.0
[output]
every = 0.05
trajectory = "xyz"
series = true
)";

// The data that the page reads first.
nlohmann::json head_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"head\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

class View : public test::ProgramTest {
 protected:
  View() { write("gas.toml", gas); }
  void run(const std::string& options = "") {
    const Outcome o = carom("run gas.toml --quiet --force " + options);
    ASSERT_EQ(o.status, 0) << o.err;
  }
};
using LongView = View;

TEST_F(View, MakesOnePageThatCostsLittleMoreThanTwoBytesADiskAndFrame) {
  run("-o out");
  const Outcome o = carom("view out");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out, "out/view.html\n");
  EXPECT_THAT(o.err, HasSubstr("101 frames, 1000 disks, 0."));
  const std::string page = text_of(at("out/view.html"));
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("<title>a gas &lt;of disks&gt;</title>"));
  const std::size_t program = 64'000;  // bytes of a page without a run
  EXPECT_LT(page.size(), program + static_cast<std::size_t>(2.5 * 101 * 1000));
  EXPECT_NEAR(head_of(page)["fast"], 2.5 * std::sqrt(2.0), 0.6) << "2.5 root mean squares of the speeds, all but those "
                                                                   "of disks that collided between two frames";
  EXPECT_EQ(carom("view out --quiet --force").err, "");
  EXPECT_EQ(text_of(at("out/view.html")), page) << "the same run must give the same bytes";
}

TEST_F(View, BothFormatsOfATrajectoryMakeTheSamePage) {
  run("-o xyz --t-end 1");
  run("-o h5 --t-end 1 --set output.trajectory='\"h5md\"'");
  ASSERT_EQ(carom("view xyz -o xyz.html").status, 0);
  ASSERT_EQ(carom("view h5 -o h5.html").status, 0);
  EXPECT_EQ(text_of(at("xyz.html")), text_of(at("h5.html")));
}

TEST_F(View, NothingIsReplacedUnlessTold) {
  run("-o out --t-end 0.2");
  write("there.html", "mine");
  const Outcome o = carom("view out -o there.html");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("there.html: exists already"));
  EXPECT_EQ(text_of(at("there.html")), "mine");
  EXPECT_EQ(carom("view out -o there.html --force").status, 0);
  EXPECT_THAT(text_of(at("there.html")), StartsWith("<!doctype html>"));
}

TEST_F(View, WhereItCannotBeWrittenIsSaidBeforehand) {
  run("-o out --t-end 0.2");
  write("file", "mine");
  for (const std::string made : {"view out -o file/page.html", "view out -o file/sub/page.html",
                                 "render out -o file/picture.png", "render out -o file/sub/film.mp4"}) {
    const Outcome o = carom(made);
    EXPECT_EQ(o.status, 2) << made;
    EXPECT_EQ(o.err, "carom: error: " + made.substr(made.find("file/")) +
                         ": cannot be written: Not a directory; expected a file in another folder (-o)\n");
  }
  EXPECT_EQ(text_of(at("file")), "mine");
  EXPECT_EQ(carom("view out -o new/folder/page.html --quiet").status, 0) << "missing folders must be made";
  EXPECT_THAT(text_of(at("new/folder/page.html")), StartsWith("<!doctype html>"));
}

TEST_F(View, ARunThatWasKilledIsShownUpToItsLastFrame) {
  run("-o out --t-end 1");
  fs::create_directories(at("broken/carom-unfinished"));
  for (const char* const file : {"trajectory.xyz", "series.csv", "scene.toml"}) {
    const std::string whole = text_of(at(std::string("out/") + file));
    const bool cut = std::string(file) != "scene.toml";
    write(std::string("broken/carom-unfinished/") + file, cut ? whole.substr(0, whole.size() * 3 / 5) : whole);
  }
  const Outcome o = carom("view broken -o part.html");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("12 frames, 1000 disks"));
}

TEST_F(LongView, SizeIsKeptAndWhatIsLeftOutIsSaid) {
  run("-o out");
  const Outcome o = carom("view out -o small.html --max-size 100kB");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_LE(fs::file_size(at("small.html")), 100'000U);
  EXPECT_THAT(o.err, HasSubstr("carom: the page shows every"));
  EXPECT_THAT(text_of(at("small.html")), HasSubstr("shows every"));
  const Outcome tiny = carom("view out -o tiny.html --max-size 10kB");
  EXPECT_EQ(tiny.status, 2);
  EXPECT_THAT(tiny.err, HasSubstr("--max-size: 10000 bytes are too few"));
  EXPECT_FALSE(fs::exists(at("tiny.html")));
}

TEST_F(View, CurvesOfTheAnalysisAreOnThePage) {
  run("-o out --t-end 0.5 --set 'analysis.what=[\"pair_correlation\", \"displacement\", \"profile\"]'"
      " --set 'analysis.pair_correlation={ r_max = 4.0, bins = 800 }' --set analysis.every=0.1");
  ASSERT_EQ(carom("view out").status, 0);
  const nlohmann::json curves = head_of(text_of(at("out/view.html")))["curves"];
  std::vector<std::string> names;
  for (const auto& curve : curves) names.push_back(curve["name"]);
  EXPECT_THAT(names, testing::ElementsAre("g(r), 1 point of 2", "mean vx (position)", "mean vy (position)",
                                          "temperature (position)", "mean square displacement"));
  const auto r = curves[0]["x"].get<std::vector<double>>(), g = curves[0]["y"].get<std::vector<double>>();
  ASSERT_EQ(r.size(), 400U);
  double contact = 0.0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (r[k] < 0.99) {
      EXPECT_EQ(g[k], 0.0) << "disks do not overlap at r = " << r[k];
    } else if (r[k] > 1.0 && r[k] < 1.1) {
      contact = std::max(contact, g[k]);
    }
  }
  EXPECT_NEAR(contact, 3.2, 0.8) << "g at contact is 3.1 at this packing fraction";
  EXPECT_EQ(curves[0]["inTime"], false);
  EXPECT_EQ(curves[4]["inTime"], true);
  EXPECT_EQ(curves[4]["x"], (nlohmann::json{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}));
  write("out/analysis.h5", "no HDF5");
  const Outcome o = carom("view out --force");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.err, HasSubstr("warning: the page has no curves of the analysis: out/analysis.h5: cannot be read"));
}

TEST_F(View, ADamagedTrajectoryIsNamedAndLeavesNothing) {
  run("-o out --t-end 0.2");
  std::string text = text_of(at("out/trajectory.xyz"));
  text.replace(text.rfind("X "), 4, "X ?!");
  write("out/trajectory.xyz", text);
  const Outcome o = carom("view out");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("out/trajectory.xyz:"));
  EXPECT_FALSE(fs::exists(at("out/view.html")));
  write("out/trajectory.xyz", "");
  EXPECT_THAT(carom("view out").err, HasSubstr("out/trajectory.xyz: holds no frame"));
}

TEST_F(View, WithoutASceneTheTrajectoryIsEnough) {
  run("-o out --t-end 0.2");
  fs::remove(at("out/scene.toml"));
  fs::remove(at("out/series.csv"));
  const Outcome o = carom("view out/trajectory.xyz -o alone.html");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(text_of(at("alone.html")), HasSubstr("<title>out/trajectory.xyz</title>"));
  EXPECT_THAT(text_of(at("alone.html")), HasSubstr("\"sides\":[\"periodic\",\"periodic\",\"wall\",\"wall\"]"));
}

TEST_F(View, OpensThePageWithTheDesktopsOpener) {
  run("-o out --t-end 0.2");
  fs::create_directories(at("bin"));
  write("bin/xdg-open", "#!/bin/sh\necho \"$1\" >opened\n");
  fs::permissions(at("bin/xdg-open"), fs::perms::owner_all);
  const Outcome o = shell("PATH=bin:$PATH $C view out --open");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(text_of(at("opened")), fs::canonical(at("out/view.html")).string() + "\n");
  const Outcome none = shell("PATH=/nowhere $C view out --open --force");
  EXPECT_EQ(none.status, 0);
  EXPECT_THAT(none.err, HasSubstr("warning: --open: there is no xdg-open; open the page in a browser by hand\n"));
  EXPECT_EQ(shell("PATH=/nowhere $C view out --open --force --quiet").err, "");
}

TEST_F(View, ASceneCanAskForIt) {
  run("-o out --t-end 1 --set output.view=true");
  const std::string page = text_of(at("out/view.html"));
  ASSERT_EQ(carom("view out -o same.html").status, 0);
  EXPECT_EQ(text_of(at("same.html")), page);
  EXPECT_THAT(text_of(at("out/scene.toml")), HasSubstr("\nview = true\n"));
  // The page is a result like others: it is only replaced on request, and a run without it leaves no page of an earlier
  // run.
  fs::create_directories(at("old"));
  write("old/view.html", "an older run");
  const Outcome o = carom("run gas.toml -o old --t-end 0.1");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("old: holds view.html of an earlier run"));
  EXPECT_EQ(text_of(at("old/view.html")), "an older run");
  run("-o old --t-end 0.1");
  EXPECT_FALSE(fs::exists(at("old/view.html")));
}

TEST_F(View, ARunThatGoesOnMakesThePageOfAllItsFrames) {
  run("-o out --t-end 0.5 --set output.view=true --set output.checkpoint=100");
  EXPECT_THAT(text_of(at("out/view.html")), HasSubstr("\"frames\":11,"));
  ASSERT_EQ(carom("resume out --t-end 1 --quiet").status, 0);
  EXPECT_THAT(text_of(at("out/view.html")), HasSubstr("\"frames\":21,"));
  ASSERT_EQ(carom("view out -o same.html").status, 0);
  EXPECT_EQ(text_of(at("same.html")), text_of(at("out/view.html")));
}

TEST_F(View, APageOfARunThatStoppedStaysWhenItHasGoneOn) {
  ASSERT_EQ(carom("run gas.toml -o out --quiet --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("view out --quiet").status, 0);
  const std::string page = text_of(at("out/view.html"));
  ASSERT_EQ(carom("resume out --quiet --t-end 0.2").status, 0);
  EXPECT_TRUE(fs::exists(at("out/summary.json")));
  EXPECT_EQ(text_of(at("out/view.html")), page);
}

TEST_F(View, APageThatFailsCostsTheRunNothingElse) {
  const std::string small = "run gas.toml -o out --t-end 0.2 --set output.view=true --set disks.0.count=20";
  const Outcome lost =
      shell("ulimit -f 100; $C " + small + " --quiet");  // blocks of 512 bytes, fewer than any page has
  EXPECT_EQ(lost.status, 1);
  EXPECT_THAT(lost.err, HasSubstr("carom: error: view.html could not be made: "));
  EXPECT_THAT(lost.err, HasSubstr("; all other results are in out; carom view out makes the page\n"));
  EXPECT_TRUE(fs::exists(at("out/summary.json")));
  EXPECT_FALSE(fs::exists(at("out/view.html")));
  EXPECT_EQ(carom("view out").status, 0);
}

TEST_F(View, WithoutATrajectoryASceneCannotAskForIt) {
  const Outcome o = carom("run gas.toml -o out --set output.trajectory='\"none\"' --set output.view=true");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("output.view: is true, but there is no trajectory to play; expected trajectory = "
                               "\"xyz\" or \"h5md\" as well"));
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(View, CheckSaysWhatItCosts) {
  const Outcome o = carom("check gas.toml --json --set output.view=true");
  ASSERT_EQ(o.status, 0) << o.err;
  run("-o out --set output.view=true");
  const auto size = static_cast<double>(fs::file_size(at("out/view.html")));
  const nlohmann::json said = nlohmann::json::parse(o.out);
  EXPECT_NEAR(said["files_bytes"].value("view.html", 0.0), size, 0.3 * size);
}

// The results of an earlier run stay until the run that replaces it is done.
TEST_F(View, TellsOfARunInThePlaceOfAnEarlierOne) {
  run("-o out --t-end 0.2");
  const pid_t next = start({"run", "gas.toml", "--quiet", "--force", "-o", "out", "--t-end", "1e9"});
  while (!fs::exists(at("out/carom-unfinished/trajectory.xyz"))) usleep(1000);
  const std::string note =
      "carom: out/trajectory.xyz belongs to an earlier run than the one in progress in out/carom-unfinished\n";
  const Outcome page = carom("view out -o page.html"), picture = carom("render out -o last.svg");
  EXPECT_THAT(page.err, HasSubstr(note));
  EXPECT_THAT(page.err, HasSubstr("5 frames"));
  EXPECT_EQ(picture.err, note);
  EXPECT_EQ(carom("render out -o last.svg --force --quiet").err, "");
  kill(next, SIGKILL);
  wait_for(next);
  EXPECT_EQ(carom("render out -o last.svg --force").err, "");
}

TEST_F(View, ARunCanEndWithIt) {
  fs::create_directories(at("bin"));
  write("bin/xdg-open", "#!/bin/sh\necho \"$1\" >opened\n");
  fs::permissions(at("bin/xdg-open"), fs::perms::owner_all);
  const Outcome o = shell("PATH=bin:$PATH $C run gas.toml -o out --t-end 0.2 --view --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, StartsWith("{")) << "the output must be the summary alone";
  EXPECT_THAT(o.out, testing::EndsWith("}\n"));
  EXPECT_THAT(text_of(at("out/view.html")), StartsWith("<!doctype html>"));
  EXPECT_EQ(text_of(at("opened")), fs::canonical(at("out/view.html")).string() + "\n");
  // There is no browser. Whether the page is made only for this option or for the scene as well, the message names the
  // option.
  for (const std::string asked : {"", " --set output.view=true"}) {
    const std::string again = "PATH=/nowhere $C run gas.toml -o out --force --t-end 0.2 --view" + asked;
    EXPECT_THAT(shell(again).err, HasSubstr("warning: --view: there is no xdg-open; open the page"));
    EXPECT_EQ(shell(again + " --quiet").err, "");
  }
  std::string bare = gas;
  bare.erase(bare.find("trajectory = "), std::string("trajectory = \"xyz\"\n").size());
  write("bare.toml", bare);
  const Outcome none = carom("run bare.toml -o none --view");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("--view: the scene writes no trajectory; expected a trajectory"));
  EXPECT_FALSE(fs::exists(at("none")));
}

}  // namespace
}  // namespace carom
