// Plots: the data recorded, drawing by gnuplot with any title, and runs without gnuplot.
#include "io/plots/plot.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>

#include "core/base/check.hpp"
#include "io/files/output_file.hpp"
#include "io/files/shown_text.hpp"
#include "io/plots/gnuplot.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::text_of;
using ::testing::ElementsAre;

class Plot : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder_.path() / name; }
  const test::TestFolder folder_{::testing::UnitTest::GetInstance()->current_test_info()->name()};
};

Disks disks_with_ids(const std::vector<DiskId>& ids) {
  Disks d;
  for (const DiskId id : ids) append(d, {0.0, 0.0, 1.0 * id, -1.0 * id, 1.0, 1.0, id});
  return d;
}

std::vector<DiskId> recorded(const VelocityRecord& record) {
  std::vector<DiskId> ids;
  for (const auto& curve : record.curves) ids.push_back(curve.id);
  return ids;
}

TEST(VelocityRecord, TenLowestIdsInAnyStorageOrder) {
  VelocityRecord r;
  record(r, disks_with_ids({11, 3, 0, 7, 9, 1, 2, 4, 5, 6, 8, 10}), 0.0);
  EXPECT_THAT(recorded(r), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(r.curves[7].vx, ElementsAre(7.0));
  EXPECT_THAT(r.curves[7].vy, ElementsAre(-7.0));
}

TEST(VelocityRecord, NewcomersFillUpAndLostDisksEnd) {
  VelocityRecord r;
  record(r, disks_with_ids({0, 1}), 0.0);
  record(r, disks_with_ids({1, 5}), 1.0);
  record(r, {}, 2.0);
  EXPECT_THAT(recorded(r), ElementsAre(0, 1, 5));
  EXPECT_THAT(r.curves[0].t, ElementsAre(0.0));
  EXPECT_THAT(r.curves[1].t, ElementsAre(0.0, 1.0));
  EXPECT_THAT(r.curves[2].t, ElementsAre(1.0));
}

TEST_F(Plot, VelocitiesOfTwoDisks) {
  VelocityRecord r;
  for (int k = 0; k < 10000; ++k) record(r, disks_with_ids({0, 1}), 0.01 * k);
  const std::string path = at("velocity.svg");
  const std::string marker = at("injected");
  // A title is only text, even if gnuplot or a shell could take it for a command.
  for (const std::string& title : {"it's `touch " + marker + "`", "\n'; system('touch " + marker + "')"}) {
    ASSERT_TRUE(plot_velocity(path, title, r));
    EXPECT_TRUE(text_of(path).find(marker) != std::string::npos) << "the whole title must be shown";
    EXPECT_FALSE(fs::exists(marker));
  }
  ASSERT_TRUE(plot_velocity(path, "it's <&> {/Bold é}", r));
  const std::string svg = text_of(path);
  for (const char* const shown : {"disk 0", "disk 1", "time t", ">vx<", ">vy<", "&lt;&amp;", "é"}) {
    EXPECT_TRUE(svg.find(shown) != std::string::npos) << shown;
  }
  EXPECT_LT(svg.size(), 600000U) << "long lines must be thinned";
}

// With more disks than colours the distribution of velocities is shown.
TEST_F(Plot, VelocitiesOfManyDisksAreBands) {
  VelocityRecord r;
  for (int k = 0; k < 9000; ++k) {
    Disks d;
    for (DiskId id = 0; id <= 100; ++id) {
      const auto v = static_cast<double>((id * 37 + static_cast<DiskId>(k)) % 101) - 50.0;  // from -50 to 50
      append(d, {0.0, 0.0, v, 2.0 * v, 1.0, 1.0, id});
    }
    record(r, d, 0.01 * k);
  }
  EXPECT_EQ(r.most, 101U);
  ASSERT_EQ(r.bands.size(), 9000U);
  EXPECT_THAT(r.bands[77].vx, ElementsAre(-50.0, -45.0, -25.0, 0.0, 25.0, 45.0, 50.0));
  EXPECT_THAT(r.bands[77].vy, ElementsAre(-100.0, -90.0, -50.0, 0.0, 50.0, 90.0, 100.0));
  const std::string path = at("bands.svg");
  ASSERT_TRUE(plot_velocity(path, "many", r));
  const std::string svg = text_of(path);
  for (const char* const shown : {"velocities of all disks", "median", "95 %", "greatest", ">vx<", ">vy<"}) {
    EXPECT_TRUE(svg.find(shown) != std::string::npos) << shown;
  }
  EXPECT_TRUE(svg.find("disk 0") == std::string::npos);
  EXPECT_LT(svg.size(), 3'000'000U);
}

TEST_F(Plot, BandsDoNotDependOnStorageOrder) {
  VelocityRecord a, b;
  Disks there, back;
  for (DiskId id = 0; id < 50'000; ++id) append(there, {0.0, 0.0, std::sin(id), std::cos(id), 1.0, 1.0, id});
  for (DiskId id = 50'000; id-- > 0;) append(back, {0.0, 0.0, std::sin(id), std::cos(id), 1.0, 1.0, id});
  record(a, there, 0.0);
  record(b, back, 0.0);
  EXPECT_EQ(a.bands[0].vx, b.bands[0].vx);
  EXPECT_EQ(a.bands[0].vy, b.bands[0].vy);
  EXPECT_NEAR(a.bands[0].vx[5], std::sin(0.45 * M_PI), 0.01);
}

// Which zero is the least, and so its sign in the file, once depended on the order of storage.
TEST_F(Plot, ZerosOfBandsHaveNoSign) {
  VelocityRecord r;
  Disks d;
  for (DiskId id = 0; id < 20; ++id) append(d, {0.0, 0.0, -0.0, id == 0 ? 0.0 : -0.0, 1.0, 1.0, id});
  record(r, d, 0.0);
  for (std::size_t k = 0; k < velocity_levels; ++k) {
    EXPECT_FALSE(std::signbit(r.bands[0].vx[k])) << k;
    EXPECT_FALSE(std::signbit(r.bands[0].vy[k])) << k;
  }
}

// Of many disks every second or third is taken, by its id; here no disk has such an id.
TEST_F(Plot, BandsOfDisksWhoseIdsLieBetweenTheMultiples) {
  VelocityRecord r;
  Disks d;
  for (DiskId k = 0; k < 30'000; ++k) append(d, {0.0, 0.0, 1e-4 * k, 1.0, 1.0, 1.0, 2 * k + 1});
  record(r, d, 0.0);
  ASSERT_EQ(r.bands.size(), 1U);
  EXPECT_NEAR(r.bands[0].vx[3], 1.5, 1e-3);
  EXPECT_EQ(r.bands[0].vy[3], 1.0);
}

TEST_F(Plot, ALineThatEndsEarlyIsMarked) {
  VelocityRecord r;
  record(r, disks_with_ids({0, 1}), 0.0);
  record(r, disks_with_ids({0, 1}), 1.0);
  record(r, disks_with_ids({1}), 2.0);
  const std::string path = at("gone.svg");
  ASSERT_TRUE(plot_velocity(path, "a sink", r));
  EXPECT_TRUE(text_of(path).find("disk 0, gone") != std::string::npos);
  EXPECT_TRUE(text_of(path).find("disk 1, gone") == std::string::npos);
}

TEST_F(Plot, NothingToShowIsStillAPlot) {
  const std::string path = at("empty.svg");
  EXPECT_TRUE(plot_velocity(path, "no disks", {}));
  EXPECT_TRUE(text_of(path).find("no data") != std::string::npos) << "the plot must say so";
  EXPECT_TRUE(plot_energy(path, "one frame at rest", {{0.0}, {0.0}, {0.0}, {0.0}}));
  EXPECT_TRUE(plot_energy(path, "", {{0.0, 1.0}, {2.0, 1.0}, {0.0, 1.0}, {2.0, 2.0}}));
  EXPECT_TRUE(text_of(path).find("potential") != std::string::npos);
  EXPECT_TRUE(text_of(path).find("no data") == std::string::npos);
}

// If the total energy exceeds kinetic and potential energy, the rest belongs to spins and has its own line.
TEST_F(Plot, TheEnergyOfSpinsIsALine) {
  const std::string path = at("energy.svg");
  ASSERT_TRUE(plot_energy(path, "smooth", {{0.0, 1.0}, {2.0, 0.2}, {1.0, 0.1}, {3.0, 0.3}}));
  EXPECT_TRUE(text_of(path).find("rotational") == std::string::npos);
  ASSERT_TRUE(plot_energy(path, "rough", {{0.0, 1.0}, {2.0, 1.5}, {1.0, 1.0}, {3.0, 3.0}}));
  EXPECT_TRUE(text_of(path).find(">rotational<") != std::string::npos);
  ASSERT_TRUE(plot_energy(path, "hardly spinning", {{0.0, 1.0}, {2.0, 1.5}, {1.0, 1.0}, {3.0 + 1e-6, 2.5 + 1e-6}}));
  EXPECT_TRUE(text_of(path).find(">rotational<") != std::string::npos) << "more than rounding";
}

// A single point drawn as a line would be invisible: a run of one window has one sample of the pressure.
TEST_F(Plot, ASinglePointIsSeen) {
  const std::string path = at("point.svg");
  const std::string drawn = "xlink:href='#gpPt6'";
  ASSERT_TRUE(draw_svg({"one", "t", 0.5, {{"y", {{"samples", {0.5}, {1.0}}}}}}, path));
  EXPECT_TRUE(text_of(path).find(drawn) != std::string::npos);
  ASSERT_TRUE(draw_svg({"two", "t", 0.5, {{"y", {{"samples", {0.0, 0.5}, {1.0, 1.0}}}}}}, path));
  EXPECT_TRUE(text_of(path).find(drawn) == std::string::npos);
}

TEST_F(Plot, LogarithmicAxesAndAGuide) {
  const std::string path = at("log.svg");
  const Line curve{"measured", {0.1, 1.0, 100.0}, {1e-3, 1.0, 1e3}};
  const Line guide{"~ t", {0.1, 50.0}, {1e-3, 0.5}, LineStyle::guide};
  ASSERT_TRUE(draw_svg({"log", "t", 100.0, {{"y", {curve, guide}}}, true}, path));
  const std::string svg = text_of(path);
  for (const char* const shown : {"measured", ">~ t<", ">0.1<", ">10<", ">0.001<"}) {
    EXPECT_TRUE(svg.find(shown) != std::string::npos) << shown;
  }
  const Line earlier{"early", {1e-5, 100.0}, {1.0, 2.0}};
  ASSERT_TRUE(draw_svg({"log", "t", 100.0, {{"y", {earlier, guide}}}, true}, path));
  EXPECT_TRUE(text_of(path).find(">1e-05<") != std::string::npos) << "the axis starts where the first line does";
  ASSERT_TRUE(draw_svg({"nothing", "t", 0.0, {{"y", {}}}, true}, path)) << "no data must not be an error";
}

// With titles and names of any length the subject remains readable, and all stay within the picture.
TEST_F(Plot, LongTitlesAndNamesAreShortened) {
  const std::string long_title = "é" + std::string(500, 'x');
  EXPECT_EQ(shortened("é23", 3), "é23");
  EXPECT_EQ(shortened("é234", 3), "é2…");
  EXPECT_EQ(heading("gas", "energy"), "gas: energy");
  EXPECT_THAT(heading(long_title, "energy"), ::testing::EndsWith("xx…: energy"));
  EXPECT_EQ(letters_of(heading(long_title, "energy")), 92U);
  const std::string path = at("long.svg");
  const Line line{std::string(40, 'n'), {0.0, 1.0}, {0.0, 1.0}};
  const Line gone{"short", {0.0, 0.5}, {1.0, 1.0}};
  ASSERT_TRUE(draw_svg({heading(long_title, "energy"), "t", 1.0, {{"y", {line, gone}}}}, path));
  const std::string svg = text_of(path);
  EXPECT_TRUE(svg.find('>' + std::string(31, 'n') + "…<") != std::string::npos);
  EXPECT_TRUE(svg.find(">short, gone<") != std::string::npos);
  EXPECT_TRUE(svg.find("xx…: energy<") != std::string::npos);
}

// Browsers show nothing of a file whose text contains "]]>" or U+FFFE.
TEST_F(Plot, TitlesThatNoXmlMayHave) {
  const std::string path = at("odd.svg");
  ASSERT_TRUE(draw_svg({"a]]>b]]>\xef\xbf\xbe\xef\xbf\xbf.", "t", 1.0, {{"y", {}}}}, path));
  const std::string svg = text_of(path);
  EXPECT_TRUE(svg.find("a]] >b]] >\ufffd\ufffd.") != std::string::npos);
  EXPECT_TRUE(svg.find("]]>") == std::string::npos);
}

// RFC 3629, table 3-7 of the Unicode standard: the limits of the first two bytes.
TEST(ShownText, LettersAreThoseOfUtf8) {
  for (const char* const letter : {"a", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xe1\x80\x80", "\xed\x9f\xbf",
                                   "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf1\x80\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(letter_bytes(letter), std::string(letter).size()) << letter;
    EXPECT_EQ(shown_text(letter), letter);
  }
  for (const char* const none : {"\x80", "\xc1\xbf", "\xc2", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xe1\x80", "\xe1\x80\xc0",
                                 "\xf0\x8f\xbf\xbf", "\xf1\x80\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_EQ(letter_bytes(none), 0U) << none;
  }
}

TEST_F(Plot, AFullDiskIsAnError) {
  EXPECT_THROW(plot_energy("/dev/full", "full", {{0.0, 1.0}, {2.0, 1.0}, {0.0, 1.0}, {2.0, 2.0}}), RunError);
}

// gnuplot does not report a full disk: the end of its picture is missing, whatever its exit status.
TEST_F(Plot, WhatGnuplotLeavesUndoneIsAnError) {
  const std::string path = at("part.svg"), saved = getenv("PATH");
  const auto complaint_with = [&](const std::string& commands) -> std::string {
    write_file(at("gnuplot"), "#!/bin/sh\n" + commands);
    fs::permissions(at("gnuplot"), fs::perms::owner_all);
    setenv("PATH", folder_.path().c_str(), 1);
    std::string said;
    try {
      plot_velocity(path, "part", {});
    } catch (const RunError& e) {
      said = e.what();
    }
    setenv("PATH", saved.c_str(), 1);
    return said;
  };
  EXPECT_THAT(complaint_with("echo '<svg>' > plot.svg\n"), ::testing::HasSubstr("the picture is incomplete"));
  EXPECT_THAT(complaint_with("echo '<svg></svg>' > plot.svg\necho 'line 3: no font'\nexit 1\n"),
              ::testing::EndsWith("part.svg: line 3: no font"));
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(complaint_with("echo '<svg></svg>' > plot.svg\n"), "");
  EXPECT_EQ(text_of(path), "<svg></svg>\n");
}

TEST_F(Plot, WithoutGnuplotNothingIsWritten) {
  const std::string path = at("none.svg");
  const std::string saved = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_FALSE(plot_velocity(path, "none", {}));
  setenv("PATH", saved.c_str(), 1);
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace carom
