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

#include "core/base/kernel_set.hpp"
#include "io/trajectory/decimal_batch.hpp"
#include "io/trajectory/decimal_scale.hpp"

namespace carom {
namespace {

template <class Number>
std::string by_library(Number value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

using Room = std::array<char, shortest_decimal_bytes + 8>;

// Returns an empty text if the text of a number is right, otherwise the wrong text. Memory beyond the space for the
// writer must not change.
template <class Number, class Write>
std::string wrong_by(Write&& write, Number number) {
  Room text;
  text.fill('#');
  const std::string written(text.data(), write(text.data()));
  if (written != by_library(number)) return written + " for " + by_library(number);
  for (std::size_t k = shortest_decimal_bytes; k < text.size(); ++k) {
    if (text[k] != '#') return "beyond its room: " + written;
  }
  return "";
}

template <class Number>
class ShortestDecimal : public ::testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(wrong_in_batch(), ""); }

  // Tests a number and its negative, by themselves and, once there are enough of them, in a batch.
  std::string wrong(Number value) {
    std::string text;
    for (const Number number : {value, -value}) {
      text += wrong_by([&](char* out) { return write_shortest(out, number); }, number);
      batch_.numbers[held_++] = number;
    }
    if (held_ == batch_.size) text += wrong_in_batch();
    return text;
  }

  // Tests a number and its neighbours.
  std::string wrong_near(Number value) {
    Number low = value, high = value;
    for (int k = 0; k < 40; ++k) {
      if (std::string text = wrong(low) + wrong(high); !text.empty()) return text;
      low = std::nextafter(low, Number{0});
      high = std::nextafter(high, std::numeric_limits<Number>::infinity());
    }
    return "";
  }

 private:
  std::string wrong_in_batch() {
    choose_decimal_kernel<Number>()(batch_);
    std::string text;
    for (std::size_t k = 0; k < held_; ++k) {
      text += wrong_by([&](char* out) { return write_decimal(out, batch_, k); }, batch_.numbers[k]);
    }
    held_ = 0;
    return text;
  }

  DecimalBatch<Number> batch_;
  std::size_t held_ = 0;
};

using Numbers = ::testing::Types<double, float>;
TYPED_TEST_SUITE(ShortestDecimal, Numbers);

TYPED_TEST(ShortestDecimal, RandomNumbersOfEverydaySize) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  for (int k = 0; k < 200'000; ++k) {
    ASSERT_EQ(this->wrong(static_cast<TypeParam>(normal(random))), "");
    ASSERT_EQ(this->wrong(static_cast<TypeParam>(std::exp(exponent(random)))), "");
  }
}

TYPED_TEST(ShortestDecimal, AroundPowersOfTwoAndOfTen) {
  for (int b = -40; b < 60; ++b) ASSERT_EQ(this->wrong_near(std::ldexp(TypeParam{1}, b)), "") << b;
  for (int e = -12; e < 18; ++e) {
    for (const double factor : {1.0, 2.0, 3.0, 5.0, 9.0, 9.9, 99.0}) {
      ASSERT_EQ(this->wrong_near(static_cast<TypeParam>(factor * std::pow(10.0, e))), "") << factor << "e" << e;
    }
  }
}

// Such numbers may be half-way between two shortest decimals, of which the even one is written.
TYPED_TEST(ShortestDecimal, NumbersOfFewBits) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 200'000; ++k) {
    const int bits = 1 + static_cast<int>(random() % 53);
    const double whole = static_cast<double>(random() >> (64 - bits));
    ASSERT_EQ(this->wrong(static_cast<TypeParam>(std::ldexp(whole, static_cast<int>(random() % 40) - 14 - bits))), "");
  }
}

TYPED_TEST(ShortestDecimal, NumbersOfFewDigits) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 200'000; ++k) {
    const auto whole = static_cast<double>(random() % 100'000);
    ASSERT_EQ(this->wrong(static_cast<TypeParam>(whole / std::pow(10.0, static_cast<double>(random() % 12)))), "");
  }
}

TYPED_TEST(ShortestDecimal, AnyBits) {
  std::mt19937_64 random(4);
  using Bits = std::conditional_t<sizeof(TypeParam) == 8, std::uint64_t, std::uint32_t>;
  for (int k = 0; k < 100'000; ++k) {
    const auto number = std::bit_cast<TypeParam>(static_cast<Bits>(random()));
    if (std::isnan(number)) continue;  // their signs and payloads have no text
    ASSERT_EQ(this->wrong(number), "");
  }
}

TYPED_TEST(ShortestDecimal, ZeroAndTheExtremes) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam number :
       {TypeParam{0}, Limits::max(), Limits::min(), Limits::denorm_min(), Limits::epsilon(), Limits::infinity()}) {
    EXPECT_EQ(this->wrong(number), "");
  }
}

// So that the tests above are of it: a number that the kernel leaves out is written by write_shortest.
TYPED_TEST(ShortestDecimal, TheKernelConvertsNumbersOfEverydaySize) {
  if (kernel_set() == KernelSet::baseline) GTEST_SKIP() << "the baseline converts none";
  DecimalBatch<TypeParam> batch;
  std::mt19937_64 random(5);
  for (TypeParam& number : batch.numbers)
    number = static_cast<TypeParam>(std::ldexp(static_cast<double>(random()), -50));
  choose_decimal_kernel<TypeParam>()(batch);
  for (std::size_t k = 0; k < batch.size; ++k) {
    EXPECT_LT(batch.scales[k].exponent, static_cast<unsigned>(exponents));
    EXPECT_NE(batch.texts[k][batch.digits_at - static_cast<std::size_t>(batch.scales[k].zeros)], '0');
  }
}

}  // namespace
}  // namespace carom
