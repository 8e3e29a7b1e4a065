#include "core/base/exact_sum.hpp"

#include <cstring>

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(16)));
using Longs = long long __attribute__((vector_size(16)));

constexpr std::size_t lanes = 2;
constexpr int block_bits = 8;
constexpr std::size_t block = ExactSum::block;
static_assert(block == std::size_t{1} << block_bits && block % lanes == 0);
constexpr std::size_t few = 64;  // where it does not pay
// Larger and smaller values are added one by one, so that nothing below overflows or is subnormal.
constexpr double largest_extracted = 0x1p900;
constexpr double least_extracted = 0x1p-900;

Doubles both(double a) {
  return Doubles{a, a};
}

Doubles load(const double* x) {
  Doubles v;
  std::memcpy(&v, x, sizeof v);
  return v;
}

Doubles larger(Doubles a, Doubles b) {
#if defined(__SSE2__)
  return __builtin_ia32_maxpd(a, b);
#else
  return a > b ? a : b;
#endif
}

// Added to values below 2^e and taken off again, it leaves all their bits from 2^(e - 44) on: so few that sums of a
// block of them are exact. What is missing is below 2^(e - 44), exactly.
constexpr int taken_bits = 52 - block_bits;
double extractor(int e) {
  return std::ldexp(1.0, e + block_bits);
}

// Of a block, in each lane.
struct Extracted {
  Doubles leading = both(0.0), next = both(0.0);  // sums
  bool is_all = true;                             // is nothing left of any value?
};

Extracted extract(const double* x, double first, double second) {
  Extracted sum;
  Longs left{};
  for (std::size_t k = 0; k < block; k += lanes) {
    const Doubles v = load(x + k);
    const Doubles taken = (v + both(first)) - both(first);
    const Doubles rest = v - taken;
    const Doubles taken_next = (rest + both(second)) - both(second);
    sum.leading += taken;
    sum.next += taken_next;
    left |= rest != taken_next;
  }
  sum.is_all = (left[0] | left[1]) == 0;
  return sum;
}

double left_of(double x, double first, double second) {
  const double rest = x - ((x + first) - first);
  return rest - ((rest + second) - second);
}

}  // namespace

double largest_size(std::span<const double> values) {
  constexpr Longs magnitude_bits{0x7fffffffffffffffLL, 0x7fffffffffffffffLL};
  Doubles largest = both(0.0);
  std::size_t k = 0;
  for (; k + lanes <= values.size(); k += lanes) {
    const Longs bits = std::bit_cast<Longs>(load(values.data() + k)) & magnitude_bits;
    largest = larger(std::bit_cast<Doubles>(bits), largest);
  }
  if (k < values.size()) largest = larger(both(std::abs(values[k])), largest);
  return std::max(largest[0], largest[1]);
}

void ExactSum::add(std::span<const double> values) {
  for (; !values.empty(); values = values.subspan(std::min(block, values.size()))) {
    const std::span<const double> some = values.first(std::min(block, values.size()));
    add(some, largest_size(some));
  }
}

// Leading bits are taken from all values in a common unit, where sums are exact: ExtractVector of Rump, Ogita and
// Oishi, "Accurate floating-point summation part I", SIAM J. Sci. Comput. 31 (2008), 189, twice.
void ExactSum::add(std::span<const double> values, double largest) {
  const std::size_t count = values.size();
  if (count < few || !(largest < largest_extracted && largest > least_extracted)) {
    for (const double x : values) add(x);
    return;
  }
  std::array<double, block> padded;
  if (count < block) {
    std::copy_n(values.begin(), count, padded.begin());
    std::fill(padded.begin() + static_cast<std::ptrdiff_t>(count), padded.end(), 0.0);
  }
  const int e = std::ilogb(largest) + 1;
  const double first = extractor(e);
  const double second = extractor(e - taken_bits);
  const Extracted sum = extract(count < block ? padded.data() : values.data(), first, second);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    add(sum.leading[lane]);
    add(sum.next[lane]);
  }
  if (sum.is_all) [[likely]]
    return;
  for (const double x : values) add(left_of(x, first, second));
}

}  // namespace carom
