#include "core/scene/csv.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Vec2> rows(std::string_view text) {
  return parse_csv_pairs(text, "p.csv", "disks.0.positions");
}

std::string complaint_of(std::string_view text) {
  try {
    rows(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, ReadsRowsWithAndWithoutHeader) {
  EXPECT_THAT(rows("1,2\n3,4\n"), ElementsAre(Vec2{1, 2}, Vec2{3, 4}));
  EXPECT_THAT(rows("x,y\n1,2\n"), ElementsAre(Vec2{1, 2}));
  EXPECT_THAT(rows("# from the lab\n\"vx [m/s]\", \"vy [m/s]\"\n\n 1.5 , -2e-3 \n# end\n"),
              ElementsAre(Vec2{1.5, -2e-3}));
}

TEST(Csv, ReadsOtherLineEndsAndMarks) {
  EXPECT_THAT(rows("1,2\r\n3,4"), ElementsAre(Vec2{1, 2}, Vec2{3, 4}));
  EXPECT_THAT(rows("\xef\xbb\xbf"
                   "x,y\n+1,2\n"),
              ElementsAre(Vec2{1, 2}));
  EXPECT_THAT(rows(""), IsEmpty());
  EXPECT_THAT(rows("x,y\n"), IsEmpty());
}

TEST(Csv, NamesTheLineItCannotRead) {
  EXPECT_THAT(complaint_of("1,2\n3;4\n"), testing::StartsWith("p.csv:2: disks.0.positions: cannot read \"3;4\""));
  EXPECT_THAT(complaint_of("# a\n\n1,2\nx,y\n"), HasSubstr("p.csv:4: ")) << "a header may only be the first line";
  EXPECT_THAT(complaint_of("abc,2\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("1.0abc,2\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("1,2,3\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("1\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("1,\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("nan,1\n"), HasSubstr("p.csv:1: "));
  EXPECT_THAT(complaint_of("1,2\n1,inf\n"), HasSubstr("p.csv:2: "));
  EXPECT_THAT(complaint_of("1,1e999\n"), HasSubstr("p.csv:1: "));
}

TEST(Csv, ANumberHasOneSign) {
  EXPECT_THAT(rows("+1,-2\n"), ElementsAre(Vec2{1.0, -2.0}));
  for (const char* const line : {"+-1,2", "1,+-2", "--1,2", "++1,2", "1,-+2"}) {
    EXPECT_THAT(complaint_of(std::string(line) + "\n"), HasSubstr("cannot read")) << line;
  }
}

// With the columns exchanged the disks would silently be in other places.
TEST(Csv, AHeaderThatNamesYFirstIsRefused) {
  for (const char* const heading : {"y,x", "y , x", "vy,vx", "vy [m/s],vx [m/s]", "\"y\",\"x\"", "Y,X", "y1,x1"}) {
    EXPECT_THAT(complaint_of(std::string("# a\n") + heading + "\n1,2\n"),
                HasSubstr("p.csv:2: disks.0.positions: has columns "))
        << heading;
    EXPECT_THAT(complaint_of(std::string(heading) + "\n1,2\n"), HasSubstr("; expected x first, then y")) << heading;
  }
  for (const char* const heading : {"x,y", "vx [m/s],vy [m/s]", "X,Y", "a,b", "lazy,lax", "yaw,xy", "y,y"}) {
    EXPECT_EQ(parse_csv_pairs(std::string(heading) + "\n1,2\n", "p.csv", "k").size(), 1U) << heading;
  }
}

// A file of velocities taken as one of positions would silently give another scene.
TEST(Csv, AHeaderOfVelocitiesIsRefusedForPlaces) {
  const auto complaint = [](const char* heading, CsvPairs pairs) -> std::string {
    try {
      parse_csv_pairs(std::string(heading) + "\n1,2\n", "p.csv", "k", pairs);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* const heading : {"vx,vy", "\"vx\", \"vy\"", "v_x [m/s],v_y [m/s]", "Velocity x,Velocity y"}) {
    EXPECT_THAT(complaint(heading, CsvPairs::places), testing::StartsWith("p.csv:1: k: has columns ")) << heading;
    EXPECT_THAT(complaint(heading, CsvPairs::places), testing::EndsWith("; expected places, as in \"x,y\"")) << heading;
    EXPECT_EQ(complaint(heading, CsvPairs::any), "") << heading;
  }
  for (const char* const heading : {"x,y", "a,b", "vertical,y"}) {
    EXPECT_EQ(complaint(heading, CsvPairs::places), "") << heading;
  }
}

TEST(Csv, ComplaintIsOneShortLine) {
  const std::string message = complaint_of("1\t\x01" + std::string(10000, '7') + ",\n");
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_EQ(message.find('\x01'), std::string::npos);
  EXPECT_LT(message.size(), 300U);
}

TEST(Csv, LosesNoBit) {
  test::Draws draws(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 v{draws.in(-1, 1) * draws.decades(1e-300, 1e300), draws.in(-1, 1)};
    EXPECT_THAT(rows(fmt::format("{:.17g},{:.17g}\n", v.x, v.y)), ElementsAre(v));
  }
}

TEST(TextFile, SaysWhatIsWrongWithTheFile) {
  const test::TestFolder folder("csv_test");
  const auto message = [](const std::string& path) -> std::string {
    try {
      read_text_file(path, "gas.toml:3: key");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message((folder.path() / "none").string()), HasSubstr("gas.toml:3: key: cannot be opened"));
  EXPECT_THAT(message(folder.path().string()), HasSubstr("is a directory; expected a file"));
  EXPECT_EQ(read_text_file(folder.write("a.txt", "two\nlines"), "here"), "two\nlines");
}

}  // namespace
}  // namespace carom
