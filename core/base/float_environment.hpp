// How the processor rounds and what it does with the smallest numbers: part of the bits, and a host program may have
// changed both (libraries built with -ffast-math set flush-to-zero when they are loaded).
#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace carom {

// From its construction to its end, this thread rounds to nearest, keeps denormal numbers and traps nothing; then all
// is as it was, but for the flags of exceptions that have occurred. At the entries of the library and in every block of
// work that another thread runs.
class FloatEnvironment {
 public:
  FloatEnvironment();
  ~FloatEnvironment();
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

#ifdef __SSE2__
 private:
  unsigned before_ = _mm_getcsr();
};

// Bits 0 to 5 tell of exceptions that have occurred, which change no result.
inline constexpr unsigned float_control = ~0x3fU, usual_float_control = 0x1f80U;

// Writing the register costs more than reading it, and mostly it is as it should be.
inline FloatEnvironment::FloatEnvironment() {
  if ((before_ & float_control) != usual_float_control) _mm_setcsr(usual_float_control);
}

inline FloatEnvironment::~FloatEnvironment() {
  if ((before_ & float_control) != usual_float_control) _mm_setcsr(before_);
}
#else
 private:
  std::fenv_t before_{};
};

inline FloatEnvironment::FloatEnvironment() {
  std::fegetenv(&before_);
  std::fesetenv(FE_DFL_ENV);
}

inline FloatEnvironment::~FloatEnvironment() {
  std::fesetenv(&before_);
}
#endif

}  // namespace carom
