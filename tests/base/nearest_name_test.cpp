#include "core/base/nearest_name.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/base/input_message.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

TEST(EditDistance, CountsSingleChanges) {
  EXPECT_EQ(edit_distance("mass", "mass"), 0U);
  EXPECT_EQ(edit_distance("", "mass"), 4U);
  EXPECT_EQ(edit_distance("mass", ""), 4U);
  EXPECT_EQ(edit_distance("mas", "mass"), 1U);
  EXPECT_EQ(edit_distance("masss", "mass"), 1U);
  EXPECT_EQ(edit_distance("moss", "mass"), 1U);
  EXPECT_EQ(edit_distance("amss", "mass"), 1U) << "a swap of neighbours is one change";
  EXPECT_EQ(edit_distance("MASS", "mass"), 0U) << "case is ignored";
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(EditDistance, IsSymmetricAndBounded) {
  test::Draws draws(1);
  const auto word = [&] {
    std::string w;
    for (std::uint64_t n = draws.bits() % 9; n > 0; --n) w += static_cast<char>('a' + draws.bits() % 3);
    return w;
  };
  for (int k = 0; k < 2000; ++k) {
    const std::string a = word();
    const std::string b = word();
    const std::size_t d = edit_distance(a, b);
    EXPECT_EQ(d, edit_distance(b, a)) << a << " " << b;
    EXPECT_LE(d, std::max(a.size(), b.size())) << a << " " << b;
    EXPECT_GE(d, std::max(a.size(), b.size()) - std::min(a.size(), b.size())) << a << " " << b;
    EXPECT_EQ(d == 0, a == b) << a << " " << b;
  }
}

TEST(NearestName, IsTheClosestThenTheFirst) {
  constexpr std::array<std::string_view, 3> methods{"rollback", "pairwise", "exact"};
  EXPECT_EQ(nearest_name("exakt", methods), "exact");
  EXPECT_EQ(nearest_name("pair-wise", methods), "pairwise");
  EXPECT_EQ(nearest_name("rolback", methods), "rollback");
  constexpr std::array<std::string_view, 2> tie{"left", "lift"};
  EXPECT_EQ(nearest_name("loft", tie), "left");
}

TEST(NearestName, IsNamedOnlyWhereItIsNear) {
  EXPECT_TRUE(is_near("restituton", "restitution"));
  EXPECT_TRUE(is_near("from_mass", "from_radius"));
  EXPECT_TRUE(is_near("--thread", "--threads"));
  EXPECT_FALSE(is_near("colour", "count"));
  EXPECT_FALSE(is_near("--foo", "--force")) << "dashes must not count as similarity";
  EXPECT_FALSE(is_near("x", "title"));
  constexpr std::array<std::string_view, 3> keys{"width", "height", "left"};
  EXPECT_EQ(expected_one_of(keys, "widht"), "expected one of width, height, left (nearest: width)");
  EXPECT_EQ(expected_one_of(keys, "temperature"), "expected one of width, height, left");
}

}  // namespace
}  // namespace carom
