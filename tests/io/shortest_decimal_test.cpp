// Numbers are written as by std::to_chars, whose text is the shortest that reads back the same bits.
#include "io/trajectory/shortest_decimal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

namespace carom {
namespace {

template <class Number>
std::string by_library(Number value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// Tests a number and its negative: returns an empty text if both are right, otherwise the wrong text. Memory beyond the
// space for the writer must not change.
template <class Number>
std::string wrong(Number value) {
  for (const Number number : {value, -value}) {
    std::array<char, shortest_decimal_bytes + 8> text;
    text.fill('#');
    const std::string written(text.data(), write_shortest(text.data(), number));
    if (written != by_library(number)) return written + " for " + by_library(number);
    for (std::size_t k = shortest_decimal_bytes; k < text.size(); ++k) {
      if (text[k] != '#') return "beyond its room: " + written;
    }
  }
  return "";
}

// Tests a number and its neighbours.
template <class Number>
std::string wrong_near(Number value) {
  Number low = value, high = value;
  for (int k = 0; k < 40; ++k) {
    if (std::string text = wrong(low) + wrong(high); !text.empty()) return text;
    low = std::nextafter(low, Number{0});
    high = std::nextafter(high, std::numeric_limits<Number>::infinity());
  }
  return "";
}

template <class Number>
class ShortestDecimal : public ::testing::Test {};
using Numbers = ::testing::Types<double, float>;
TYPED_TEST_SUITE(ShortestDecimal, Numbers);

TYPED_TEST(ShortestDecimal, RandomNumbersOfEverydaySize) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  for (int k = 0; k < 200'000; ++k) {
    ASSERT_EQ(wrong(static_cast<TypeParam>(normal(random))), "");
    ASSERT_EQ(wrong(static_cast<TypeParam>(std::exp(exponent(random)))), "");
  }
}

TYPED_TEST(ShortestDecimal, AroundPowersOfTwoAndOfTen) {
  for (int b = -40; b < 60; ++b) ASSERT_EQ(wrong_near(std::ldexp(TypeParam{1}, b)), "") << b;
  for (int e = -12; e < 18; ++e) {
    for (const double factor : {1.0, 2.0, 3.0, 5.0, 9.0, 9.9, 99.0}) {
      ASSERT_EQ(wrong_near(static_cast<TypeParam>(factor * std::pow(10.0, e))), "") << factor << "e" << e;
    }
  }
}

// Such numbers may be half-way between two shortest decimals, of which the even one is written.
TYPED_TEST(ShortestDecimal, NumbersOfFewBits) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 200'000; ++k) {
    const int bits = 1 + static_cast<int>(random() % 53);
    const double whole = static_cast<double>(random() >> (64 - bits));
    ASSERT_EQ(wrong(static_cast<TypeParam>(std::ldexp(whole, static_cast<int>(random() % 40) - 14 - bits))), "");
  }
}

TYPED_TEST(ShortestDecimal, NumbersOfFewDigits) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 200'000; ++k) {
    const auto whole = static_cast<double>(random() % 100'000);
    ASSERT_EQ(wrong(static_cast<TypeParam>(whole / std::pow(10.0, static_cast<double>(random() % 12)))), "");
  }
}

TYPED_TEST(ShortestDecimal, AnyBits) {
  std::mt19937_64 random(4);
  using Bits = std::conditional_t<sizeof(TypeParam) == 8, std::uint64_t, std::uint32_t>;
  for (int k = 0; k < 100'000; ++k) {
    const auto number = std::bit_cast<TypeParam>(static_cast<Bits>(random()));
    if (std::isnan(number)) continue;  // their signs and payloads have no text
    ASSERT_EQ(wrong(number), "");
  }
}

TYPED_TEST(ShortestDecimal, ZeroAndTheExtremes) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam number :
       {TypeParam{0}, Limits::max(), Limits::min(), Limits::denorm_min(), Limits::epsilon(), Limits::infinity()}) {
    EXPECT_EQ(wrong(number), "");
  }
}

}  // namespace
}  // namespace carom
