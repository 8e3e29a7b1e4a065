// A set of places: it numbers them in ascending order, and forgets them when it is cleared.
#include "parallel/slabs/place_set.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/support/draws.hpp"

namespace carom {
namespace {

TEST(PlaceSet, NumbersItsPlacesInOrder) {
  test::Draws draws(7);
  for (const std::uint32_t n : {1U, 63U, 64U, 65U, 1000U}) {
    std::vector<std::uint32_t> places;
    PlaceSet set;
    set.clear(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (draws.in(0.0, 1.0) < 0.3) places.push_back(i);
    }
    for (const std::uint32_t place : places) set.insert(place);
    set.count();
    for (std::uint32_t k = 0; k < places.size(); ++k) EXPECT_EQ(set.number_of(places[k]), k) << n;
  }
}

TEST(PlaceSet, ForgetsWhatItHeld) {
  PlaceSet set;
  set.clear(200);
  for (const std::uint32_t place : {3U, 70U, 150U}) set.insert(place);
  set.count();
  set.clear(100);
  set.insert(70);
  set.count();
  EXPECT_EQ(set.number_of(70), 0U);
}

}  // namespace
}  // namespace carom
