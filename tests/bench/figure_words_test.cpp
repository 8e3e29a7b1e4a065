// The arguments of carom_figures: a misspelt part gives an error, rather than no measurement, and an option is not
// taken for a folder.
#include "bench/support/figure_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

FigureWords read(const std::vector<std::string>& words) {
  return figure_words(words);
}

std::string complaint(const std::vector<std::string>& words) {
  try {
    read(words);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(FigureWords, NameAFolderAndParts) {
  const FigureWords all = read({"out"});
  EXPECT_EQ(all.folder, "out");
  for (const std::string_view part : figure_parts) EXPECT_TRUE(all.wants(part)) << part;
  const FigureWords some = read({"out", "exact_growth", "gas"});
  EXPECT_THAT(some.parts, ElementsAre("exact_growth", "gas"));
  EXPECT_TRUE(some.wants("gas"));
  EXPECT_TRUE(some.wants("exact_growth"));
  EXPECT_FALSE(some.wants("exact"));
}

TEST(FigureWords, ThatAreNotKnownAreNamed) {
  EXPECT_EQ(complaint({"out", "gas", "sacling"}),
            "\"sacling\": is no part of the figures; expected one of memory, gas, scaling, special, features, exact, "
            "exact_growth, borders (nearest: scaling)");
  EXPECT_THAT(complaint({"out", "--help"}), HasSubstr("is no part of the figures"));
  EXPECT_THAT(complaint({"out", ""}), HasSubstr("is no part of the figures"));
}

TEST(FigureWords, AnOptionOrAPartIsNoFolder) {
  for (const char* const word : {"--help", "-o", "gas", ""}) {
    EXPECT_THAT(complaint({word}), HasSubstr("stands where the folder is expected")) << word;
    EXPECT_THAT(complaint({word, "memory"}), HasSubstr("expected a folder for the results")) << word;
  }
  EXPECT_THAT(complaint({}), HasSubstr("no folder given"));
  EXPECT_EQ(read({"./gas"}).folder, "./gas");
}

}  // namespace
}  // namespace carom::bench
